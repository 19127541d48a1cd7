// @ts-check
// The tables: operating points at the load, loop, characteristics per pressure.
import { h } from "../../dom.js";
import { figure } from "../../facts.js";
import { units } from "../../state.js";
import { aligned, number, readable, scaleOf } from "../../format.js";
import { shown } from "../../plots/axes.js";
import { subscript } from "../../ui/field.js";
import { answeredLoad, curves, pressuresShown } from "./model.js";

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
    pressuresShown.value.map(() => ({ cells: columns.map(() => null), mark: undefined }));
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

/** All figures by pressure, in tables that open below the plots. */
export const tables = () =>
  h(
    "details",
    { class: "card tables" },
    h(
      "summary",
      null,
      h("b", null, "Tables"),
      h(
        "span",
        { class: "muted" },
        " by pressure: at the load, loop of filling and venting, characteristics",
      ),
    ),
    h(
      "div",
      { class: "three" },
      part(
        "At the load",
        () => `${answeredLoad.value} ${branch()}`,
        table("Operating points at the load", "operating_point", POINT, operatingPoints, true),
      ),
      part(
        "Loop of filling and venting",
        () => answeredLoad.value,
        table("Width of the loop at the load", "loop", LOOP, loopRows, true),
        h(
          "p",
          { class: "muted" },
          "Distance between the branches of a slow loop, in length and in pressure. An ideal muscle has none.",
        ),
      ),
      part(
        "Characteristics",
        branch,
        table("Characteristics per pressure", "characteristics", CHARACTERISTICS, characteristics),
      ),
    ),
  );

/** @param {string} title @param {() => string} of @param {import("../../dom.js").Child[]} body */
const part = (title, of, ...body) =>
  h(
    "section",
    { "aria-label": title },
    h("div", { class: "card-head" }, h("h3", null, title), h("span", { class: "muted" }, of)),
    ...body,
  );

const branch = () => curves.value?.branch ?? "";
