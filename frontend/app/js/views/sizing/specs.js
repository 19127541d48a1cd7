// @ts-check
// The fields of a task: what the server declares of each, and how it is entered. Paths are those of the request.
import { figure } from "../../facts.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** `bounds`: for the arrow keys; `empty`: shown in a field that is left open; `whole`: an integer.
 * @typedef {{bounds: [number, number], empty?: string, whole?: boolean}} Entry */

const UPRIGHT = Math.PI / 2;

/** @type {Record<string, Entry>} */
const ENTRIES = {
  "load.mass": { bounds: [0, 200] },
  "load.force": { bounds: [0, 2000] },
  "load.inclination": { bounds: [-UPRIGHT, UPRIGHT] },
  "load.spring": { bounds: [0, 1e5] },
  "load.counterweight": { bounds: [0, 200] },
  "load.lever_ratio": { bounds: [0.1, 5] },
  "load.pair.angle": { bounds: [0, Math.PI], empty: "required" },
  "load.pair.torque": { bounds: [0, 50] },
  "load.pair.inertia": { bounds: [0, 1] },
  "load.pair.pulley_radius": { bounds: [0.005, 0.2], empty: "all" },
  stroke: { bounds: [0, 0.5], empty: "required" },
  time: { bounds: [0, 5], empty: "no limit" },
  time_down: { bounds: [0, 5], empty: "no limit" },
  cycle_time: { bounds: [0, 10], empty: "no limit" },
  speed: { bounds: [0, 5], empty: "by time" },
  stiffness: { bounds: [0, 1e5], empty: "no limit" },
  supply_pressure: { bounds: [1e5, 8e5] },
  ambient_temperature: { bounds: [253.15, 353.15] },
  "limits.max_length": { bounds: [0.05, 3] },
  "limits.max_diameter": { bounds: [0.01, 0.2], empty: "no limit" },
  "limits.max_parallel": { bounds: [1, 6], whole: true },
  "limits.end_fittings": { bounds: [0, 0.3] },
  "limits.max_contraction": { bounds: [0.05, 0.4] },
  "limits.force_reserve": { bounds: [0, 1] },
  "limits.pressure_reserve": { bounds: [0, 0.5] },
  "limits.max_impact_energy": { bounds: [0.01, 100], empty: "no limit" },
  "limits.life": { bounds: [1e5, 1e7], empty: "no limit" },
  "catalogue.tube_length": { bounds: [0, 5] },
  "uncertainty.blocked_force": { bounds: [0, 0.5] },
  "uncertainty.supply_pressure": { bounds: [0, 0.3] },
  "uncertainty.hysteresis": { bounds: [0, 0.1], empty: "catalogue" },
  "operation.cycles_per_year": { bounds: [1e3, 1e8] },
  "operation.air_price": { bounds: [0, 0.1] },
  "uncertainty.specimens": { bounds: [0, 1000], whole: true },
  max_proposals: { bounds: [1, 30], whole: true },
};

/** A field of the task: its figure, with the default of the server, and how it is entered. @param {string} path */
export function fieldOf(path) {
  const { quantity, ...declared } = figure(`task.${path}`);
  return { ...declared, quantity: /** @type {Quantity | null} */ (quantity), ...ENTRIES[path] };
}
/** @param {string} path */
export const isNumber = (path) => path in ENTRIES;

/** @type {[string, string][]} */
export const RANKINGS = [
  ["balanced", "balanced"],
  ["air", "least air"],
  ["time", "fastest"],
  ["length", "shortest"],
  ["reserve", "largest force reserve"],
  ["probability", "most probable"],
];
export const USUAL_RANKING = "balanced";
