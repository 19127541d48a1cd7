// @ts-check
// The design: muscle, effects and operating conditions. Every view about the muscle shares this part of the
// document.
import { BAR } from "../format.js";
import { OVER, STIFFNESS } from "./curve-axes.js";
import { computed } from "../reactive.js";
import { addPart, doc, edit, look } from "../state.js";

/** @typedef {import("../types.js").Doc} Doc */
/** @typedef {import("../types.js").Design} Design */
/** @typedef {import("../types.js").Muscle} Muscle */

/** @returns {Design} a real muscle with measured points beside it */
export const defaultDesign = () => ({
  muscle: { preset: "DMSP-20", form: "braid", values: { nominal_length: 0.3 } },
  effects: null,
  pressures: [1, 2, 3, 4, 5, 6].map((p) => p * BAR),
  pressure: null,
  contraction: 0.15,
  load: 500,
  load_as: "force",
  direction: 0,
  temperature: 293.15,
  dead_volume: 0,
  fixed_length: null,
  range: null,
  clipped: true,
  across: "contraction",
  over: "contraction",
  stiffness: "tangent",
  reference: "auto",
});

/** @param {unknown} x @returns {x is Record<string, unknown>} */
const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);
/** @param {unknown} x @returns {x is number} */
const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

/** What each value must be; a missing value takes its default.
 * @type {Record<string, (x: unknown) => boolean>} */
const DESIGN_CHECKS = {
  muscle: (x) =>
    isObject(x) && (x.preset === null || typeof x.preset === "string") &&
    ["braid", "thread", "rhombus"].includes(String(x.form)) && isObject(x.values) &&
    Object.values(x.values).every(isNumber),
  effects: (x) =>
    x === null ||
    (isObject(x) && Object.values(x).every((p) => isObject(p) && Object.values(p).every(isNumber))),
  pressures: (x) => Array.isArray(x) && x.length >= 1 && x.length <= 12 && x.every(isNumber),
  pressure: (x) => x === null || isNumber(x),
  contraction: (x) => x === null || isNumber(x),
  load: isNumber,
  load_as: (x) => x === "force" || x === "mass",
  direction: (x) => [-1, 0, 1].includes(/** @type {number} */ (x)),
  temperature: isNumber,
  dead_volume: isNumber,
  fixed_length: (x) => x === null || isNumber(x),
  range: (x) => x === null || (Array.isArray(x) && x.length === 2 && x.every(isNumber)),
  clipped: (x) => typeof x === "boolean",
  across: (x) => ["contraction", "length", "braid_angle"].includes(String(x)),
  over: (x) => Object.keys(OVER).includes(String(x)),
  stiffness: (x) => Object.keys(STIFFNESS).includes(String(x)),
  reference: (x) => x === null || typeof x === "string",
};

/** Reads the Design part of a link or file. @param {unknown} raw @returns {Design}
 * @throws {Error} names the key */
export function readDesign(raw) {
  if (!isObject(raw)) throw new Error("the design is missing");
  for (const [key, value] of Object.entries(raw)) {
    if (!Object.hasOwn(DESIGN_CHECKS, key)) throw new Error(`a design has no “${key}”`);
    if (!DESIGN_CHECKS[key](value)) throw new Error(`the value of “${key}” is invalid`);
  }
  return { ...defaultDesign(), ...raw };
}

addPart("design", { start: defaultDesign, read: readDesign });

export const design = computed(() => doc.value.design);

/** @param {Partial<Design>} patch @returns {(d: Doc) => Doc} */
export const patchDesign = (patch) => (d) => ({ ...d, design: { ...d.design, ...patch } });
/** @param {Partial<Design>} patch @param {string} label */
export const editDesign = (patch, label) => edit(patchDesign(patch), label);

/** The document with the muscle shown in the Design view. @param {Doc} d @returns {Doc} */
const muscleShown = (d) => ({ ...d, view: "design", sizing: { ...d.sizing, mode: "muscle" } });
/** Shows the muscle in the Design view. */
export const showMuscle = () => look(muscleShown);
/** Changes the design and shows it in the Design view. @param {Partial<Design>} patch @param {string} label */
export const openDesign = (patch, label) => edit((d) => muscleShown(patchDesign(patch)(d)), label);

/** The muscle as requests to the server take it. @param {Muscle} muscle */
export function muscleInput({ preset: id, form, values }) {
  const { side, along, around, ...rest } = values;
  /** @type {Record<string, unknown>} */
  const input = { ...rest };
  if (id) input.preset = id;
  if (form === "rhombus" && side) input.rhombus = { side, along, around };
  return input;
}

/** What every request about the static model needs. @param {Design} d */
export const modelInput = (d) => ({
  muscle: muscleInput(d.muscle),
  effects: d.effects,
  direction: d.direction,
  temperature: d.temperature,
});
