// @ts-check
// The phase plot on the page: legend, meaning of the dashed lines, point at the cursor, menu.
import { h } from "../../../dom.js";
import { UNITS } from "../../../facts.js";
import { apart, computed, effect } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { scaleOf, toShown, withUnit } from "../../../format.js";
import { palette, pressureColour } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { openDialog } from "../../../ui/dialog.js";
import { dataTable, downloadText, toCsv } from "../../../ui/table.js";
import { extent } from "../../../plots/axes.js";
import { row, span } from "../cursor.js";
import { lookTransient, run, transient } from "../model.js";
import { isSteady, phaseSpec, phaseTable } from "./phase.js";
import { plot } from "./plot.js";

export const phase = plot(
  "phase",
  "Phase plot",
  "Contraction over pressure, with the static equilibrium",
);

const zoom = computed(() => transient.value.phase);

/** Drawn when the run or the display changes. */
export function drawPhase() {
  const answer = run.value;
  palette.value;
  const o = {
    system: units.value,
    zoom: zoom.value,
    zoomed: (/** @type {import("../../../types.js").Zoom | null} */ to) => lookTransient({ phase: to }),
  };
  if (answer && view.value === "transient") phase.chart.show((p) => phaseSpec({ run: answer, ...o }, p));
}

/** The meaning of the dashed lines. */
export function phaseNote() {
  const answer = run.value, system = units.value;
  if (!answer) return null;
  const { weight, spring, lever_ratio: ratio } = answer;
  const [least, most] = extent([answer.load_force]), steady = isSteady(answer);
  const force = (/** @type {number} */ si) => withUnit(si, "force", system);
  const loads = [
    Math.abs(weight) > 1e-6 ? `${force(weight)} of weight` : null,
    !steady ? `the external force at that time (${force(least)} to ${force(most)})` : null,
    steady && most !== 0 ? `${force(most)} of external force` : null,
    spring ? `the spring of ${withUnit(spring, "stiffness", system)}` : null,
  ].filter((part) => part !== null);
  const against = loads.length
    ? ` against ${loads.join(", ").replace(/, ([^,]*)$/, " and $1")}`
    : " without a load";
  const lever = ratio === 1 ? "" : `, with a lever ratio of ${Number(ratio.toPrecision(3))}`;
  const when = answer.joint
    ? "static equilibrium of the pair at both pressures at each time"
    : steady
    ? "static equilibrium at each pressure"
    : "static equilibrium at the pressure at each time";
  return h("p", { class: "hint" }, `Dashed: ${when}${against}${lever}.`);
}

export function phaseLegend() {
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
    h("li", null, h("i", { class: "dash", style: `color:${p.soft}` }), `${UNITS.phases.extend}, static`),
    h("li", null, h("i", { class: "dash", style: `color:${p.second}` }), `${UNITS.phases.retract}, static`),
  );
}

/** The point at the cursor. */
export function phasePoint() {
  const dot = h("div", { class: "dot", hidden: true });
  phase.chart.over.append(dot);
  const show = () => {
    const axes = phase.chart.axes, answer = run.value, i = row.value, system = units.value;
    const p = answer?.pressure[i], k = answer?.contraction[i];
    dot.hidden = !axes || p == null || k == null;
    if (dot.hidden || p == null || k == null) return;
    const x = axes.xaxis.c2p(toShown(p, scaleOf("pressure", system))), y = axes.yaxis.c2p(100 * k);
    dot.hidden = x < 0 || y < 0 || x > axes.xaxis._length || y > axes.yaxis._length;
    dot.style.transform = `translate(${axes.xaxis._offset + x}px,${axes.yaxis._offset + y}px)`;
  };
  effect(show);
  phase.chart.after.add(() => apart(show));
}

export function phaseItems() {
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
