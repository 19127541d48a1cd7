// @ts-check
// Results: the verdict, the operating points at the load, characteristics per pressure.
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { figure } from "../../facts.js";
import { units } from "../../state.js";
import { design } from "../../muscle/document.js";
import { aligned, number, readable, scaleOf, withUnit } from "../../format.js";
import { shown } from "../../plots/axes.js";
import { subscript } from "../../ui/field.js";
import { flag } from "../../ui/flag.js";
import { curves, fault } from "./model.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {import("../../facts.js").DeclaredFigure} DeclaredFigure */

const POINT =
  /** @type {const} */ (["pressure", "contraction", "length", "stiffness", "stiffness_closed", "diameter"]);
const LOOP = /** @type {const} */ (["pressure", "stroke", "share", "pressure_width"]);
const CHARACTERISTICS = /** @type {const} */ (["pressure", "blocked_force", "free_contraction", "max_work"]);

/** @typedef {{cells: (number | null)[], mark?: string}} Row */

/** A table with a row for each pressure; before the first answer they are empty, so that nothing moves later.
 * @param {string} title @param {string} group of the figures @param {readonly string[]} names of the columns
 * @param {() => Row[]} rows @param {boolean} [narrow] heads are symbols */
function table(title, group, names, rows, narrow) {
  const columns = names.map((name) => figure(`${group}.${name}`));
  const emptyRows = () =>
    design.value.pressures.map(() => ({ cells: columns.map(() => null), mark: undefined }));
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": title },
    h(
      "table",
      { class: "data" },
      h("caption", { class: "unseen" }, title),
      h("thead", null, h("tr", null, ...columns.map((one, i) => head(one, narrow || i === 0)))),
      h("tbody", null, () => {
        const all = curves.value ? rows() : emptyRows();
        const texts = columns.map(({ quantity }, i) => column(all.map((r) => r.cells[i]), quantity));
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

/** @param {DeclaredFigure} one @param {boolean} [narrow] */
const head = ({ label, symbol, definition, quantity }, narrow) =>
  h(
    "th",
    { scope: "col", title: narrow ? `${label}: ${definition}` : definition, abbr: label },
    narrow ? subscript(symbol) : label,
    h("small", null, () => scaleOf(quantity, units.value).unit),
  );

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
    cells: POINT.map((name) => o[name]),
    mark: c && o.flags.length ? explain(c, o.flags) : undefined,
  }));
}

/** Distance of the branches of filling and venting at each pressure. */
function loopRows() {
  const loop = curves.value?.over_pressure?.loop;
  return (loop?.pressure ?? []).map((p, i) => ({
    cells: LOOP.map((name) => name === "pressure" ? p : loop?.[name][i] ?? null),
  }));
}

function characteristics() {
  return (curves.value?.characteristics ?? []).map((c) => ({
    cells: CHARACTERISTICS.map((name) => c[name]),
    mark: c.free_contraction_note ?? undefined,
  }));
}

/** Remarks that are no limits of the muscle. */
const NOTES = ["unverified", "outside_measured_range", "stretched"];

/** Whether the muscle holds the load within its limits, and which limits it crosses. */
function verdict() {
  const c = curves.value;
  if (!c) {
    return h("p", { class: "muted" }, fault.value ? "No valid model yet." : "Waiting for curves…");
  }
  const hard = c.flags.filter((f) => !NOTES.includes(f.code)),
    notes = c.flags.filter((f) => NOTES.includes(f.code));
  const best = c.holds, sound = best !== null && best.flags.length === 0;
  const grade = !sound ? "bad" : hard.length ? "warn" : "good";
  const text = (/** @type {"pressure" | "force" | "contraction" | "length"} */ name) =>
    withUnit(best?.[name], figure(`operating_point.${name}`).quantity, units.value);
  const reach = best
    ? `${text("pressure")} holds ${text("force")} at ${text("contraction")} contraction (${
      text("length")
    } long) ${c.branch}.`
    : `None of these pressures holds ${loadText.value}.`;
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

/** The used share of each limit as a bar, full at the limit. */
function margins() {
  const c = curves.value;
  if (!c) return h("div", { class: "margins" });
  if (!c.limits_used.length) return null; // the muscle has no known limit
  const { label, definition } = figure("muscle_limits.share");
  return h(
    "div",
    { class: "margins", title: `${label}: ${definition}` },
    ...c.limits_used.map(({ name, used, limit, share }) => {
      const one = figure(`muscle_limits.${name}`);
      return h(
        "div",
        { class: share > 1.0001 ? "over" : "" },
        h("span", { title: one.definition }, one.label),
        h("span", { class: "bar" }, h("i", { style: `width:${Math.min(100, share * 100)}%` })),
        h(
          "span",
          { class: "num" },
          `${withUnit(used, one.quantity, units.value)} of ${withUnit(limit, one.quantity, units.value)}`,
        ),
      );
    }),
  );
}

const loadText = computed(() => withUnit(design.value.load, "force", units.value));
const branch = () => curves.value?.branch ?? "";

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
        h("span", { class: "muted" }, () => `${loadText.value} ${branch()}`),
      ),
      table("Operating points at the load", "operating_point", POINT, operatingPoints, true),
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
      table("Width of the loop at the load", "loop", LOOP, loopRows, true),
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
      h(
        "div",
        { class: "card-head" },
        h("h2", null, "Characteristics"),
        h("span", { class: "muted" }, branch),
      ),
      table("Characteristics per pressure", "characteristics", CHARACTERISTICS, characteristics),
    ),
  ];
}
