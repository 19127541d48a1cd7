// @ts-check
// The residual by measured level and eighth of the contraction, also for each direction of motion. Pure functions.
import { column, varies } from "../words.js";

/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../types.js").Series} Series */
/** Means in SI; `up`, `down`: of lengthening and shortening alone.
 * @typedef {{mean: number, rms: number, count: number, up: number | null, down: number | null}} Cell */
/** `range`: of the variable of the rows; `channel`: a row of several channels has no range.
 * @typedef {{range: [number, number], level: number | null, channel?: string, cells: (Cell | null)[]}} Row */
/** `split`: the directions disagree by more than chance, so that a mean over both would hide it; rows with the
 * largest level first; `scaled`: in units of the noise of each channel.
 * @typedef {{x: string, y: string, edges: number[], rows: Row[], split: boolean, scaled: boolean}} Grid */

const COLUMNS = 8, MOST_LEVELS = 14;
/** Levels closer than this share of the largest one are one level. */
const SAME_LEVEL = 0.01;

/** The map of a comparison: channels over time where there are several, levels where the file has them, else the
 * ranges of the server.
 * @param {Comparison} a @returns {Grid | null} */
export function mapOf(a) {
  const series = a.series.filter((s) => s.use !== "validation");
  const isOne = new Set(series.map((s) => s.channel)).size <= 1;
  return isOne ? ofLevels(series, a.noise_floor) ?? ofRanges(a) : ofChannels(series, a) ?? ofRanges(a);
}

/** @param {Series[]} series */
function levelsOf(series) {
  const all = series.flatMap((s) => s.pressure === null ? [] : [s.pressure]).sort((a, b) => a - b);
  if (all.length < series.length) return [];
  const near = SAME_LEVEL * Math.abs(all.at(-1) ?? 0);
  return all.filter((p, i) => !i || p - all[i - 1] > near);
}

/** @param {Series[]} series @param {number | null} sigma @returns {Grid | null} */
function ofLevels(series, sigma) {
  const levels = levelsOf(series);
  if (!levels.length || levels.length > MOST_LEVELS) return null;
  const x = ["contraction", "time"].find((name) => varies(series, name));
  if (!x) return null;
  const edges = edgesOf(series, x);
  const rows = levels.map((level, k) => {
    const next = levels[k + 1] ?? Infinity, last = levels[k - 1] ?? -Infinity;
    const mine = series.filter((s) => nearest(s.pressure ?? 0, last, level, next));
    return rowOf(mine, level, x, edges);
  });
  const found = rows.map((row) => row.row).reverse();
  return {
    x,
    y: "pressure",
    edges,
    rows: found,
    scaled: false,
    split: disagree(rows.flatMap((row) => row.tallies), sigma),
  };
}

/** Equal parts of the range of a variable. @param {Series[]} series @param {string} x */
function edgesOf(series, x) {
  let low = Infinity, high = -Infinity;
  for (const s of series) {
    for (const v of column(s, x)) {
      if (v === null) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return Array.from({ length: COLUMNS + 1 }, (_, i) => low + ((high - low) * i) / COLUMNS);
}

/** Each channel over time, in units of its noise. @param {Series[]} series @param {Comparison} a
 * @returns {Grid | null} */
function ofChannels(series, a) {
  if (!varies(series, "time")) return null;
  const edges = edgesOf(series, "time"), names = [...new Set(series.map((s) => s.channel))];
  const rows = names.map((channel) => {
    const noise = a.channels[channel]?.noise_floor || 1;
    const mine = series.filter((s) => s.channel === channel)
      .map((s) => ({ ...s, residual: s.residual.map((r) => r === null ? null : r / noise) }));
    return { ...rowOf(mine, 0, "time", edges).row, level: null, channel };
  });
  return { x: "time", y: "channel", edges, rows, split: false, scaled: true };
}

/** @param {number} p @param {number} last @param {number} level @param {number} next */
const nearest = (p, last, level, next) =>
  Math.abs(p - level) <= Math.abs(p - last) && Math.abs(p - level) < Math.abs(p - next);

/** Sums of one direction in a cell. @typedef {{n: number, sum: number, squares: number}} Tally */
const tally = () => ({ n: 0, sum: 0, squares: 0 });
/** @param {Tally} t @param {number} r */
function count(t, r) {
  t.n++;
  t.sum += r;
  t.squares += r * r;
}

/** @param {Series[]} series @param {number} level @param {string} x @param {number[]} edges */
function rowOf(series, level, x, edges) {
  const tallies = Array.from({ length: COLUMNS }, () => ({ all: tally(), up: tally(), down: tally() }));
  let low = level, high = level;
  const first = edges[0], span = edges[COLUMNS] - first;
  for (const s of series) {
    const at = column(s, x), pressures = s.x_pressure;
    s.residual.forEach((r, i) => {
      const v = at[i], p = pressures[i];
      if (r === null || v === null) return;
      if (p !== null && p < low) low = p;
      if (p !== null && p > high) high = p;
      const cell = tallies[Math.min(COLUMNS - 1, Math.max(0, Math.floor(((v - first) / span) * COLUMNS)))];
      count(cell.all, r);
      const way = Math.sign(s.direction[i] ?? 0);
      if (way) count(way > 0 ? cell.up : cell.down, r);
    });
  }
  const mean = (/** @type {Tally} */ t) => t.n ? t.sum / t.n : null;
  const cells = tallies.map(({ all, up, down }) =>
    all.n
      ? {
        mean: all.sum / all.n,
        rms: Math.sqrt(all.squares / all.n),
        count: all.n,
        up: mean(up),
        down: mean(down),
      }
      : null
  );
  return { row: { range: /** @type {[number, number]} */ ([low, high]), level, cells }, tallies };
}

/** Standard deviations of a chi-squared sum from which the directions disagree. */
const BEYOND_CHANCE = 3;
/** Mean difference of the directions over the noise, below which it is not worth two rows. */
const WORTH = 0.5;

/** Whether the means of both directions differ by more than their scatter allows.
 * @param {{up: Tally, down: Tally}[]} cells @param {number | null} sigma */
function disagree(cells, sigma) {
  const both = cells.filter(({ up, down }) => up.n > 1 && down.n > 1);
  if (!both.length) return false;
  let chi = 0, gap = 0, scatter = 0;
  for (const { up, down } of both) {
    const spread = [up, down].reduce((sum, t) => sum + t.squares - (t.sum * t.sum) / t.n, 0);
    const variance = Math.max(spread / (up.n + down.n - 2), (sigma ?? 0) ** 2, 1e-30);
    const difference = up.sum / up.n - down.sum / down.n;
    chi += difference ** 2 / (variance * (1 / up.n + 1 / down.n));
    gap += Math.abs(difference);
    scatter += Math.sqrt(variance);
  }
  const k = both.length;
  return chi > k + BEYOND_CHANCE * Math.sqrt(2 * k) && gap / k > WORTH * (sigma ?? scatter / k);
}

/** The map of the server over two variables in equal ranges. @param {Comparison} a @returns {Grid | null} */
function ofRanges({ heat_map: map }) {
  if (!map) return null;
  const edge = (/** @type {(number | null)[]} */ edges, /** @type {number} */ i) => edges[i] ?? 0;
  const rows = map.mean.map((means, iy) => ({
    range: /** @type {[number, number]} */ ([edge(map.y_edges, iy), edge(map.y_edges, iy + 1)]),
    level: null,
    cells: means.map((mean, ix) => {
      const n = map.count[iy]?.[ix] ?? 0;
      return mean === null || !n
        ? null
        : { mean, rms: map.rms[iy][ix] ?? Math.abs(mean), count: n, up: null, down: null };
    }),
  })).reverse();
  return { x: map.x, y: map.y, edges: map.x_edges.map((v) => v ?? 0), rows, split: false, scaled: false };
}
