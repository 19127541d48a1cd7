// @ts-check
// From the document to the body of a request. Pure functions.
import { muscleInput } from "../../muscle/document.js";

/** @typedef {import("../../types.js").Compare} Compare */
/** @typedef {import("../../types.js").Step} Step */

/** Which files take part. @param {Compare} c */
export const used = (c) => c.files.filter((file) => file.use !== "off");

/** The model part of every request of this view; a step of the history stands in for the model of now.
 * @param {Compare} c @param {Pick<Step, "effects" | "freed" | "values">} [model] */
export function modelBody(c, model = { effects: c.effects, freed: c.freed, values: c.muscle.values }) {
  const muscle = muscleInput({ ...c.muscle, values: model.values });
  return {
    ...(c.drive ? { drive: { schema: 1, ...c.drive, muscle } } : { muscle }),
    effects: model.effects,
    measurements: used(c).map(({ id, use }) => ({ id, use })),
    ...(c.free.length ? { free: c.free } : {}),
    ...(model.freed.length ? { freed: model.freed } : {}),
    ...(c.noise === null ? {} : { noise: c.noise }),
  };
}

/** The body as text, by which answers are kept; null = there is nothing to compare with.
 * @param {Compare} c @param {Pick<Step, "effects" | "freed" | "values">} [model] */
export const keyOf = (c, model) =>
  used(c).some((file) => file.use === "fit") ? JSON.stringify(modelBody(c, model)) : null;

const GEOMETRY = ["nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter"];

/** The numbers of a muscle in an answer. @param {Record<string, any> | null | undefined} muscle
 * @returns {Record<string, number>} */
export const valuesOf = (muscle) =>
  Object.fromEntries(
    Object.entries(muscle ?? {}).filter(([key, v]) => GEOMETRY.includes(key) && typeof v === "number"),
  );
