// @ts-check
// Changes of the model: effects added or removed, fits, steps back. Each is one undo step.
import { signal } from "../../../reactive.js";
import { edit } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { status } from "../../../store.js";
import { ahead, answer, compare, diagnosis, fitWith, preset } from "../answers.js";
import { fitOf, stepOf, withStep } from "../document.js";
import { keyOf, valuesOf } from "../request.js";
import { effectValues } from "../../../muscle/preset.js";
import { OWN_TERM, titleOf } from "../words.js";

/** @typedef {import("../../../types.js").Compare} Compare */
/** @typedef {import("../../../types.js").Step} Step */
/** @typedef {import("../types.js").Candidate} Candidate */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../../../types.js").Effects} Effects */
/** @typedef {import("../types.js").Model} Model */

/** Whether the user requested a fit that is under way. */
export const fitting = signal(false);

/** The current model with its error, as a step of the history. */
export const here = () =>
  stepOf(compare.value, answer.value?.rmse ?? null, diagnosis.value?.baseline.holdout_rmse ?? null);

/** The geometry with the values of a fit. @param {Model} model */
const geometryOf = (model) => ({ ...compare.peek().muscle.values, ...valuesOf(model.muscle) });

/** @param {Step[]} added steps after the current one; the last is the new model @param {string} label */
function go(added, label) {
  const all = [...compare.peek().history, here(), ...added];
  const last = /** @type {Step} */ (all.pop());
  edit((d) => ({ ...d, compare: withStep(d.compare, last, all) }), label);
}

/** @param {Candidate} c */
export function add(c) {
  const title = titleOf(c.effect);
  go([{
    label: `+ ${title}`,
    effects: c.model.effects,
    freed: c.freed,
    values: geometryOf(c.model),
    fit: fitOf({ [c.effect]: c.parameters }),
    rmse: c.rmse,
    holdout: c.holdout_rmse,
  }], `add ${title}`);
}

/** Adds every effect the diagnosis found missing, in one undo step. */
export function addAll() {
  const result = diagnosis.peek();
  const path = ahead.peek();
  if (!result || !path.length) return;
  const names = path.map((s) => s.added ? titleOf(s.added) : "Values fitted");
  go(
    path.map((s, i) => ({
      label: `+ ${names[i]}`,
      effects: s.model.effects,
      freed: s.freed,
      values: geometryOf(s.model),
      fit: i === path.length - 1 ? fitOf(result.parameters) : {},
      rmse: s.rmse,
      holdout: s.holdout_rmse,
    })),
    path.length === 1 ? `add ${names[0]}` : `add ${path.length} effects`,
  );
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

/** Fits the parameters of a model and makes it the current one.
 * @param {Effects | null} effects @param {string} label of the undo step @param {string} step of the history
 * @throws {ApiError} why the server cannot fit it */
export async function takeFitted(effects, label, step) {
  const c = compare.peek();
  const freed = effects === null ? c.freed : c.freed.filter((name) => name.split(".")[0] in effects);
  const start = { freed, values: c.muscle.values };
  if (!keyOf(c, { effects, ...start })) return;
  fitting.value = true;
  try {
    let values = effects, tries = 0, atBound = true;
    let got = /** @type {Comparison | null} */ (null);
    // The bounds of the constants of a formula depend on their start values: at a bound, the fit is continued.
    while (atBound && tries++ < MOST_FITS) {
      got = await fitWith(keyOf(c, { effects: values, ...start }) ?? "");
      if (compare.peek() !== c && keyOf(compare.peek()) !== keyOf(c)) return;
      values = fittedValues(values ?? {}, got);
      atBound = Object.values(got.parameters[OWN_TERM] ?? {}).some((p) => p.at_bound);
    }
    if (!got) return;
    const free = Object.fromEntries(
      Object.entries(valuesOf(got.geometry)).filter(([name]) => c.free.includes(name)),
    );
    go([{
      label: step,
      effects: values,
      freed,
      values: { ...c.muscle.values, ...free },
      fit: fitOf(got.parameters),
      rmse: got.rmse,
      holdout: got.holdout_rmse,
    }], label);
  } finally {
    fitting.value = false;
  }
}

/** Like takeFitted; a failure is shown in the status line.
 * @param {Effects | null} effects @param {string} label @param {string} step */
async function fitted(effects, label, step) {
  try {
    await takeFitted(effects, label, step);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    status.value = `The fit did not succeed: ${error.words}`;
  }
}

/** Fits every parameter of the model again. */
export const refit = () => fitted(compare.peek().effects, "refit", "Refit");
export const refitByKey = () => {
  if (answer.peek() && !fitting.peek()) refit();
};

/** Removes an effect and fits the others again. @param {string} id */
export function remove(id) {
  const title = titleOf(id);
  const all = compare.peek().effects ?? effectValues(preset.peek());
  const effects = Object.fromEntries(Object.entries(all).filter(([name]) => name !== id));
  return fitted(effects, `remove ${title}`, `− ${title}`);
}

/** Goes back to a model of the history and removes the later ones; undo brings them back. @param {number} index */
export function goBack(index) {
  const { history } = compare.peek();
  const step = history[index];
  edit(
    (d) => ({ ...d, compare: withStep(d.compare, step, history.slice(0, index)) }),
    `back to ${step.label}`,
  );
}
