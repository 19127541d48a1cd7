// @ts-check
// The Design view starts from a muscle or from a task: the switch between both, the place of the task's page,
// which is fetched when it is first shown, and its keys.
import { h } from "../../dom.js";
import { apart, computed, effect } from "../../reactive.js";
import { later } from "../../ui/later.js";
import { doc, edit, look, view } from "../../state.js";

/** @typedef {import("./document.js").Sizing["mode"]} Mode */

export const inTask = computed(() => doc.value.sizing.mode === "task");

/** @type {[Mode, string, string][]} */
const MODES = [
  ["muscle", "Muscle", "What a muscle does"],
  ["task", "Task", "Which drive does what is wanted"],
];

/** The muscle of the Design view, wherever one comes from. */
export const showMuscle = () =>
  look((d) => ({ ...d, view: "design", sizing: { ...d.sizing, mode: "muscle" } }));

/** @param {Mode} mode */
const change = (mode) => edit((d) => ({ ...d, sizing: { ...d.sizing, mode } }), `from a ${mode}`);

export const modeSwitch = () =>
  h(
    "div",
    { class: "segments mode-switch", role: "radiogroup", "aria-label": "Start from" },
    ...MODES.map(([id, label, title]) =>
      h("button", {
        type: "button",
        role: "radio",
        title,
        "aria-checked": () => String((inTask.value ? "task" : "muscle") === id),
        onclick: () => change(id),
      }, label)
    ),
  );

/** The Task side of the view. @returns {HTMLElement} */
export function taskSide() {
  const page = later(async () => (await import("./page.js")).taskPage);
  const place = h("div", { class: "task-side", hidden: () => !inTask.value });
  effect(() => {
    if (inTask.value && !place.hasChildNodes()) place.append(apart(page));
  });
  return place;
}

/** @type {import("../../ui/shortcuts.js").Shortcut[]} */
export const TASK_KEYS = [{
  keys: "Ctrl Enter",
  what: "Design, Task: propose drives",
  typing: true,
  match: (e) => e.key === "Enter" && (e.ctrlKey || e.metaKey) && view.peek() === "design" && inTask.peek(),
  run: async () => {
    document.activeElement?.dispatchEvent(new Event("change")); // what is still being typed counts
    (await import("./model.js")).propose();
  },
}];
