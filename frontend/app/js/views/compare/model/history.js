// @ts-check
// Changes of the model: effects added or removed, fits, steps back. Each is one undo step.
import { signal } from "../../../reactive.js";
import { doc, edit } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { status } from "../../../store.js";
import { answer, compare, diagnosis, fitWith, preset, preview } from "../answers.js";
import { contextOf, fitOf, stepOf, withStep } from "../document.js";
import { keyOf, valuesOf } from "../request.js";
import { effectValues } from "../../../muscle/preset.js";
import { OWN_TERM, titleOf } from "../words.js";

/** @typedef {import("../../../types.js").Compare} Compare */
/** @typedef {import("../../../types.js").Step} Step */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../../../types.js").Effects} Effects */
/** @typedef {import("../types.js").Model} Model */

/** Whether the user requested a fit that is under way. */
export const fitting = signal(false);

/** The current model with its error, as a step of the history. */
export const here = () =>
  stepOf(
    compare.value,
    answer.value?.rmse_beyond_accuracy ?? null,
    diagnosis.value?.baseline.holdout_rmse ?? null,
  );

/** The models so far, the current one last. */
export const models = () => [...compare.value.history, here()];

/** The geometry with the values of a fit. @param {Model} model */
export const geometryOf = (model) => ({ ...compare.peek().muscle.values, ...valuesOf(model.muscle) });

/** The effects of the model of now, with their values. */
export const effectsNow = () => compare.peek().effects ?? effectValues(preset.peek());

/** @param {Step[]} added steps after the current one; the last is the new model @param {string} label */
export const go = (added, label) => replace([...compare.peek().history, here(), ...added], label);

/** @param {Step[]} all the models, of which the last becomes the current one @param {string} label */
export function replace(all, label) {
  const history = [...all], last = /** @type {Step} */ (history.pop());
  preview(null);
  edit((d) => ({ ...d, compare: withStep(d.compare, last, history) }), label);
}

/** Adds a model with a formula of the user. @param {Model} model @param {string} label */
export const addModel = (model, label) =>
  go([{
    label: `+ ${label}`,
    effects: model.effects,
    freed: compare.peek().freed,
    values: geometryOf(model),
    fit: compare.peek().fit,
    rmse: null,
    holdout: null,
  }], `add ${label}`);

/** The values of a model after a fit. @param {Effects} effects @param {Comparison} got @returns {Effects} */
const fittedValues = (effects, got) =>
  Object.fromEntries(
    Object.entries(got.parameters).map(([id, parameters]) => {
      const numbers = Object.entries(parameters).map(([name, p]) => [name, p.value]);
      return [id, { ...effects[id], ...Object.fromEntries(numbers) }];
    }),
  );

const MOST_FITS = 4;

/** A model with its parameters fitted; null: the document has changed meanwhile, or there is nothing to fit to.
 * @param {Pick<Step, "label" | "effects" | "freed" | "values" | "context">} model @returns {Promise<Step | null>}
 * @throws {ApiError} why the server cannot fit it */
export async function fittedStep(model) {
  const c = compare.peek(), { effects } = model, { id } = doc.peek().cases;
  const freed = effects === null ? model.freed : model.freed.filter((name) => name.split(".")[0] in effects);
  if (!keyOf(c, { ...model, freed })) return null;
  let values = effects, tries = 0, atBound = true;
  let got = /** @type {Comparison | null} */ (null);
  // The bounds of the constants of a formula depend on their start values: at a bound, the fit is continued.
  while (atBound && tries++ < MOST_FITS) {
    got = await fitWith(keyOf(c, { ...model, effects: values, freed }) ?? "");
    if (doc.peek().cases.id !== id) return null;
    if (compare.peek() !== c && keyOf(compare.peek()) !== keyOf(c)) return null;
    values = fittedValues(values ?? {}, got);
    atBound = Object.values(got.parameters[OWN_TERM] ?? {}).some((p) => p.at_bound);
  }
  if (!got) return null;
  const free = Object.fromEntries(
    Object.entries(valuesOf(got.geometry)).filter(([name]) => c.free.includes(name)),
  );
  return {
    ...model,
    effects: values,
    freed,
    values: { ...model.values, ...free },
    fit: fitOf(got.parameters),
    rmse: got.rmse_beyond_accuracy,
    holdout: got.holdout_rmse,
  };
}

/** Runs a change that asks the server for fits; a failure is shown in the status line.
 * @param {() => Promise<void>} change */
export async function whileFitting(change) {
  if (fitting.peek()) return;
  fitting.value = true;
  try {
    await change();
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    status.value = `The fit did not succeed: ${error.words}`;
  } finally {
    fitting.value = false;
  }
}

/** The current model with other effects. @param {Effects | null} effects @param {string} label */
const modelWith = (effects, label) => {
  const c = compare.peek();
  return { label, effects, freed: c.freed, values: c.muscle.values };
};

/** Fits the parameters of a model and makes it the current one.
 * @param {Effects | null} effects @param {string} label of the undo step @param {string} step of the history
 * @param {Partial<Step>} [more] @throws {ApiError} why the server cannot fit it */
export async function takeFitted(effects, label, step, more = {}) {
  fitting.value = true;
  try {
    const got = await fittedStep(modelWith(effects, step));
    if (got) go([{ ...got, ...more }], label);
  } finally {
    fitting.value = false;
  }
}

/** Fits every parameter of the model again. */
export const refit = () =>
  whileFitting(async () => {
    const got = await fittedStep(modelWith(compare.peek().effects, "Refit"));
    if (got) go([got], "refit");
  });
export const refitByKey = () => {
  if (answer.peek() && !fitting.peek()) refit();
};

/** Removes an effect and fits the others again. @param {string} id */
export const remove = (id) =>
  whileFitting(async () => {
    const title = titleOf(id);
    const effects = Object.fromEntries(Object.entries(effectsNow()).filter(([name]) => name !== id));
    const got = await fittedStep(modelWith(effects, `− ${title}`));
    if (got) go([got], `remove ${title}`);
  });

/** Goes back to a model of the history and removes the later ones; undo brings them back. @param {number} index */
export function goBack(index) {
  const { history } = compare.peek();
  replace(history.slice(0, index + 1), `back to ${history[index].label}`);
}

/** The models so far, each with what is said of the data now: for a change of that. @returns {Step[]} */
export const stamped = () => {
  const context = contextOf(compare.peek());
  return models().map((step) => ({ ...step, context: step.context ?? context }));
};
