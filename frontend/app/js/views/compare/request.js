// @ts-check
// Requests of this view, from the document. Pure functions.
import { filesOf } from "./document.js";
import { muscleInput } from "../../muscle/document.js";

/** @typedef {import("../../types.js").Compare} Compare */
/** @typedef {import("../../types.js").Step} Step */
/** What a request needs of a step. @typedef {Pick<Step, "effects" | "freed" | "values" | "context">} Asked */

/** The files that are not switched off. @param {Pick<Compare, "files">} c */
export const used = (c) => c.files.filter((file) => file.use !== "off");

/** What is said of an experiment, as requests take it: the accuracies of the channels in one text.
 * @param {import("../../types.js").Experiment} experiment */
function experimentInput(experiment) {
  const isAccuracy = (/** @type {string} */ key) => key.startsWith("accuracy_");
  const said = Object.entries(experiment);
  const accuracies = said.filter(([key]) => isAccuracy(key)).map(([key, one]) =>
    `${key.slice("accuracy_".length)} ${typeof one === "string" ? one : one.value}`
  );
  return {
    ...Object.fromEntries(said.filter(([key]) => !isAccuracy(key))),
    ...(accuracies.length ? { accuracy: accuracies.join(", ") } : {}),
  };
}

/** The decisions about entries of the present files; those about other files do not count.
 * @param {Pick<Compare, "files" | "decisions">} c @returns {import("../../types.js").Decisions} */
export const decided = (c) =>
  c.decisions.of === used(c).map((file) => file.id).join() ? c.decisions : { of: "", use: [], keep: [] };

/** Data and model as every request of this view takes them; the model is the current one or a step of the history.
 * @param {Compare} c @param {Asked} [model] */
export function modelBody(c, model = { effects: c.effects, freed: c.freed, values: c.muscle.values }) {
  const files = filesOf(c.files, model.context), taken = model.context?.decisions ?? c.decisions;
  const muscle = muscleInput({ ...c.muscle, values: model.values }),
    decisions = decided({ files, decisions: taken });
  return {
    ...(c.drive ? { drive: { schema: 1, ...c.drive, muscle } } : { muscle }),
    effects: model.effects,
    measurements: used({ files }).map(({ id, use, experiment, prepare }) => ({
      id,
      use,
      ...(experiment ? { experiment: experimentInput(experiment) } : {}),
      ...(prepare?.length ? { prepare } : {}),
    })),
    ...(c.free.length ? { free: c.free } : {}),
    ...(model.freed.length ? { freed: model.freed } : {}),
    ...(c.noise === null ? {} : { noise: c.noise }),
    ...(decisions.use.length ? { use: decisions.use } : {}),
    ...(decisions.keep.length ? { keep: decisions.keep } : {}),
  };
}

/** The request as text; null: there is no file to fit to. @param {Compare} c @param {Asked} [model] */
export const keyOf = (c, model) =>
  used(c).some((file) => file.use === "fit") ? JSON.stringify(modelBody(c, model)) : null;

const GEOMETRY = ["nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter"];

/** The numbers of a muscle in an answer. @param {Record<string, any> | null | undefined} muscle
 * @returns {Record<string, number>} */
export const valuesOf = (muscle) =>
  Object.fromEntries(
    Object.entries(muscle ?? {}).filter(([key, v]) => GEOMETRY.includes(key) && typeof v === "number"),
  );
