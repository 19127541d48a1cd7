// @ts-check
// The quantities that curves of a muscle are drawn over, and the colours and names of the pressures.
import { number, scaleOf, toShown } from "../format.js";
import { figure } from "../facts.js";
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

/** Title and quantity of an axis. @param {string} key */
function titled(key) {
  const { label, quantity } = figure(key);
  return { title: label, quantity };
}

/** @type {Record<Across, {title: string, quantity: Quantity}>} */
export const ACROSS = {
  contraction: titled("curves.contraction"),
  length: titled("curves.length"),
  braid_angle: titled("curves.braid_angle"),
};

/** The value of the x quantity at a contraction, between the columns of the curves; null beside them.
 * @param {Curves} c @param {Across} across @param {number | null} k */
export function acrossAt(c, across, k) {
  const { contraction } = c, values = c[across];
  const last = contraction.length - 1;
  if (k === null || !(k >= contraction[0] && k <= contraction[last])) return null;
  const i = Math.max(1, contraction.findIndex((each) => each >= k));
  const low = values[i - 1], high = values[i];
  if (low === null || high === null) return null;
  return low + (high - low) * (k - contraction[i - 1]) / (contraction[i] - contraction[i - 1]);
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
  contraction: titled("over_pressure.contraction"),
  length: titled("over_pressure.length"),
  diameter: titled("over_pressure.diameter"),
  outer_diameter: titled("over_pressure.outer_diameter"),
  outer_diameter_at_fixed_length: {
    ...titled("over_pressure.outer_diameter_at_fixed_length"),
    axis: figure("over_pressure.outer_diameter").label,
  },
  force: { ...titled("over_pressure.force_at_fixed_length"), axis: figure("curves.force").label },
};

/** Definitions of the stiffness with their formulas. @type {Record<StiffnessOf, {title: string, text: string}>} */
export const STIFFNESS = {
  tangent: { title: "tangent", text: figure("curves.stiffness").definition },
  from_force: { title: "of the force", text: figure("curves.stiffness_from_force").definition },
  secant: { title: "secant", text: figure("curves.stiffness_secant").definition },
};

/** Whether both ends are held, instead of a load that hangs. @param {Over} over */
export const atFixedLength = (over) => over === "force" || over === "outer_diameter_at_fixed_length";
