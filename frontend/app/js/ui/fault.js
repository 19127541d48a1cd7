// @ts-check
// The notice of a view when the server refused its request: the message, and a button to the field or to retry.
import { h, icon } from "../dom.js";

/** Puts the cursor into the field of this key; without one, into a field of the part it belongs to
 * ("load.mass", then "load").
 * @param {string} key @param {string} [within] selector of the part of the page to search
 * @returns {boolean} whether there is one */
export function goToField(key, within = "body") {
  const root = document.querySelector(within);
  for (let name = key; name; name = name.replace(/\.?[^.]*$/, "")) {
    const box = root?.querySelector(`[data-field="${CSS.escape(name)}"]`) ?? document.getElementById(name);
    box?.closest("details")?.setAttribute("open", "");
    const input = box?.matches("input, select") ? box : box?.querySelector("input, select, textarea");
    if (input instanceof HTMLElement) {
      input.focus();
      return true;
    }
  }
  return false;
}

/** @param {string} text @param {{goTo?: (() => void) | null, retry: () => void}} o  `goTo`: to the field, if the
 *   message belongs to one; else `retry` is offered */
export const faultNotice = (text, { goTo = null, retry }) =>
  h(
    "div",
    { class: "notice bad", role: "alert" },
    icon("warn"),
    h("span", null, text),
    goTo
      ? h("button", { type: "button", onclick: goTo }, "Go to the field")
      : h("button", { type: "button", onclick: retry }, "Try again"),
  );
