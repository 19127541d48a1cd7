// @ts-check
// Columns of runs and measurements: values at other times, intervals, the row at a time. Pure functions.

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../types.js").Measured} Measured */

const MOST_DOTS = 400;

/** Values of a run at other times, interpolated linearly; null outside the run.
 * @param {number[]} time @param {(number | null)[]} values @param {number[]} wanted */
export function resampled(time, values, wanted) {
  let k = 0;
  return wanted.map((t) => {
    if (t < time[0] - 1e-9 || t > time[time.length - 1] + 1e-9) return null;
    while (k < time.length - 2 && time[k + 1] < t) k++;
    const a = values[k], b = values[k + 1];
    if (a == null || b == null) return null;
    const share = (t - time[k]) / (time[k + 1] - time[k] || 1);
    return a + (b - a) * Math.min(1, Math.max(0, share));
  });
}

/** The time intervals in which something is so at each row. @param {number[]} time @param {boolean[]} isSo
 * @returns {[number, number][]} */
export function intervals(time, isSo) {
  /** @type {[number, number][]} */
  const found = [];
  isSo.forEach((on, i) => {
    if (!on) return;
    const last = found.at(-1);
    if (last && isSo[i - 1]) last[1] = time[i];
    else found.push([time[i], time[i]]);
  });
  return found.filter(([from, to]) => to > from);
}

/** Values of a run without those at a stop, where an impact would dwarf all others.
 * @param {Run} run @param {(number | null)[]} values */
export function withoutImpacts({ contact }, values) {
  return values.map((v, i) => contact[i - 1] || contact[i] || contact[i + 1] ? null : v);
}

/** The points of a measured channel in a time range, thinned out for drawing.
 * @param {Measured | null} measured @param {[number, number]} span
 * @param {string[]} names of channels; the first one present is taken
 * @param {(value: number, name: string) => number} [shown] what is drawn of a value */
export function measuredColumn(measured, [from, to], names, shown = (value) => value) {
  const time = /** @type {number[] | undefined} */ (measured?.columns.time);
  const name = names.find((one) => measured?.columns[one]);
  if (!measured || !time || !name) return null;
  const y = /** @type {number[]} */ (measured.columns[name]);
  const inside = [...time.keys()].filter((i) => time[i] >= from && time[i] <= to);
  const step = Math.max(1, Math.ceil(inside.length / MOST_DOTS));
  const kept = inside.filter((_, k) => k % step === 0);
  return { x: kept.map((i) => time[i]), y: kept.map((i) => shown(y[i], name)) };
}

/** Measured positions of the load: a file has the stroke or the length of the muscle.
 * @param {Run} run @param {Measured | null} measured @param {[number, number]} span @param {number} lever */
export function measuredPosition(run, measured, span, lever) {
  const rest = run.geometry.nominal_length, middle = rest * middleOf(run);
  return measuredColumn(
    measured,
    span,
    ["displacement", "length"],
    (value, name) => ((name === "length" ? rest - value : value) - middle) / lever,
  );
}

/** The row of a run nearest to a time. @param {number[]} time @param {number} t */
export function rowAt(time, t) {
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle;
  }
  return t - time[low] <= time[high] - t ? low : high;
}

/** The contraction of both muscles of an antagonist pair at position 0; 0 for a single muscle. @param {Run} run */
export function middleOf(run) {
  const k = run.contraction.findIndex((v) => v != null);
  return run.joint && k >= 0
    ? (run.contraction[k] ?? 0) - (run.position[k] ?? 0) / run.geometry.nominal_length
    : 0;
}
