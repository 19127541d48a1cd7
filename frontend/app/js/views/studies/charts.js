// @ts-check
// Histogram of a figure with its percentiles; two columns over each other, with the Pareto front.
import { h } from "../../dom.js";
import { figure } from "../../facts.js";
import { toShown } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { plotlyReady } from "../../plots/library.js";
import { drawBands } from "../../plots/overlay.js";
import { palette } from "../../plots/theme.js";
import { computed, effect, signal } from "../../reactive.js";
import { units, view } from "../../state.js";
import { answer, shown } from "./model.js";
import { figures, front, numbersOf, pins } from "./rows.js";
import { columnText, scaleFor, titleOf } from "./words.js";

/** @typedef {import("../../plots/chart.js").Spec} Spec */
/** @typedef {import("./model.js").Column} Column */

/** The choice of a column that falls back when the columns change.
 * @param {() => Column[]} among @param {number} place */
function choice(among, place) {
  const wanted = signal("");
  const now = computed(() => {
    const all = among();
    return all.find((c) => c.name === wanted.value) ?? all[Math.min(place, all.length - 1)] ?? null;
  });
  const list = (/** @type {string} */ label) =>
    h("select", {
      class: "small",
      "aria-label": label,
      onchange: (
        /** @type {Event} */ e,
      ) => (wanted.value = /** @type {HTMLSelectElement} */ (e.target).value),
    }, () =>
      among().map((c) =>
        h("option", { value: c.name, selected: c.name === now.value?.name }, titleOf(c.name))
      ));
  return { now, list };
}

/** @param {string} id @param {string} label */
const plotHost = (id, label) => h("div", { class: "plot", id, role: "figure", "aria-label": label });

/** @param {number[]} values @returns {[number, number]} a little wider than the values */
function around(values) {
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(high >= low)) return [0, 1];
  const margin = 0.05 * (high - low) || 0.05 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}

/** @param {Column} column */
function axis(column) {
  const scale = scaleFor(column.name, column.unit, units.peek());
  return { scale, title: scale.unit ? `${titleOf(column.name)} (${scale.unit})` : titleOf(column.name) };
}

// ---- histogram

const LEAST_BINS = 6, MOST_BINS = 40;
const histogramOf = choice(() => figures.value, 0);
const MARKED = ["5", "50", "95"];
const summaryNow = computed(() =>
  answer.value?.summary.find((s) => s.figure === histogramOf.now.value?.name) ?? null
);

/** @param {import("../../plots/theme.js").Palette} p @returns {Spec} */
function histogram(p) {
  const column = /** @type {Column} */ (histogramOf.now.peek()), { scale, title } = axis(column);
  const values = numbersOf(column.name).flatMap((v) => v === null ? [] : [toShown(v, scale)]);
  const [low, high] = around(values);
  const bins = Math.min(MOST_BINS, Math.max(LEAST_BINS, Math.round(Math.sqrt(values.length))));
  const counts = /** @type {number[]} */ (Array(bins).fill(0)), width = (high - low) / bins;
  for (const v of values) counts[Math.min(bins - 1, Math.floor((v - low) / width))]++;
  const edges = counts.flatMap((_, i) => [low + i * width, low + (i + 1) * width]);
  const marks = MARKED.flatMap((q) => {
    const one = summaryNow.peek()?.percentiles[q]?.value;
    return one == null ? [] : [toShown(one, scale)];
  });
  return {
    x: { title, range: [low, high] },
    y: { title: "Runs", range: [0, 1.08 * Math.max(1, ...counts)] },
    traces: [{
      id: "runs",
      x: [low, ...edges, high],
      y: [0, ...counts.flatMap((n) => [n, n]), 0],
      line: { color: p.accent },
    }],
    zones: [],
    marks,
    revision: column.name,
  };
}

function percentileLine() {
  const s = summaryNow.value, column = histogramOf.now.value;
  if (!s || !column) return "";
  const scale = scaleFor(column.name, column.unit, units.value);
  const found = MARKED.flatMap((q) => s.percentiles[q] ? [{ q, ...s.percentiles[q] }] : []);
  const text = columnText(found.flatMap((e) => [e.value, e.low, e.high]), scale);
  const unit = scale.unit ? `\u00a0${scale.unit}` : "";
  return found.map((e) => {
    const ends = e.low === null || e.high === null ? "" : ` (${text(e.low)} to ${text(e.high)}${unit})`;
    return h("span", null, h("b", null, `${e.q}\u00a0%: ${text(e.value)}${unit}`), ends);
  });
}

export function histogramCard() {
  const host = plotHost("study-histogram", "How a figure is distributed over the runs");
  const chart = new Chart(host, "histogram");
  drawBands(chart);
  effect(() => {
    palette.value;
    units.value;
    summaryNow.value;
    shown.value;
    if (plotlyReady.value && view.value === "studies" && histogramOf.now.value) chart.show(histogram);
  });
  return h(
    "section",
    { class: "card chart", "aria-label": "Distribution" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Distribution"),
      histogramOf.list("Figure of the distribution"),
    ),
    host,
    h("p", { class: "percentiles" }, percentileLine),
  );
}

// ---- two columns

const numeric = () => (shown.value?.columns ?? []).filter((c) => c.unit !== null);
const inGoals = () => {
  const goals = answer.value?.goals ?? [];
  return goals.length > 1
    ? [...numeric()].sort((a, b) => Number(goals.includes(b.name)) - Number(goals.includes(a.name)))
    : numeric();
};
const across = choice(inGoals, 0);
const up = choice(() => {
  const goals = answer.value?.goals ?? [];
  if (goals.length > 1) return inGoals().slice(1).concat(inGoals().slice(0, 1));
  return [...figures.value, ...numeric().filter((c) => c.kind === "quantity")];
}, 0);
const FEW = 400;

/** @param {import("../../plots/theme.js").Palette} p @returns {Spec} */
function scatter(p) {
  const a = /** @type {Column} */ (across.now.peek()), b = /** @type {Column} */ (up.now.peek());
  const ax = axis(a), ay = axis(b), runs = shown.peek()?.table.run ?? [];
  const xs = numbersOf(a.name), ys = numbersOf(b.name);
  const points = runs.flatMap((run, i) => {
    const x = xs[i], y = ys[i];
    return x === null || y === null
      ? []
      : [{ run: Number(run), x: toShown(x, ax.scale), y: toShown(y, ay.scale) }];
  });
  const best = front.peek(), size = points.length > FEW ? 4 : 6;
  /** @param {string} id @param {typeof points} some @param {object} marker */
  const trace = (id, some, marker) => ({
    id,
    x: some.map((q) => q.x),
    y: some.map((q) => q.y),
    marker: /** @type {any} */ (marker),
  });
  const isMarked = (/** @type {number} */ run) => pins.peek().includes(run);
  return {
    x: { title: ax.title, range: around(points.map((q) => q.x)) },
    y: { title: ay.title, range: around(points.map((q) => q.y)) },
    traces: [
      trace("runs", points.filter((q) => !best.has(q.run)), { size, symbol: "circle", color: p.accent }),
      trace("front", points.filter((q) => best.has(q.run)), {
        size: 9,
        symbol: "diamond",
        color: p.load,
      }),
      trace("pinned", points.filter((q) => isMarked(q.run)), {
        size: 14,
        symbol: "circle-open",
        color: p.ink,
      }),
    ],
    zones: [],
    revision: `${a.name} ${b.name}`,
  };
}

export function scatterCard() {
  const host = plotHost("study-scatter", "Two columns of the runs over each other");
  const chart = new Chart(host, "runs");
  effect(() => {
    palette.value;
    units.value;
    shown.value;
    front.value;
    pins.value;
    if (plotlyReady.value && view.value === "studies" && across.now.value && up.now.value) {
      chart.show(scatter);
    }
  });
  return h(
    "section",
    { class: "card chart", "aria-label": "Relations" },
    h(
      "div",
      { class: "card-head" },
      h(
        "h2",
        null,
        () => (answer.value?.goals.length ?? 0) > 1 ? figure("studied.front").label : "Relations",
      ),
      h(
        "span",
        { class: "pair-of" },
        up.list("Column on the vertical axis"),
        h("span", { class: "muted" }, "over"),
        across.list("Column on the horizontal axis"),
      ),
    ),
    host,
    h(
      "p",
      { class: "percentiles" },
      () =>
        front.value.size
          ? `${front.value.size} ${
            front.value.size === 1 ? "run is best" : `runs on the ${figure("studied.front").label}`
          }: diamonds.`
          : "",
    ),
  );
}
