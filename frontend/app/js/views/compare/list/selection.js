// @ts-check
// "What would cause this?": what each entry would explain of the residual in the chosen range.
import { brush, shown } from "../answers.js";
import { isInside } from "../words.js";
import { without } from "./sketch.js";

/** Means and sizes in the chosen range, SI. `mean`, `size`: of what the effect would explain; `seen`: mean of the
 * residual; `cause`: whether the effect is an answer.
 * @typedef {{mean: number, seen: number, size: number, cause: boolean}} Inside */

/** Share of the residual there from which on an effect is an answer. */
const CAUSE = 0.1;

/** What an effect explains in the chosen range: the whole proposal less that without it; null: no range is chosen,
 * it is not known, or several channels are predicted. @param {string} effect @returns {Inside | null} */
export function insideOf(effect) {
  const whole = without.value[""], less = without.value[effect], now = shown.value, range = brush.value;
  if (!whole || !less || !now || !range || Object.keys(less.channels).length > 1) return null;
  let n = 0, sum = 0, squares = 0, seen = 0, all = 0;
  less.series.forEach((s, k) => {
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
  return n
    ? { mean: sum / n, seen: seen / n, size: Math.sqrt(squares / n), cause: squares >= CAUSE ** 2 * all }
    : null;
}
