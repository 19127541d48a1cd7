// @ts-check
// Parallel coordinates: one axis for each column, one line for each run. Drawn as SVG, because Plotly's own compile
// code while they run, which the security policy of the page forbids.
import { h, svg } from "../../dom.js";
import { effect } from "../../reactive.js";
import { units, view } from "../../state.js";
import { shown } from "./model.js";
import { front, numbersOf, pins, places } from "./rows.js";
import { columnText, scaleFor, titleOf, valueText } from "./words.js";

const HEIGHT = 250, TOP = 46, BOTTOM = 24, STEP = 124, SIDE = 62;
/** More lines would not be seen apart. */
const MOST_LINES = 1500;

/** @param {(number | null)[]} values @returns {[number, number]} */
function extremes(values) {
  const known = values.filter((v) => v !== null);
  return [
    known.reduce((a, b) => Math.min(a, b), Infinity),
    known.reduce((a, b) => Math.max(a, b), -Infinity),
  ];
}

/** Values that read the same on the page do not differ here either.
 * @param {(number | null)[]} values @param {import("../../format.js").Scale} scale @returns {[number, number]} */
function ends(values, scale) {
  const [low, high] = extremes(values);
  return valueText(low, scale) === valueText(high, scale) ? [low - 1, high + 1] : [low, high];
}

function drawing() {
  const now = shown.value;
  if (!now) return null;
  const columns = now.columns.filter((c) => c.unit !== null && numbersOf(c.name).some((v) => v !== null));
  const scales = columns.map((c) => scaleFor(c.name, c.unit, units.value));
  const lists = columns.map((c) => numbersOf(c.name)),
    ranges = lists.map((values, k) => ends(values, scales[k]));
  const width = 2 * SIDE + STEP * (columns.length - 1);
  const x = (/** @type {number} */ k) => SIDE + k * STEP;
  const y = (/** @type {number} */ k, /** @type {number} */ v) =>
    HEIGHT - BOTTOM - ((v - ranges[k][0]) / (ranges[k][1] - ranges[k][0])) * (HEIGHT - TOP - BOTTOM);
  /** @param {number} place */
  const line = (place) => {
    let path = "", isDown = false;
    lists.forEach((values, k) => {
      const v = values[place];
      if (v !== null) path += `${isDown ? "L" : "M"}${x(k)} ${y(k, v).toFixed(1)}`;
      isDown = v !== null;
    });
    return path;
  };
  const kept = places.value.slice(0, MOST_LINES);
  const of = (/** @type {(run: number) => boolean} */ test) =>
    kept.filter((i) => test(Number(now.table.run[i]))).map(line).join("");
  const isPinned = (/** @type {number} */ run) => pins.value.includes(run);
  const { length } = kept;
  return svg(
    "svg",
    { width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}`, "aria-hidden": "true", class: "parallel" },
    svg("path", {
      class: "line",
      d: of((run) => !front.value.has(run) && !isPinned(run)),
      opacity: length > 300 ? 0.18 : length > 60 ? 0.4 : 0.8,
    }),
    svg("path", { class: "line front", d: of((run) => front.value.has(run)) }),
    svg("path", { class: "line pinned", d: of(isPinned) }),
    ...columns.flatMap((c, k) => {
      const scale = scales[k], [name, ...more] = titleOf(c.name).split(", ");
      const [least, most] = extremes(lists[k]), text = columnText([least, most], scale);
      /** @param {number} at @param {string} text @param {string} [kind] */
      const label = (at, text, kind = "") =>
        svg("text", { x: x(k), y: at, "text-anchor": "middle", class: kind }, text);
      return [
        svg("line", { x1: x(k), x2: x(k), y1: TOP, y2: HEIGHT - BOTTOM, class: "axis" }),
        label(13, name, "name"),
        label(26, [more.join(", "), scale.unit].filter(Boolean).join(", "), "unit"),
        label(TOP - 6, text(most)),
        label(HEIGHT - BOTTOM + 14, text(least)),
      ];
    }),
  );
}

export function parallelCard() {
  const place = h("div", {
    class: "scroll",
    tabindex: 0,
    role: "region",
    "aria-label": "Parallel coordinates: one line for each run; the table has the numbers",
  });
  effect(() => {
    if (view.value !== "studies") return;
    const svg = drawing();
    place.replaceChildren(...(svg ? [svg] : []));
  });
  return h(
    "section",
    { class: "card", "aria-label": "All columns" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "All columns"),
      h(
        "span",
        { class: "muted" },
        () =>
          places.value.length > MOST_LINES
            ? `the first ${MOST_LINES} runs of the table`
            : "the runs of the table",
      ),
    ),
    place,
  );
}
