// @ts-check
// The command palette (Ctrl K): views, presets, effects and actions, found by typing a part of their name.
import { h } from "../dom.js";
import { effect, signal } from "../reactive.js";
import { openDialog } from "./dialog.js";

/** `also`: what else it is found by. @typedef {{label: string, kind: string, also?: string, note?: string, run: () => unknown}} Command */

const MOST = 60;

/** How well a name fits what was typed: 0 = not at all. Every word must occur; at the start of a word counts more.
 * @param {Command} command @param {string[]} words */
function fit({ label, kind, also = "" }, words) {
  const name = label.toLowerCase(), text = `${name} ${kind} ${also}`.toLowerCase();
  let score = 1;
  for (const word of words) {
    if (!text.includes(word)) return 0;
    if (name.startsWith(word)) score += 3;
    else if (name.includes(` ${word}`)) score += 2;
    else if (name.includes(word)) score += 1;
  }
  return score;
}

/** @param {Command[]} all @param {string} typed */
export function matching(all, typed) {
  const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
  return all.map((command) => ({ command, score: fit(command, words) })).filter(({ score }) => score)
    .sort((a, b) => b.score - a.score).slice(0, MOST).map(({ command }) => command);
}

/** @param {Command[]} all @param {string} [title] */
export function openPalette(all, title = "Go to, or add") {
  const typed = signal(""), at = signal(0), shown = signal(all.slice(0, MOST));
  const idOf = (/** @type {number} */ i) => `command-${i}`;
  /** @param {Command | undefined} command */
  const take = (command) => {
    if (!command) return;
    dialog.close();
    command.run();
  };
  const input = h("input", {
    type: "text",
    role: "combobox",
    autocomplete: "off",
    spellcheck: "false",
    "aria-label": "Search views, presets, effects and actions",
    "aria-expanded": "true",
    "aria-controls": "commands",
    "aria-activedescendant": () => shown.value.length ? idOf(at.value) : null,
    oninput: () => (typed.value = input.value),
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      const last = shown.peek().length - 1;
      if (e.key === "Enter") take(shown.peek()[at.peek()]);
      else if (e.key === "ArrowDown") at.value = Math.min(last, at.peek() + 1);
      else if (e.key === "ArrowUp") at.value = Math.max(0, at.peek() - 1);
      else return;
      e.preventDefault();
      list.querySelector(`#${idOf(at.peek())}`)?.scrollIntoView({ block: "nearest" });
    },
  });
  const list = h(
    "div",
    { id: "commands", role: "listbox", "aria-label": "Commands" },
    () =>
      shown.value.map((command, i) =>
        h(
          "div",
          {
            id: idOf(i),
            role: "option",
            class: "command",
            "aria-selected": () => String(at.value === i),
            onclick: () => take(command),
          },
          h("span", null, command.label),
          h("small", null, command.note ?? command.kind),
        )
      ),
  );
  const dialog = openDialog(
    { title },
    input,
    list,
    h("p", { class: "hint", role: "status" }, () => shown.value.length ? "" : "Nothing has this name."),
  );
  dialog.classList.add("palette");
  const stop = effect(() => {
    shown.value = matching(all, typed.value);
    at.value = 0;
  });
  dialog.addEventListener("close", stop);
  input.focus();
}
