// @ts-check
// Drives, their figures, limits and aims in words, with the user's units.
import { h } from "../../dom.js";
import { figure, inSentence } from "../../facts.js";
import { units } from "../../state.js";
import { withUnit } from "../../format.js";

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

/** @typedef {{ [K in keyof Proposal]: Proposal[K] extends number | null ? K : never }[keyof Proposal]} Name */

/** A figure of a proposal as it is declared. @param {string} name */
export const sizingFigure = (name) => figure(`sizing.${name}`);

const CYCLES = "life";
/** A figure of a drive as text. @param {Proposal} p @param {Name} name */
export function valueText(p, name) {
  const value = p[name];
  if (value == null) return `– ${sizingFigure(name).otherwise}`.trim();
  if (name === CYCLES) return `${Number(value.toPrecision(2)).toLocaleString("en")} cycles`;
  return asText(value, /** @type {Quantity} */ (sizingFigure(name).quantity));
}

/** Figures as terms with their definitions. @param {Proposal} p @param {Name[]} names */
export const terms = (p, names) =>
  names.flatMap((name) => {
    const { label, definition } = sizingFigure(name);
    return [h("dt", { title: definition }, label), h("dd", null, valueText(p, name))];
  });

/** @param {string} name */
export const limitName = (name) => inSentence(figure(`limit.${name}`).label);

/** The figure of each aim. @type {Record<Aim, keyof Design>} */
const AIMS = {
  air: "air_volume_anr",
  time: "time",
  length: "installed_length",
  reserve: "force_reserve",
  stiffness: "stiffness",
};
/** An aim: its label, quantity, and value of a drive. @param {Aim} aim */
export function aimOf(aim) {
  const name = AIMS[aim], { label, quantity } = sizingFigure(name);
  return {
    label,
    quantity: /** @type {Quantity} */ (quantity),
    of: (/** @type {Design} */ d) => Number(d[name]),
  };
}
