// @ts-check
// Axes of the plots: columns in shown units, ranges that stand still while a slider moves, names and colours.
import { niceStep, number, scaleOf, toShown } from "../format.js";

/** @typedef {import("../types.js").Curves} Curves */
/** @typedef {import("../types.js").Across} Across */
/** @typedef {import("../types.js").Over} Over */
/** @typedef {import("../types.js").Preset} Preset */
/** @typedef {import("../format.js").System} System */
/** @typedef {import("../format.js").Quantity} Quantity */
/** What a plot needs; `place` keeps the ranges of one place apart from those of another.
 * @typedef {{place: string, curves: Curves, across: Across, over: Over, system: System,
 *   reference: Preset | null}} View */

/** @type {Record<Across, {title: string, quantity: Quantity}>} */
export const ACROSS = {
  contraction: { title: "Contraction", quantity: "ratio" },
  length: { title: "Length", quantity: "length" },
  braid_angle: { title: "Braid angle", quantity: "angle" },
};

/** @param {(number | null)[]} values @param {Quantity} quantity @param {System} system */
export function shown(values, quantity, system) {
  const s = scaleOf(quantity, system), offset = s.offset ?? 0;
  return values.map((v) => v == null ? null : (v - offset) / s.factor);
}

/** @param {string} title @param {Quantity} quantity @param {System} system */
export const axisTitle = (title, quantity, system) => `${title} (${scaleOf(quantity, system).unit})`;

/** Ranges that stay put while a slider moves: a new one is taken when the data leaves it or halves.
 * @type {Map<string, [number, number]>} */
const kept = new Map();
/** @param {string} key @param {number} low @param {number} high @returns {[number, number]} */
export function steadyRange(key, low, high) {
  if (!(high > low)) high = low + (Math.abs(low) || 1);
  const last = kept.get(key), span = high - low;
  if (last && low >= last[0] && high <= last[1] && span > 0.55 * (last[1] - last[0])) return last;
  const step = 10 ** Math.floor(Math.log10(span)) / 4;
  // A range that is left by a moving slider will be left again: it gets room to grow.
  const growing = last && span < 1.5 * (last[1] - last[0]) && span > 0.5 * (last[1] - last[0]);
  const margin = (growing ? 0.15 : 0.04) * span;
  const from = low >= 0 && low < 0.5 * span ? 0 : Math.floor((low - margin) / step) * step;
  /** @type {[number, number]} */
  const range = [from, Math.ceil((high + margin) / step) * step];
  kept.set(key, range);
  return range;
}

/** Another muscle, quantity or family is another picture: its ranges start afresh. */
export function forgetRanges() {
  kept.clear();
  return null;
}

/** @param {(number | null)[][]} rows @returns {[number, number]} */
export function extent(rows) {
  let low = Infinity, high = -Infinity;
  for (const row of rows) {
    for (const v of row) {
      if (v == null) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Value at a contraction, read off the answer's own columns. @param {Curves} c @param {Across} across
 * @param {number} k */
export function acrossAt(c, across, k) {
  if (across === "contraction") return k;
  if (across === "length") return c.geometry.nominal_length * (1 - k);
  const cosine = (1 - k) * Math.cos(c.geometry.braid_angle);
  return Math.acos(Math.min(1, Math.max(-1, cosine)));
}

/** @param {View} v the x columns of the curves, in shown units */
export const xColumn = ({ curves, across, system }) => shown(curves[across], ACROSS[across].quantity, system);

/** @param {View} v @param {string} key */
export function xAxis(v, key) {
  const { title, quantity } = ACROSS[v.across];
  const [low, high] = extent([xColumn(v)]);
  const range = steadyX(`${v.place}${key}${v.across}${v.system}`, low, high);
  return { title: axisTitle(title, quantity, v.system), range };
}

/** As steadyRange, but close to the data on both sides. @param {string} key @param {number} low
 * @param {number} high @returns {[number, number]} */
export function steadyX(key, low, high) {
  const span = high - low || 1, step = niceStep(span / 30);
  const last = kept.get(`x${key}`);
  const near = (/** @type {number} */ gap) => gap > -1e-6 * span && gap < 0.08 * span;
  if (last && near(low - last[0]) && near(last[1] - high)) return last;
  const tiny = 1e-6;
  /** @type {[number, number]} */
  const range = [Math.floor(low / step + tiny) * step, Math.ceil(high / step - tiny) * step];
  kept.set(`x${key}`, range);
  return range;
}

/** @param {number} p @param {Curves} c 0 at the lowest pressure of the family, 1 at the highest */
export function shareOf(p, c) {
  const low = Math.min(...c.pressure), high = Math.max(...c.pressure);
  return high > low ? (p - low) / (high - low) : 0.6;
}

/** @param {View} v @param {number} p */
export function pressureName({ system }, p) {
  const s = scaleOf("pressure", system);
  return `${number(toShown(p, s), 2)} ${s.unit}`;
}

/** @type {Record<Over, {title: string, quantity: Quantity}>} */
export const OVER = {
  contraction: { title: "Contraction", quantity: "ratio" },
  length: { title: "Length", quantity: "length" },
  diameter: { title: "Braid diameter", quantity: "length" },
  outer_diameter: { title: "Outer diameter", quantity: "length" },
  force: { title: "Force", quantity: "force" },
};
