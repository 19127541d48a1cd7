// @ts-check
// Quantities as documents write them, "6 bar" or "120 N*s/m", converted to SI.

const INCH = 0.0254, POUND = 0.45359237, LBF = 4.4482216152605;

/** Exponents of m, kg, s, K, rad. @typedef {number[]} Dimension */
/** @type {Record<string, Dimension>} */
const OF = {
  none: [0, 0, 0, 0, 0],
  length: [1, 0, 0, 0, 0],
  volume: [3, 0, 0, 0, 0],
  mass: [0, 1, 0, 0, 0],
  time: [0, 0, 1, 0, 0],
  frequency: [0, 0, -1, 0, 0],
  temperature: [0, 0, 0, 1, 0],
  angle: [0, 0, 0, 0, 1],
  force: [1, 1, -2, 0, 0],
  pressure: [-1, 1, -2, 0, 0],
  energy: [2, 1, -2, 0, 0],
  power: [2, 1, -3, 0, 0],
};
/** What units measure, and their factors. The spellings are among those the server accepts.
 * @type {[keyof typeof OF, Record<string, number>][]} */
const UNITS = [
  ["none", { "%": 0.01, "1": 1 }],
  ["length", { m: 1, cm: 1e-2, CM: 1e-2, mm: 1e-3, MM: 1e-3, um: 1e-6, µm: 1e-6 }],
  ["length", { in: INCH, inch: INCH, ft: 12 * INCH }],
  ["volume", { l: 1e-3, L: 1e-3, ml: 1e-6 }],
  ["mass", { kg: 1, g: 1e-3, t: 1e3, lb: POUND }],
  ["time", { s: 1, sec: 1, Sec: 1, ms: 1e-3, us: 1e-6, µs: 1e-6, min: 60, h: 3600 }],
  ["frequency", { Hz: 1, kHz: 1e3 }],
  ["temperature", { K: 1 }],
  ["angle", { rad: 1, deg: Math.PI / 180, "°": Math.PI / 180 }],
  ["force", { N: 1, mN: 1e-3, kN: 1e3, lbf: LBF }],
  ["pressure", {
    Pa: 1,
    pa: 1,
    hPa: 100,
    kPa: 1e3,
    kpa: 1e3,
    KPa: 1e3,
    KPA: 1e3,
    MPa: 1e6,
    MPA: 1e6,
    GPa: 1e9,
  }],
  ["pressure", { bar: 1e5, Bar: 1e5, BAR: 1e5, mbar: 100, atm: 101325 }],
  ["pressure", { psi: LBF / INCH ** 2, PSI: LBF / INCH ** 2, Psi: LBF / INCH ** 2 }],
  ["energy", { J: 1, kJ: 1e3 }],
  ["power", { W: 1 }],
];
/** Factor and dimension of a unit. @typedef {{factor: number, of: Dimension}} Measure */
/** @type {Map<string, Measure>} */
const MEASURES = new Map(
  UNITS.flatMap(([kind, factors]) =>
    Object.entries(factors).map((
      [unit, factor],
    ) => /** @type {[string, Measure]} */ ([unit, { factor, of: OF[kind] }]))
  ),
);
/** Temperature scales: factor and offset. They cannot be part of a compound unit. @type {Record<string, [number, number]>} */
const SHIFTED = {
  degC: [1, 273.15],
  "°C": [1, 273.15],
  degF: [5 / 9, 273.15 - (32 * 5) / 9],
};

/** @param {Measure} one @param {Measure} other @param {1 | -1} sign @returns {Measure} */
const times = (one, other, sign) => ({
  factor: one.factor * other.factor ** sign,
  of: one.of.map((x, i) => x + sign * other.of[i]),
});

/** Factor to SI and dimension of a unit such as "l/(s*bar)"; null: unknown unit. @param {string} text
 * @returns {Measure | null} */
function measureOf(text) {
  const tokens = text.match(/[A-Za-zµ°%]+|\*\*|[()*/·^ ]|-?\d+/g) ?? [];
  if (tokens.join("") !== text) return null;
  let at = 0;
  /** @returns {Measure | null} */
  const power = () => {
    const token = tokens[at++];
    /** @type {Measure | null} */
    let base = null;
    if (token === "(") {
      base = product();
      if (tokens[at++] !== ")") return null;
    } else base = MEASURES.get(token) ?? null;
    if (base === null) return null;
    if (tokens[at] === "^" || tokens[at] === "**") at++;
    if (!/^-?\d+$/.test(tokens[at] ?? "")) return base;
    const exponent = Number(tokens[at++]);
    return { factor: base.factor ** exponent, of: base.of.map((x) => x * exponent) };
  };
  /** @returns {Measure | null} */
  const product = () => {
    let value = power();
    while (value !== null && at < tokens.length && tokens[at] !== ")") {
      const sign = /[*/· ]/.test(tokens[at]) ? tokens[at++] : "*";
      const next = power();
      value = next === null ? null : times(value, next, sign === "/" ? -1 : 1);
    }
    return value;
  };
  const value = product();
  return at === tokens.length ? value : null;
}

/** Whether a unit measures what an SI unit does; without a unit: whether that is a plain number.
 * @param {Measure | null} measure @param {string} si */
function fits(measure, si) {
  const wanted = measureOf(si), of = measure?.of ?? OF.none;
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
  if (Object.hasOwn(SHIFTED, match[2])) {
    const [factor, offset] = SHIFTED[match[2]];
    return si === undefined || si === "K" ? number * factor + offset : null;
  }
  const { unit, stated } = splitReference(match[2]);
  const measure = measureOf(unit), shift = referenceShift(stated, wanted);
  if (measure === null || shift === null || (si !== undefined && !fits(measure, si))) return null;
  return Number((number * measure.factor + shift).toPrecision(12));
}
