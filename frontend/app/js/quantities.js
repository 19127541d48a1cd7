// @ts-check
// Quantities as documents write them, "6 bar" or "120 N*s/m", converted to SI.

const INCH = 0.0254, POUND = 0.45359237, LBF = 4.4482216152605;
/** @type {Record<string, number>} */
const FACTORS = {
  ...{ m: 1, cm: 1e-2, mm: 1e-3, um: 1e-6, µm: 1e-6, in: INCH, inch: INCH, ft: 12 * INCH },
  ...{
    Pa: 1,
    hPa: 100,
    kPa: 1e3,
    MPa: 1e6,
    GPa: 1e9,
    bar: 1e5,
    mbar: 100,
    psi: LBF / INCH ** 2,
    atm: 101325,
  },
  // as the server accepts them too
  ...{ Bar: 1e5, BAR: 1e5, PSI: LBF / INCH ** 2, Psi: LBF / INCH ** 2, pa: 1 },
  ...{ kpa: 1e3, KPa: 1e3, KPA: 1e3, MPA: 1e6, MM: 1e-3, CM: 1e-2, sec: 1, Sec: 1 },
  ...{ N: 1, mN: 1e-3, kN: 1e3, lbf: LBF, kg: 1, g: 1e-3, t: 1e3, lb: POUND, J: 1, kJ: 1e3, W: 1, K: 1 },
  ...{ s: 1, ms: 1e-3, us: 1e-6, µs: 1e-6, min: 60, h: 3600, Hz: 1, kHz: 1e3 },
  ...{ l: 1e-3, L: 1e-3, ml: 1e-6, rad: 1, deg: Math.PI / 180, "°": Math.PI / 180, "%": 0.01 },
};
/** Temperature scales: factor and offset. They cannot be part of a compound unit. @type {Record<string, [number, number]>} */
const SHIFTED = {
  degC: [1, 273.15],
  "°C": [1, 273.15],
  degF: [5 / 9, 273.15 - (32 * 5) / 9],
};

/** The SI factor of a unit such as "l/(s*bar)"; null: unknown unit. @param {string} text */
function factorOf(text) {
  const tokens = text.match(/[A-Za-zµ°%]+|\*\*|[()*/·^ ]|-?\d+/g) ?? [];
  if (tokens.join("") !== text) return null;
  let at = 0;
  /** @returns {number | null} */
  const power = () => {
    const token = tokens[at++];
    /** @type {number | null} */
    let base = null;
    if (token === "(") {
      base = product();
      if (tokens[at++] !== ")") return null;
    } else if (token === "1") base = 1;
    else if (token !== undefined && Object.hasOwn(FACTORS, token)) base = FACTORS[token];
    if (base === null) return null;
    if (tokens[at] === "^" || tokens[at] === "**") at++;
    return /^-?\d+$/.test(tokens[at] ?? "") ? base ** Number(tokens[at++]) : base;
  };
  /** @returns {number | null} */
  const product = () => {
    let value = power();
    while (value !== null && at < tokens.length && tokens[at] !== ")") {
      const sign = /[*/· ]/.test(tokens[at]) ? tokens[at++] : "*";
      const next = power();
      value = next === null ? null : sign === "/" ? value / next : value * next;
    }
    return value;
  };
  const value = product();
  return at === tokens.length ? value : null;
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

/** A number in SI, or a text with a unit as a number in SI; null: neither, or a text only the server can convert.
 * @param {unknown} value @param {Counted} [counted] @returns {number | null} */
export function siNumber(value, counted = {}) {
  if (typeof value === "number") return value;
  const match = typeof value === "string" &&
    /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/i.exec(value);
  if (!match) return null;
  const number = Number(match[1]);
  if (match[2] === "") return number;
  if (Object.hasOwn(SHIFTED, match[2])) return number * SHIFTED[match[2]][0] + SHIFTED[match[2]][1];
  const { unit, stated } = splitReference(match[2]);
  const factor = factorOf(unit), shift = referenceShift(stated, counted);
  return factor === null || shift === null ? null : Number((number * factor + shift).toPrecision(12));
}
