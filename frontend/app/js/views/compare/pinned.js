// @ts-check
// Models of the board with their comparison: asked for while the board is open or their lines are drawn.
import { computed } from "../../reactive.js";
import { Question } from "../../server/question.js";
import { view } from "../../state.js";
import { compare, comparisonsWith, isCompared } from "./answers.js";
import { keyOf, used } from "./request.js";

/** @typedef {import("./types.js").Comparison} Comparison */
/** @typedef {import("../../types.js").Pinned} Pinned */

/** The files that a model is compared with, as the board remembers them. @param {import("../../types.js").Compare} c */
export const filesOf = (c) => used(c).map((file) => file.id).join();

/** Whether a pinned model belongs to the files of now. @param {Pinned} pin */
export const isHere = (pin) => pin.of === filesOf(compare.value);

/** The request of a pinned model with the files of now; its own entries where it was pinned with these files.
 * @param {Pinned} pin */
const textOf = (pin) => keyOf(compare.value, isHere(pin) ? pin : { ...pin, context: undefined });

const texts = computed(() => JSON.stringify(compare.value.pins.map(textOf)));
const question = new Question((text, stop) => comparisonsWith(JSON.parse(text), stop), { patience: 0 });
/** The comparison of each pin; null: not known. @type {import("../../reactive.js").Signal<(Comparison | null)[]>} */
export const pinnedAnswers = computed(() => {
  const found = question.answered.value === texts.value ? question.answer.value : null;
  return compare.value.pins.map((_pin, i) => found?.[i] ?? null);
});

/** The pins that are drawn in the overlay. */
export const pinned = computed(() =>
  compare.value.traces.flatMap((i) => {
    const pin = compare.value.pins[i], comparison = pinnedAnswers.value[i];
    return pin && comparison ? [{ name: pin.name, comparison }] : [];
  })
);

/** Starts asking; called once. */
export const followPins = () =>
  question.follow(() => compare.value.pins.length ? texts.value : null, {
    active: () =>
      view.value === "compare" && isCompared.value &&
      (compare.value.board || compare.value.traces.length > 0),
  });
