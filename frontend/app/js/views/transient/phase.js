// @ts-check
// The phase plot: contraction over pressure, the run coloured by time, on the static map of both directions.
import { scaleOf, toShown } from "../../format.js";
import { axisTitle, extent, shown, steadyRange } from "../design/axes.js";
import { pressureColour } from "../../plots/theme.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {import("../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../format.js").System} System */
/** Force against the pull [N], spring [N/m] and lever ratio at rest.
 * @typedef {{resisting: number, spring: number, ratio: number}} Load */

const PIECES = 14;

/** The contraction at which the muscle holds the load at each pressure, between the stops.
 * Balance of the load at rest: i² F = i W + k s.
 * @param {Curves} curves @param {Load} load @param {[number, number]} stops as contractions
 * @returns {(number | null)[]} per pressure */
export function holding(curves, { resisting, spring, ratio }, [low, high]) {
  const rest = curves.geometry.nominal_length;
  const needed = (/** @type {number} */ k) => resisting / ratio + (spring * k * rest) / ratio ** 2;
  return curves.force.map((row) => {
    for (let i = row.length - 1; i >= 0; i--) {
      const k = curves.contraction[i], spare = (row[i] ?? 0) - needed(k);
      if (spare < 0) continue;
      if (k >= high || i === row.length - 1) return Math.min(high, Math.max(low, k));
      const next = curves.contraction[i + 1], short = needed(next) - (row[i + 1] ?? 0);
      return Math.min(high, Math.max(low, k + ((next - k) * spare) / (spare + short || 1)));
    }
    return low;
  });
}

/** @param {Run} run @param {{filling: Curves, venting: Curves} | null} statics @param {Load} load
 * @param {System} system @param {Palette} p @returns {import("../../plots/chart.js").Spec} */
export function phaseSpec(run, statics, load, system, p) {
  const rest = run.geometry.nominal_length;
  /** @type {[number, number]} */
  const stops = [run.limits.position_min * load.ratio / rest, run.limits.position_max * load.ratio / rest];
  const x = shown(run.pressure, "pressure", system), y = shown(run.contraction, "ratio", system);
  /** @type {import("../../plots/chart.js").Trace[]} */
  const traces = [];
  for (
    const [id, color]
      of /** @type {["filling" | "venting", string][]} */ ([["filling", p.soft], ["venting", p.second]])
  ) {
    const curves = statics?.[id];
    if (!curves) continue;
    traces.push({
      id,
      x: shown([0, ...curves.pressure], "pressure", system),
      y: shown([stops[0], ...holding(curves, load, stops)], "ratio", system),
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
  const [, most] = extent([x, ...traces.slice(0, statics ? 2 : 0).map((t) => t.x)]);
  const [low, high] = extent(traces.map((t) => t.y));
  return {
    x: { title: axisTitle("Pressure", "pressure", system), range: steadyRange(`phase p${system}`, 0, most) },
    y: {
      title: axisTitle("Contraction", "ratio", system),
      range: steadyRange(`phase k${system}`, low, high),
    },
    traces,
    zones: [],
    revision: system,
  };
}

/** The run in the plane of the plot as a table. @param {Run} run @param {System} system
 * @returns {import("../../ui/table.js").Table} */
export function phaseTable(run, system) {
  const s = scaleOf("pressure", system);
  return {
    columns: [{ title: "Time", unit: "s" }, { title: "Pressure", unit: s.unit }, {
      title: "Contraction",
      unit: "%",
    }],
    rows: run.time.map((t, i) => {
      const p = run.pressure[i], k = run.contraction[i];
      return [t, p == null ? null : toShown(p, s), k == null ? null : 100 * k];
    }),
  };
}
