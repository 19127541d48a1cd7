// @ts-check
// What the diagnosis found missing, as the entries of the list; and adding them.
import { computed, signal } from "../../../reactive.js";
import { ahead, candidates, compare, diagnosis, stage } from "../answers.js";
import { fitOf } from "../document.js";
import { effectsNow, fittedStep, geometryOf, go, takeFitted, whileFitting } from "../model/history.js";
import { exchanged } from "../model/steps.js";
import { titleOf } from "../words.js";

/** @typedef {import("../../../types.js").Step} Step */
/** @typedef {import("../../../types.js").Effects} Effects */
/** @typedef {import("../../../types.js").Telling} Telling */
/** @typedef {import("../types.js").Candidate} Candidate */
/** @typedef {import("../types.js").PathStep} PathStep */
/** @typedef {import("../types.js").Diagnosis} Diagnosis */
/** An effect of the joint proposal. `group`: the effects that the data cannot tell from it, itself first; `chosen`:
 * one of them; `from`, `to`: the error before and after it, with the entries above already in; `correction`: it is
 * not called missing, but the model predicts better with it.
 * @typedef {{effect: string, group: string[], chosen: string, correction: boolean, from: number, to: number, holdout: number,
 *   probability: number | null, reason: string, tells: Telling[], step: PathStep,
 *   candidate: Candidate | null}} Entry */

/** Effect of the proposal -> the one chosen among those that the data cannot tell from it. */
const choices = signal(/** @type {Record<string, string>} */ ({}));
/** @param {string} effect @param {string} chosen */
export const choose = (effect, chosen) => (choices.value = { ...choices.peek(), [effect]: chosen });

/** Fields that newer servers add to a verdict.
 * @typedef {{probabilities?: Record<string, number>, applied?: Record<string, string>}} Newer */

/** The tests that would tell the effects of a group apart. @param {Diagnosis["verdict"]} verdict
 * @param {string[]} group @returns {Telling[]} */
const tellsOf = ({ experiments }, group) =>
  experiments.filter((e) => e.pair.every((id) => group.includes(id))).map((e) => ({
    pair: e.pair,
    declared: e.declared,
    protocol: e.protocol,
    separation: e.separation,
    minutes: /** @type {{minutes?: number | null}} */ (e).minutes ?? null,
  }));

/** @param {string} id @returns {Candidate | null} */
const candidateOf = (id) => candidates.value.find((c) => c.effect === id) ?? null;

/** The entries of the verdict, in the order of the joint proposal. @type {import("../../../reactive.js").Signal<Entry[]>} */
export const entries = computed(() => {
  const result = diagnosis.value;
  if (!result) return [];
  const { verdict } = result, newer = /** @type {Newer} */ (verdict), steps = ahead.value;
  return steps.flatMap((step, i) => {
    const { added } = step;
    if (!added) return [];
    const group = verdict.indistinguishable.find(([one]) => one === added) ?? [added];
    const chosen = choices.value[added] ?? added;
    const own = group.includes(chosen) ? chosen : added;
    const before = i ? steps[i - 1].rmse : result.baseline.rmse;
    const candidate = candidateOf(own);
    const correction = verdict.corrections.find((c) => c.effect === added);
    const likely = newer.probabilities?.[added] ??
      correction?.probability ??
      /** @type {{probability?: number | null}} */ (candidateOf(added) ?? {}).probability ?? null;
    return [{
      effect: added,
      group,
      chosen: own,
      correction: step.correction,
      from: before,
      to: step.rmse,
      holdout: step.holdout_rmse,
      probability: likely,
      reason: step.correction && correction
        ? `Not called missing: ${correction.why}. The model predicts left-out groups better with it`
        : newer.applied?.[added] ?? "",
      tells: tellsOf(verdict, group),
      step,
      candidate,
    }];
  });
});

/** The step of the proposal that fits the model's own numbers again, if that is the first one. */
export const refits = computed(() => ahead.value[0]?.refitted ? ahead.value[0] : null);

/** The best candidate while the diagnosis runs. */
export const soFar = computed(() =>
  ["running", "cancelled"].includes(stage.value) ? candidates.value[0] ?? null : null
);

/** What the history keeps of an entry's open choice. @param {Entry} entry */
const open = ({ group, tells }) => group.length > 1 ? { twins: group, tells } : {};

/** The values that were fitted before: a new effect fits them again, which changes their standard errors.
 * @param {import("../../../types.js").Fit} fit @returns {import("../../../types.js").Fit} */
const fittedAgain = (fit) =>
  Object.fromEntries(
    Object.entries(fit).map(([id, values]) => [
      id,
      Object.fromEntries(
        Object.entries(values).map(([name, { at_bound }]) => [name, { stderr: null, at_bound }]),
      ),
    ]),
  );

/** The step of a candidate. @param {Candidate} c @returns {Step} */
const stepOfCandidate = (c) => ({
  label: `+ ${titleOf(c.effect)}`,
  effects: c.model.effects,
  freed: c.freed,
  values: geometryOf(c.model),
  fit: { ...fittedAgain(compare.peek().fit), ...fitOf({ [c.effect]: c.parameters }) },
  rmse: c.rmse,
  holdout: c.holdout_rmse,
});

/** Adds an effect that was tried. @param {Candidate} c */
export const addCandidate = (c) => go([stepOfCandidate(c)], `add ${titleOf(c.effect)}`);

/** Whether a model is the one of now with one more effect. @param {Effects} effects @param {string} added */
const addsOnly = (effects, added) => {
  const now = effectsNow();
  return Object.keys(effects).every((id) => id === added || id in now);
};

/** The model of now with an entry's effect, as it was found in the model of its step.
 * @param {Entry} entry @returns {Effects} */
const withOnly = ({ chosen, effect, step }) => ({
  ...effectsNow(),
  [chosen]: exchanged(step.model.effects, effect, chosen)[chosen],
});

/** An entry's effect is tried alone, and in the proposal beside those above it. Where that fit is better, alone
 * ended in a worse minimum. */
const BETTER = 0.999;

/** Whether the model of an entry's step is the one of now with its effect, and fitted better than the candidate.
 * @param {Entry} entry */
const isStepBetter = ({ chosen, effect, candidate, step }) =>
  chosen === effect && addsOnly(step.model.effects, chosen) &&
  !(candidate && addsOnly(candidate.model.effects, chosen) && candidate.rmse * BETTER <= step.rmse);

/** Adds an entry, alone: as it was tried or, where it was not tried alone, fitted. @param {Entry} entry */
export function add(entry) {
  const { chosen, candidate, step } = entry, title = titleOf(chosen);
  if (isStepBetter(entry)) {
    const result = diagnosis.peek(), isLast = step === ahead.peek().at(-1);
    return go([{
      label: `+ ${title}`,
      effects: step.model.effects,
      freed: step.freed,
      values: geometryOf(step.model),
      fit: isLast && result ? fitOf(result.parameters) : fittedAgain(compare.peek().fit),
      rmse: step.rmse,
      holdout: step.holdout_rmse,
      ...open(entry),
    }], `add ${title}`);
  }
  if (candidate && addsOnly(candidate.model.effects, chosen)) {
    return go([{ ...stepOfCandidate(candidate), ...open(entry) }], `add ${title}`);
  }
  return whileFitting(() => takeFitted(withOnly(entry), `add ${title}`, `+ ${title}`, open(entry)));
}

/** Adds every effect the diagnosis found missing, in one undo step; or those up to a step of its path.
 * @param {PathStep} [upTo] */
export function addAll(upTo) {
  const result = diagnosis.peek(), whole = ahead.peek();
  const path = upTo ? whole.slice(0, whole.indexOf(upTo) + 1) : whole;
  const all = entries.peek().filter((entry) => path.includes(entry.step));
  if (!result || !path.length) return;
  const label = all.length === 1 ? `add ${titleOf(all[0].chosen)}` : `add ${all.length} effects`;
  const asFound = path.map((s, i) => {
    const entry = all.find((e) => e.step === s);
    return {
      label: entry ? `+ ${titleOf(entry.chosen)}` : "Values fitted",
      effects: s.model.effects,
      freed: s.freed,
      values: geometryOf(s.model),
      fit: i === whole.length - 1 ? fitOf(result.parameters) : {},
      rmse: s.rmse,
      holdout: s.holdout_rmse,
      ...(entry ? open(entry) : {}),
    };
  });
  const others = all.filter((e) => e.chosen !== e.effect);
  if (!others.length) return go(asFound, label);
  return whileFitting(async () => {
    /** @type {Step[]} */
    const fitted = [];
    for (const step of asFound) {
      const effects = others.reduce((now, e) => exchanged(now, e.effect, e.chosen), step.effects);
      const got = effects === step.effects ? step : await fittedStep({ ...step, effects });
      if (!got) return;
      fitted.push(got);
    }
    go(fitted, label);
  });
}

/** The model of an entry added alone, for a look at it. @param {Entry} entry */
export const modelOf = (entry) => {
  const { candidate, chosen, step } = entry, better = isStepBetter(entry);
  const tried = !better && candidate && addsOnly(candidate.model.effects, chosen) ? candidate : null;
  const model = tried?.model ?? (better ? step.model : null);
  return {
    effects: model?.effects ?? withOnly(entry),
    freed: tried?.freed ?? step.freed,
    values: model ? geometryOf(model) : compare.peek().muscle.values,
  };
};
