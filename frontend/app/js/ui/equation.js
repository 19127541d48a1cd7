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

/** Size of the letters of a formula, and the least down to which one that is too wide is set smaller [px]. */
const FULL_PX = 15, LEAST_PX = 9;
/** Gaps in a formula do not shrink as its letters do. */
const SPARE = 0.96;

/** Sets the formulas as large as their box allows; one that is too wide even when small is scrolled.
 * @param {HTMLElement} box */
function fit(box) {
  box.style.fontSize = "";
  const over = Math.max(...[...box.children].map((one) => one.scrollWidth / (one.clientWidth || 1)));
  if (over > 1) box.style.fontSize = `${Math.max(LEAST_PX, (SPARE * FULL_PX) / over).toFixed(1)}px`;
}

const resized = new ResizeObserver((changes) => {
  for (const { target } of changes) fit(/** @type {HTMLElement} */ (target));
});

/** @param {string} title of its effect @param {string | undefined} markup @param {string} latex is shown
 * without markup */
export function equationBox(title, markup, latex) {
  const box = h(
    "div",
    { class: "equation", tabindex: 0, role: "region", "aria-label": `Equation of ${title}` },
    ...markup ? formulas(markup).map((one) => h("div", null, mathml(one))) : [h("code", null, latex)],
  );
  resized.observe(box);
  return box;
}
