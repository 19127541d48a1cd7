// @ts-check
// The plots over time and the phase plot; all are drawn when an answer arrives.
import { figure } from "../../../facts.js";
import { h, icon } from "../../../dom.js";
import { computed, effect, signal } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { brief, number, parse, scaleOf, toShown, withUnit } from "../../../format.js";
import { drawBands, writeLabels } from "../../../plots/overlay.js";
import { palette } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { menuButton } from "../../../ui/menu.js";
import { plotlyReady } from "../../../plots/library.js";
import { at } from "../../../paths.js";
import { cursor, followTime, row, second, secondRow, span, toggleSecond } from "../cursor.js";
import { angleSpec, jointCells, stiffnessSpec, torqueSpec } from "./joint.js";
import { measured } from "../measured.js";
import { drive, duration, lookTransient, mode, run, timeWindow, transient } from "../model.js";
import { drawPhase, phase, phaseItems, phaseLegend, phaseNote, phasePoint } from "./phase-card.js";
import { pinKey, pinRuns, pins } from "../pinned-runs.js";
import { pinNames } from "../run-names.js";
import { plot } from "./plot.js";
import { switchings } from "../inputs/signals.js";
import { siNumber } from "../../../quantities.js";
import {
  accelerationSpec,
  flowSpec,
  forceSpec,
  legendOf,
  positionSpec,
  pressureSpec,
  speedSpec,
  toleranceOf,
  valveSpec,
} from "./specs.js";

/** @typedef {import("./specs.js").View} View */
/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("./plot.js").Plot} Plot */

const NARROWEST = 1e-3;

/** A signal over time: what its strip shows, and the column that the cursors read.
 * @typedef {{id: string, title: string, label: string, spec: (v: View, p: import("../../../plots/theme.js").Palette) =>
 *   import("../../../plots/chart.js").Spec, of: (r: Run) => (number | null)[] | undefined,
 *   quantity: import("../../../format.js").Quantity, joint?: boolean}} Signal */

/** @param {string} id @param {string} key of the figure @param {string} label @param {Signal["spec"]} spec
 * @param {Signal["of"]} of @param {string} [title] @returns {Signal} */
function signalOf(id, key, label, spec, of, title) {
  const one = figure(key), quantity = one.quantity === "number" ? "ratio" : one.quantity;
  return { id, title: title ?? one.label, label, spec, of, quantity, joint: key.startsWith("joint.") };
}

/** @type {Signal[]} */
const SIGNALS = [
  signalOf(
    "position",
    "run.position",
    "Position over time with reference and stops",
    positionSpec,
    (r) => r.position,
  ),
  signalOf("valve", "run.command", "Command and opening of the valve over time", valveSpec, (r) => r.command),
  signalOf(
    "pressure",
    "run.pressure",
    "Pressure in muscle, tube and supply over time",
    pressureSpec,
    (r) => r.pressure,
  ),
  signalOf("flow", "run.mass_flow", "Mass flow over time", flowSpec, (r) => r.mass_flow),
  signalOf("force", "run.force", "Force of the muscle over time", forceSpec, (r) => r.force),
  signalOf("speed", "run.velocity", "Velocity over time", speedSpec, (r) => r.velocity),
  signalOf(
    "acceleration",
    "run.acceleration",
    "Acceleration over time",
    accelerationSpec,
    (r) => r.acceleration,
  ),
  signalOf(
    "angle",
    "joint.angle",
    "Angle of the pulley over time",
    angleSpec,
    (r) => r.joint?.angle,
    "Joint angle",
  ),
  signalOf(
    "torque",
    "joint.torque",
    "Torque of both muscles on the pulley over time",
    torqueSpec,
    (r) => r.joint?.torque,
    "Joint torque",
  ),
  signalOf(
    "stiffness",
    "joint.stiffness",
    "Stiffness of the joint over time",
    stiffnessSpec,
    (r) => r.joint?.stiffness,
  ),
];
const strips = SIGNALS.map((one) => ({ ...one, ...plot(one.id, one.title, one.label, true) }));
/** @typedef {typeof strips[number]} Strip */

const SHORTER = "Positive when shortening, also while venting";
const SIGNED = ["position", "speed", "acceleration"];
/** Whether the run is one of an antagonist pair. */
export const paired = computed(() => Boolean(run.value?.joint));
const tolerance = computed(() => transient.value.tolerance);
/** The strips in their order; they change with what is chosen only, not with each change of the drive. */
const shownIds = computed(() =>
  strips.filter(({ id, joint }) => transient.value.signals.includes(id) && (paired.value || !joint))
    .map(({ id }) => id).join(" ")
);
const shownStrips = computed(() =>
  shownIds.value.split(" ").flatMap((id) => strips.find((one) => one.id === id) ?? [])
);
/** All plots of the run with their titles, for the export as one sheet. */
export const shownCharts = () => [...shownStrips.peek(), phase].map(({ title, chart }) => ({ title, chart }));

/** @param {string} id */
function toggle(id) {
  const { signals } = transient.peek();
  const next = signals.includes(id) ? signals.filter((one) => one !== id) : [...signals, id];
  if (next.length) lookTransient({ signals: next });
}

/** @param {[number, number] | null} range */
function setWindow(range) {
  const end = run.peek()?.duration ?? duration.peek();
  if (!range) return lookTransient({ window: null });
  const from = Math.max(0, Math.min(...range)), to = Math.min(end, Math.max(...range));
  const whole = from <= 1e-6 * end && to >= end * (1 - 1e-6);
  if (to - from < NARROWEST) return;
  lookTransient({ window: whole ? null : [Number(from.toFixed(5)), Number(to.toFixed(5))] });
}

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
    tolerance: tolerance.value,
    bare: false,
    supply: siNumber(at(drive.peek(), "supply.pressure")),
    lever: siNumber(at(drive.peek(), "load.lever_ratio")) ?? 1,
    pinned: pins.value.flatMap((pin, index) => {
      const pinnedRun = runs.get(pinKey(pin.drive));
      return pinnedRun && "time" in pinnedRun
        ? [{ name: pinNames.value[index] ?? pin.name, run: pinnedRun, index }]
        : [];
    }),
    measured: measured.value,
    switches: switchings(command, answer.duration),
    brush: setWindow,
  };
}

/** Counts the drawings; legends follow them. */
const drawn = signal(0);

let drawings = 0, untold = false;
/** Tell of a drawing once its last strip has its axes: a strip that was just put into the page has them later. */
function tell() {
  if (!untold || !shownStrips.peek().at(-1)?.chart.axes) return;
  untold = false;
  drawn.value = ++drawings;
  document.documentElement.dataset.ran = String(drawings);
}

function drawAll() {
  const v = viewNow();
  palette.value;
  if (!v || view.value !== "transient") return;
  const shown = shownStrips.value, last = shown.at(-1);
  for (const one of shown) one.chart.show((p) => one.spec({ ...v, bare: one !== last }, p));
  untold = true;
  tell();
}

/** @param {Strip} one */
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

/** @param {Plot} one @param {() => import("../../../ui/menu.js").Item[]} items */
const menuOf = (one, items) =>
  menuButton({ label: icon("more"), name: `${one.title}: save or show as table`, class: "mini", items });

/** Values of a strip at both cursors, and their difference. @param {Strip} one */
function atCursors(one) {
  return () => {
    const r = run.value, values = r && one.of(r), b = secondRow.value;
    if (!values) return null;
    const s = scaleOf(one.quantity, units.value);
    const at = (/** @type {number | null} */ i) => i === null ? null : values[i] ?? null;
    const [from, to] = [at(row.value), at(b)];
    const text = (/** @type {number | null} */ si) => si === null ? "–" : brief(toShown(si, s));
    return [
      h("span", null, text(from)),
      h("span", null, text(to)),
      h("b", null, from === null || to === null ? "–" : brief((to - from) / s.factor)),
    ];
  };
}

/** @param {Strip} one */
function strip(one) {
  const items = () =>
    chartMenu(one.chart, one.title).map((item) =>
      "label" in item && item.label === "Reset zoom" ? { ...item, label: "Show the whole run" } : item
    );
  return h(
    "div",
    {
      role: "group",
      class: () => `time-strip ${one.host.id}${shownStrips.value.at(-1) === one ? " last" : ""}`,
      "aria-label": one.title,
      hidden: () => !shownStrips.value.includes(one),
    },
    h(
      "div",
      { class: "strip-head" },
      h("h3", { title: SIGNED.includes(one.id) ? SHORTER : null }, one.title),
      h("span", { class: "muted" }, () => scaleOf(one.quantity, units.value).unit),
      legend(one),
      menuOf(one, items),
    ),
    one.host,
    h("div", { class: "at-cursors num", "aria-live": "off" }, atCursors(one)),
  );
}

/** The tolerance that the strip of the position is marked by. */
function toleranceNote() {
  const r = run.value, judged = r && toleranceOf(r, tolerance.value);
  if (!judged) return null;
  return [
    h(
      "label",
      { class: "tolerance" },
      "Tolerance ±",
      h("input", {
        type: "text",
        inputmode: "decimal",
        "aria-label": "Tolerance in percent of the range of the reference",
        value: () => number(100 * tolerance.value, 2),
        onchange: (/** @type {Event} */ e) => {
          const input = /** @type {HTMLInputElement} */ (e.target);
          const got = parse(input.value, scaleOf("ratio", "bar"), "ratio");
          if ("value" in got && got.value > 0 && got.value < 1) lookTransient({ tolerance: got.value });
          input.value = number(100 * tolerance.peek(), 2);
        },
      }),
      `% = ${withUnit(judged.most, "length", units.value)}`,
    ),
    h(
      "span",
      { class: "muted" },
      h("i", { class: "inside" }),
      "inside ",
      h("i", { class: "outside" }),
      "outside",
    ),
  ];
}

/** Times of the cursors, and what they tell of a swing. */
function cursorHeads() {
  const b = second.value, [from, to] = [cursor.value, b];
  const text = (/** @type {number} */ t) => `${brief(t)} s`;
  const gap = to === null ? null : to - from;
  return [
    h("span", null, h("small", null, "A"), text(from)),
    h("span", null, h("small", null, "B"), to === null ? "–" : text(to)),
    h(
      "span",
      { title: gap ? `1 ÷ (B − A) = ${brief(1 / Math.abs(gap))} Hz` : null },
      h("small", null, "B − A"),
      gap === null ? "–" : text(gap),
    ),
  ];
}

/** The time window as numbers, which can also be dragged in the plots. */
function windowFields() {
  /** @param {0 | 1} side @param {string} label */
  const entry = (side, label) =>
    h("input", {
      type: "text",
      inputmode: "decimal",
      "aria-label": label,
      value: () => brief(span.value[side]),
      onchange: (/** @type {Event} */ e) => {
        const input = /** @type {HTMLInputElement} */ (e.target);
        const typed = Number(input.value.replace(",", ".").replace(/\s*s$/, ""));
        /** @type {[number, number]} */
        const next = [...span.peek()];
        next[side] = typed;
        if (Number.isFinite(typed) && next[0] < next[1]) setWindow(next);
        input.value = brief(span.peek()[side]);
      },
    });
  return h(
    "span",
    { class: "window" },
    h("small", null, "Window"),
    entry(0, "Window from, in seconds"),
    h("small", null, "to"),
    entry(1, "Window to, in seconds"),
    h("small", null, "s"),
    h("button", {
      type: "button",
      class: "link",
      disabled: () => timeWindow.value === null,
      title: "Also: double click in a plot",
      onclick: () => setWindow(null),
    }, "All"),
  );
}

const stripsCard = () =>
  h(
    "section",
    {
      class: "card strips-card",
      "aria-label": "Signals over time",
      style: () => `--strips: ${shownStrips.value.length}`,
    },
    h(
      "div",
      { class: "strips-head" },
      h(
        "div",
        { class: "signals", role: "group", "aria-label": "Signals shown" },
        ...strips.map((one) =>
          h("button", {
            type: "button",
            "aria-pressed": () => String(transient.value.signals.includes(one.id)),
            hidden: () => Boolean(one.joint) && !paired.value,
            onclick: () => toggle(one.id),
          }, one.title)
        ),
      ),
      h("button", {
        type: "button",
        class: "link",
        title: "The second cursor stays where it is put: a click in a strip, or the key B",
        "aria-pressed": () => String(second.value !== null),
        onclick: toggleSecond,
      }, () => second.value === null ? "Put B" : "Remove B"),
      h("div", { class: "at-cursors heads num", "aria-live": "off" }, cursorHeads),
    ),
    h("div", { class: "tolerances" }, windowFields(), toleranceNote),
    ...strips.map(strip),
    h("div", { class: "values", "aria-live": "off" }, readout),
    h(
      "ul",
      { class: "legend key" },
      h("li", null, h("i", { class: "hatch" }), "on a stop"),
      h("li", null, h("i", { class: "slack" }), () => paired.value ? "muscle 1 slack" : "muscle slack"),
      h(
        "li",
        { hidden: () => !run.value?.stuck.includes(true) },
        h("i", { class: "stuck" }),
        "stuck by friction",
      ),
      h("li", null, h("i", { class: "fill" }), "choked filling"),
      h("li", null, h("i", { class: "exhaust" }), "choked venting"),
      h("li", null, h("i", { class: "instant" }), "switching"),
    ),
  );

const phaseFrame = () =>
  h(
    "section",
    { class: `card chart ${phase.host.id}`, "aria-label": phase.title },
    h("div", { class: "card-head" }, h("h2", null, phase.title), phaseLegend, menuOf(phase, phaseItems)),
    phase.host,
    phaseNote,
  );

/** The values under the cursor, in one line. */
function readout() {
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
  const cards = [stripsCard(), phaseFrame()];
  strips.forEach(({ chart }) => {
    drawBands(chart);
    writeLabels(chart);
    chart.after.add(tell);
  });
  followTime(strips.map(({ chart }) => chart));
  phasePoint();
  effect(() => {
    if (plotlyReady.value) drawAll();
  });
  effect(() => {
    if (plotlyReady.value) drawPhase();
  });
  return { strips: cards[0], phase: cards[1] };
}
