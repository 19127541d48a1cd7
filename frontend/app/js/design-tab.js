// @ts-check
// The Design tab: it starts from a muscle or from a task, with a switch between both.
import { h } from "./dom.js";
import { effect } from "./reactive.js";
import { edit } from "./state.js";
import { askLine, designView, takeAsked } from "./views/design/index.js";
import { inTask } from "./views/sizing/document.js";
import { taskView } from "./views/sizing/index.js";
import { segments } from "./ui/segments.js";

/** @typedef {import("./types.js").Sizing["mode"]} Mode */

/** @type {[Mode, string, string][]} */
const MODES = [
  ["muscle", "Muscle", "What a muscle does"],
  ["task", "Find a drive", "Which drive does a task"],
];

/** @param {Mode} mode */
const change = (mode) => edit((d) => ({ ...d, sizing: { ...d.sizing, mode } }), `from a ${mode}`);

const modeSwitch = () =>
  segments("Start from", MODES, () => inTask.value ? "task" : "muscle", change, "segments mode-switch");

export function designTab() {
  const muscle = designView();
  effect(() => {
    muscle.hidden = inTask.value;
  });
  return h("div", { class: "start-from" }, h("div", { class: "ask-row" }, modeSwitch(), askLine(takeAsked)), muscle, taskView());
}
