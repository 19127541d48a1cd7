// @ts-check
// Fields of the experiment: what the file and the user say of each, and what is still open. Pure functions.
import { number, parse, quantityOf, scaleOf, toShown } from "../format.js";

/** @typedef {import("./types.js").Field} Field */
/** @typedef {import("./types.js").Said} Said */
/** @typedef {import("./types.js").Experiment} Experiment */
/** @typedef {import("../format.js").System} System */

/** The words of what was said. @param {Said} said */
export const textOf = (said) => typeof said === "string" ? said : said.value;

/** A value of a field in the shown unit. @param {Field} f @param {number | string} value @param {System} system */
export function valueText(f, value, system) {
  if (typeof value === "string") return value;
  const quantity = f.unit === "1" ? "ratio" : quantityOf(f.unit);
  if (!quantity) return `${number(value, 6)} ${f.unit}`.trim();
  const s = scaleOf(quantity, system);
  const text = number(toShown(value, s), s.digits);
  return s.unit ? `${text} ${s.unit}` : text;
}

/** How a field goes on without an answer: with what is assumed, or with what the view says later.
 * @typedef {"assumed" | "later"} Way */
/** Whether nobody has answered what this kind of test needs.
 * @param {Field} f @param {Said | undefined} said @param {Way | undefined} [way] */
export const isOpen = (f, said, way) =>
  f.unanswered && said === undefined && way !== "later" && !(way === "assumed" && f.value !== null);

/** Units of a field that measure something else than its own, as the newtons of a load in kg.
 * @param {Field} f */
const unitsOf = (f) => [f.unit, ...f.units.filter((unit) => quantityOf(unit) !== null && unit !== f.unit)];

/** Reads what the user typed as requests take it, in SI with the unit.
 * @param {Field} f @param {string} text @param {System} system @returns {{said: string} | {error: string}} */
export function readSaid(f, text, system) {
  const tidy = text.trim();
  if (!f.unit) {
    if (f.closed && !f.choices.includes(tidy)) return { error: `Choose ${f.choices.join(", ")}.` };
    return { said: tidy };
  }
  if (f.units.includes("%") && tidy.endsWith("%")) return { said: tidy };
  /** @type {{error: string} | null} */
  let wrong = null;
  for (const unit of unitsOf(f)) {
    const quantity = quantityOf(unit);
    if (!quantity || quantity === "number") continue;
    const got = parse(tidy, scaleOf(quantity, system), quantity, undefined, { reference: "gauge" });
    if ("error" in got) {
      wrong ??= got;
      continue;
    }
    const shown = (/** @type {number} */ si) => valueText({ ...f, unit }, si, system);
    if (f.least !== null && unit === f.unit && got.value < f.least) {
      return { error: `At least ${shown(f.least)}.` };
    }
    if (f.most !== null && unit === f.unit && got.value > f.most) {
      return { error: `At most ${shown(f.most)}.` };
    }
    return { said: `${Number(got.value.toPrecision(12))} ${unit}` };
  }
  return wrong ?? { said: tidy };
}

/** What was said, as a field shows it. @param {Field} f @param {Said} said @param {System} system */
export function saidText(f, said, system) {
  const text = textOf(said), match = /^([-+.\de]+) (\S+)$/.exec(text);
  return match && quantityOf(match[2]) ? valueText({ ...f, unit: match[2] }, Number(match[1]), system) : text;
}

/** What the file says where the user says something else; "" = they agree.
 * @param {Field} f @param {Said | undefined} said @param {System} system */
export function contradicted(f, said, system) {
  if (said === undefined || f.origin !== "file" || f.value === null) return "";
  const file = valueText(f, f.value, system);
  return saidText(f, said, system) === file ? "" : file;
}
