// @ts-check
// The phase plot: contraction over pressure, the run coloured by time, and the static equilibrium.
import { scaleOf, toShown, toSi } from "../../../format.js";
import { axisTitle, extent, shown, steadyRange } from "../../../plots/axes.js";
import { pressureColour } from "../../../plots/theme.js";
import { STATES } from "./specs.js";

/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {import("../../../types.js").Zoom} Zoom */
/** @typedef {{run: Run, system: System, zoom: Zoom | null, zoomed: (zoom: Zoom | null) => void}} Phase */

const PIECES = 14, LEAST_PERCENT = 2;

/** Whether the external force is constant. @param {Run} run */
export function isSteady({ load_force: force }) {
  const [low, high] = extent([force]);
  return high - low <= 1e-9 * Math.max(1, Math.abs(high));
}

/** The dashed lines: along the pressures if the external force is constant, else along the time of the run.
 * @param {Run} run @param {(number | null)[]} contraction */
function restLine(run, contraction) {
  const rows = [...run.pressure.keys()].filter((i) => run.pressure[i] !== null);
  if (!run.joint && isSteady(run)) rows.sort((a, b) => Number(run.pressure[a]) - Number(run.pressure[b]));
  return { pressure: rows.map((i) => run.pressure[i]), contraction: rows.map((i) => contraction[i] ?? null) };
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
    const line = restLine(run, run[`static_${id}`] ?? []);
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
