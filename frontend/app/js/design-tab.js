// @ts-check
// The Design tab: it starts from a muscle or from a task, with a switch between both.
import { h } from "./dom.js";
import { effect } from "./reactive.js";
import { edit } from "./state.js";
import { designView } from "./views/design/index.js";
import { inTask } from "./views/sizing/document.js";
import { taskView } from "./views/sizing/index.js";

/** @typedef {import("./types.js").Sizing["mode"]} Mode */

/** @type {[Mode, string, string][]} */
const MODES = [
  ["muscle", "Muscle", "What a muscle does"],
  ["task", "Task", "Find a drive for a task"],
];

/** @param {Mode} mode */
const change = (mode) => edit((d) => ({ ...d, sizing: { ...d.sizing, mode } }), `from a ${mode}`);

const modeSwitch = () =>
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

export function designTab() {
  const muscle = designView();
  effect(() => {
    muscle.hidden = inTask.value;
  });
  return h("div", { class: "start-from" }, modeSwitch(), muscle, taskView());
}
