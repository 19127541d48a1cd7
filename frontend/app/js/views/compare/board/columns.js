// @ts-check
// The models of the board as columns: the pinned ones and the case itself; pinning, using, removing.
import { computed } from "../../../reactive.js";
import { answer, compare, diagnosis, editCompare, heldOut, lookCompare, stale, steps } from "../answers.js";
import { contextOf, fitOf, MOST_PINS, surer } from "../document.js";
import { effectsNow, go, here } from "../model/history.js";
import { filesOf, isHere, pinnedAnswers } from "../pinned.js";
import { titleOf } from "../words.js";

/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../../../types.js").Pinned} Pinned */
/** @typedef {import("../../../types.js").Effects} Effects */
/** `index`: of the pins, −1 for the case. `fitted`: to the files of now.
 * @typedef {{name: string, note: string, index: number, comparison: Comparison | null, effects: Effects,
 *   fit: import("../../../types.js").Fit, holdout: number | null, fitted: boolean,
 *   values: Record<string, number>}} Column */

const NAMED = 2;

/** @param {Effects} effects */
function nameOf(effects) {
  const titles = Object.keys(effects).map((id) => titleOf(id).replace(/ \([^)]*\)$/, ""));
  if (!titles.length) return "Ideal muscle";
  const more = titles.length - NAMED;
  return `${titles.slice(0, NAMED).join(", ")}${more > 0 ? ` + ${more}` : ""}`;
}

/** @param {number} n */
const effectCount = (n) => n ? `${n} effect${n > 1 ? "s" : ""}` : "start";

/** Errors of the fitted values of the model of now. */
const fitNow = () => {
  const result = diagnosis.value;
  const last = result && !result.verdict.effects.length ? fitOf(result.parameters) : {};
  const { fit } = compare.value, ids = [...new Set([...Object.keys(last), ...Object.keys(fit)])];
  return Object.fromEntries(
    ids.map((id) => [
      id,
      Object.fromEntries(
        Object.keys({ ...last[id], ...fit[id] }).flatMap((name) => {
          const known = surer(fit[id]?.[name], last[id]?.[name]);
          return known ? [[name, known]] : [];
        }),
      ),
    ]),
  );
};

export const columns = computed(() => {
  const pins = compare.value.pins.map((pin, index) => /** @type {Column} */ ({
    name: pin.name,
    note: isHere(pin)
      ? effectCount(Object.keys(pin.effects ?? {}).length)
      : "of another file, not fitted to this one",
    index,
    comparison: pinnedAnswers.value[index],
    effects: pin.effects ?? {},
    fit: pin.fit,
    holdout: isHere(pin) ? pin.holdout : null,
    fitted: isHere(pin),
    values: pin.values,
  }));
  /** @type {Column} */
  const mine = {
    name: "This case",
    note: effectCount(Object.keys(effectsNow()).length),
    index: -1,
    comparison: stale.value ? null : answer.value,
    effects: (compare.value, effectsNow()),
    fit: fitNow(),
    holdout: heldOut(),
    fitted: true,
    values: compare.value.muscle.values,
  };
  return [...pins, mine];
});

/** Whether the model of now can be pinned. */
export const canPin = computed(() =>
  answer.value !== null && !stale.value && compare.value.pins.length < MOST_PINS
);

/** Pins the model of now, with its entries and files. */
export function pin() {
  const c = compare.peek(), taken = new Set(c.pins.map((p) => p.name)), base = nameOf(effectsNow());
  let name = base;
  for (let k = 2; taken.has(name); k++) name = `${base} (${k})`;
  const pinned = {
    ...here(),
    fit: fitNow(),
    context: contextOf(c),
    name,
    of: filesOf(c),
    effects: effectsNow(),
  };
  editCompare({ pins: [...c.pins, pinned] }, `pin ${name}`);
}

/** Pins the first model of the case. */
export function pinStart() {
  const c = compare.peek(), [first] = steps.peek();
  if (!first || c.pins.length >= MOST_PINS) return;
  editCompare({
    pins: [...c.pins, {
      ...first,
      context: first.context ?? contextOf(c),
      name: first.label,
      of: filesOf(c),
    }],
  }, `pin ${first.label}`);
}

/** @param {number} index */
export function unpin(index) {
  const { pins, traces } = compare.peek();
  const kept = traces.filter((i) => i !== index).map((i) => i > index ? i - 1 : i);
  editCompare({ pins: pins.filter((_pin, i) => i !== index), traces: kept }, `unpin ${pins[index].name}`);
}

/** Makes a pinned model the model of the case. @param {number} index */
export function useModel(index) {
  const { name, of: _of, context: _context, ...step } = compare.peek().pins[index];
  go([{ ...step, label: name }], `use ${name}`);
}

/** Draws a pinned model in the overlay, or no more. @param {number} index */
export function draw(index) {
  const { traces } = compare.peek();
  const drawn = traces.includes(index);
  lookCompare({ traces: drawn ? traces.filter((i) => i !== index) : [...traces, index].sort() });
}
