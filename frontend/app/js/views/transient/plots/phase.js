// @ts-check
// The phase plot: contraction over pressure, the run coloured by time, and the static equilibrium.
import { scaleOf, toShown, toSi } from "../../../format.js";
import { axisTitle, extent, shown, steadyRange } from "../../../plots/axes.js";
import { pressureColour } from "../../../plots/theme.js";
import { middleOf } from "../series.js";
import { STATES } from "./specs.js";

/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../types.js").Curves} Curves */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {import("../statics.js").Statics} Statics */
/** @typedef {import("../../../types.js").Zoom} Zoom */
/** The static load: weight [N], spring [N/m], lever ratio.
 * @typedef {{weight: number, spring: number, ratio: number}} Load */
/** @typedef {{run: Run, statics: Statics | null, load: Load, system: System, zoom: Zoom | null,
 *   zoomed: (zoom: Zoom | null) => void}} Phase */

const PIECES = 14, HALVINGS = 22, LEAST_PERCENT = 2, SLACK = 0.5;

/** The row before a value in an ascending column, and the position of the value between that row and the next, 0…1.
 * @param {number[]} column @param {number} x @returns {[number, number]} */
function between(column, x) {
  let low = 0, high = column.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (column[middle] <= x) low = middle;
    else high = middle;
  }
  const share = (x - column[low]) / (column[high] - column[low] || 1);
  return [low, Math.min(1, Math.max(0, share))];
}

/** The force map of the curves, continued below zero where the muscle is slack: between two pressures, the
 * contraction without force is then interpolated too. @type {WeakMap<Curves, number[][]>} */
const maps = new WeakMap();
/** @param {Curves} c */
function mapOf(c) {
  const known = maps.get(c);
  if (known) return known;
  const rows = c.force.map((row) => {
    const line = row.map((f) => f ?? 0), last = line.findLastIndex((f) => f > 0);
    if (last < 0) return line.map((_, j) => -j);
    const slope = last > 0 ? line[last] - line[last - 1] : -line[0];
    return line.map((f, j) => j <= last ? f : line[last] + (j - last) * Math.min(slope, -line[last]));
  });
  maps.set(c, rows);
  return rows;
}

/** Static force at a pressure and a contraction, interpolated linearly.
 * @param {Curves} c @param {number} p @param {number} k */
function forceAt(c, p, k) {
  const map = mapOf(c), [i, up] = between(c.pressure, p), [j, along] = between(c.contraction, k);
  const row = (/** @type {number} */ n) => {
    const line = map[Math.min(n, map.length - 1)];
    const a = line[j], b = line[Math.min(j + 1, line.length - 1)];
    return a + (b - a) * along;
  };
  return Math.max(0, row(i) + (row(i + 1) - row(i)) * up);
}

/** Whether the external force is constant. @param {Run} run */
export function isSteady({ load_force: force }) {
  const [low, high] = extent([force]);
  return high - low <= 1e-9 * Math.max(1, Math.abs(high));
}

/** Contractions in static equilibrium, each at a pressure and an external force, and for a pair at the pressure of
 * the second muscle, which moves the other way. Balance: i² F = i (W + F_e) + k s.
 * @param {Run} run @param {Load} load @param {Curves} pulling @param {Curves} letting
 * @param {{pressure: (number | null)[], counter: (number | null)[] | null, force: (number | null)[]}} rows */
export function resting(run, load, pulling, letting, { pressure, counter, force }) {
  const rest = run.geometry.nominal_length, middle = middleOf(run), { ratio } = load;
  const low = run.limits.position_min * ratio, high = run.limits.position_max * ratio;
  return pressure.map((p, i) => {
    const outer = force[i], second = counter?.[i];
    if (p == null || outer == null || (counter && second == null)) return null;
    const spare = (/** @type {number} */ s) =>
      forceAt(pulling, p, middle + s / rest) -
      (second == null ? 0 : forceAt(letting, second, middle - s / rest)) -
      (load.weight + outer) / ratio - (load.spring * s) / ratio ** 2;
    const least = spare(low), most = spare(high);
    if (most > 0) return middle + high / rest;
    if (least < 0) return middle + low / rest;
    if (least === 0 && most === 0) return null; // no force in either direction: every position is an equilibrium
    let from = low, to = high;
    for (let n = 0; n < HALVINGS; n++) {
      const s = 0.5 * (from + to);
      if (spare(s) > 0) from = s;
      else to = s;
    }
    const k = middle + to / rest;
    const isSlack = second != null &&
      forceAt(pulling, p, k) + forceAt(letting, second, 2 * middle - k) < SLACK;
    return isSlack ? null : k;
  });
}

/** The dashed lines: over all pressures if the external force is constant, else at every time of the run.
 * @param {Phase} o @param {"filling" | "venting"} id */
function restLine({ run, statics, load }, id) {
  if (!statics) return null;
  const pulling = statics[id], letting = statics[id === "filling" ? "venting" : "filling"];
  const { joint, load_force: force } = run;
  if (joint || !isSteady(run)) {
    const rows = { pressure: run.pressure, counter: joint?.counter_pressure ?? null, force };
    return { pressure: run.pressure, contraction: resting(run, load, pulling, letting, rows) };
  }
  const { pressure } = pulling;
  const rows = { pressure, counter: null, force: pressure.map(() => force[0] ?? 0) };
  return { pressure, contraction: resting(run, load, pulling, letting, rows) };
}

/** @param {Phase} o @param {Palette} p @returns {import("../../../plots/chart.js").Spec} */
export function phaseSpec(o, p) {
  const { run, system, zoom } = o;
  const x = shown(run.pressure, "pressure", system), y = shown(run.contraction, "ratio", system);
  /** @type {import("../../../plots/chart.js").Trace[]} */
  const traces = [];
  for (
    const [id, color]
      of /** @type {["filling" | "venting", string][]} */ ([["filling", p.soft], ["venting", p.second]])
  ) {
    const line = restLine(o, id);
    if (!line) continue;
    traces.push({
      id,
      x: shown(line.pressure, "pressure", system),
      y: shown(line.contraction, "ratio", system),
      line: { color, dash: "dash", width: 1.5 },
      column: `static, ${id}`,
    });
  }
  const size = Math.ceil((x.length - 1) / PIECES);
  for (let k = 0; k < PIECES; k++) {
    const part = (/** @type {(number | null)[]} */ all) => all.slice(k * size, (k + 1) * size + 1);
    traces.push({
      id: `run${k}`,
      x: part(x),
      y: part(y),
      line: { color: pressureColour(k / (PIECES - 1), p), width: 2.4 },
      column: "run",
    });
  }
  const [, most] = extent([x, ...traces.map((t) => t.x)]);
  const [low, top] = extent(traces.map((t) => t.y)), high = Math.max(top, low + LEAST_PERCENT);
  const inShown = (
    /** @type {[number, number]} */ range,
    /** @type {"pressure" | "ratio"} */ quantity,
  ) => /** @type {[number, number]} */ (shown(range, quantity, system));
  const inSi = (/** @type {[number, number]} */ range, /** @type {"pressure" | "ratio"} */ quantity) => {
    const s = scaleOf(quantity, system);
    return /** @type {[number, number]} */ (range.map((v) => Number(toSi(v, s).toPrecision(6))));
  };
  return {
    x: {
      title: axisTitle("Pressure", "pressure", system),
      range: zoom ? inShown(zoom.pressure, "pressure") : steadyRange(`phase p${system}`, 0, most),
    },
    y: {
      title: axisTitle("Contraction", "ratio", system),
      range: zoom ? inShown(zoom.contraction, "ratio") : steadyRange(`phase k${system}`, low, high),
    },
    traces,
    zones: [],
    zoomed: (to) => o.zoomed(to && { pressure: inSi(to.x, "pressure"), contraction: inSi(to.y, "ratio") }),
    revision: `${system}${JSON.stringify(zoom)}`,
  };
}

/** The values of the phase plot as a table. @param {Run} run @param {System} system
 * @returns {import("../../../ui/table.js").Table} */
export function phaseTable(run, system) {
  const s = scaleOf("pressure", system);
  return {
    columns: [
      { title: "Time", unit: "s" },
      { title: "Pressure", unit: s.unit },
      { title: "Contraction", unit: "%" },
      ...STATES.map((title) => ({ title, text: true })),
    ],
    rows: run.time.map((t, i) => {
      const p = run.pressure[i], k = run.contraction[i];
      return [
        t,
        p == null ? null : toShown(p, s),
        k == null ? null : 100 * k,
        ...STATES.map((key) => Number(run[key][i])),
      ];
    }),
  };
}
