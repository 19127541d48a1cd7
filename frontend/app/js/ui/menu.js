// @ts-check
// A button that opens a list of actions; arrow keys move through it.
import { h } from "../dom.js";
import { openPopover } from "./dialog.js";

/** @typedef {{label: string, note?: string, run: () => void, checked?: boolean} | {heading: string}} Item */

/** `visible`: its label is also its name for screen readers.
 * @param {{label: import("../dom.js").Child, name: string, class?: string, visible?: boolean,
 *   items: () => Item[] | Promise<Item[]>}} o */
export function menuButton(o) {
  const button = h("button", {
    type: "button",
    class: o.class ?? "",
    "aria-haspopup": "menu",
    "aria-expanded": "false",
    "aria-label": o.visible ? null : o.name,
    title: o.name,
    onclick: async () => {
      const items = await o.items();
      openPopover(button, o.name, (close) => list(items, close), { role: "menu", kind: "menu" });
    },
  }, o.label);
  return button;
}

/** @param {Item[]} items @param {() => void} close */
function list(items, close) {
  /** @param {Item} item */
  const row = (item) => {
    if ("heading" in item) return h("div", { class: "menu-heading", role: "presentation" }, item.heading);
    const role = item.checked === undefined ? "menuitem" : "menuitemradio";
    return h(
      "button",
      {
        type: "button",
        role,
        "aria-checked": item.checked === undefined ? null : String(item.checked),
        onclick: () => {
          close();
          item.run();
        },
      },
      h("span", null, item.label),
      item.note ? h("small", null, item.note) : null,
    );
  };
  const rows = items.map(row);
  const box = h("div", {
    role: "none",
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      const buttons = rows.filter((r) => r.matches("button"));
      const at = buttons.indexOf(/** @type {any} */ (document.activeElement));
      /** @type {Record<string, number>} */
      const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 };
      if (!(e.key in to)) return;
      e.preventDefault();
      buttons.at(to[e.key] % buttons.length)?.focus();
    },
  }, ...rows);
  return box;
}
