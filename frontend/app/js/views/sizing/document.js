// @ts-check
// The task in the document: as /api/sizings takes it, numbers in SI, only what differs from the defaults; and what
// is shown of the answer. The server checks what the numbers mean.
import { inSi } from "../../drive/document.js";
import { LEVER } from "../../drive/task.js";
import { at, isObject, put } from "../../paths.js";
import { computed } from "../../reactive.js";
import { addPart, doc } from "../../state.js";

/** @typedef {import("../../types.js").Aim} Aim */
/** @typedef {import("../../types.js").Sizing} Sizing */
/** @typedef {import("../../types.js").Task} Task */
/** @typedef {import("../../types.js").TaskArrangement} Arrangement */

/** @type {Aim[]} */
export const AIM_NAMES = ["air", "time", "length", "reserve", "stiffness"];
const ARRANGEMENTS = ["lift", "lever", "antagonist"];
const USUAL_PAIR = { angle: Math.PI / 3, torque: 2, inertia: 0.02 };

/** @returns {Sizing} an example task: that of the preset lift-20kg */
const defaultSizing = () => ({
  mode: "muscle",
  arrangement: "lift",
  task: {
    load: { mass: 20 },
    stroke: 0.06,
    time: 0.5,
    limits: { max_length: 0.6, max_diameter: 0.06 },
    catalogue: { muscles: ["DMSP-10", "DMSP-20", "DMSP-40"], valves: ["MPYE-5-1/8-HF"] },
  },
  selected: 0,
  axes: ["air", "time"],
});

/** The same task in another arrangement, with the fields that arrangement requires.
 * @param {Sizing} sizing @param {Arrangement} arrangement @returns {Partial<Sizing>} */
export function rearranged({ task }, arrangement) {
  let next = task;
  if (arrangement === "lever" && at(task, "load.lever_ratio") === undefined) {
    next = put(next, "load.lever_ratio", LEVER);
  }
  if (arrangement === "antagonist" && !at(task, "load.pair")) next = put(next, "load.pair", USUAL_PAIR);
  return { arrangement, task: next };
}

/** A task document of a file or preset, with quantities such as "20 kg" converted to SI.
 * @param {Task} document @returns {Partial<Sizing>} */
export function opened(document) {
  const { schema: _schema, title, catalogue, rank_by: rank, ...rest } = document;
  const { muscles, valves, tubes, ...more } = catalogue ?? {};
  const task = {
    ...(title ? { title } : {}),
    ...inSi(rest),
    ...(catalogue
      ? { catalogue: JSON.parse(JSON.stringify({ muscles, valves, tubes, ...inSi(more) })) }
      : {}),
    ...(rank ? { rank_by: rank } : {}),
  };
  const ratio = at(task, "load.lever_ratio");
  const arrangement = at(task, "load.pair") ? "antagonist" : ratio && ratio !== 1 ? "lever" : "lift";
  return { arrangement, task, selected: 0 };
}

/** A task of this program or of the command line, as opposed to a drive or a document of this page.
 * @param {unknown} raw @returns {raw is Task} */
export const isTaskDocument = (raw) =>
  isObject(raw) && isObject(raw.load) && !("design" in raw) && !("muscle" in raw) && isPlain(raw);

/** Only numbers, texts, lists and objects, not nested deeply. @param {unknown} x @param {number} [depth]
 * @returns {boolean} */
function isPlain(x, depth = 0) {
  if (x === null || typeof x === "string" || (typeof x === "number" && Number.isFinite(x))) return true;
  return depth < 4 && typeof x === "object" && Object.values(x).every((one) => isPlain(one, depth + 1));
}

/** Reads the task of a link or file; missing values take their defaults, as in links older than the task.
 * @param {unknown} raw @returns {Sizing} @throws {Error} says which part is invalid */
function readSizing(raw) {
  const start = defaultSizing();
  if (raw === undefined) return start;
  if (!isObject(raw)) throw new Error("“sizing” is not an object");
  const { mode, arrangement, task = start.task, selected, axes } = raw;
  const parts = ["load", "limits", "catalogue", "uncertainty"];
  const isTask = isObject(task) && isPlain(task) &&
    parts.every((key) => task[key] === undefined || isObject(task[key]));
  if (!isTask) throw new Error("“sizing.task” is invalid");
  const isAxes = Array.isArray(axes) && axes.length === 2 && axes.every((a) => AIM_NAMES.includes(a));
  return {
    mode: mode === "task" ? "task" : "muscle",
    arrangement: ARRANGEMENTS.includes(arrangement) ? arrangement : start.arrangement,
    task,
    selected: Number.isInteger(selected) && selected >= 0 ? selected : 0,
    axes: isAxes ? [axes[0], axes[1]] : start.axes,
  };
}

addPart("sizing", { start: defaultSizing, read: readSizing });

/** The Design view starts from a task. */
export const inTask = computed(() => doc.value.sizing.mode === "task");
