// @ts-check
// Drives, limits and aims in words, with the user's units.
import { units } from "../../state.js";
import { readable, withUnit } from "../../format.js";

/** @typedef {import("../../types.js").S["ExploredDrive"]} Explored */
/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */
/** @typedef {import("../../types.js").Aim} Aim */
/** @typedef {import("../../format.js").Quantity} Quantity */
/** What proposals and explored drives have in common. @typedef {Explored | Proposal} Design */

/** @param {number | null | undefined} si @param {Quantity} quantity */
export const asText = (si, quantity) => withUnit(si, quantity, units.value);

/** Whole percent: what is left of a limit, or a probability. @param {number | null | undefined} x */
export const percent = (x) => x == null ? "–" : `${Math.round(100 * x)}\u00a0%`;

/** The margin to a limit, as long as its bar: a full bar is 100 % or more. @param {number} margin */
export const spare = (margin) => margin > 1 ? "> 100\u00a0% left" : `${percent(margin)} left`;

/** "2 × DMSP-20, 412 mm"; for an antagonist pair the muscles of both sides are counted. @param {Design} d */
export function driveWords(d) {
  const pair = "pulley_radius" in d && d.pulley_radius != null, count = d.parallel * (pair ? 2 : 1);
  const sides = pair && d.parallel > 1 ? `, ${d.parallel} per side` : "";
  return `${count > 1 ? `${count} × ` : ""}${d.muscle}, ${asText(d.nominal_length, "length")}${sides}`;
}

/** Valve, tube and pressure. @param {Design} d */
export const partsOf = (d) => [
  d.valve,
  d.tube ?? "no tube",
  asText(d.pressure, "pressure"),
  ...("pulley_radius" in d && d.pulley_radius != null
    ? [`pulley of ${asText(d.pulley_radius, "length")} radius`]
    : []),
];
/** The same as one text. @param {Design} d */
export const partsWords = (d) => partsOf(d).join(", ");

/** @type {Record<Proposal["binding"], string>} */
const LIMITS = {
  length: "length",
  pressure: "pressure",
  contraction: "contraction",
  force: "force reserve",
  force_limit: "muscle force",
  suspended_mass: "hanging mass",
  valve_pressure: "valve pressure",
  diameter: "diameter",
  stiffness: "stiffness",
  life: "life",
  temperature: "temperature",
  time: "time",
  time_down: "time back",
  cycle_time: "cycle time",
};
/** @param {string} name */
export const limitName = (name) => LIMITS[/** @type {Proposal["binding"]} */ (name)] ?? readable(name);

/** @type {Record<Aim, {title: string, quantity: Quantity, good: "less" | "more",
 *   of: (d: Design, fittings: number) => number}>} */
export const AIMS = {
  air: { title: "Air per cycle", quantity: "normal", good: "less", of: (d) => d.air_volume_anr },
  time: { title: "Time for the stroke", quantity: "time", good: "less", of: (d) => d.time },
  length: {
    title: "Installed length",
    quantity: "length",
    good: "less",
    of: (d, fittings) => d.nominal_length + fittings,
  },
  reserve: { title: "Force reserve", quantity: "ratio", good: "more", of: (d) => d.force_reserve },
  stiffness: { title: "Stiffness", quantity: "stiffness", good: "more", of: (d) => d.stiffness },
};
