// @ts-check
// Names and scales of the columns of a study.
import { figure, hasFigure } from "../../facts.js";
import { capitalized, number, plainScale, quantityOf, readable, scaleOf, toShown } from "../../format.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../format.js").Scale} Scale */
/** @typedef {import("../../format.js").System} System */
/** @typedef {import("../../types.js").S["StudyColumn"]} Column */

/** What a study watches, as it is declared; null for a quantity. @param {string} path */
const watchedFigure = (path) => hasFigure(`study.${path}`) ? figure(`study.${path}`) : null;

/** Where the last part of a path of a quantity alone would not say what it is. @type {Record<string, string>} */
const TITLES = {
  "muscle.nominal_length": "Rest length",
  "load.mass": "Mass",
  "supply.pressure": "Supply pressure",
  "tube.length": "Tube length",
  "load.force": "Load force",
  "gas.temperature": figure("task.ambient_temperature").label,
  "gas.ambient_pressure": "Ambient pressure",
};

/** @param {string} path of a figure or a quantity */
export function titleOf(path) {
  const watched = watchedFigure(path), [base, factor] = path.split(" (");
  if (watched) return watched.label;
  const known = TITLES[base], keys = base.split(".");
  const name = known ?? capitalized(readable(keys.at(-1) ?? ""));
  const around = known || keys.length < 2 ? "" : `, ${readable(keys.slice(-2, -1)[0])}`;
  return `${name}${around}${factor ? ", factor" : ""}`;
}

/** What a group of paths is called in a list. @param {string} path */
export function groupOf(path) {
  const watched = watchedFigure(path), keys = path.split(".");
  if (watched) return watched.section || "Task";
  if (keys[0] === "effects") return `Effect: ${readable(keys[1])}`;
  return keys.length > 1 ? capitalized(readable(keys[0])) : "Drive";
}

const SHARES = /contraction|share|reserve|restitution|opening/;

/** @param {string} path @param {string | null} unit SI @returns {Quantity | null} */
export function kindOf(path, unit) {
  const watched = watchedFigure(path);
  if (watched) return /** @type {Quantity | null} */ (watched.quantity);
  const si = (unit ?? "1").replaceAll("^", "");
  if (si === "1") return SHARES.test(path) && !path.includes("(") ? "ratio" : "number";
  return quantityOf(si, path);
}

/** @param {string} path @param {string | null} unit @param {System} system @returns {Scale} */
export function scaleFor(path, unit, system) {
  const kind = kindOf(path, unit);
  return kind ? scaleOf(kind, system) : plainScale(unit ?? "1");
}

/** The scale of a difference: without the offset of temperature scales. @param {Scale} scale */
export const ofDifference = (scale) => ({ ...scale, offset: 0 });

/** @param {number | null | undefined} si @param {Scale} scale */
export const valueText = (si, scale) => si == null ? "–" : number(toShown(si, scale), scale.digits + 2);

const FIGURES = 4, FEW = 2, MOST_PLACES = 7;

/** Writes the numbers of a column with one number of decimals: four significant digits for the largest, two for
 * the smallest, none that no number needs. @param {(number | null)[]} si @param {Scale} scale
 * @returns {(si: number | null | undefined) => string} */
export function columnText(si, scale) {
  const values = si.filter((v) => v !== null && Number.isFinite(v)).map((v) => toShown(Number(v), scale));
  const sizes = values.filter(Boolean).map((v) => Math.floor(Math.log10(Math.abs(v))));
  if (!sizes.length) return (v) => valueText(v, scale);
  const wished = Math.max(0, FIGURES - 1 - Math.max(...sizes), FEW - 1 - Math.min(...sizes));
  if (wished > MOST_PLACES) return (v) => valueText(v, scale);
  const needs = (/** @type {number} */ places) =>
    values.every((v) => Number(v.toFixed(places)) === Number(v.toFixed(wished)));
  let places = 0;
  while (places < wished && !needs(places)) places++;
  return (v) =>
    v == null ? "–" : toShown(v, scale).toFixed(places).replace("-", "−").replace(/^−(0\.?0*)$/, "$1");
}

/** @param {number | null | undefined} si @param {Scale} scale */
export function withUnitOf(si, scale) {
  const text = valueText(si, scale);
  return si == null || !scale.unit ? text : `${text}\u00a0${scale.unit}`;
}

/** @param {number} share */
export const percentText = (share) => `${(100 * share).toFixed(1).replace(/\.0$/, "")}\u00a0%`;

/** How runs ended. @type {Record<string, string>} */
export const OUTCOMES = {
  completed: "completed",
  refused: "refused: no drive can have these values",
  no_proposal: "without a proposal",
};

/** @param {string} name */
export const outcomeText = (name) => OUTCOMES[name] ?? readable(name);
