// @ts-check
// The one scale of map and residual: linear inside the noise, logarithmic outside, fixed by the first model of the
// case. A map of a solved case is plain, one of a bad model is dark.
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { brief } from "../../../format.js";
import { first } from "../answers.js";
import { channelScale } from "../words.js";
import { allSeries, channel, channels, noiseOf } from "./pictures.js";

/** `most`: the residual at full colour; `sigma`: the noise, null where it is not known; SI.
 * @typedef {{most: number, sigma: number | null}} Scale */

/** The residual that a value of the scale is linear up to, in standard deviations. */
const LINEAR = 2;

/** Rounds up to the next 1, 2, 2.5 or 5 times a power of ten. @param {number} x */
function roundedUp(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return ([1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((step) => step * power >= x * (1 - 1e-9)) ?? 10) * power;
}

/** The scale of a channel. @param {string} name @returns {Scale | null} */
export function scaleFor(name) {
  const a = first.value;
  if (!a) return null;
  const sigma = noiseOf(a, name);
  const map = channels.value.length > 1 ? null : a.heat_map;
  const cells = map
    ? map.rows.flatMap((row) => row.cells.flatMap((c) => c ? [c.mean, c.lengthening, c.shortening] : []))
    : [];
  let most = Math.max(0, ...cells.map((v) => Math.abs(v ?? 0)));
  if (!map) {
    for (const s of allSeries(a)) {
      if (s.channel === name) { for (const r of s.residual) most = Math.max(most, Math.abs(r ?? 0)); }
    }
  }
  const unit = channelScale(a.unit, name, units.value).factor;
  return { most: unit * roundedUp(Math.max(most, LINEAR * (sigma ?? 0), 1e-12) / unit), sigma };
}

/** The scale of the residual shown, and of the map of a single channel. */
export const scale = computed(() => scaleFor(channel.value));

/** The scale of the map; that of several channels is in units of their noise. */
export const mapScale = computed(() => {
  const map = first.value?.heat_map ?? null;
  if (!map || channels.value.length < 2) return scale.value;
  const sizes = map.rows.flatMap((row) => row.cells.map((c) => Math.abs(c?.mean ?? 0)));
  return { most: roundedUp(Math.max(LINEAR, ...sizes)), sigma: 1 };
});

/** A mean below this many standard deviations of one reading is none. */
const NONE = 0.75;
/** Whether a mean is none. @param {number} mean @param {Scale} s */
export const isQuiet = (mean, { sigma }) => sigma !== null && Math.abs(mean) < NONE * sigma;

/** The place of a residual on a scale: −1…1 within it. @param {number} r @param {Scale} s */
export const placeOf = (r, { most, sigma }) =>
  sigma ? Math.asinh(r / (LINEAR * sigma)) / Math.asinh(most / (LINEAR * sigma)) : r / most;

/** Marks beyond this place would run into those of the ends. */
const ENDS_FREE = 0.66;

/** Marks of a scale in shown units, with their places: zero, some round values, both ends.
 * @param {Scale} s @param {number} factor SI per shown unit @returns {{at: number, text: string}[]} */
export function marksOf(s, factor) {
  const end = s.most / factor;
  /** @type {{value: number, place: number}[]} */
  const round = [];
  for (let power = 10 ** Math.ceil(Math.log10(end)); power > end / 1e6; power /= 10) {
    for (const step of [5, 1]) {
      const value = (step * power) / 10;
      const place = placeOf(value * factor, s), last = round.at(-1);
      if (value < 0.7 * end && place > 0.24 && (!last || last.place - place > 0.24) && place < ENDS_FREE) {
        round.push({ value, place });
      }
    }
  }
  const text = (/** @type {number} */ v) => brief(v).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  const positive = [{ value: end, place: 1 }, ...round];
  return [
    ...positive.map(({ value, place }) => ({ at: -place, text: `−${text(value)}` })),
    { at: 0, text: "0" },
    ...positive.map(({ value, place }) => ({ at: place, text: `+${text(value)}` })),
  ].sort((a, b) => a.at - b.at);
}
