// @ts-check
// An equation in a narrow card: MathML does not wrap, so each formula has its own line.
import { h, mathml } from "../dom.js";

const WIDE_GAP = '<mspace width="1em" />';
const MATH = "http://www.w3.org/1998/Math/MathML";

/** @param {string} part */
const isWhole = (part) =>
  new DOMParser().parseFromString(`<mrow xmlns="${MATH}">${part}</mrow>`, "application/xml")
    .querySelector("parsererror") === null;

/** @param {string} markup of one or more formulas with a wide gap between them @returns {string[]} */
function formulas(markup) {
  const inner = /^(<math[^>]*>)<mrow>(.*)<\/mrow><\/math>$/s.exec(markup);
  const parts = inner?.[2].split(WIDE_GAP) ?? [];
  return inner && parts.every(isWhole)
    ? parts.map((part) => `${inner[1]}<mrow>${part}</mrow></math>`)
    : [markup];
}

/** @param {string} title of its effect @param {string | undefined} markup @param {string} latex is shown
 * without markup */
export const equationBox = (title, markup, latex) =>
  h(
    "div",
    { class: "equation", tabindex: 0, role: "region", "aria-label": `Equation of ${title}` },
    ...markup ? formulas(markup).map((one) => h("div", null, mathml(one))) : [h("code", null, latex)],
  );
