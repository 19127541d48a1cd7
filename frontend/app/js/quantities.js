// @ts-check
// Quantities as documents write them, "6 bar" or "120 N*s/m", converted to SI.
import { UNITS } from "./facts.js";

/** Exponents of m, kg, s, K, rad. @typedef {number[]} Dimension */
/** Factor and dimension of a unit. @typedef {{factor: number, of: Dimension}} Measure */
/** @type {Map<string, Measure>} */
const MEASURES = new Map(
  Object.entries(UNITS.names).map(([unit, { factor, dimension }]) => [unit, { factor, of: dimension }]),
);
const NOTHING = [0, 0, 0, 0, 0];

/** @param {Measure} one @param {Measure} other @param {1 | -1} sign @returns {Measure} */
const times = (one, other, sign) => ({
  factor: one.factor * other.factor ** sign,
  of: one.of.map((x, i) => x + sign * other.of[i]),
});

const UNIT = /[A-Za-zµ°%]+|\*\*|[()*/·^ ]|-?\d+/g;
const CALCULATED = /\d+\.?\d*(?:e[+-]?\d+)?|\.\d+|[A-Za-zµ°%]+|\*\*|[()*/·^ +-]/gi;

/** Factor to SI and dimension of a unit such as "l/(s*bar)", or of a calculation such as "20 kg * 9.81 m/s^2";
 * null: an unknown unit, or a sum of different things. @param {string} text @param {boolean} [calculated]
 * whether numbers may stand in it @returns {Measure | null} */
export function measureOf(text, calculated = false) {
  const tokens = text.match(calculated ? CALCULATED : UNIT) ?? [];
  if (tokens.join("") !== text) return null;
  let at = 0;
  const blank = () => {
    while (calculated && tokens[at] === " ") at++;
  };
  /** @returns {Measure | null} */
  const power = () => {
    blank();
    const token = tokens[at++];
    /** @type {Measure | null} */
    let base = null;
    if (token === "(") {
      base = sum();
      if (tokens[at++] !== ")") return null;
    } else if (calculated && /^[\d.]/.test(token ?? "")) return { factor: Number(token), of: NOTHING };
    else base = MEASURES.get(token) ?? null;
    if (base === null) return null;
    if (tokens[at] === "^" || tokens[at] === "**") at++;
    if (!/^-?\d+$/.test(tokens[at] ?? "")) return base;
    const exponent = Number(tokens[at++]);
    return { factor: base.factor ** exponent, of: base.of.map((x) => x * exponent) };
  };
  /** @returns {Measure | null} */
  const product = () => {
    let value = power();
    for (blank(); value !== null && at < tokens.length && !/^[)+-]$/.test(tokens[at]); blank()) {
      const sign = /[*/· ]/.test(tokens[at]) ? tokens[at++] : "*";
      const next = power();
      value = next === null ? null : times(value, next, sign === "/" ? -1 : 1);
    }
    return value;
  };
  /** @returns {Measure | null} */
  const sum = () => {
    let value = product();
    while (value !== null && /^[+-]$/.test(tokens[at] ?? "")) {
      const sign = tokens[at++] === "+" ? 1 : -1, next = product();
      if (next === null || next.of.some((x, i) => x !== value?.of[i])) return null;
      value = { factor: value.factor + sign * next.factor, of: value.of };
    }
    return value;
  };
  const value = sum();
  return at === tokens.length ? value : null;
}

/** Whether a unit measures what an SI unit does; without a unit: whether that is a plain number.
 * @param {Measure | null} measure @param {string} si */
export function fits(measure, si) {
  const wanted = measureOf(si), of = measure?.of ?? NOTHING;
  return wanted !== null && wanted.of.every((x, i) => x === of[i]);
}

/** [Pa], where a document states no ambient pressure */
export const ATMOSPHERE = 101325;

/** What a pressure is counted from. @typedef {"gauge" | "absolute"} Reference */
/** What the pressure wanted is counted from, and the ambient pressure [Pa].
 * @typedef {{reference?: Reference | null, ambient?: number}} Counted */

/** "bar(a)", "bara", "bar abs", "psig", "MPa (gauge)": a unit that says what a pressure is counted from. */
const REFERENCED = new RegExp(
  "^([kKMmhd]?(?:Pa|pa|PA)|[mM]?(?:bar|Bar|BAR)|psi|PSI|Psi)\\s*" +
    "(?:\\(\\s*(g|a|gauge|rel|abs|absolute)\\s*\\)|(g|a|gauge|rel|abs|absolute))\\.?$",
);

/** The unit without the word for the reference of a pressure, and the reference; null: there is no such word.
 * @param {string} unit @returns {{unit: string, stated: Reference | null}} */
export function splitReference(unit) {
  const match = REFERENCED.exec(unit);
  if (!match) return { unit, stated: null };
  return { unit: match[1], stated: (match[2] ?? match[3]).startsWith("a") ? "absolute" : "gauge" };
}

/** What is added to a pressure so that it counts from what is wanted [Pa]; null: an absolute pressure where no
 * reference is known. @param {Reference | null} stated @param {Counted} wanted */
export function referenceShift(stated, { reference = null, ambient = ATMOSPHERE }) {
  if (stated === null || stated === reference) return 0;
  if (reference === null) return stated === "gauge" ? 0 : null;
  return stated === "absolute" ? -ambient : ambient;
}

/** A number in SI, or a text with a unit as a number in SI; null: neither, or a text that only the server can
 * convert or refuse.
 * @param {unknown} value @param {Counted & {unit?: string}} [wanted]  `unit`: the SI unit of the value, if it is known
 * @returns {number | null} */
export function siNumber(value, wanted = {}) {
  if (typeof value === "number") return value;
  const match = typeof value === "string" &&
    /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/i.exec(value);
  if (!match) return null;
  const number = Number(match[1]), { unit: si } = wanted;
  if (match[2] === "") return si === undefined || fits(null, si) ? number : null;
  if (Object.hasOwn(UNITS.shifted, match[2])) {
    const [factor, offset] = UNITS.shifted[match[2]];
    return si === undefined || si === "K" ? number * factor + offset : null;
  }
  const { unit, stated } = splitReference(match[2]);
  const measure = measureOf(unit), shift = referenceShift(stated, wanted);
  if (measure === null || shift === null || (si !== undefined && !fits(measure, si))) return null;
  return Number((number * measure.factor + shift).toPrecision(12));
}
