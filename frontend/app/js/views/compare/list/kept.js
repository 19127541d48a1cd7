// @ts-check
// What the last verdict said, while the next model of the same case is diagnosed: the list keeps its place, so that
// nothing moves when the new verdict arrives.
import { computed, effect, signal } from "../../../reactive.js";
import { compare, diagnosis, stage } from "../answers.js";
import { effectsNow } from "../model/history.js";
import { keyOf } from "../request.js";
import { entries } from "./plan.js";
import { sketches } from "./sketch.js";

/** @typedef {import("./plan.js").Entry} Entry */
/** `basis`: the request without its model.
 * @typedef {{basis: string | null, entries: Entry[], sketches: Record<string, import("./sketch.js").Sketch>,
 *   result: import("../types.js").Diagnosis}} Kept */

const basis = computed(() => keyOf(compare.value, { effects: {}, freed: [], values: {} }));
const last = signal(/** @type {Kept | null} */ (null));

/** Remembers each verdict; called once. */
export function followVerdicts() {
  effect(() => {
    const result = diagnosis.value;
    if (stage.value !== "done" || !result) return;
    const drawn = sketches.value, before = last.peek();
    // The sketches of a verdict go a moment before it does.
    const isKnown = before?.result === result && !Object.keys(drawn).length;
    last.value = {
      basis: basis.peek(),
      entries: entries.value,
      sketches: isKnown ? before.sketches : drawn,
      result,
    };
  });
}

/** The last verdict while another model of the same files and experiment is compared and diagnosed; else null. */
export const kept = computed(() => {
  const now = last.value;
  return now && ["waiting", "running"].includes(stage.value) && now.basis === basis.value ? now : null;
});

/** Its entries that are not in the model yet. */
export const remaining = computed(() => {
  const all = kept.value?.entries ?? [], inModel = effectsNow();
  return all.filter((entry) => !(entry.chosen in inModel));
});
