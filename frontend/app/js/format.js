// @ts-check
// Quantities: SI in the program, the user's units on the page. Reading numbers with units, writing numbers with
// sensible digits.
import { UNITS } from "./facts.js";
import { fits, measureOf, referenceShift, splitReference } from "./quantities.js";

/** @typedef {"si" | "bar" | "us"} System */
/** SI = shown × factor + offset, or shown = 20 lg SI of decibels.
 * @typedef {{unit: string, factor: number, offset?: number, digits: number, decibels?: boolean}} Scale */
/** @typedef {"length" | "pressure" | "modulus" | "force" | "stiffness" | "volume" | "temperature" | "torque" | "rotary" |
 *   "energy" | "angle" | "ratio" | "number" | "cost" | "percent" | "time" | "lapse" | "frequency" | "mass" | "speed" | "sweep" | "acceleration" |
 *   "conductance" | "rate" | "flow" | "air" | "normal" | "area" | "compliance" | "softness" | "damping" |
 *   "pressureDamping" | "perKelvin" | "gain" | "integralGain" | "derivativeGain" | "level" | "resistance"} Quantity */

/** [Pa] */
export const BAR = 1e5;

/** How each kind of quantity is shown in each unit system. @type {Record<Quantity, Record<System, Scale>>} */
export const SCALES = /** @type {Record<Quantity, Record<System, Scale>>} */ (UNITS.scales);

/** The quantity of a value by its SI unit: of several with the same unit the first. @type {Record<string, Quantity>} */
const OF_SI = {};
for (const [quantity, unit] of Object.entries(UNITS.quantities)) {
  OF_SI[unit.replaceAll("^", "")] ??= /** @type {Quantity} */ (quantity);
}

/** The quantity of a parameter by its SI unit; a modulus is shown in N/mm², not in bar.
 * @param {string} unit @param {string} [name]
 * @returns {Quantity | null} null: the unit has no scale of its own */
export function quantityOf(unit, name = "") {
  if (unit === "Pa" && /modulus|constant/.test(name)) return "modulus";
  if (unit === "1" || unit === "") return "number";
  return OF_SI[unit] ?? null;
}

/** How far a number is from one that stands beside it: "−41 %". @param {number} from @param {number} to */
export function changeText(from, to) {
  const percent = (100 * (to - from)) / Math.abs(from);
  return `${percent < 0 ? "−" : "+"}${Math.abs(percent).toFixed(Math.abs(percent) < 10 ? 1 : 0)}\u00a0%`;
}

/** A sentence whose numbers stay on a line with their units. @param {string} text */
export const unbroken = (text) => text.replace(/(\d) (?=%|mm|ms|Hz|[smJlgN]\b|kg|bar|m\/s)/g, "$1\u00a0");

/** A scale for a unit that has none: values are shown as they are. @param {string} unit */
export const plainScale = (unit) => ({ unit: tidyUnit(unit), factor: 1, digits: 6, offset: 0 });

/** "N*s/m" → "N·s/m", "m3" → "m³". @param {string} unit */
export const tidyUnit = (unit) =>
  unit === "1" ? "" : unit.replaceAll("**", "^").replaceAll("*", "·").replace(/\^?2\b/g, "²").replace(
    /\^?3\b/g,
    "³",
  ).replace(/^deg$/, "°").replace(/^degC$/, "°C");

/** @param {Quantity} quantity @param {System} system @returns {Scale} */
export const scaleOf = (quantity, system) => SCALES[quantity][system];

/** @param {number} si @param {Scale} s */
export const toShown = (si, s) =>
  s.decibels ? si > 0 ? 20 * Math.log10(si) : NaN : (si - (s.offset ?? 0)) / s.factor;
/** @param {number} shown @param {Scale} s */
export const toSi = (shown, s) => s.decibels ? 10 ** (shown / 20) : shown * s.factor + (s.offset ?? 0);

/** 1, 2 or 5 times a power of ten, at most x. @param {number} x */
export function niceStep(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  const lead = x / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** A number with at most `digits` decimals and about five significant figures, no trailing zeros.
 * @param {number} value @param {number} digits */
export function number(value, digits) {
  if (!Number.isFinite(value)) return "–";
  const size = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)));
  const places = Math.max(0, Math.min(digits, size < -digits ? 3 - size : 4 - size));
  if (places > 12) return value.toExponential(2);
  const text = value.toFixed(places);
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return short === "-0" ? "0" : short.replace("-", "−");
}

/** A number with three significant figures, for tables and readouts. @param {number} value */
export function brief(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const places = size === 0 ? 0 : size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
  return value.toFixed(places).replace(/^-/, "−").replace(/^−0(\.0+)?$/, "0");
}

/** @param {number | null | undefined} si @param {Quantity} quantity @param {System} system */
export function withUnit(si, quantity, system) {
  if (si == null) return "–";
  const s = scaleOf(quantity, system);
  const text = quantity === "pressure" ? number(toShown(si, s), 2) : brief(toShown(si, s));
  return s.unit ? `${text}${s.unit === "°" ? "" : "\u00a0"}${s.unit}` : text;
}

/** A figure by its declaration, with its unit. @param {number | null | undefined} si
 * @param {import("./facts.js").DeclaredFigure} figure @param {System} system */
export const figureText = (si, { quantity }, system) =>
  withUnit(si, /** @type {Quantity} */ (quantity), system);

/** A probability in whole percents: "94 %", "> 99 %", "< 1 %". @param {number} probability 0…1 */
export function probabilityText(probability) {
  const [least, most] = UNITS.certain;
  return probability > most
    ? `> ${Math.round(100 * most)}\u00a0%`
    : probability < least
    ? `< ${Math.round(100 * least)}\u00a0%`
    : `${Math.round(100 * probability)}\u00a0%`;
}

/** Case changes the meaning of these. */
const AMBIGUOUS = new Set(["mPa", "Mbar", "MBar", "MBAR"]);

/** @param {string} unit as a user writes it: case does not matter where there is one meaning */
function typedUnit(unit) {
  const key = unit.toLowerCase();
  return Object.hasOwn(UNITS.typed, key) && !AMBIGUOUS.has(unit) ? UNITS.typed[key] : null;
}

/** Weight of a mass [N/kg]. */
export const GRAVITY = UNITS.typed.kgf.factor;

/** The value of "20*9.81" or "20 kg * 9.81 m/s^2"; null: it is no calculation, or of another quantity.
 * @param {string} text @param {Scale} s @param {Quantity | null} quantity @param {boolean} [weighs] */
function calculated(text, s, quantity, weighs) {
  const measure = measureOf(
    text.replace(/(\d),(\d)/g, "$1.$2").replaceAll("×", "*").replaceAll("−", "-"),
    true,
  );
  if (!measure || !Number.isFinite(measure.factor)) return null;
  const si = UNITS.quantities[quantity ?? "number"] ?? "1";
  if (fits(measure, si.replace("%", "1"))) {
    const plain = si === "1" && !text.includes("%");
    return {
      value: plain ? toSi(measure.factor, s) : measure.factor,
      kind: plain ? undefined : quantity ?? "number",
    };
  }
  if (fits(measure, "1") && !text.includes("%")) return { value: toSi(measure.factor, s) };
  return weighs && fits(measure, "kg") ? { value: measure.factor * GRAVITY, kind: "mass" } : null;
}

/** Reads "30 cm", "6 bar", "25°", "1,5", "20*9.81"; a bare number is in the shown unit.
 * @param {string} text @param {Scale} s @param {Quantity | null} quantity
 * @param {string} [sample] the number of the example
 * @param {import("./quantities.js").Counted & {weighs?: boolean}} [counted] what a pressure is counted from; whether
 * a mass is read as its weight
 * @returns {{value: number, kind?: string} | {error: string}} SI; `kind`: the quantity of the typed unit */
export function parse(text, s, quantity, sample, counted = {}) {
  const tidy = text.trim().replace("−", "-").replace(/^([+-]?\d+),(\d+)(?=\D|$)/, "$1.$2");
  const example = `${sample || "1.5"} ${s.unit}`.trim();
  if (tidy === "") return { error: `Enter a number, for example ${example}.` };
  const match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/i.exec(tidy);
  const result = /[\d)]\s*[-+*/×^]/.test(tidy) && !/^[+-]?[\d.]+e/i.test(tidy)
    ? calculated(tidy, s, quantity, counted.weighs)
    : null;
  if (result) return result;
  if (!match) return { error: `“${text.trim()}” is not a number. Enter for example ${example}.` };
  const value = Number(match[1]);
  const { unit, stated } = splitReference(match[2].trim());
  const shift = referenceShift(stated, counted);
  if (shift === null) {
    return {
      error: `“${text.trim()}” is an absolute pressure. Enter a gauge pressure or a difference, ` +
        `for example ${example}.`,
    };
  }
  const known = typedUnit(unit);
  if (!unit || (unit === s.unit && stated === null) || (s.unit && tidyUnit(unit) === s.unit)) {
    return { value: toSi(value, s) + shift, kind: unit ? known?.quantity : undefined };
  }
  if (!known) return { error: `The unit “${unit}” is not known. Enter for example ${example}.` };
  const kind = /** @type {Quantity} */ (known.quantity), { factor, offset } = known;
  const wanted = basicQuantity(quantity);
  if (kind === "ratio" && wanted === "number" && s.unit === "") return { value: value * factor };
  if (counted.weighs && kind === "mass") return { value: value * factor * GRAVITY, kind };
  if (basicQuantity(kind) !== wanted) {
    return { error: `“${unit}” measures ${noun(kind)}, this is ${noun(wanted)}.` };
  }
  return { value: value * factor + offset + shift, kind };
}

/** The same quantity may be shown on different scales. @param {Quantity | null} quantity */
const basicQuantity = (quantity) =>
  quantity === "modulus"
    ? "pressure"
    : quantity === "lapse"
    ? "time"
    : quantity === "sweep"
    ? "speed"
    : quantity;

/** @param {Quantity | null} quantity */
function noun(quantity) {
  if (quantity === null || quantity === "number") return "a plain number";
  if (quantity === "ratio") return "a ratio";
  return (/^[aeiou]/.test(quantity) ? "an " : "a ") + quantity;
}

/** The quantity of a unit as presets write it; null: it is not converted. @param {string} unit
 * @returns {Quantity | null} */
export function quantityOfUnit(unit) {
  return /** @type {Quantity | undefined} */ (typedUnit(unit)?.quantity) ?? null;
}

/** The numbers of a column with the same number of decimals.
 * @param {(number | null)[]} values */
export function aligned(values) {
  const most = Math.max(...values.map((v) => Math.abs(v ?? 0)));
  const places = most >= 100 ? 0 : most >= 10 ? 1 : most >= 1 ? 2 : 3;
  const tidy = (/** @type {string} */ text) => text.replace(/^-(?=0\.?0*$)/, "").replace("-", "−");
  return values.map((v) => v == null ? "–" : tidy(v.toFixed(places)));
}

/** A preset's {value, unit} in SI. @param {{value: number, unit: string}} q */
export function siOf(q) {
  const known = typedUnit(q.unit);
  return known ? q.value * known.factor + known.offset : q.value;
}

/** Words of keys that are written in another way. @type {Record<string, string>} */
const WORDS = { area: "force per pressure", displacement: "stroke", mooney: "Mooney", stribeck: "Stribeck" };

/** A name of a document or request in words: "max_contraction" → "max contraction". @param {string} key */
export const readable = (key) =>
  key.replaceAll("_", " ").replace(/\b(?:area|displacement|mooney|stribeck)\b/g, (word) => WORDS[word]);

/** @param {string} text */
export const capitalized = (text) => text.replace(/^./, (letter) => letter.toUpperCase());
