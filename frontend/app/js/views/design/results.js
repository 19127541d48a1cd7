// @ts-check
// Results: the verdict, the operating points at the load, characteristics per pressure.
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { units } from "../../state.js";
import { design } from "../../muscle/document.js";
import { aligned, number, readable, scaleOf, withUnit } from "../../format.js";
import { shown } from "../../plots/axes.js";
import { flag } from "../../ui/flag.js";
import { curves, fault } from "./model.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {[title: string, quantity: Quantity]} Column */
/** @typedef {{cells: (number | null)[], mark?: string}} Row */

/** @param {Column[]} columns @returns {Row[]} */
const emptyRows = (columns) => design.value.pressures.map(() => ({ cells: columns.map(() => null) }));

/** A table with a row for each pressure; before the first answer they are empty, so that nothing moves later.
 * @param {string} title @param {Column[]} columns @param {() => Row[]} rows */
function figures(title, columns, rows) {
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": title },
    h(
      "table",
      { class: "data" },
      h("caption", { class: "unseen" }, title),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          ...columns.map(([name, quantity]) =>
            h("th", { scope: "col" }, name, h("small", null, () => scaleOf(quantity, units.value).unit))
          ),
        ),
      ),
      h("tbody", null, () => {
        const all = curves.value ? rows() : emptyRows(columns);
        const texts = columns.map(([, quantity], i) => column(all.map((r) => r.cells[i]), quantity));
        return all.map(({ mark }, k) =>
          h(
            "tr",
            { class: mark ? "marked" : null, title: mark ?? null },
            ...texts.map((column, i) => h(i ? "td" : "th", i ? null : { scope: "row" }, column[k])),
          )
        );
      }),
    ),
  );
}

/** @param {(number | null)[]} values in SI @param {Quantity} quantity */
function column(values, quantity) {
  const numbers = shown(values, quantity, units.value);
  return quantity === "pressure" ? numbers.map((v) => number(v ?? NaN, 2)) : aligned(numbers);
}

/** The flags of a row in words. @param {Curves} c @param {string[]} codes */
const explain = (c, codes) =>
  codes.map((code) => c.flags.find((f) => f.code === code)?.message ?? readable(code)).join("; ");

function operatingPoints() {
  const c = curves.value;
  return (c?.operating_points ?? []).map((o) => ({
    cells: [o.pressure, o.contraction, o.length, o.stiffness, o.stiffness_closed, o.diameter],
    mark: c && o.flags.length ? explain(c, o.flags) : undefined,
  }));
}

/** Distance of the branches of filling and venting at each pressure. */
function loopRows() {
  const loop = curves.value?.over_pressure?.loop;
  return (loop?.pressure ?? []).map((p, i) => ({
    cells: [p, loop?.stroke[i] ?? null, loop?.share[i] ?? null, loop?.pressure_width[i] ?? null],
  }));
}

function characteristics() {
  return (curves.value?.characteristics ?? []).map((c) => ({
    cells: [c.pressure, c.blocked_force, c.free_contraction, c.max_work],
    mark: c.free_contraction_flag ?? undefined,
  }));
}

/** Remarks that are no limits of the muscle. */
const NOTES = ["unverified", "outside_measured_range"];

/** Whether the muscle holds the load within its limits, and which limits it crosses. */
function verdict() {
  const c = curves.value;
  if (!c) {
    return h("p", { class: "muted" }, fault.value ? "No valid model yet." : "Waiting for curves…");
  }
  const hard = c.flags.filter((f) => !NOTES.includes(f.code)),
    notes = c.flags.filter((f) => NOTES.includes(f.code));
  const points = c.operating_points.filter((o) => o.contraction != null);
  const sound = points.filter((o) => !o.flags.some((code) => !NOTES.includes(code)));
  const best = sound.at(-1) ?? points.at(-1);
  const grade = !sound.length ? "bad" : hard.length ? "warn" : "good";
  const reach = best
    ? `${withUnit(best.pressure, "pressure", units.value)} holds ${
      withUnit(best.force, "force", units.value)
    } at ${withUnit(best.contraction, "ratio", units.value)} contraction (${
      withUnit(best.length, "length", units.value)
    } long).`
    : `None of these pressures holds ${withUnit(design.value.load, "force", units.value)}.`;
  return [
    h(
      "p",
      { class: `verdict ${grade}` },
      icon(grade === "good" ? "check" : "warn"),
      h(
        "span",
        null,
        { good: "Within all limits. ", warn: "", bad: best ? "Outside the limits: " : "" }[grade],
        reach,
      ),
    ),
    ...[...hard, ...notes].map((f) => flag(f, NOTES.includes(f.code))),
  ];
}

/** What is left of each limit, as one bar each: empty at the limit, full at 100 % or more. */
function margins() {
  const c = curves.value;
  if (!c) return h("div", { class: "margins" });
  const most = (/** @type {(number | null | undefined)[]} */ all) => Math.max(...all.map((v) => v ?? 0));
  /** @type {[string, number, number | null, Quantity][]} */
  const rows = [
    ["Pressure", most(c.pressure), c.limits.max_pressure, "pressure"],
    ["Load", design.value.load, c.limits.max_force, "force"],
    ["Contraction", most(c.operating_points.map((o) => o.contraction)), c.limits.max_contraction, "ratio"],
  ];
  const known = rows.filter(([, , limit]) => limit);
  if (!known.length) return null; // the muscle has no known limit
  return h(
    "div",
    { class: "margins" },
    ...known.map(([name, used, limit, quantity]) => {
      const left = (limit ?? 0) / used - 1;
      return h(
        "div",
        { class: left < -1e-4 ? "over" : "" },
        h("span", null, name),
        h("span", { class: "bar" }, h("i", { style: `width:${100 * Math.min(1, Math.max(0, left))}%` })),
        h(
          "span",
          { class: "num" },
          `${withUnit(used, quantity, units.value)} of ${withUnit(limit, quantity, units.value)}`,
        ),
      );
    }),
  );
}

const loadText = computed(() => withUnit(design.value.load, "force", units.value));

export function resultCards() {
  return [
    h(
      "section",
      { class: "card", "aria-label": "Verdict" },
      h("div", { class: "card-head" }, h("h2", null, "Verdict")),
      h("div", { class: "verdicts" }, verdict),
      margins,
    ),
    h(
      "section",
      { class: "card", "aria-label": "Operating points" },
      h(
        "div",
        { class: "card-head" },
        h("h2", null, "At the load"),
        h("span", { class: "muted" }, () => loadText.value),
      ),
      figures("Operating points at the load", [
        ["P", "pressure"],
        ["ε", "ratio"],
        ["L", "length"],
        ["k open", "stiffness"],
        ["k closed", "stiffness"],
        ["D", "length"],
      ], operatingPoints),
    ),
    h(
      "section",
      { class: "card", "aria-label": "Hysteresis loop" },
      h(
        "div",
        { class: "card-head" },
        h("h2", null, "Loop of filling and venting"),
        h("span", { class: "muted" }, () => loadText.value),
      ),
      figures("Width of the loop at the load", [
        ["P", "pressure"],
        ["ΔL", "length"],
        ["of L₀", "ratio"],
        ["ΔP", "pressure"],
      ], loopRows),
      h(
        "p",
        { class: "muted" },
        "Distance between the branches of a slow loop, in length and in pressure. " +
          "An ideal muscle has none.",
      ),
    ),
    h(
      "section",
      { class: "card", "aria-label": "Characteristics" },
      h("div", { class: "card-head" }, h("h2", null, "Characteristics")),
      figures("Characteristics per pressure", [
        ["P", "pressure"],
        ["Blocked force", "force"],
        ["Free contraction", "ratio"],
        ["Work", "energy"],
      ], characteristics),
    ),
  ];
}
