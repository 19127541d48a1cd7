// @ts-check
// What each plot over time shows: lines, bands and marks in the user's units. Pure functions.
import { figure } from "../../../facts.js";
import { axisTitle, extent, shown, steadyRange } from "../../../plots/axes.js";
import { scaleOf } from "../../../format.js";
import { intervals, measuredColumn, measuredPosition, resampled, withoutImpacts } from "../series.js";

/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../plots/chart.js").Trace} Trace */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../types.js").Measured} Measured */
/** @typedef {{name: string, run: Run, index: number}} Pinned */
/** @typedef {{run: Run, system: System, window: [number, number], tolerance: number, bare: boolean, supply: number | null, lever: number,
 *   pinned: Pinned[], measured: Measured | null, switches: number[], zoomed: boolean,
 *   brush: (range: [number, number] | null) => void}} View */
/** A column of a run as one line of a plot.
 * @typedef {{id: string, name: string, values: (number | null)[], color: string, dash?: string,
 *   width?: number, label?: string | null}} Line */

/** Colours that differ from the accent and from each other, also for colour-blind readers. @param {Palette} p */
export const pinColours = (p) =>
  p.dark ? ["#c9a2ff", "#4fd1c0", "#e6c54a", "#ff8fbf"] : ["#7b3fb5", "#00776b", "#8a6a00", "#b3206e"];

/** What a row of a run is, besides its values. @type {("contact" | "slack" | "stuck")[]} */
export const STATES = ["contact", "slack", "stuck"];

/** @param {View} v @param {Palette} p @param {{key: string, title: string, quantity: Quantity, lines: Line[],
 *   dots?: {x: number[], y: (number | null)[]} | null, within?: (number | null)[][], zero?: boolean,
 *   least?: number}} o  `least`: the smallest span of the y axis in SI
 * @returns {Spec} */
export function overTime(v, p, o) {
  const { key, title, quantity, lines, dots = null, within, zero = false, least = 0 } = o;
  const { run, system, window: span } = v;
  /** @type {Trace[]} */
  const traces = lines.map((line) => ({
    id: line.id,
    x: run.time,
    y: shown(line.values, quantity, system),
    line: { color: line.color, width: line.width ?? 2, dash: line.dash },
    column: line.name,
  }));
  if (dots) {
    traces.unshift({
      id: "measured",
      x: dots.x,
      y: shown(dots.y, quantity, system),
      marker: { size: 4, symbol: "circle", color: p.load },
      column: "measured",
    });
  }
  const shownRange = within ? within.map((row) => shown(row, quantity, system)) : traces.map((t) => t.y);
  const [bottom, top] = extent(zero ? [...shownRange, [0]] : shownRange);
  const spare = Math.max(0, (least / scaleOf(quantity, system).factor - (top - bottom)) / 2);
  const low = bottom - spare, high = top + spare;
  const all = lines.flatMap((line, i) => {
    if (!line.label) return [];
    const y = traces[i + (dots ? 1 : 0)].y;
    const k = labelRow(run, y, span);
    const value = k === null ? null : y[k];
    return value == null || k === null
      ? []
      : [{ text: line.label, x: run.time[k], y: value, color: line.color }];
  });
  return {
    x: { title: "Time (s)", range: span, bare: v.bare },
    y: {
      title: axisTitle(title, quantity, system),
      range: steadyRange(`run ${key}${system}${v.zoomed}`, low, high),
    },
    traces,
    zones: [],
    labels: all,
    bands: [
      ...run.choked.map((c) => ({ x: /** @type {[number, number]} */ ([c.from, c.to]), kind: c.side })),
      ...STATES.flatMap((kind) => intervals(run.time, run[kind]).map((x) => ({ x, kind }))),
    ],
    marks: v.switches,
    states: STATES.map((title) => ({ title, isSo: run[title] })),
    brush: v.brush,
    revision: `${span}${system}`,
  };
}

/** The row at which the name of a line is written: near the end of the time shown.
 * @param {Run} run @param {(number | null)[]} y @param {[number, number]} span */
function labelRow({ time }, y, [from, to]) {
  const wanted = from + 0.98 * (to - from);
  for (let k = time.length - 1; k >= 0; k--) if (time[k] <= wanted && y[k] != null) return k;
  return null;
}

/** A column of the pinned runs that have it, at the times of the run.
 * @param {View} v @param {Palette} p @param {(r: Run) => (number | null)[] | null} of @returns {Line[]} */
export const pinLines = (v, p, of) =>
  v.pinned.flatMap((pin) => {
    const values = of(pin.run);
    return values
      ? [{
        id: `pin${pin.index}`,
        name: pin.name,
        values: resampled(pin.run.time, values, v.run.time),
        color: pinColours(p)[pin.index],
        width: 1.3,
      }]
      : [];
  });

/** @param {View} v @param {Palette} p @returns {Spec} */
export function positionSpec(v, p) {
  const { run } = v, { position_min: low, position_max: high } = run.limits;
  const flat = (/** @type {number} */ value) => run.time.map(() => value);
  /** @type {Line[]} */
  const lines = [
    { id: "stop-low", name: "lower stop", values: flat(low), color: p.soft, dash: "dot", width: 1.2 },
    {
      id: "stop-high",
      name: "upper stop",
      values: flat(high),
      color: p.soft,
      dash: "dot",
      width: 1.2,
      label: "stop",
    },
    ...pinLines(v, p, (r) => r.position),
  ];
  if (run.reference) {
    lines.push({
      id: "reference",
      name: "reference",
      values: run.reference,
      color: p.load,
      dash: "dash",
      width: 1.6,
    });
  }
  if (run.interval) {
    const { low, high, share } = run.interval, percent = Math.round(100 * share);
    for (const [id, values] of /** @type {const} */ ([["low", low], ["high", high]])) {
      const name = `${percent} % of readings, ${id} end`;
      lines.push({ id: `interval-${id}`, name, values, color: p.accent, dash: "dot", width: 1 });
    }
  }
  lines.push({ id: "position", name: "position", values: run.position, color: p.accent });
  const spec = overTime(v, p, {
    key: "position",
    title: figure("run.position").label,
    quantity: "length",
    lines,
    dots: measuredPosition(v.run, v.measured, v.window, v.lever),
  });
  const judged = toleranceOf(run, v.tolerance);
  if (judged) {
    for (const kind of /** @type {const} */ (["inside", "outside"])) {
      const isSo = judged.inside.map((is) => is === (kind === "inside"));
      spec.bands?.push(...intervals(run.time, isSo).map((x) => ({ x, kind })));
    }
  }
  return spec;
}

/** Where the position is within a share of the range of its reference; null without a reference that moves.
 * @param {Run} run @param {number} tolerance */
export function toleranceOf(run, tolerance) {
  const { reference, position } = run;
  if (!reference) return null;
  const [low, high] = extent([reference]), most = tolerance * (high - low);
  if (!(most > 0)) return null;
  const inside = position.map((x, i) =>
    x != null && reference[i] != null && Math.abs(x - Number(reference[i])) <= most
  );
  return { most, inside };
}

/** The second muscle of an antagonist pair. @param {Palette} p @param {(number | null)[]} values @returns {Line} */
const second = (p, values) => ({ id: "counter", name: "muscle 2", values, color: p.load, width: 1.6 });

/** @param {View} v @param {Palette} p @returns {Spec} */
export function pressureSpec(v, p) {
  const { run, supply } = v;
  const lines = pinLines(v, p, (r) => r.pressure);
  if (supply != null) {
    lines.push({
      id: "supply",
      name: "supply",
      values: run.time.map(() => supply),
      color: p.soft,
      dash: "dot",
      width: 1.2,
      label: "supply",
    });
  }
  if (run.regulator_pressure) {
    lines.push({
      id: "regulator",
      name: "set point",
      values: run.regulator_pressure,
      color: p.load,
      dash: "dash",
      width: 1.5,
    });
  }
  if (run.tube_pressure) {
    lines.push({
      id: "tube",
      name: run.joint?.counter_pressure ? "tube 1" : "tube",
      values: run.tube_pressure,
      color: p.second,
      dash: "dash",
      width: 1.5,
    });
  }
  if (run.joint?.counter_pressure) lines.push(second(p, run.joint.counter_pressure));
  lines.push({
    id: "muscle",
    name: run.joint?.counter_pressure ? "muscle 1" : "muscle",
    values: run.pressure,
    color: p.accent,
  });
  return overTime(v, p, {
    key: "pressure",
    title: figure("run.pressure").label,
    quantity: "pressure",
    lines,
    dots: measuredColumn(v.measured, v.window, ["pressure"]),
    zero: true,
  });
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export const speedSpec = (v, p) =>
  overTime(v, p, {
    key: "speed",
    title: figure("run.velocity").label,
    quantity: "speed",
    lines: [
      ...pinLines(v, p, (r) => r.velocity),
      { id: "velocity", name: "velocity", values: v.run.velocity, color: p.accent },
    ],
    dots: measuredColumn(v.measured, v.window, ["velocity"], (lengthening) => -lengthening / v.lever),
    zero: true,
    least: 0.01,
  });

/** @param {View} v @param {Palette} p @returns {Spec} */
export function accelerationSpec(v, p) {
  const { run } = v, free = withoutImpacts(run, run.acceleration);
  return overTime(v, p, {
    key: "acceleration",
    title: figure("run.acceleration").label,
    quantity: "acceleration",
    lines: [{ id: "acceleration", name: "acceleration", values: run.acceleration, color: p.accent }],
    within: [free.some((a) => a != null) ? free : run.acceleration],
    zero: true,
    least: 0.5,
  });
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function flowSpec(v, p) {
  const { run } = v, vented = run.exhaust_flow.map((x) => x == null ? null : -x);
  /** @type {Line[]} */
  const lines = [
    ...pinLines(v, p, (r) => r.mass_flow),
    { id: "supply", name: "supply", values: run.supply_flow, color: p.soft, dash: "dot", width: 1.4 },
    { id: "exhaust", name: "atmosphere", values: vented, color: p.second, dash: "dash", width: 1.5 },
    {
      id: "flow",
      name: run.joint?.counter_pressure ? "muscle 1" : "muscle",
      values: run.mass_flow,
      color: p.accent,
    },
  ];
  if (run.joint?.counter_mass_flow) lines.push(second(p, run.joint.counter_mass_flow));
  return overTime(v, p, {
    key: "flow",
    title: figure("run.mass_flow").label,
    quantity: "flow",
    lines,
    zero: true,
  });
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function forceSpec(v, p) {
  const { run } = v, name = run.joint?.counter_pressure ? "muscle 1" : "force of the muscle";
  /** @type {Line[]} */
  const lines = pinLines(v, p, (r) => r.force);
  if (run.friction.some((x) => x !== 0)) {
    const values = run.friction, label = figure("run.friction").label.toLowerCase();
    lines.push({ id: "friction", name: label, values, color: p.load, dash: "dot", width: 1.5 });
  }
  if (run.load_force.some((x) => x !== 0)) {
    const color = run.joint ? p.soft : p.second;
    lines.push({
      id: "external",
      name: "external force",
      values: run.load_force,
      color,
      dash: "dash",
      width: 1.5,
    });
  }
  if (run.joint?.counter_force) lines.push(second(p, run.joint.counter_force));
  lines.push({ id: "force", name, values: run.force, color: p.accent });
  return overTime(v, p, {
    key: "force",
    title: figure("run.force").label,
    quantity: "force",
    lines,
    dots: measuredColumn(v.measured, v.window, ["force"]),
    zero: true,
  });
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function valveSpec(v, p) {
  const { run } = v;
  /** @type {Line[]} */
  const lines = [
    ...pinLines(v, p, (r) => r.command),
    {
      id: "opening",
      name: "opening of the valve",
      values: run.opening,
      color: p.second,
      dash: "dash",
      width: 1.5,
    },
    ...(run.joint?.counter_command ? [{ ...second(p, run.joint.counter_command), name: "command 2" }] : []),
    { id: "command", name: "command", values: run.command, color: p.accent },
  ];
  return overTime(v, p, {
    key: "valve",
    title: figure("run.command").label,
    quantity: "ratio",
    lines,
    dots: measuredColumn(v.measured, v.window, ["command"]),
    zero: true,
  });
}

/** The legend of a plot: name, colour, dash. @param {Spec} spec */
export const legendOf = (spec) =>
  spec.traces.filter((t) => t.line && !t.id.startsWith("stop")).map((t) => ({
    name: t.column ?? t.id,
    color: t.line?.color ?? "",
    dashed: Boolean(t.line?.dash),
  }));
