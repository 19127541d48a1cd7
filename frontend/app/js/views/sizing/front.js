// @ts-check
// Trade-offs: all drives that fulfil the task over two aims. A click selects a proposal.
import { inSentence } from "../../facts.js";
import { h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { scaleOf, toShown } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { chartMenu } from "../../plots/export.js";
import { palette } from "../../plots/theme.js";
import { menuButton } from "../../ui/menu.js";
import { axisTitle, extent } from "../../plots/axes.js";
import { plotlyReady } from "../../plots/library.js";
import { AIM_NAMES, inTask } from "./document.js";
import { answer, chosenIndex, lookSizing, proposals, sizing } from "./model.js";
import { aimOf, asText, driveWords, partsWords, sizingFigure } from "./words.js";

/** @typedef {import("../../types.js").Aim} Aim */
/** @typedef {import("./words.js").Design} Design */
/** @typedef {import("../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../types.js").S["ExploredDrive"]} Explored */

/** How close to a mark a click must be; how far apart the numbers are kept [px]. */
const REACH = 14, APART = 25;
/** Explored drives further out than this many widths of the proposals are not shown: they would press the proposals
 * together. */
const NEAR = 1.2;
const axes = computed(() => sizing.value.axes);
/** How many explored drives the plot does not show. */
const outside = signal(0);
/** The explored drive the user clicked on. */
const pointed = signal(/** @type {Explored | null} */ (null));

/** Whether a proposal has the same parts. @param {Explored} e */
const isProposed = (e) =>
  proposals.value.some((p) =>
    p.muscle === e.muscle && p.parallel === e.parallel && p.valve === e.valve && p.tube === e.tube
  );
const others = computed(() => (answer.value?.explored ?? []).filter((e) => !isProposed(e)));

/** In shown units. @param {Aim} aim @param {Design} d */
function valueOf(aim, d) {
  const { quantity, of } = aimOf(aim);
  return toShown(of(d), scaleOf(quantity, units.value));
}

/** The range of an axis: all proposals, and those explored drives that lie near them.
 * @param {number[]} proposed @param {number[]} more @returns {[number, number]} */
function rangeOf(proposed, more) {
  const [from, to] = extent([proposed]), wide = to - from || Math.abs(to) || 1;
  const near = more.filter((v) => v > from - NEAR * wide && v < to + NEAR * wide);
  const [low, high] = extent([[...proposed, ...near]]), span = high - low || Math.abs(high) || 1;
  return [low >= 0 ? Math.max(0, low - 0.1 * span) : low - 0.1 * span, high + 0.1 * span];
}

/** @param {import("../../plots/theme.js").Palette} p @returns {Spec} */
function spec(p) {
  const [ax, ay] = axes.value;
  /** @param {Design[]} list @param {string} id @param {string} symbol @param {string} color @param {number} size */
  const marks = (list, id, symbol, color, size) => ({
    id,
    x: list.map((d) => valueOf(ax, d)),
    y: list.map((d) => valueOf(ay, d)),
    marker: { size, symbol, color },
  });
  const dominated = marks(others.value.filter((e) => !e.front), "dominated", "circle-open", p.soft, 8);
  const best = marks(others.value.filter((e) => e.front), "front", "circle", p.accent, 7);
  const proposed = marks(proposals.value, "proposals", "circle", p.ink, 4);
  const title = (/** @type {Aim} */ aim) =>
    axisTitle(aimOf(aim).label.replace(" (ANR)", ""), aimOf(aim).quantity, units.value).replace(
      "(ANR))",
      "ANR)",
    );
  return {
    x: { title: title(ax), range: rangeOf(proposed.x, [...best.x, ...dominated.x]) },
    y: { title: title(ay), range: rangeOf(proposed.y, [...best.y, ...dominated.y]) },
    zones: [],
    traces: [dominated, best, proposed].filter((t) => t.x.length),
    revision: `${ax}${ay}${units.value}`,
  };
}

/** @param {0 | 1} which @param {string} label */
const axisChoice = (which, label) =>
  h("select", {
    "aria-label": label,
    class: "small",
    onchange: (/** @type {Event} */ e) => {
      const aim = /** @type {Aim} */ (/** @type {HTMLSelectElement} */ (e.target).value);
      lookSizing({ axes: which ? [axes.peek()[0], aim] : [aim, axes.peek()[1]] });
    },
  }, () =>
    AIM_NAMES.map((aim) =>
      h("option", { value: aim, selected: axes.value[which] === aim }, inSentence(aimOf(aim).label))
    ));

const legend = () =>
  h(
    "ul",
    { class: "legend" },
    h(
      "li",
      { title: sizingFigure("front").definition },
      h("i", { class: "dot full" }),
      sizingFigure("front").label,
    ),
    h("li", null, h("i", { class: "dot" }), "others"),
    h("li", { class: "muted" }, "numbered: the proposals; not numbered: not among the best"),
    () => {
      const far = outside.value;
      return far ? h("li", { class: "muted" }, `${far} mark${far > 1 ? "s" : ""} outside the plot`) : null;
    },
  );

/** Moves points apart whose square marks would cover each other, along the axis on which that takes less.
 * @param {{x: number, y: number}[]} points */
function spread(points) {
  const placed = points.map(({ x, y }, i) => ({ x: x + 1e-3 * i, y: y - 2e-3 * i }));
  for (let round = 0; round < 400; round++) {
    let moved = false;
    placed.forEach((a, i) =>
      placed.slice(0, i).forEach((b) => {
        const dx = a.x - b.x, dy = a.y - b.y, axis = Math.abs(dx) > Math.abs(dy) ? "x" : "y";
        const away = a[axis] - b[axis], push = (APART - Math.abs(away)) / 2 * Math.sign(away);
        if (Math.abs(away) >= APART) return;
        moved = true;
        a[axis] += push;
        b[axis] -= push;
      })
    );
    if (!moved) break;
  }
  return placed;
}

const SVG = "http://www.w3.org/2000/svg";

/** @param {Record<string, number>} ends */
function leader(ends) {
  const line = document.createElementNS(SVG, "line");
  for (const [key, value] of Object.entries(ends)) line.setAttribute(key, String(value));
  return line;
}

/** Writes the number of each proposal beside its point; on the Pareto front filled, else hollow. @param {Chart} chart */
function numbers(chart) {
  const box = h("div", { class: "ranks" }), lines = document.createElementNS(SVG, "svg");
  chart.over.append(box);
  const place = () => {
    const layout = chart.axes;
    if (!layout) return;
    const [ax, ay] = axes.peek(), { _offset: left, _length: width } = layout.xaxis;
    const { _offset: top, _length: height } = layout.yaxis;
    const points = proposals.peek().map((p) => ({
      x: layout.xaxis.c2p(valueOf(ax, p)),
      y: layout.yaxis.c2p(valueOf(ay, p)),
    }));
    const placed = spread(points);
    const inside = points.map(({ x, y }) => x >= -1 && x <= width + 1 && y >= -1 && y <= height + 1);
    const buttons = proposals.peek().map((p, i) =>
      h("button", {
        type: "button",
        hidden: !inside[i],
        class: `rank-mark${p.front ? " front" : ""}`,
        "aria-pressed": String(chosenIndex.peek() === i),
        "aria-label": `Proposal ${i + 1}: ${driveWords(p)}`,
        title: `${driveWords(p)}, ${partsWords(p)}`,
        style: `transform:translate(${left + placed[i].x}px,${top + placed[i].y}px)`,
        onclick: () => lookSizing({ selected: i }),
      }, String(i + 1))
    );
    lines.replaceChildren(
      ...points.flatMap(({ x, y }, i) =>
        inside[i]
          ? [leader({ x1: left + x, y1: top + y, x2: left + placed[i].x, y2: top + placed[i].y })]
          : []
      ),
    );
    const at = [...box.children].indexOf(/** @type {Element} */ (document.activeElement)) - 1;
    box.replaceChildren(lines, ...buttons);
    if (at >= 0) buttons[at]?.focus();
  };
  chart.after.add(place);
  return place;
}

/** @param {Chart} chart */
function pointing(chart) {
  chart.host.addEventListener("click", (event) => {
    const layout = chart.axes;
    if (!layout || /** @type {Element} */ (event.target).closest("button")) return;
    const box = chart.host.getBoundingClientRect();
    const [ax, ay] = axes.peek();
    const near = others.peek().map((e) => {
      const dx = layout.xaxis._offset + layout.xaxis.c2p(valueOf(ax, e)) - (event.clientX - box.left);
      const dy = layout.yaxis._offset + layout.yaxis.c2p(valueOf(ay, e)) - (event.clientY - box.top);
      return { e, far: Math.hypot(dx, dy) };
    }).sort((a, b) => a.far - b.far)[0];
    pointed.value = near && near.far < REACH ? near.e : null;
  });
}

function pointedLine() {
  const e = pointed.value;
  if (!e) {
    return h(
      "span",
      { class: "muted" },
      "Click a number to select the proposal, a mark to see which drive it is.",
    );
  }
  const [ax, ay] = axes.value;
  const figure = (/** @type {Aim} */ aim) =>
    `${inSentence(aimOf(aim).label)} ${asText(aimOf(aim).of(e), aimOf(aim).quantity)}`;
  return [
    h("b", null, driveWords(e)),
    `, ${partsWords(e)}: ${figure(ax)}, ${figure(ay)}. Estimated coarsely; not among the proposals.`,
  ];
}

/** @param {Chart} chart */
function countOutside({ spec: drawn }) {
  if (!drawn) return;
  const hides = (/** @type {number | null} */ v, /** @type {[number, number]} */ [low, high]) =>
    v != null && (v < low || v > high);
  outside.value =
    drawn.traces.flatMap((t) => t.x.filter((x, i) => hides(x, drawn.x.range) || hides(t.y[i], drawn.y.range)))
      .length;
}

export function frontCard() {
  const host = h("div", {
    class: "plot",
    id: "pareto",
    role: "figure",
    "aria-label": "Drives that fulfil the task over two aims",
  });
  const chart = new Chart(host, "pareto");
  const placeNumbers = numbers(chart);
  pointing(chart);
  chart.after.add(() => countOutside(chart));
  effect(() => {
    answer.value;
    pointed.value = null;
  });
  effect(() => {
    palette.value;
    axes.value;
    units.value;
    if (plotlyReady.value && inTask.value && proposals.value.length) chart.show(spec);
  });
  effect(() => {
    chosenIndex.value;
    placeNumbers();
  });
  return h(
    "section",
    { class: "card chart pareto", "aria-label": "Trade-offs", hidden: () => !proposals.value.length },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Trade-offs"),
      h(
        "span",
        { class: "aims" },
        axisChoice(1, "Aim on the vertical axis"),
        h("span", { class: "muted" }, "over"),
        axisChoice(0, "Aim on the horizontal axis"),
      ),
      menuButton({
        label: icon("more"),
        name: "Trade-offs: save",
        class: "mini",
        items: () =>
          chartMenu(chart, "Trade-offs").filter((one) => "label" in one && !/table|CSV/.test(one.label)),
      }),
    ),
    legend(),
    host,
    h("p", { class: "pointed", "aria-live": "polite" }, pointedLine),
  );
}
