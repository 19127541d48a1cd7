// @ts-check
// The keyboard shortcuts, and the list of them behind “?”.
import { h } from "../dom.js";
import { openDialog } from "./dialog.js";

/** @typedef {{keys: string, what: string, match: (e: KeyboardEvent) => boolean, run: () => void,
 *   typing?: boolean}} Shortcut  `typing`: also while a text field has the focus */

/** Keys in a row, and those of the element that has the focus, for the list only. @type {[string, string][]} */
const ELSEWHERE = [
  ["G D", "Go to Design; likewise G T Transient, G C Compare & diagnose, G P Catalogue, G S Studies"],
  ["← → ↑ ↓", "Step a value, a choice, a cursor or the load line; Shift or Page keys: ten steps"],
  ["B", "In a time strip: put the second cursor, or take it away; a click puts it too"],
  ["Enter", "Apply the typed value; units and expressions are allowed: 30 cm, 20 kg, 20*9.81"],
  ["Esc", "Close a dialog, leave a field unchanged"],
  ["Drag, double click", "Zoom into a plot, reset the zoom"],
];

/** Keys after G that go to a place. @typedef {Record<string, () => void>} Places */

/** How long a key after G is waited for [ms]. */
const CHORD_MS = 1500;

/** @param {Shortcut[]} table @param {Places} places */
export function listenToKeys(table, places) {
  let since = -Infinity;
  addEventListener("keydown", (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    const typing = target.matches?.("input:not([type=range], [type=checkbox]), textarea, select");
    if (document.querySelector("dialog[open]")) return;
    const isChord = event.timeStamp - since < CHORD_MS, go = places[event.key.toLowerCase()];
    since = !typing && plain("g")(event) ? event.timeStamp : -Infinity;
    if (isChord && go && !typing && plain(event.key)(event)) {
      event.preventDefault();
      return go();
    }
    const hit = table.find((s) => s.match(event) && (!typing || s.typing));
    if (!hit) return;
    event.preventDefault();
    hit.run();
  });
}

/** @param {string} key */
export const plain = (key) => (/** @type {KeyboardEvent} */ e) =>
  e.key === key && !e.ctrlKey && !e.metaKey && !e.altKey;
/** @param {string} key @param {boolean} [shift] */
export const control = (key, shift = false) => (/** @type {KeyboardEvent} */ e) =>
  e.key.toLowerCase() === key && (e.ctrlKey || e.metaKey) && e.shiftKey === shift;

/** @param {Shortcut[]} table */
export function showShortcuts(table) {
  const rows = [...table.map((s) => [s.keys, s.what]), ...ELSEWHERE];
  openDialog(
    { title: "Keyboard and reference" },
    h(
      "dl",
      { class: "keys" },
      ...rows.flatMap(([keys, what]) => [
        h("dt", null, ...keys.split(" ").map((k) => h("kbd", null, k))),
        h("dd", null, what),
      ]),
    ),
    h(
      "p",
      { class: "reference-links" },
      "Reference, also offline: ",
      h("a", { href: "/help/python", target: "_blank" }, "Python"),
      ", ",
      h("a", { href: "/help/http", target: "_blank" }, "HTTP"),
      ".",
    ),
  );
}
