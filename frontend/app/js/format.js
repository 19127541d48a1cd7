// @ts-check
// Quantities: SI in the program, the user's units on the page. Reading numbers with units, writing numbers with
// sensible digits.
import { referenceShift, splitReference } from "./quantities.js";

/** @typedef {"si" | "bar" | "us"} System */
/** SI = shown × factor + offset.
 * @typedef {{unit: string, factor: number, offset?: number, digits: number}} Scale */
/** @typedef {keyof typeof SCALES} Quantity */

/** [Pa] */
export const BAR = 1e5;
const DEG = Math.PI / 180;
const INCH = 0.0254, LBF = 4.4482216152605, PSI = 6894.757293168, POUND = 0.45359237;

/** @param {string} unit @param {number} factor @param {number} digits @param {number} [offset]
 * @returns {Scale} */
const scale = (unit, factor, digits, offset = 0) => ({ unit, factor, digits, offset });
/** @param {Scale} one */
const same = (one) => ({ si: one, bar: one, us: one });

/** How each kind of quantity is shown in each unit system. */
export const SCALES = {
  length: { si: scale("mm", 1e-3, 1), bar: scale("mm", 1e-3, 1), us: scale("in", INCH, 3) },
  pressure: { si: scale("kPa", 1e3, 1), bar: scale("bar", 1e5, 3), us: scale("psi", PSI, 2) },
  modulus: { si: scale("MPa", 1e6, 4), bar: scale("N/mm²", 1e6, 4), us: scale("psi", PSI, 1) },
  force: { si: scale("N", 1, 1), bar: scale("N", 1, 1), us: scale("lbf", LBF, 2) },
  stiffness: { si: scale("kN/m", 1e3, 2), bar: scale("N/mm", 1e3, 2), us: scale("lbf/in", LBF / INCH, 1) },
  volume: { si: scale("cm³", 1e-6, 2), bar: scale("cm³", 1e-6, 2), us: scale("in³", INCH ** 3, 3) },
  temperature: {
    si: scale("K", 1, 1),
    bar: scale("°C", 1, 1, 273.15),
    us: scale("°F", 5 / 9, 1, 273.15 - (32 * 5) / 9),
  },
  torque: { si: scale("N·m", 1, 2), bar: scale("N·m", 1, 2), us: scale("lbf·in", LBF * INCH, 2) },
  rotary: {
    si: scale("N·m/rad", 1, 2),
    bar: scale("N·m/rad", 1, 2),
    us: scale("lbf·in/rad", LBF * INCH, 2),
  },
  energy: { si: scale("J", 1, 2), bar: scale("J", 1, 2), us: scale("ft·lbf", LBF * 12 * INCH, 2) },
  angle: same(scale("°", DEG, 2)),
  ratio: same(scale("%", 0.01, 2)),
  number: same(scale("", 1, 4)),
  time: same(scale("s", 1, 4)),
  lapse: same(scale("ms", 1e-3, 1)),
  frequency: same(scale("Hz", 1, 3)),
  mass: { si: scale("kg", 1, 3), bar: scale("kg", 1, 3), us: scale("lb", POUND, 3) },
  speed: { si: scale("m/s", 1, 3), bar: scale("m/s", 1, 3), us: scale("in/s", INCH, 2) },
  sweep: { si: scale("mm/s", 1e-3, 1), bar: scale("mm/s", 1e-3, 1), us: scale("in/s", INCH, 2) },
  acceleration: { si: scale("m/s²", 1, 2), bar: scale("m/s²", 1, 2), us: scale("ft/s²", 12 * INCH, 2) },
  conductance: same(scale("l/(s·bar)", 1e-8, 4)),
  rate: {
    si: scale("l/min", 1e-3 / 60, 1),
    bar: scale("l/min", 1e-3 / 60, 1),
    us: scale("ft³/min", (12 * INCH) ** 3 / 60, 2),
  },
  flow: { si: scale("g/s", 1e-3, 3), bar: scale("g/s", 1e-3, 3), us: scale("lb/min", POUND / 60, 3) },
  air: { si: scale("g", 1e-3, 3), bar: scale("g", 1e-3, 3), us: scale("oz", POUND / 16, 4) },
  normal: same(scale("l (ANR)", 1e-3, 3)),
  area: { si: scale("N/bar", 1e-5, 2), bar: scale("N/bar", 1e-5, 2), us: scale("lbf/psi", LBF / PSI, 4) },
  compliance: same(scale("mm/kN", 1e-6, 2)),
  softness: same(scale("%/kN", 1e-5, 3)),
  damping: same(scale("N/(m/s)", 1, 1)),
  pressureDamping: same(scale("N/(m/s·bar)", 1e-5, 3)),
  perKelvin: same(scale("%/K", 1e-2, 3)),
  resistance: same(scale("bar/(l/s)", 1e8, 3)),
};

/** Units a user may type, by the quantity they belong to.
 * @type {Record<string, [Quantity, number, number?]>} */
const TYPED = {
  m: ["length", 1],
  cm: ["length", 1e-2],
  mm: ["length", 1e-3],
  um: ["length", 1e-6],
  µm: ["length", 1e-6],
  in: ["length", INCH],
  inch: ["length", INCH],
  '"': ["length", INCH],
  ft: ["length", 12 * INCH],
  pa: ["pressure", 1],
  hpa: ["pressure", 100],
  kpa: ["pressure", 1e3],
  mpa: ["pressure", 1e6],
  bar: ["pressure", 1e5],
  mbar: ["pressure", 100],
  psi: ["pressure", PSI],
  atm: ["pressure", 101325],
  "n/mm²": ["pressure", 1e6],
  "n/mm2": ["pressure", 1e6],
  "n/mm^2": ["pressure", 1e6],
  n: ["force", 1],
  kn: ["force", 1e3],
  lbf: ["force", LBF],
  lb: ["force", LBF],
  kgf: ["force", 9.80665],
  "n/m": ["stiffness", 1],
  "kn/m": ["stiffness", 1e3],
  "n/mm": ["stiffness", 1e3],
  "lbf/in": ["stiffness", LBF / INCH],
  m3: ["volume", 1],
  "m³": ["volume", 1],
  l: ["volume", 1e-3],
  ml: ["volume", 1e-6],
  "cm³": ["volume", 1e-6],
  cm3: ["volume", 1e-6],
  "mm³": ["volume", 1e-9],
  mm3: ["volume", 1e-9],
  "in³": ["volume", INCH ** 3],
  in3: ["volume", INCH ** 3],
  k: ["temperature", 1],
  "°c": ["temperature", 1, 273.15],
  degc: ["temperature", 1, 273.15],
  c: ["temperature", 1, 273.15],
  "°f": ["temperature", 5 / 9, 273.15 - (32 * 5) / 9],
  degf: ["temperature", 5 / 9, 273.15 - (32 * 5) / 9],
  f: ["temperature", 5 / 9, 273.15 - (32 * 5) / 9],
  j: ["energy", 1],
  "ft·lbf": ["energy", LBF * 12 * INCH],
  "°": ["angle", DEG],
  deg: ["angle", DEG],
  rad: ["angle", 1],
  "%": ["ratio", 0.01],
  s: ["time", 1],
  ms: ["lapse", 1e-3],
  min: ["time", 60],
  hz: ["frequency", 1],
  khz: ["frequency", 1e3],
  kg: ["mass", 1],
  g: ["mass", 1e-3],
  t: ["mass", 1e3],
  lbm: ["mass", POUND],
  "m/s": ["speed", 1],
  "mm/s": ["speed", 1e-3],
  "l/(s·bar)": ["conductance", 1e-8],
  "l/(s*bar)": ["conductance", 1e-8],
  "l/(min·bar)": ["conductance", 1e-8 / 60],
  "l/(min*bar)": ["conductance", 1e-8 / 60],
  "m3/(s*pa)": ["conductance", 1],
  "l/min": ["rate", 1e-3 / 60],
  "ft^3/min": ["rate", (12 * INCH) ** 3 / 60],
  "ft³/min": ["rate", (12 * INCH) ** 3 / 60],
};

/** The quantity of a value by its SI unit. @type {Record<string, Quantity>} */
const OF_SI = {
  m: "length",
  Pa: "pressure",
  N: "force",
  "N/m": "stiffness",
  m3: "volume",
  K: "temperature",
  rad: "angle",
  J: "energy",
  s: "time",
  kg: "mass",
  Hz: "frequency",
  "m/s": "speed",
  m2: "area",
  "m/N": "compliance",
  "1/N": "softness",
  "N*s/m": "damping",
  "N*s/(m*Pa)": "pressureDamping",
  "1/K": "perKelvin",
  "Pa*s/m3": "resistance",
  "m3/(s*Pa)": "conductance",
};

/** The quantity of a parameter by its SI unit; a modulus is shown in N/mm², not in bar.
 * @param {string} unit @param {string} [name]
 * @returns {Quantity | null} null: the unit has no scale of its own */
export function quantityOf(unit, name = "") {
  if (unit === "Pa" && /modulus|constant/.test(name)) return "modulus";
  if (unit === "1" || unit === "") return "number";
  return OF_SI[unit] ?? null;
}

/** A scale for a unit that has none: values are shown as they are. @param {string} unit */
export const plainScale = (unit) => scale(tidyUnit(unit), 1, 6);

/** "N*s/m" → "N·s/m", "m3" → "m³". @param {string} unit */
export const tidyUnit = (unit) =>
  unit === "1" ? "" : unit.replaceAll("**", "^").replaceAll("*", "·").replace(/\^?2\b/g, "²").replace(
    /\^?3\b/g,
    "³",
  ).replace(/^deg$/, "°").replace(/^degC$/, "°C");

/** @param {Quantity} quantity @param {System} system @returns {Scale} */
export const scaleOf = (quantity, system) => SCALES[quantity][system];

/** @param {number} si @param {Scale} s */
export const toShown = (si, s) => (si - (s.offset ?? 0)) / s.factor;
/** @param {number} shown @param {Scale} s */
export const toSi = (shown, s) => shown * s.factor + (s.offset ?? 0);

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

/** Case changes the meaning of these. */
const AMBIGUOUS = new Set(["mPa", "Mbar", "MBar", "MBAR"]);

/** @param {string} unit as a user writes it: case does not matter where there is one meaning */
function typedUnit(unit) {
  const key = unit.toLowerCase();
  return Object.hasOwn(TYPED, key) && !AMBIGUOUS.has(unit) ? TYPED[key] : null;
}

/** Reads "30 cm", "6 bar", "25°", "1,5"; a bare number is in the shown unit.
 * @param {string} text @param {Scale} s @param {Quantity | null} quantity
 * @param {string} [sample] the number of the example
 * @param {import("./quantities.js").Counted} [counted] what a pressure is counted from
 * @returns {{value: number} | {error: string}} SI */
export function parse(text, s, quantity, sample, counted = {}) {
  const tidy = text.trim().replace("−", "-").replace(/^([+-]?\d+),(\d+)(?=\D|$)/, "$1.$2");
  const example = `${sample || "1.5"} ${s.unit}`.trim();
  if (tidy === "") return { error: `Enter a number, for example ${example}.` };
  const match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/i.exec(tidy);
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
  if (!unit || (unit === s.unit && stated === null) || (s.unit && tidyUnit(unit) === s.unit)) {
    return { value: toSi(value, s) + shift };
  }
  const known = typedUnit(unit);
  if (!known) return { error: `The unit “${unit}” is not known. Enter for example ${example}.` };
  const [kind, factor, offset = 0] = known;
  const wanted = basicQuantity(quantity);
  if (kind === "ratio" && wanted === "number" && s.unit === "") return { value: value * factor };
  if (basicQuantity(kind) !== wanted) {
    return { error: `“${unit}” measures ${noun(kind)}, this is ${noun(wanted)}.` };
  }
  return { value: value * factor + offset + shift };
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
  return typedUnit(unit)?.[0] ?? null;
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
  return known ? q.value * known[1] + (known[2] ?? 0) : q.value;
}

/** Words of keys that are written in another way. @type {Record<string, string>} */
const WORDS = { area: "force per pressure", displacement: "stroke", mooney: "Mooney", stribeck: "Stribeck" };

/** A name of a document or request in words: "max_contraction" → "max contraction". @param {string} key */
export const readable = (key) =>
  key.replaceAll("_", " ").replace(/\b(?:area|displacement|mooney|stribeck)\b/g, (word) => WORDS[word]);

/** @param {string} text */
export const capitalized = (text) => text.replace(/^./, (letter) => letter.toUpperCase());
