// @ts-check
// The plots: five over one time axis and the phase plot; one drawing of all of them when an answer arrives.
import { h, icon } from "../../dom.js";
import { apart, computed, effect, signal } from "../../reactive.js";
import { units, view } from "../../state.js";
import { scaleOf, withUnit } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { drawBands, writeLabels } from "../../plots/overlay.js";
import { palette, pressureColour } from "../../plots/theme.js";
import { chartMenu } from "../../plots/export.js";
import { openDialog } from "../../ui/dialog.js";
import { menuButton } from "../../ui/menu.js";
import { dataTable, downloadText, toCsv } from "../../ui/table.js";
import { plotlyReady } from "../design/charts.js";
import { at } from "./document.js";
import { followTime, row, span } from "./cursor.js";
import { measured } from "./measured.js";
import {
  drive,
  lookTransient,
  mode,
  numberAt,
  pinKey,
  pinRuns,
  pins,
  run,
  statics,
  timeWindow,
  transient,
} from "./model.js";
import { phaseSpec, phaseTable } from "./phase.js";
import { switchings } from "./signals.js";
import { siNumber } from "./units.js";
import { accelerationSpec, legendOf, lowerSpec, positionSpec, pressureSpec, speedSpec } from "./specs.js";

/** @typedef {import("./specs.js").View} View */
/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("./document.js").Lower} Lower */
/** @typedef {{id: string, title: string, host: HTMLElement, chart: Chart}} Plot */

const NARROWEST = 1e-3;

/** @param {string} id @param {string} title @param {string} label @returns {Plot} */
function plot(id, title, label) {
  const host = h("div", { class: "plot", id: `run-${id}`, role: "figure", "aria-label": label });
  return { id, title, host, chart: new Chart(host, `run-${id}`) };
}

const position = plot("position", "Position", "Position over time with reference and stops");
const pressure = plot("pressure", "Pressure", "Pressure in muscle, tube and supply over time");
const speed = plot("speed", "Speed", "Speed over time");
const acceleration = plot("acceleration", "Acceleration", "Acceleration over time");
const lower = plot("lower", "Flow and force", "Mass flow, force or valve over time");
const phase = plot("phase", "Phase plot", "Contraction over pressure on the static map");

const overTime = [position, pressure, speed, lower, acceleration];
/** All plots with their titles, for the export of the sheet. */
export const charts = [...overTime, phase].map(({ title, chart }) => ({ title, chart }));

/** @param {[number, number] | null} range */
export function setWindow(range) {
  const duration = run.peek()?.duration ?? numberAt("duration") ?? 1;
  if (!range) return lookTransient({ window: null });
  const from = Math.max(0, Math.min(...range)), to = Math.min(duration, Math.max(...range));
  const whole = from <= 1e-6 * duration && to >= duration * (1 - 1e-6);
  if (to - from < NARROWEST) return;
  lookTransient({ window: whole ? null : [Number(from.toFixed(5)), Number(to.toFixed(5))] });
}

/** The force that resists the pull at rest, for the static map: i² F = i W + k s. */
const staticLoad = computed(() => {
  const force = numberAt("load.force") ?? 0;
  const mass = numberAt("load.mass") ?? 0, angle = numberAt("load.inclination") ?? Math.PI / 2;
  return {
    resisting: mass * 9.80665 * Math.sin(angle) + force,
    spring: numberAt("load.spring") ?? 0,
    ratio: numberAt("load.lever_ratio") ?? 1,
  };
});

const lowerKind = computed(() => transient.value.lower);

/** @returns {View | null} what the answers give, not what the inputs say: a plot never mixes the two */
function viewNow() {
  const answer = run.value;
  if (!answer) return null;
  const signal_ = mode.peek() === "controller" ? null : at(drive.peek(), "command");
  const known = pinRuns.value;
  return {
    run: answer,
    system: units.value,
    window: span.value,
    zoomed: timeWindow.value !== null,
    lower: lowerKind.value,
    supply: siNumber(at(drive.peek(), "supply.pressure")),
    pinned: pins.value.flatMap((pin, index) => {
      const found = known.get(pinKey(pin.drive));
      return found && "time" in found ? [{ name: pin.name, run: found, index }] : [];
    }),
    measured: measured.value,
    switches: switchings(signal_, answer.duration),
    brush: setWindow,
  };
}

/** Legends follow what is drawn. */
const drawn = signal(0);

let drawings = 0;
function drawAll() {
  const v = viewNow();
  palette.value;
  if (!v || view.value !== "transient") return;
  position.chart.show((p) => positionSpec(v, p));
  pressure.chart.show((p) => pressureSpec(v, p));
  speed.chart.show((p) => speedSpec(v, p));
  lower.chart.show((p) => lowerSpec(v, p));
  acceleration.chart.show((p) => accelerationSpec(v, p));
  if (!position.chart.axes) return;
  drawn.value = ++drawings;
  document.documentElement.dataset.ran = String(drawings);
}

/** The phase plot also follows the static map, which arrives on its own. */
function drawPhase() {
  const answer = run.value, map = statics.value, load = staticLoad.peek(), system = units.value;
  palette.value;
  if (answer && view.value === "transient") phase.chart.show((p) => phaseSpec(answer, map, load, system, p));
}

/** @param {Plot} one */
function legend(one) {
  const key = computed(() => {
    drawn.value;
    return JSON.stringify(one.chart.spec ? legendOf(one.chart.spec) : []);
  });
  return () => {
    /** @type {ReturnType<typeof legendOf>} */
    const entries = JSON.parse(key.value);
    if (entries.length < 2) return null;
    return h(
      "ul",
      { class: "legend" },
      ...entries.map((e) =>
        h("li", null, h("i", { class: e.dashed ? "dash" : "", style: `color:${e.color}` }), e.name)
      ),
    );
  };
}

/** @param {Plot} one @param {import("../../dom.js").Child[]} head */
function frame(one, ...head) {
  const items = () =>
    chartMenu(one.chart, one.title).map((item) =>
      "label" in item && item.label === "Reset zoom" ? { ...item, label: "Show the whole run" } : item
    );
  return h(
    "section",
    { class: `card chart ${one.host.id}`, "aria-label": one.title },
    h(
      "div",
      { class: "card-head" },
      h("h2", { class: one === lower ? "unseen" : null }, one.title),
      ...head,
      menuButton({
        label: icon("more"),
        name: `${one.title}: save or show as table`,
        class: "mini",
        items: one === phase ? phaseItems : items,
      }),
    ),
    one.host,
  );
}

function phaseItems() {
  const answer = run.peek();
  const rest = chartMenu(phase.chart, phase.title).slice(2);
  if (!answer) return rest;
  const table = phaseTable(answer, units.peek());
  return [
    {
      label: "Show as table",
      run: () => openDialog({ title: phase.title, wide: true }, dataTable(table, phase.title)),
    },
    { label: "Save as CSV", run: () => downloadText("mckibben-run-phase.csv", toCsv(table), "text/csv") },
    ...rest,
  ];
}

/** @type {[Lower, string][]} */
const LOWER = [["flow", "Mass flow"], ["force", "Force"], ["valve", "Valve"]];

const lowerChoice = () =>
  h("select", {
    "aria-label": "Quantity of this plot",
    class: "small",
    onchange: (/** @type {Event} */ e) =>
      lookTransient({ lower: /** @type {Lower} */ (/** @type {HTMLSelectElement} */ (e.target).value) }),
  }, () => LOWER.map(([id, name]) => h("option", { value: id, selected: lowerKind.value === id }, name)));

const phaseLegend = () => {
  const p = palette.value;
  const stops = Array.from({ length: 6 }, (_, k) => pressureColour(k / 5, p)).join(",");
  const end = scaleOf("time", units.value).unit;
  const [from, to] = span.value;
  return h(
    "ul",
    { class: "legend" },
    h(
      "li",
      null,
      `${Number(from.toPrecision(3))} `,
      h("i", { class: "ramp", style: `background:linear-gradient(to right,${stops})` }),
      `${Number(to.toPrecision(3))} ${end}`,
    ),
    h("li", null, h("i", { class: "dash", style: `color:${p.soft}` }), "fill, static"),
    h("li", null, h("i", { class: "dash", style: `color:${p.second}` }), "vent, static"),
  );
};

/** The cursor's point in the phase plot. */
function phasePoint() {
  const dot = h("div", { class: "dot", hidden: true });
  phase.chart.over.append(dot);
  const show = () => {
    const axes = phase.chart.axes, answer = run.value, i = row.value, system = units.value;
    const p = answer?.pressure[i], k = answer?.contraction[i];
    dot.hidden = !axes || p == null || k == null;
    if (dot.hidden || p == null || k == null) return;
    const s = scaleOf("pressure", system);
    const x = axes.xaxis._offset + axes.xaxis.c2p(p / s.factor),
      y = axes.yaxis._offset + axes.yaxis.c2p(100 * k);
    dot.style.transform = `translate(${x}px,${y}px)`;
  };
  effect(show);
  phase.chart.after.add(() => apart(show));
}

/** The values under the cursor, in one line. */
export function readout() {
  const answer = run.value, i = row.value, system = units.value;
  if (!answer) return h("span", { class: "muted" }, "…");
  /** @param {string} name @param {(number | null)[]} values @param {import("../../format.js").Quantity} q */
  const cell = (name, values, q) => h("span", null, h("small", null, name), withUnit(values[i], q, system));
  return [
    cell("x", answer.position, "length"),
    cell("v", answer.velocity, "speed"),
    cell("p", answer.pressure, "pressure"),
    cell("F", answer.force, "force"),
    cell("ε", answer.contraction, "ratio"),
    cell("Ø", answer.diameter, "length"),
  ];
}

export function plotCards() {
  const cards = [
    frame(position, legend(position)),
    frame(pressure, legend(pressure)),
    frame(speed),
    frame(lower, lowerChoice(), legend(lower)),
    frame(acceleration),
    frame(phase, phaseLegend),
  ];
  overTime.forEach(({ chart }) => {
    drawBands(chart);
    writeLabels(chart);
  });
  followTime(overTime.map(({ chart }) => chart));
  phasePoint();
  effect(() => {
    if (plotlyReady.value) drawAll();
  });
  effect(() => {
    if (plotlyReady.value) drawPhase();
  });
  return cards;
}
