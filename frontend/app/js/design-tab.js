// @ts-check
// The Design tab: it starts from a muscle or from a task, with a switch between both and one line to ask for either.
import { h } from "./dom.js";
import { effect } from "./reactive.js";
import { doc, edit, units } from "./state.js";
import { number, scaleOf, toShown } from "./format.js";
import { at, put } from "./paths.js";
import { segments } from "./ui/segments.js";
import { askLine, designView, muscleWords, takeAsked } from "./views/design/index.js";
import { inTask } from "./views/sizing/document.js";
import { taskView } from "./views/sizing/index.js";

/** @typedef {import("./types.js").Sizing["mode"]} Mode */
/** @typedef {import("./types.js").S["AskedLine"]} AskedLine */

/** @type {[Mode, string, string][]} */
const MODES = [
  ["muscle", "Muscle", "What a muscle does"],
  ["task", "Find a drive", "Which drive does a task"],
];

/** @param {Mode} mode */
const change = (mode) => edit((d) => ({ ...d, sizing: { ...d.sizing, mode } }), `from a ${mode}`);

const modeSwitch = () =>
  segments("Start from", MODES, () => inTask.value ? "task" : "muscle", change, "segments mode-switch");

/** What a line can state of a task: path, its field in the line, quantity, and the words around it.
 * @type {[string, "mass" | "load" | "stroke" | "time" | "pressure" | "room", import("./format.js").Quantity, string][]} */
const OF_TASK = [
  ["load.mass", "mass", "mass", "lift #"],
  ["load.force", "load", "force", "against #"],
  ["stroke", "stroke", "length", "by #"],
  ["time", "time", "time", "in #"],
  ["supply_pressure", "pressure", "pressure", "at #"],
  ["limits.max_length", "room", "length", "with # of room"],
];

/** The task as a line. */
const taskWords = () =>
  OF_TASK.flatMap(([path, , quantity, words]) => {
    const si = at(doc.value.sizing.task, path), s = scaleOf(quantity, units.value);
    return si ? words.replace("#", `${number(toShown(si, s), s.digits)} ${s.unit}`) : [];
  }).join(" ");

/** Whether a line asks for a drive: it says how fast, or in how much room, or how far without a muscle.
 * @param {AskedLine} line */
const isTask = (line) =>
  line.time !== null || line.room !== null || (line.stroke !== null && line.muscle === null);

/** @param {AskedLine} line */
async function take(line) {
  if (!isTask(line) && !(inTask.peek() && line.muscle === null)) {
    if (inTask.peek()) change("muscle");
    return takeAsked(line);
  }
  edit((d) => {
    let next = d.sizing.task;
    for (const [path, name] of OF_TASK) {
      const value = line[name];
      // A mass is its own field; its weight is no further force.
      if (value !== null && !(name === "load" && line.mass !== null)) next = put(next, path, value);
    }
    return { ...d, sizing: { ...d.sizing, mode: "task", arrangement: "lift", task: next } };
  }, "asked");
  (await import("./views/sizing/model.js")).propose();
}

export function designTab() {
  const muscle = designView();
  effect(() => {
    muscle.hidden = inTask.value;
  });
  const words = () => inTask.value ? taskWords() : muscleWords.value;
  return h(
    "div",
    { class: "start-from" },
    h("div", { class: "ask-row" }, modeSwitch(), askLine(words, take)),
    muscle,
    taskView(),
  );
}
