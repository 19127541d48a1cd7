// @ts-check
// One choice of a few, as buttons side by side. They are one tab stop; arrow keys move the choice.
import { h } from "../dom.js";

/** Value, label, and what it means. @template T
 * @typedef {[T, import("../dom.js").Child, string?]} Option */

/** @template T @param {string} label @param {Option<T>[]} options @param {() => T | null} get
 * @param {(value: T) => void} set @param {string} [kind] its CSS class */
export function segments(label, options, get, set, kind = "segments") {
  const place = () => options.findIndex(([value]) => value === get());
  /** @param {KeyboardEvent} event */
  const move = (event) => {
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const next = (Math.max(0, place()) + by + options.length) % options.length;
    const name = box.getAttribute("aria-label");
    set(options[next][0]);
    // The choice may have built the group anew.
    const now = box.isConnected ? box : document.querySelector(`[role=radiogroup][aria-label="${name}"]`);
    /** @type {HTMLElement | undefined} */ (now?.children[next])?.focus();
  };
  const box = h(
    "div",
    { class: kind, role: "radiogroup", "aria-label": label, onkeydown: move },
    ...options.map(([value, text, title], i) =>
      h("button", {
        type: "button",
        role: "radio",
        title,
        "data-key": `${label} ${value}`, // what was built anew finds its focus by this
        tabindex: () => Math.max(0, place()) === i ? 0 : -1,
        "aria-checked": () => String(get() === value),
        onclick: () => set(value),
      }, ...[text].flat())
    ),
  );
  return box;
}
