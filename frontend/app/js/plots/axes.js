// @ts-check
// Axes of plots: columns in shown units, titles, ranges that stay the same while a slider moves.
import { niceStep, scaleOf, toShown } from "../format.js";

/** @typedef {import("../format.js").System} System */
/** @typedef {import("../format.js").Quantity} Quantity */
/** @param {(number | null)[]} values @param {Quantity} quantity @param {System} system */
export function shown(values, quantity, system) {
  const s = scaleOf(quantity, system);
  return values.map((v) => v == null || (s.decibels && v <= 0) ? null : toShown(v, s));
}

/** @param {string} title @param {Quantity} quantity @param {System} system */
export const axisTitle = (title, quantity, system) => `${title} (${scaleOf(quantity, system).unit})`;

/** Ranges that stay the same while a slider moves: a new one is chosen when the data leave the old one, or fill
 * little more than half of it.
 * @type {Map<string, [number, number]>} */
const kept = new Map();
/** @param {string} key @param {number} low @param {number} high @returns {[number, number]} */
export function steadyRange(key, low, high) {
  if (!(high > low)) high = low + (Math.abs(low) || 1);
  const last = kept.get(key), span = high - low;
  if (last && low >= last[0] && high <= last[1] && span > 0.55 * (last[1] - last[0])) return last;
  const step = 10 ** Math.floor(Math.log10(span)) / 4;
  // Data that leave the range while a slider moves will go on growing: leave room.
  const growing = last && span < 1.5 * (last[1] - last[0]) && span > 0.5 * (last[1] - last[0]);
  const margin = (growing ? 0.15 : 0.04) * span;
  const from = low >= 0 && low < 0.5 * span ? 0 : Math.floor((low - margin) / step) * step;
  /** @type {[number, number]} */
  const range = [from, Math.ceil((high + margin) / step) * step];
  kept.set(key, range);
  return range;
}

/** Forgets all ranges: for another muscle, other quantities or other pressures. */
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

/** Like steadyRange, but close to the data on both sides. @param {string} key @param {number} low
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
