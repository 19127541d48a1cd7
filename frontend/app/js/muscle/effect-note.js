// @ts-check
// What is known about an effect: cause, equation, parameters with sources, similar effects, references.
import { h, mathml } from "../dom.js";
import { equationBox } from "../ui/equation.js";
import { units } from "../state.js";
import { effectsById } from "../store.js";
import { capitalized, number, plainScale, quantityOf, scaleOf, toShown } from "../format.js";
import { gradeTag } from "../ui/sources.js";

/** @param {import("../types.js").Parameter} p */
function parameterRow(p) {
  const quantity = quantityOf(p.unit, p.name);
  const s = quantity ? scaleOf(quantity, units.peek()) : plainScale(p.unit);
  const show = (/** @type {number} */ si) => number(toShown(si, s), s.digits);
  return h(
    "tr",
    null,
    h("td", null, mathml(p.symbol_mathml)),
    h(
      "td",
      { class: "text" },
      p.description,
      h("small", { class: "source" }, p.source.text, " ", gradeTag(p.source.grade)),
    ),
    h("td", null, show(p.default)),
    h("td", null, `${show(p.lower)} … ${show(p.upper)}`),
    h("td", { class: "text" }, s.unit || "–"),
  );
}

/** @param {import("../types.js").Effect} e @param {boolean} [pictured] signature and twins stand beside it in pictures */
export function effectNote(e, pictured = false) {
  const titleOf = (/** @type {string} */ id) => effectsById.peek().get(id)?.title ?? id;
  return h(
    "div",
    null,
    h("h3", null, e.title),
    h("p", null, e.cause),
    equationBox(e.title, e.equation_mathml, e.equation),
    e.parameters.length
      ? h(
        "table",
        { class: "data small parameters-table" },
        h(
          "thead",
          null,
          h(
            "tr",
            null,
            h("td", null),
            ...["Parameter", "Default", "Range", "Unit"].map((t, i) =>
              h("th", { scope: "col", class: i % 3 ? "" : "text" }, t)
            ),
          ),
        ),
        h("tbody", null, ...e.parameters.map(parameterRow)),
      )
      : null,
    pictured ? null : h("h4", null, "What it looks like in the residual"),
    pictured ? null : h("p", null, `${capitalized(e.signature.text)}.`),
    e.kinds.length ? h("p", { class: "muted" }, `Visible in ${e.kinds.join(", ")} tests.`) : null,
    e.confused_with.length && !pictured ? h("h4", null, "Easily confused with") : null,
    e.confused_with.length && !pictured
      ? h(
        "ul",
        { class: "plain" },
        ...e.confused_with.map((c) => h("li", null, h("b", null, titleOf(c.effect)), `: ${c.separated_by}`)),
      )
      : null,
    e.references.length ? h("h4", null, "References") : null,
    h("ul", { class: "plain" }, ...e.references.map((r) => h("li", null, r.text, " ", gradeTag(r.grade)))),
  );
}
