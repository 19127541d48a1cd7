// @ts-check
// The fields of a task: name, default and explanation of each. Paths are those of the request.
/** @typedef {import("../../format.js").Quantity} Quantity */
/** `unit`: of a quantity without a scale of its own; `usual`: the server's default, null: left open, which the
 * field shows as `empty`; `whole`: an integer; `bounds`: for the arrow keys.
 * @typedef {{label: string, quantity: Quantity | null, unit?: string, bounds: [number, number],
 *   usual: number | null, empty?: string, whole?: boolean, why: string}} Field */

const UPRIGHT = Math.PI / 2;

/** @type {Record<string, Field>} */
export const FIELDS = {
  "load.mass": {
    label: "Mass",
    quantity: "mass",
    bounds: [0, 200],
    usual: 0,
    why: "The mass to be moved. 0: only the other loads count.",
  },
  "load.force": {
    label: "External force",
    quantity: "force",
    bounds: [0, 2000],
    usual: 0,
    why: "Acts against the muscle, besides the weight. Default 0.",
  },
  "load.inclination": {
    label: "Inclination",
    quantity: "angle",
    bounds: [-UPRIGHT, UPRIGHT],
    usual: UPRIGHT,
    why: "Angle between the direction of motion and the horizontal. Default 90°: the load hangs.",
  },
  "load.spring": {
    label: "Spring",
    quantity: "stiffness",
    bounds: [0, 1e5],
    usual: 0,
    why: "Acts against the contraction, relaxed at the start. Default 0: no spring.",
  },
  "load.counterweight": {
    label: "Counterweight",
    quantity: "mass",
    bounds: [0, 200],
    usual: 0,
    why: "Hangs on the other side of a pulley and pulls with the muscle. Default 0: none.",
  },
  "load.lever_ratio": {
    label: "Lever ratio",
    quantity: "number",
    bounds: [0.1, 5],
    usual: 1,
    why: "Stroke of the muscle per stroke of the load. 1: no lever.",
  },
  "load.pair.angle": {
    label: "Angle",
    quantity: "angle",
    bounds: [0, Math.PI],
    usual: null,
    empty: "required",
    why: "The whole swing, from one end to the other.",
  },
  "load.pair.torque": {
    label: "Torque",
    quantity: "torque",
    bounds: [0, 50],
    usual: 0,
    why: "Acts against the first muscle over the whole swing. Default 0.",
  },
  "load.pair.inertia": {
    label: "Inertia",
    quantity: null,
    unit: "kg*m^2",
    bounds: [0, 1],
    usual: 0,
    why: "Of everything that turns. 0: the time depends on the air flow alone.",
  },
  "load.pair.pulley_radius": {
    label: "Pulley radius",
    quantity: "length",
    bounds: [0.005, 0.2],
    usual: null,
    empty: "all",
    why: "Leave empty to try eight radii from 10 to 120 mm.",
  },
  stroke: {
    label: "Stroke",
    quantity: "length",
    bounds: [0, 0.5],
    usual: null,
    empty: "required",
    why: "Travel of the load.",
  },
  time: {
    label: "Time for the stroke",
    quantity: "time",
    bounds: [0, 5],
    usual: null,
    empty: "no limit",
    why: "Longest time for the stroke. Leave empty for no limit.",
  },
  time_down: {
    label: "Time for the return",
    quantity: "time",
    bounds: [0, 5],
    usual: null,
    empty: "no limit",
    why: "Longest time for the return. Leave empty for no limit.",
  },
  cycle_time: {
    label: "Cycle time",
    quantity: "time",
    bounds: [0, 10],
    usual: null,
    empty: "no limit",
    why: "Longest time for the stroke and the return together. Leave empty for no limit.",
  },
  speed: {
    label: "Speed",
    quantity: "speed",
    bounds: [0, 5],
    usual: null,
    empty: "by time",
    why: "Average speed of the stroke, instead of its time. Leave empty to use the time.",
  },
  stiffness: {
    label: "Hold stiffness",
    quantity: "stiffness",
    bounds: [0, 1e5],
    usual: null,
    empty: "no limit",
    why:
      "Least stiffness at the end of the stroke with the valve open; with the valve closed it is higher. Leave empty for no limit.",
  },
  supply_pressure: {
    label: "Supply",
    quantity: "pressure",
    bounds: [1e5, 8e5],
    usual: 6e5,
    why: "Gauge pressure. Default 6 bar: a usual supply, and the limit of most muscles.",
  },
  ambient_temperature: {
    label: "Ambient",
    quantity: "temperature",
    bounds: [253.15, 353.15],
    usual: 293.15,
    why: "Default 20 °C.",
  },
  "limits.max_length": {
    label: "Length",
    quantity: "length",
    bounds: [0.05, 3],
    usual: 1,
    why: "Longest installed length without pressure. Default 1 m. Longer muscles exist.",
  },
  "limits.max_diameter": {
    label: "Diameter",
    quantity: "length",
    bounds: [0.01, 0.2],
    usual: null,
    empty: "no limit",
    why: "Largest outer diameter, at the end of the stroke. Leave empty for no limit.",
  },
  "limits.max_parallel": {
    label: "In parallel",
    quantity: "number",
    bounds: [1, 6],
    usual: 2,
    whole: true,
    why: "Largest number of muscles side by side. Default 2: more muscles rarely share a load evenly.",
  },
  "limits.end_fittings": {
    label: "End fittings",
    quantity: "length",
    bounds: [0, 0.3],
    usual: 0,
    why: "Length of both end fittings together. Default 0: no verified value is known, enter yours.",
  },
  "limits.max_contraction": {
    label: "Contraction",
    quantity: "ratio",
    bounds: [0.05, 0.4],
    usual: 0.2,
    why: "At the end of the stroke. Default 20 %. Makers allow 25 %, but the force is small there.",
  },
  "limits.force_reserve": {
    label: "Force reserve",
    quantity: "ratio",
    bounds: [0, 1],
    usual: 0.1,
    why:
      "Static force above the load along the whole stroke. Default 10 %: specimens differ by about that much.",
  },
  "limits.pressure_reserve": {
    label: "Pressure reserve",
    quantity: "ratio",
    bounds: [0, 0.5],
    usual: 0,
    why:
      "Share of the supply pressure that is not used. Default 0: the tolerance of the supply is entered below.",
  },
  "limits.max_impact_energy": {
    label: "Impact",
    quantity: "energy",
    bounds: [0.01, 100],
    usual: null,
    empty: "no limit",
    why:
      "Energy that the end stop can take. A drive above it is proposed behind those below it. Leave empty for no limit.",
  },
  "limits.life": {
    label: "Life",
    quantity: "number",
    bounds: [1e5, 1e7],
    usual: null,
    empty: "no limit",
    why:
      "Least number of load cycles. Leave empty for no limit. The life is an unverified estimate: makers publish no curves.",
  },
  "catalogue.tube_length": {
    label: "Tube length",
    quantity: "length",
    bounds: [0, 5],
    usual: 1,
    why: "From the valve to each muscle. Default 1 m. 0: no tube.",
  },
  "uncertainty.blocked_force": {
    label: "Force spread",
    quantity: "ratio",
    bounds: [0, 0.5],
    usual: 0.1,
    why:
      "Two standard deviations between specimens. Default 10 %: published curves of one size differ by that much.",
  },
  "uncertainty.supply_pressure": {
    label: "Supply tolerance",
    quantity: "ratio",
    bounds: [0, 0.3],
    usual: 0.03,
    why: "Largest deviation. Default 3 %: a usual pressure regulator.",
  },
  "uncertainty.hysteresis": {
    label: "Hysteresis",
    quantity: "ratio",
    bounds: [0, 0.1],
    usual: null,
    empty: "catalogue",
    why:
      "Largest width of the loop as a share of the nominal length. Leave empty for the value of the catalogue.",
  },
  "operation.cycles_per_year": {
    label: "Cycles per year",
    quantity: "number",
    bounds: [1e3, 1e8],
    usual: 1e6,
    why: "For the cost of the air. Default one million.",
  },
  "operation.air_price": {
    label: "Price per m³ of air",
    quantity: "number",
    bounds: [0, 0.1],
    usual: 0.025,
    why: "Per cubic metre at ANR. Default 0.025 euro, not verified; the usual range is 0.01 to 0.03.",
  },
  "uncertainty.specimens": {
    label: "Specimens",
    quantity: "number",
    bounds: [0, 1000],
    usual: 100,
    whole: true,
    why: "Simulated for each proposal. Default 100: the probability is then within 5 %. 0: none.",
  },
  max_proposals: {
    label: "Proposals",
    quantity: "number",
    bounds: [1, 30],
    usual: 10,
    whole: true,
    why: "Largest number of proposals. Default 10.",
  },
};

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
export const RANKING_WHY =
  "Balanced: air consumption times the square root of length and number of muscles, because air is a running " +
  "cost and space is not. Drives that probably fail come last in any order.";
