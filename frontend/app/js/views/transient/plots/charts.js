// @ts-check
// The plots over time and the phase plot; all are drawn when an answer arrives.
import { figure } from "../../../facts.js";
import { h, icon } from "../../../dom.js";
import { computed, effect, signal } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { withUnit } from "../../../format.js";
import { drawBands, writeLabels } from "../../../plots/overlay.js";
import { palette } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { menuButton } from "../../../ui/menu.js";
import { plotlyReady } from "../../../plots/library.js";
import { at } from "../../../paths.js";
import { followTime, row, span } from "../cursor.js";
import { angleSpec, jointCells, stiffnessSpec, torqueSpec } from "./joint.js";
import { measured } from "../measured.js";
import { drive, duration, lookTransient, mode, run, timeWindow, transient } from "../model.js";
import { drawPhase, phase, phaseItems, phaseLegend, phaseNote, phasePoint } from "./phase-card.js";
import { pinKey, pinRuns, pins } from "../pinned-runs.js";
import { plot } from "./plot.js";
import { switchings } from "../inputs/signals.js";
import { siNumber } from "../../../quantities.js";
import { accelerationSpec, legendOf, lowerSpec, positionSpec, pressureSpec, speedSpec } from "./specs.js";

/** @typedef {import("./specs.js").View} View */
/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../types.js").Lower} Lower */
/** @typedef {import("./plot.js").Plot} Plot */

const NARROWEST = 1e-3;

const position = plot(
  "position",
  figure("run.position").label,
  "Position over time with reference and stops",
);
const pressure = plot(
  "pressure",
  figure("run.pressure").label,
  "Pressure in muscle, tube and supply over time",
);
const speed = plot("speed", figure("run.velocity").label, "Velocity over time");
const acceleration = plot("acceleration", figure("run.acceleration").label, "Acceleration over time");
const lower = plot("lower", "Flow and force", "Mass flow, force or valve over time");
const angle = plot("angle", "Joint angle", "Angle of the pulley over time");
const torque = plot("torque", "Joint torque", "Torque of both muscles on the pulley over time");
const stiffness = plot("stiffness", figure("joint.stiffness").label, "Stiffness of the joint over time");

const SHORTER = "Positive when shortening, also while venting";
const signed = [position, speed, acceleration];
const joint = [angle, torque, stiffness];
const overTime = [position, pressure, speed, lower, acceleration, ...joint];
/** All plots of the run with their titles, for the export as one sheet. */
export const shownCharts = () =>
  [...overTime, phase].filter((one) => run.peek()?.joint || !joint.includes(one))
    .map(({ title, chart }) => ({ title, chart }));

/** @param {[number, number] | null} range */
export function setWindow(range) {
  const end = run.peek()?.duration ?? duration.peek();
  if (!range) return lookTransient({ window: null });
  const from = Math.max(0, Math.min(...range)), to = Math.min(end, Math.max(...range));
  const whole = from <= 1e-6 * end && to >= end * (1 - 1e-6);
  if (to - from < NARROWEST) return;
  lookTransient({ window: whole ? null : [Number(from.toFixed(5)), Number(to.toFixed(5))] });
}

/** Whether the run is one of an antagonist pair. */
export const paired = computed(() => Boolean(run.value?.joint));

const lowerKind = computed(() => transient.value.lower);

/** What is drawn: from the answers, not from the inputs, so that a plot never mixes both. @returns {View | null} */
function viewNow() {
  const answer = run.value;
  if (!answer) return null;
  const command = mode.peek() === "controller" ? null : at(drive.peek(), "command");
  const runs = pinRuns.value;
  return {
    run: answer,
    system: units.value,
    window: span.value,
    zoomed: timeWindow.value !== null,
    lower: lowerKind.value,
    supply: siNumber(at(drive.peek(), "supply.pressure")),
    lever: siNumber(at(drive.peek(), "load.lever_ratio")) ?? 1,
    pinned: pins.value.flatMap((pin, index) => {
      const pinnedRun = runs.get(pinKey(pin.drive));
      return pinnedRun && "time" in pinnedRun ? [{ name: pin.name, run: pinnedRun, index }] : [];
    }),
    measured: measured.value,
    switches: switchings(command, answer.duration),
    brush: setWindow,
  };
}

/** Counts the drawings; legends follow them. */
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
  if (v.run.joint) {
    angle.chart.show((p) => angleSpec(v, p));
    torque.chart.show((p) => torqueSpec(v, p));
    stiffness.chart.show((p) => stiffnessSpec(v, p));
  }
  if (!position.chart.axes) return;
  drawn.value = ++drawings;
  document.documentElement.dataset.ran = String(drawings);
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

/** @param {Plot} one @param {import("../../../dom.js").Child[]} head */
function frame(one, ...head) {
  const items = () =>
    chartMenu(one.chart, one.title).map((item) =>
      "label" in item && item.label === "Reset zoom" ? { ...item, label: "Show the whole run" } : item
    );
  return h(
    "section",
    {
      class: `card chart ${one.host.id}`,
      "aria-label": one.title,
      hidden: () => joint.includes(one) && !paired.value,
    },
    h(
      "div",
      { class: "card-head" },
      h(
        "h2",
        { class: one === lower ? "unseen" : null, title: signed.includes(one) ? SHORTER : null },
        one.title,
      ),
      ...head,
      menuButton({
        label: icon("more"),
        name: `${one.title}: save or show as table`,
        class: "mini",
        items: one === phase ? phaseItems : items,
      }),
    ),
    one.host,
    one === phase ? phaseNote : null,
  );
}

/** @type {[Lower, string][]} */
const LOWER = [["flow", figure("run.mass_flow").label], ["force", figure("run.force").label], [
  "valve",
  "Valve",
]];

const lowerChoice = () =>
  h("select", {
    "aria-label": "Quantity of this plot",
    class: "small",
    onchange: (/** @type {Event} */ e) =>
      lookTransient({ lower: /** @type {Lower} */ (/** @type {HTMLSelectElement} */ (e.target).value) }),
  }, () => LOWER.map(([id, name]) => h("option", { value: id, selected: lowerKind.value === id }, name)));

/** The values under the cursor, in one line. */
export function readout() {
  const answer = run.value, i = row.value, system = units.value;
  if (!answer) return h("span", { class: "muted" }, "…");
  /** @param {string} name @param {(number | null)[]} values @param {import("../../../format.js").Quantity} q */
  const cell = (name, values, q) => h("span", null, h("small", null, name), withUnit(values[i], q, system));
  return [
    cell("x", answer.position, "length"),
    cell("v", answer.velocity, "speed"),
    cell("p", answer.pressure, "pressure"),
    cell("F", answer.force, "force"),
    cell("ε", answer.contraction, "ratio"),
    cell(answer.joint?.counter_diameter ? "Ø1" : "Ø", answer.diameter, "length"),
    ...(answer.joint ? jointCells(answer.joint, cell) : []),
  ];
}

export function plotCards() {
  const cards = [
    frame(position, legend(position)),
    frame(pressure, legend(pressure)),
    frame(speed),
    frame(lower, lowerChoice(), legend(lower)),
    frame(acceleration),
    ...joint.map((one) => frame(one, legend(one))),
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
