// @ts-check
// "What would cause this?": what each entry would explain of the residual in the chosen range.
import { brush, shown } from "../answers.js";
import { isInside } from "../words.js";
import { without } from "./sketch.js";

/** `mean`: of what the effect would explain; `seen`: mean of the residual; SI of the channel.
 * @typedef {{channel: string, mean: number, seen: number}} Share */
/** `shares`: of each channel where the effect shows most first; `cause`: whether the effect is an answer.
 * @typedef {{shares: Share[], cause: boolean}} Inside */

/** Share of the residual there from which on an effect is an answer. */
const CAUSE = 0.1;

/** What an effect explains in the chosen range: the whole proposal less that without it, for each channel on its own,
 * as their units differ. Null: no range is chosen, or it is not known.
 * @param {string} effect @returns {Inside | null} */
export function insideOf(effect) {
  const whole = without.value[""], less = without.value[effect], now = shown.value, range = brush.value;
  if (!whole || !less || !now || !range) return null;
  const found = [...new Set(less.series.map((s) => s.channel))].flatMap((channel) => {
    const noise = less.channels[channel]?.noise_floor ?? less.noise_floor;
    let n = 0, sum = 0, squares = 0, seen = 0, all = 0;
    less.series.forEach((s, k) => {
      if (s.channel !== channel) return;
      s.predicted.forEach((mine, i) => {
        const together = whole.series[k]?.predicted[i], r = now.series[k]?.residual[i];
        if (mine === null || together == null || r == null || !isInside(s, i, range)) return;
        n++;
        sum += together - mine;
        squares += (together - mine) ** 2;
        seen += r;
        all += r * r;
      });
    });
    const size = Math.sqrt(squares / (n || 1)) / (noise || 1);
    return n ? [{ channel, mean: sum / n, seen: seen / n, size, cause: squares >= CAUSE ** 2 * all }] : [];
  });
  found.sort((a, b) => b.size - a.size);
  return found.length ? { shares: found, cause: found.some((one) => one.cause) } : null;
}
