// @ts-check
// Which of its states the case is in: everything on the page that says so reads it here.
import { computed } from "../../../reactive.js";
import { chosen, compare, diagnosis, fault, files, progress, stage } from "../answers.js";
import { asked } from "./context.js";
import { entries, refits } from "./plan.js";

/** `idle`: no file is used for the fit; `stopped`: the user ended the diagnosis, or the limit of time before anything
 * helped; `context`: an entry may be wrong;
 * `verdict`: effects are missing; `unknown`: none of the catalogue helps.
 * @typedef {"empty" | "idle" | "fault" | "comparing" | "running" | "stopped" | "failed" | "context" | "verdict" |
 *   "adequate" | "unknown"} Case */

/** @type {import("../../../reactive.js").Signal<Case>} */
export const state = computed(() => {
  if (!files.value.length) return "empty";
  if (!chosen.value.some((file) => file.use === "fit")) return "idle";
  if (fault.value) return "fault";
  if (stage.value === "waiting" || stage.value === "idle") return "comparing";
  if (stage.value === "running") return "running";
  if (stage.value === "cancelled") return "stopped";
  const result = diagnosis.value;
  if (stage.value === "failed" || !result) return "failed";
  if (asked(result).length) return "context";
  const { status } = result.verdict;
  if (status === "unfinished" && !entries.value.length && !refits.value) return "stopped";
  if (entries.value.length || (refits.value && !["unknown_effect", "undecided"].includes(status))) {
    return "verdict";
  }
  return status === "adequate" ? "adequate" : "unknown";
});

const WIDE = 1.15;

/** The noise of an adequate model from the scatter of neighbouring readings to all that no variable explains, SI, where
 * the two differ; else null. */
export const wideNoise = computed(() => {
  const interval = diagnosis.value?.noise_floor.interval;
  if (state.value !== "adequate" || !interval) return null;
  const [low, high] = interval;
  return high > WIDE * low ? { low, high } : null;
});

/** Whether an open choice among effects was made in a step so far. */
export const openSteps = computed(() => {
  const { history, twins, tells, label, effects } = compare.value;
  return [...history, { twins, tells, label, effects }].flatMap((step, index) => {
    const { twins = [], tells = [] } = step;
    const chosen = twins.find((id) => id in (effects ?? {}));
    return twins.length > 1 && chosen ? [{ index, group: twins, chosen, tells }] : [];
  });
});

/** Whether the diagnosis on the page was ended by its limit of time: what it shows was found until then. */
export const unfinished = computed(() => diagnosis.value?.verdict.status === "unfinished");

/** How far the diagnosis is, 0 to 1. */
export const share = computed(() => progress.value.share);
