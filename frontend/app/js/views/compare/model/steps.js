// @ts-check
// One step of the model taken out or exchanged; the steps after it stay and are fitted again.
import { effectsById } from "../../../store.js";
import { compare, diagnosis, preset } from "../answers.js";
import { effectValues } from "../../../muscle/preset.js";
import { titleOf } from "../words.js";
import { fittedStep, goBack, models, replace, whileFitting } from "./history.js";

/** @typedef {import("../../../types.js").Step} Step */
/** @typedef {import("../../../types.js").Effects} Effects */

/** @param {Step} step @returns {Effects} */
const effectsOf = (step) => step.effects ?? effectValues(preset.peek());

/** The effects that a step added. @param {Step[]} all @param {number} i */
export const addedBy = (all, i) =>
  i === 0 ? [] : Object.keys(effectsOf(all[i])).filter((id) => !(id in effectsOf(all[i - 1])));

/** Whether a step changed what is said of the data. @param {Step[]} all @param {number} i */
export const isContext = (all, i) =>
  i > 0 && all[i - 1].context !== undefined && addedBy(all, i).length === 0 &&
  JSON.stringify(all[i - 1].context) !== JSON.stringify(all[i].context ?? now());

const now = () => ({ files: compare.peek().files, decisions: compare.peek().decisions });

/** The geometry of a later step without what a step changed. @param {Step} later @param {Step} step
 * @param {Step} before */
function valuesWithout(later, step, before) {
  const values = { ...later.values };
  for (const name of new Set([...Object.keys(step.values), ...Object.keys(before.values)])) {
    if (step.values[name] === before.values[name]) continue;
    if (name in before.values) values[name] = before.values[name];
    else delete values[name];
  }
  return values;
}

/** Takes out one step and fits the later ones again. @param {number} index of the models, from 1 */
export function takeOut(index) {
  const all = models(), step = all[index], before = all[index - 1];
  const name = step.label.replace(/^[+−] /, "");
  if (index === all.length - 1) return goBack(index - 1);
  const gone = addedBy(all, index), undone = isContext(all, index);
  whileFitting(async () => {
    /** @type {Step[]} */
    const later = [];
    for (const one of all.slice(index + 1)) {
      const effects = Object.fromEntries(
        Object.entries(effectsOf(one)).filter(([id]) => !gone.includes(id)),
      );
      const context = undone ? before.context : one.context;
      const got = await fittedStep({ ...one, effects, context, values: valuesWithout(one, step, before) });
      if (!got) return;
      later.push(got);
    }
    replace([...all.slice(0, index), ...later], `take out ${name}`);
  });
}

/** The values an effect starts with: those the diagnosis found, or the defaults. @param {string} id */
function startOf(id) {
  const found = diagnosis.peek()?.candidates.find((c) => c.effect === id)?.model.effects[id];
  const defaults = effectsById.peek().get(id)?.parameters.map((p) => [p.name, p.default]) ?? [];
  return found ?? Object.fromEntries(defaults);
}

/** Effects with one exchanged for another. @param {Effects} effects @param {string} from @param {string} to
 * @returns {Effects} */
export const exchanged = (effects, from, to) =>
  from === to || !(from in effects) ? effects : Object.fromEntries(
    Object.entries(effects).map(([id, values]) => id === from ? [to, startOf(to)] : [id, values]),
  );

/** Exchanges the effect of a step for one that the data cannot tell from it. @param {number} index
 * @param {string} from @param {string} to */
export const exchange = (index, from, to) =>
  whileFitting(async () => {
    const all = models();
    /** @type {Step[]} */
    const later = [];
    for (const one of all.slice(index)) {
      const got = await fittedStep({ ...one, effects: exchanged(effectsOf(one), from, to) });
      if (!got) return;
      later.push(got);
    }
    later[0] = { ...later[0], label: `+ ${titleOf(to)}` };
    replace([...all.slice(0, index), ...later], `${titleOf(to)} instead of ${titleOf(from)}`);
  });
