// @ts-check
// "What would cause this?": what each entry would explain of the residual in the chosen range.
import { inside } from "../answers.js";
import { explains } from "./sketch.js";

/** `mean`: of what the effect would explain; `seen`: mean of the residual; SI of the channel.
 * @typedef {{channel: string, mean: number, seen: number}} Share */
/** `shares`: of each channel where the effect shows most first; `cause`: whether the effect is an answer.
 * @typedef {{shares: Share[], cause: boolean}} Inside */

/** Share of the residual there from which on an effect is an answer. */
const CAUSE = 0.1;

/** What an effect explains in the chosen range, for each channel on its own, as their units differ. Null: no range
 * is chosen, or it is not known.
 * @param {string} effect @returns {Inside | null} */
export function insideOf(effect) {
  const seen = new Map((inside.value ?? []).map((one) => [one.channel, one]));
  const shares = (explains.value ?? []).filter((one) => one.effect === effect).flatMap((one) => {
    const { mean = null, rms = null } = seen.get(one.channel) ?? {};
    if (mean === null || rms === null) return [];
    return [{
      channel: one.channel,
      mean: one.explained_mean,
      seen: mean,
      cause: one.explained_rms >= CAUSE * rms,
    }];
  });
  return shares.length ? { shares, cause: shares.some((one) => one.cause) } : null;
}
