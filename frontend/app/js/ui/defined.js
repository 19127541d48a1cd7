// @ts-check
// A figure's name or value that says on hover and on focus how it is defined.
import { h } from "../dom.js";

/** @param {import("../facts.js").DeclaredFigure} figure @param {import("../dom.js").Child} [text] its label */
export const defined = ({ label, definition }, text = label) =>
  h("span", {
    class: "defined",
    tabindex: 0,
    role: "note",
    "aria-label": `${text}: ${definition}`,
    "data-tip": definition,
  }, text);
