// @ts-check
// Parallel coordinates: one axis for each column, one line for each run. Drawn as SVG, because Plotly's own compile
// code while they run, which the security policy of the page forbids.
import { h, icon, svg } from "../../dom.js";
import { effect } from "../../reactive.js";
import { units, view } from "../../state.js";
import { shown } from "./model.js";
import { front, keepRange, numbersOf, pins, places, ranges } from "./rows.js";
import { columnText, scaleFor, titleOf, valueText } from "./words.js";

const HEIGHT = 250, TOP = 59, BOTTOM = 24, STEP = 124, SIDE = 62;
/** Half the width in which an axis takes the pointer, and the least length of a range [px]. */
const REACH = 16, LEAST = 4;
/** More lines would not be seen apart. */
const MOST_LINES = 1500;

/** Letters that have room over an axis. */
const ROOM = 19;
/** A name in two lines at most, broken where both are about as long. @param {string} name */
function twoLines(name) {
  const words = name.split(" ");
  if (name.length <= ROOM || words.length < 2) return [name];
  const ways = words.slice(1).map((_w, i) => [words.slice(0, i + 1).join(" "), words.slice(i + 1).join(" ")]);
  const longest = (/** @type {string[]} */ way) => Math.max(...way.map((line) => line.length));
  return ways.reduce((best, way) => longest(way) < longest(best) ? way : best);
}

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

/** The part of an axis that is kept, and where it is drawn: a drag gives its ends, a click takes it away.
 * @param {number} x @param {number[] | undefined} ends @param {(from: number, to: number) => void} take */
function rangeOn(x, ends, take) {
  const mark = svg("rect", { class: "kept", x: x - 5, width: 10, y: 0, height: 0 });
  /** @param {number} a @param {number} b */
  const show = (a, b) => {
    mark.setAttribute("y", String(Math.min(a, b)));
    mark.setAttribute("height", String(Math.abs(a - b)));
  };
  if (ends) show(ends[0], ends[1]);
  let from = /** @type {number | null} */ (null);
  /** @param {PointerEvent} e */
  const at = (e) => {
    const box = area.getBoundingClientRect(), to = TOP + (e.clientY - box.top);
    return Math.min(HEIGHT - BOTTOM, Math.max(TOP, to));
  };
  const area = svg("rect", {
    class: "grip",
    x: x - REACH,
    width: 2 * REACH,
    y: TOP,
    height: HEIGHT - TOP - BOTTOM,
  });
  area.addEventListener("pointerdown", (e) => {
    area.setPointerCapture(e.pointerId);
    show(from = at(e), from);
  });
  area.addEventListener("pointermove", (e) => {
    if (from !== null) show(from, at(e));
  });
  area.addEventListener("pointerup", (e) => {
    if (from !== null) take(from, at(e));
    from = null;
  });
  return [mark, area];
}

/** The ranges in words, each with the way back. */
function rangeLine() {
  const columns = shown.value?.columns ?? [];
  const all = columns.filter((c) => c.name in ranges.value);
  if (!all.length) return "Drag along an axis to keep the runs in a range.";
  return all.map((c) => {
    const scale = scaleFor(c.name, c.unit, units.value), range = ranges.value[c.name];
    const [low, high] = range.map((v) => valueText(v, scale));
    const words = `${titleOf(c.name)} ${low} to ${high} ${scale.unit}`.trim();
    return h(
      "button",
      {
        type: "button",
        class: "chip",
        "aria-label": `${words}: show all runs`,
        onclick: () => keepRange(c.name, null),
      },
      words,
      icon("close"),
    );
  });
}

function drawing() {
  const now = shown.value;
  if (!now) return null;
  const columns = now.columns.filter((c) => c.unit !== null && numbersOf(c.name).some((v) => v !== null));
  const scales = columns.map((c) => scaleFor(c.name, c.unit, units.value));
  const lists = columns.map((c) => numbersOf(c.name)),
    spans = lists.map((values, k) => ends(values, scales[k]));
  const width = 2 * SIDE + STEP * (columns.length - 1);
  const x = (/** @type {number} */ k) => SIDE + k * STEP;
  const y = (/** @type {number} */ k, /** @type {number} */ v) =>
    HEIGHT - BOTTOM - ((v - spans[k][0]) / (spans[k][1] - spans[k][0])) * (HEIGHT - TOP - BOTTOM);
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
  /** The value at a height of the drawing. @param {number} k @param {number} at */
  const valueOf = (k, at) => {
    const share = (HEIGHT - BOTTOM - at) / (HEIGHT - TOP - BOTTOM);
    return spans[k][0] + Math.min(1, Math.max(0, share)) * (spans[k][1] - spans[k][0]);
  };
  const kept = places.value.slice(0, MOST_LINES), inside = new Set(places.value);
  const out = now.table.run.map((_, i) => i).filter((i) => !inside.has(i)).slice(0, MOST_LINES);
  const of = (/** @type {(run: number) => boolean} */ test) =>
    kept.filter((i) => test(Number(now.table.run[i]))).map(line).join("");
  const isPinned = (/** @type {number} */ run) => pins.value.includes(run);
  const { length } = kept;
  return svg(
    "svg",
    { width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}`, "aria-hidden": "true", class: "parallel" },
    svg("path", { class: "line out", d: out.map(line).join("") }),
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
        ...twoLines(name.replace(" (ANR)", "")).map((words, i) => label(13 + 13 * i, words, "name")), // the unit says it
        label(39, [more.join(", "), scale.unit].filter(Boolean).join(", "), "unit"),
        label(TOP - 6, text(most)),
        label(HEIGHT - BOTTOM + 14, text(least)),
        ...rangeOn(x(k), ranges.value[c.name]?.map((v) => y(k, v)), (from, to) =>
          keepRange(
            c.name,
            Math.abs(from - to) < LEAST
              ? null
              : [valueOf(k, Math.max(from, to)), valueOf(k, Math.min(from, to))],
          )),
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
    h("p", { class: "range-line muted" }, rangeLine),
    place,
  );
}
