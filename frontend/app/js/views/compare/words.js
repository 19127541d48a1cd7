// @ts-check
// Errors, ranges and names as the page writes them.
import { figure, figuresOf, inSentence } from "../../facts.js";
import { effectsById, presets } from "../../store.js";
import { brief, number, plainScale, quantityOf, readable, scaleOf, toShown } from "../../format.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../format.js").System} System */
/** @typedef {import("./types.js").Series} Series */

/** The id of the effect that is a formula of the user, and its parameter that holds the formula. */
export const OWN_TERM = "custom", FORMULA = "term";

/** @param {string} id */
export const titleOf = (id) =>
  id === OWN_TERM ? "Own term" : effectsById.value.get(id)?.title ?? readable(id);

/** "a, b and c" @param {string[]} names */
const listed = (names) =>
  names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;

/** "62 % of the squared error is left to explain and depends on pressure" @param {import("./types.js").Diagnosis["verdict"]} verdict */
export function whatIsLeft({ unexplained_share: share, unexplained_in: names, repeats }) {
  const where = names.map(channelWords);
  const size = `${brief(100 * share)}\u00a0% of the squared error is left to explain`;
  // A ripple depends on its coordinate anyway: where most of the rest repeats, the period says it.
  if (repeats && (!where.length || repeats.share >= 0.5)) return `${size}: ${repeats.text}`;
  const depends = `${size} and depends on ${where.length ? listed(where) : "no measured variable"}`;
  return repeats ? `${depends}; ${repeats.text}` : depends;
}

/** @typedef {{value: number | string, unit: string}} Stated */

/** A value of the experiment: "90 °", "155 mm", "DMSP-10". @param {Stated} stated @param {System} system */
export function statedText({ value, unit }, system) {
  if (typeof value === "string") {
    const known = [...presets.value.muscles ?? [], ...presets.value.valves ?? []].find((p) => p.id === value);
    return known?.id ?? value;
  }
  const quantity = unit === "1" ? "ratio" : unit ? quantityOf(unit) : null;
  if (!quantity) return `${number(value, 3)} ${unit}`.trim();
  const s = scaleOf(quantity, system);
  return `${number(toShown(value, s), 1)}${s.unit === "°" ? "" : " "}${s.unit}`.trim();
}

/** The channels of measurements, by name. @type {Map<string, import("../../facts.js").DeclaredFigure>} */
const CHANNELS = new Map(figuresOf("channel").map((each) => [each.key.replace("channel.", ""), each]));

/** A channel inside a sentence: "stroke". @param {string} name */
export const channelWords = (name) => {
  const known = CHANNELS.get(name);
  return known ? inSentence(known.label) : readable(name);
};

/** The scale of a channel; that of several together is plain.
 * @param {string} unit @param {string} channel @param {System} system */
export function channelScale(unit, channel, system) {
  const known = CHANNELS.get(channel), quantity = known?.quantity ?? (unit === "1" ? null : quantityOf(unit));
  return quantity ? scaleOf(/** @type {Quantity} */ (quantity), system) : plainScale(unit);
}

/** The unit of an error; the error of several channels together is in units of their noise.
 * @param {string} unit @param {string} channel @param {System} system */
export function errorUnit(unit, channel, system) {
  const s = channelScale(unit, channel, system);
  return unit === "1" && !s.unit ? "× noise" : s.unit;
}

/** @param {number | null | undefined} si @param {string} unit @param {string} channel @param {System} system
 * @param {boolean} [withUnit] */
export function errorText(si, unit, channel, system, withUnit = true) {
  if (si == null) return "–";
  const text = brief(si / channelScale(unit, channel, system).factor);
  return withUnit ? `${text}\u00a0${errorUnit(unit, channel, system)}`.trim() : text;
}

/** The error over the noise: "1.03", "6.7", "124". @param {number} ratio */
export const overNoise = (ratio) =>
  ratio < 1.15 ? ratio.toFixed(2) : ratio < 10 ? ratio.toFixed(1) : String(Math.round(ratio));

/** Where a series holds a channel. @type {Record<string, (s: Series) => (number | null)[] | null>} */
const COLUMNS = {
  angle: (s) => s.angle,
  contraction: (s) => s.contraction,
  pressure: (s) => s.x_pressure,
  velocity: (s) => s.velocity,
  direction: (s) => s.direction,
  time: (s) => s.time,
  length: (s) => s.length,
  // Known for the rows whose stroke is predicted; a range of it chooses all rows of other channels.
  displacement: (s) => s.channel === "displacement" ? s.measured : null,
};

/** Variables the residual is shown over, by their name in answers; `short`: where there is no room.
 * @type {Record<string, {title: string, short: string, quantity: Quantity, of: (s: Series) => (number | null)[] | null}>} */
export const VARIABLES = Object.fromEntries(
  Object.entries(COLUMNS).map(([name, of]) => {
    const { label, symbol, quantity } = figure(`channel.${name}`);
    const short = name === "contraction" ? symbol : inSentence(label);
    return [name, { title: label, short, quantity: /** @type {Quantity} */ (quantity), of }];
  }),
);

/** @param {Series} s @param {string} name @returns {(number | null)[]} */
export const column = (s, name) => VARIABLES[name]?.of(s) ?? [];

/** A variable at the readings where the motion turns. @param {import("./types.js").Reversals} r
 * @param {string} name @returns {(number | null)[]} */
export const atReversals = (r, name) =>
  ({
    angle: r.angle,
    contraction: r.contraction,
    pressure: r.x_pressure,
    velocity: r.velocity,
    time: r.time,
    length: r.length,
  })[
    name
  ] ?? [];

/** Whether a variable changes within the series. @param {Series[]} all @param {string} name */
export function varies(all, name) {
  let low = Infinity, high = -Infinity;
  for (const s of all) {
    for (const v of column(s, name)) {
      if (v == null) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high), 1e-12);
}

/** "5 to 10 %" of a variable. @param {string} name @param {[number, number]} range @param {System} system */
export function rangeText(name, [from, to], system) {
  const v = VARIABLES[name];
  if (!v) return "";
  const s = scaleOf(v.quantity, system);
  const asText = (/** @type {number} */ si) => number(toShown(si, s), s.unit === "%" ? 1 : 2);
  const low = asText(from), high = asText(to);
  return `${v.short} ${low === high ? low : `${low} to ${high}`} ${s.unit}`.trim();
}

/** @param {Series} s @param {number} i @param {import("../../types.js").Brush | null} brush */
export function isInside(s, i, brush) {
  if (!brush) return true;
  return Object.entries(brush).every(([name, [from, to]]) => {
    const v = column(s, name)[i];
    const slack = 1e-9 * Math.max(Math.abs(from), Math.abs(to));
    return v == null || (v >= from - slack && v <= to + slack);
  });
}

/** A number of any size with some significant digits: 2.03·10⁻⁶. @param {number} x @param {number} digits */
export function figures(x, digits) {
  const size = Math.abs(x);
  if (size >= 1e-3 && size < 1e5 || x === 0) {
    return number(x, Math.max(0, digits - 1 - Math.floor(Math.log10(size || 1))));
  }
  const [lead, power] = x.toExponential(digits - 1).split("e");
  const raised = [...String(Number(power))].map((c) => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]).join("");
  return `${lead.replace("-", "−")}·10${raised}`;
}

/** The scale of a parameter. @param {{unit: string, name: string}} p @param {System} system */
export function parameterScale({ unit, name }, system) {
  const quantity = quantityOf(unit, name);
  return quantity ? scaleOf(quantity, system) : plainScale(unit);
}

/** Smaller than this share of a value, a standard error says nothing: the value is exact. */
const EXACT = 1e-9;

/** "0.2183 ± 0.0021 N/mm²": to the digit that the standard error allows.
 * @param {number} si @param {number | null} stderr @param {import("../../format.js").Scale} s */
export function measuredText(si, stderr, s) {
  const value = toShown(si, s), sigma = stderr === null ? 0 : stderr / s.factor;
  const unit = s.unit ? `\u00a0${s.unit}` : "";
  if (!(sigma > EXACT * Math.max(Math.abs(value), 1e-6))) return `${figures(value, 4)}${unit}`;
  const places = 1 - Math.floor(Math.log10(sigma));
  if (places > 6) return `${figures(value, 4)}${unit}`;
  const fixed = (/** @type {number} */ x) => {
    if (places < 0) return String(Math.round(x / 10 ** -places) * 10 ** -places);
    return x.toFixed(places);
  };
  return `${fixed(value).replace("-", "−")} ± ${fixed(sigma)}${unit}`;
}

/** A standard error with two digits, "" where it says nothing. @param {number} sigma in shown units */
export const sigmaText = (sigma) => {
  const places = sigma > 0 ? 1 - Math.floor(Math.log10(sigma)) : 99;
  return places > 7 ? "" : `± ${places < 0 ? Math.round(sigma) : sigma.toFixed(places)}`;
};
