// @ts-check
// The colour scale of the map: that of the first model, by which models compare, or one up to the largest cell of
// this map, so that a small error shows its shape.
import { h } from "../../../dom.js";
import { units } from "../../../state.js";
import { compare, lookCompare, shown, steps } from "../answers.js";
import { errorText, rangeText } from "../words.js";

/** @typedef {import("../types.js").HeatMap} HeatMap */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../../../types.js").Heat} Heat */
/** `most`: the error at full colour; `start`: the same on the scale of the first model; `largest`: of all cells;
 * `at`: its place. @typedef {{kind: "start" | "own", most: number, start: number, largest: number,
 *   at: [number, number]}} HeatScale */

/** Largest cell as a share of the first scale, below which a map on that scale would look empty. */
const PALE = 1 / 5;

/** @param {(number | null)[]} edges @param {number} i @returns {[number, number]} */
export const bin = (edges, i) => [edges[i] ?? 0, edges[i + 1] ?? edges[i] ?? 0];

/** @param {HeatMap} map @param {number} first error of the first model @param {Heat} choice
 * @returns {HeatScale} */
function heatScale(map, first, choice) {
  const start = 2 * first || 1;
  let largest = 0, at = /** @type {[number, number]} */ ([0, 0]);
  map.mean.forEach((row, iy) =>
    row.forEach((mean, ix) => {
      if (mean == null || !map.count[iy]?.[ix] || Math.abs(mean) <= Math.abs(largest)) return;
      [largest, at] = [mean, [ix, iy]];
    })
  );
  const pale = Math.abs(largest) < PALE * start;
  const kind = choice === "auto" ? (pale ? "own" : "start") : choice;
  const most = Math.abs(largest) || start;
  return { kind, most: kind === "own" ? most : start, start, largest, at };
}

/** @param {Comparison} a @param {HeatMap} map */
export const scaleOf = (a, map) => heatScale(map, steps.value[0]?.rmse ?? a.rmse ?? 1, compare.value.heat);

/** The largest cell and the colour scale in words. @param {Comparison} a @param {HeatMap} map
 * @param {HeatScale} s */
export function scaleNote(a, map, s) {
  const system = units.value;
  const asText = (/** @type {number} */ si) => errorText(si, a.unit, a.predicted, system);
  if (!s.largest) return "The mean residual is zero everywhere.";
  const signed = (s.largest > 0 ? "+" : "−") + asText(Math.abs(s.largest));
  const where = `${rangeText(map.y, bin(map.y_edges, s.at[1]), system)}, ${
    rangeText(map.x, bin(map.x_edges, s.at[0]), system)
  }`;
  const size = Math.abs(s.largest);
  const calm = a.noise_floor && size < a.noise_floor ? `, less than the noise of one reading` : "";
  const largest = `Largest cell ${signed} at ${where}${calm}.`;
  if (!steps.value.length) return largest;
  return s.kind === "own"
    ? `${largest} Colours up to ${asText(s.most)}; at the start up to ${asText(s.start)}.`
    : `${largest} Colours up to ${asText(s.most)}, as at the start.`;
}

/** The switch between both scales; hidden for the first model. */
export const scaleSwitch = () =>
  h(
    "div",
    {
      class: "group",
      role: "group",
      "aria-label": "Colours of the map span",
      hidden: () => !steps.value.length || !shown.value?.heat_map,
    },
    ...[
      { id: /** @type {const} */ ("start"), label: "First scale", title: "As at the first model" },
      { id: /** @type {const} */ ("own"), label: "Own scale", title: "Up to the largest cell" },
    ].map(({ id, label, title }) =>
      h("button", {
        type: "button",
        title: `Colours: ${title.toLowerCase()}`,
        "aria-pressed": () => {
          const a = shown.value;
          return String(!!a?.heat_map && scaleOf(a, a.heat_map).kind === id);
        },
        onclick: () => lookCompare({ heat: id }),
      }, label)
    ),
  );
