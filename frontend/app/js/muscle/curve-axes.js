// @ts-check
// The quantities that curves of a muscle are drawn over, and the colours and names of the pressures.
import { number, scaleOf, toShown } from "../format.js";
import { axisTitle, extent, shown, steadyX } from "../plots/axes.js";

/** @typedef {import("../types.js").Curves} Curves */
/** @typedef {import("../types.js").Across} Across */
/** @typedef {import("../types.js").Over} Over */
/** @typedef {import("../types.js").StiffnessOf} StiffnessOf */
/** @typedef {import("../types.js").Preset} Preset */
/** @typedef {import("../format.js").System} System */
/** @typedef {import("../format.js").Quantity} Quantity */
/** What a plot of curves needs; `place`: the view, whose axis ranges are its own.
 * @typedef {{place: string, curves: Curves, across: Across, over: Over, system: System,
 *   reference: Preset | null, definition?: StiffnessOf}} View */

/** @type {Record<Across, {title: string, quantity: Quantity}>} */
export const ACROSS = {
  contraction: { title: "Contraction", quantity: "ratio" },
  length: { title: "Length", quantity: "length" },
  braid_angle: { title: "Braid angle", quantity: "angle" },
};

/** The value of the x quantity at a contraction. @param {Curves} c @param {Across} across
 * @param {number} k */
export function acrossAt(c, across, k) {
  if (across === "contraction") return k;
  if (across === "length") return c.geometry.nominal_length * (1 - k);
  const cosine = (1 - k) * Math.cos(c.geometry.braid_angle);
  return Math.acos(Math.min(1, Math.max(-1, cosine)));
}

/** The x values of the curves in shown units. @param {View} v */
export const xColumn = ({ curves, across, system }) => shown(curves[across], ACROSS[across].quantity, system);

/** @param {View} v @param {string} key */
export function xAxis(v, key) {
  const { title, quantity } = ACROSS[v.across];
  const [low, high] = extent([xColumn(v)]);
  const range = steadyX(`${v.place}${key}${v.across}${v.system}`, low, high);
  return { title: axisTitle(title, quantity, v.system), range };
}

/** 0 at the lowest of the pressures, 1 at the highest. @param {number} p @param {Curves} c */
export function shareOf(p, c) {
  const low = Math.min(...c.pressure), high = Math.max(...c.pressure);
  return high > low ? (p - low) / (high - low) : 0.6;
}

/** @param {View} v @param {number} p */
export function pressureName({ system }, p) {
  const s = scaleOf("pressure", system);
  return `${number(toShown(p, s), 2)} ${s.unit}`;
}

/** What is shown over the pressure: title, and a shorter one of the axis where it has one.
 * @type {Record<Over, {title: string, axis?: string, quantity: Quantity}>} */
export const OVER = {
  contraction: { title: "Contraction", quantity: "ratio" },
  length: { title: "Length", quantity: "length" },
  diameter: { title: "Braid diameter", quantity: "length" },
  outer_diameter: { title: "Outer diameter", quantity: "length" },
  outer_diameter_at_fixed_length: {
    title: "Outer diameter at fixed length",
    axis: "Outer diameter",
    quantity: "length",
  },
  force: { title: "Force at fixed length", axis: "Force", quantity: "force" },
};

/** Definitions of the stiffness with their formulas. @type {Record<StiffnessOf, {title: string, text: string}>} */
export const STIFFNESS = {
  tangent: { title: "tangent", text: "dF/dL at constant pressure; dashed with the valve closed" },
  from_force: {
    title: "of the force",
    text: "6 L F/(3 L² − b²): of an ideal muscle with this force and length",
  },
  secant: { title: "secant", text: "F/(L − Lmin): straight from the length without force" },
};

/** Whether both ends are held, instead of a load that hangs. @param {Over} over */
export const atFixedLength = (over) => over === "force" || over === "outer_diameter_at_fixed_length";
