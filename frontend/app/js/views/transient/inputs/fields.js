// @ts-check
// Fields of the drive by their path in the drive document: name, quantity and default of each.
import { h } from "../../../dom.js";
import { figure as declared } from "../../../facts.js";
import { units } from "../../../state.js";
import { number, scaleOf, siOf, toShown } from "../../../format.js";
import { quantityField, subscript } from "../../../ui/field.js";
import { at } from "../../../paths.js";
import { countedAt } from "../../../drive/document.js";
import { siNumber } from "../../../quantities.js";
import {
  arrangement,
  baseDrive,
  drive,
  messageFor,
  numberAt,
  partPreset,
  regulated,
  run,
  setDrive,
} from "../model.js";
import { middleOf } from "../series.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** `usual`: the default in SI; `empty`: what an empty field shows, where no value is a choice too.
 * @typedef {{label: string, symbol?: string, quantity: Quantity, unit?: string,
 *   bounds: [number, number] | (() => [number, number]), log?: boolean,
 *   usual?: number | (() => number | null | undefined), hint?: string, slider?: boolean,
 *   empty?: string}} Spec */

const DEG = Math.PI / 180;

/** A gain of the position controller, in the unit of a plain number in a document.
 * @param {string} name @param {[number, number]} bounds @param {number} [usual] @returns {Spec} */
function gain(name, bounds, usual) {
  const { label, symbol, quantity } = declared(`controller.${name}`);
  const { unit } = scaleOf(quantity, "bar");
  return { label, symbol, quantity: "number", log: false, unit, bounds, usual };
}

/** A value of the preset of valve or tube.
 * @param {"valves" | "tubes"} kind @param {string} path @param {string} key */
const figure = (kind, path, key) => () => {
  const q = partPreset(kind, path)?.data?.[key];
  return q ? siNumber(`${q.value} ${q.unit}`) ?? siOf(q) : null;
};
const valve = (/** @type {string} */ key) => figure("valves", "valve.preset", key);
const tube = (/** @type {string} */ key) => figure("tubes", "tube.preset", key);
const lowest = () => regulated.value ? 0 : -1;

/** Slider ranges cover usual values; the field accepts any value the server accepts.
 * @type {Record<string, Spec>} */
export const SPECS = {
  "supply.pressure": { label: "Supply pressure", symbol: "p_s", quantity: "pressure", bounds: [1e5, 8e5] },
  "valve.sonic_conductance": {
    label: "Conductance, filling",
    symbol: "C",
    quantity: "conductance",
    bounds: [1e-10, 1e-7],
    log: true,
    usual: valve("sonic_conductance"),
  },
  "valve.exhaust_conductance": {
    label: "Conductance, venting",
    symbol: "C_e",
    quantity: "conductance",
    bounds: [1e-10, 1e-7],
    log: true,
    // A conductance the user entered holds in both directions.
    usual: () =>
      numberAt("valve.sonic_conductance") ?? valve("exhaust_conductance")() ?? valve("sonic_conductance")(),
  },
  "valve.critical_pressure_ratio": {
    label: "Critical ratio",
    symbol: "b",
    quantity: "number",
    bounds: [0.05, 0.6],
    usual: () => valve("critical_pressure_ratio")() ?? 0.3,
  },
  "regulator.range": {
    label: "Regulator range",
    quantity: "pressure",
    bounds: [1e5, 1e6],
    usual: regulatorFigure("range"),
  },
  "regulator.time": {
    label: "Regulator time constant",
    quantity: "lapse",
    bounds: [1e-3, 0.5],
    log: true,
    usual: regulatorFigure("time"),
  },
  "regulator.damping": {
    label: "Damping of second order",
    quantity: "number",
    bounds: [0.1, 2],
    empty: "first order",
  },
  "regulator.band": {
    label: "Error at full opening",
    quantity: "pressure",
    bounds: [1e3, 1e5],
    log: true,
    usual: () => regulatorFigure("band")() ?? 0.05 * (numberAt("regulator.range") ?? 6e5),
  },
  "regulator.dead_band": {
    label: "Dead band",
    quantity: "pressure",
    bounds: [0, 2e4],
    usual: () => regulatorFigure("dead_band")() ?? 0,
  },
  "tube.inside_diameter": {
    label: "Tube inside diameter",
    symbol: "d",
    quantity: "length",
    bounds: [1e-3, 0.02],
    log: true,
    usual: tube("inside_diameter"),
  },
  "tube.length": {
    label: "Tube length",
    symbol: "l",
    quantity: "length",
    bounds: [0.05, 20],
    log: true,
    usual: tube("reference_length"),
  },
  "load.mass": { label: "Mass", symbol: "m", quantity: "mass", bounds: [0, 200], usual: 0 },
  "load.inclination": {
    label: "Inclination",
    symbol: "α",
    quantity: "angle",
    bounds: [-90 * DEG, 90 * DEG],
    usual: () => arrangement.value === "antagonist" ? 0 : 90 * DEG,
    hint: "90°: vertical, 0°: horizontal.",
  },
  "load.force": { label: "External force", symbol: "F_e", quantity: "force", bounds: [0, 2000], usual: 0 },
  "load.spring": { label: "Spring", symbol: "k", quantity: "stiffness", bounds: [0, 2e4], usual: 0 },
  "load.lever_ratio": {
    label: "Lever ratio",
    symbol: "i",
    quantity: "number",
    bounds: [0.1, 10],
    log: true,
    usual: 1,
    hint: "Stroke of the muscle per stroke of the load.",
  },
  "load.pulley_radius": {
    label: "Pulley radius",
    symbol: "r",
    quantity: "length",
    bounds: [5e-3, 0.2],
    log: true,
  },
  "load.precontraction": {
    label: "Precontraction",
    symbol: "ε_m",
    quantity: "ratio",
    bounds: [0.01, 0.25],
    usual: 0.1,
    hint: "Contraction of both muscles at 0°.",
  },
  "stops.min_contraction": {
    label: "Lower stop",
    symbol: "ε_0",
    quantity: "ratio",
    bounds: [-0.03, 0.2],
    usual: 0,
    hint: "A hanging load rests here without pressure.",
  },
  "stops.max_contraction": {
    label: "Upper stop",
    symbol: "ε_1",
    quantity: "ratio",
    bounds: [0.02, 0.35],
    usual: () => {
      const r = run.value, ratio = numberAt("load.lever_ratio") ?? 1;
      return r && middleOf(r) + (r.limits.position_max * ratio) / r.geometry.nominal_length;
    },
  },
  "stops.restitution": {
    label: "Rebound",
    symbol: "e",
    quantity: "number",
    bounds: [0, 0.9],
    usual: 0,
    hint: "Share of the impact speed with which the load rebounds. 0: it stays there.",
  },
  "start.position": {
    label: "Start position",
    symbol: "x_0",
    quantity: "length",
    bounds: () => {
      const limits = run.value?.limits;
      return limits ? [limits.position_min, limits.position_max] : [0, 0.1];
    },
    slider: false,
    empty: "at rest",
    hint: "Of the load, positive when shortening. Empty: where it rests at the initial pressure.",
  },
  "gas.wall_heat_transfer": {
    label: "Heat transfer to the wall",
    symbol: "h",
    quantity: "number",
    unit: "W/(m²·K)",
    bounds: [0, 1000],
    usual: 100,
    hint: "Not verified: 20 to 60 at rest, several hundred during a fast fill. 0: adiabatic.",
  },
  "gas.polytropic_exponent": {
    label: "Polytropic exponent",
    symbol: "n",
    quantity: "number",
    bounds: [1, 1.4],
    usual: 1.2,
    hint: "1 isothermal, 1.4 adiabatic. The mass of the air is then not conserved.",
  },
  "gas.temperature": {
    label: declared("task.ambient_temperature").label,
    symbol: "T",
    quantity: "temperature",
    bounds: [253.15, 353.15],
    usual: 293.15,
  },
  "gas.dead_volume": { label: "Dead volume", symbol: "V_d", quantity: "volume", bounds: [0, 5e-4], usual: 0 },
  "gas.ambient_pressure": {
    label: "Ambient pressure",
    symbol: "p_a",
    quantity: "pressure",
    bounds: [5e4, 1.1e5],
    usual: 101325,
  },
  start_pressure: { label: "Initial pressure", quantity: "pressure", bounds: [0, 8e5], usual: 0 },
  duration: { label: "Duration", symbol: "T", quantity: "time", bounds: [0.1, 20], log: true, usual: 4 },
  "controller.kp": gain("kp", [0, 20]),
  "controller.ki": gain("ki", [0, 100], 0),
  "controller.kd": gain("kd", [0, 1], 0),
  "controller.feed_forward": gain("feed_forward", [0, 5], 0),
  "controller.angle": { label: "Angle", symbol: "φ", quantity: "angle", bounds: [-0.5, 0.5], usual: 0 },
  "controller.stiffness.reference": {
    label: "Stiffness",
    symbol: "k",
    quantity: "rotary",
    bounds: [0, 100],
    usual: 20,
  },
  "controller.stiffness.kp": {
    label: "Gain P of the stiffness",
    quantity: "number",
    bounds: [0, 10],
    usual: () => regulated.value ? 0 : 2,
    hint: "Command per missing mean pressure, both as shares of full scale.",
  },
  "controller.stiffness.ki": {
    label: "Gain I of the stiffness",
    quantity: "number",
    unit: "1/s",
    bounds: [0, 20],
    usual: () => regulated.value ? 0.5 : 0,
  },
  "controller.derivative_filter": {
    label: "Derivative filter",
    quantity: "lapse",
    bounds: [0, 0.1],
    usual: 5e-3,
  },
  "controller.sample_time": {
    label: "Sample time",
    quantity: "lapse",
    bounds: [5e-4, 0.02],
    log: true,
    usual: 1e-3,
  },
  "controller.output_min": { label: "Lowest command", quantity: "ratio", bounds: [-1, 1], usual: lowest },
  "controller.output_max": { label: "Highest command", quantity: "ratio", bounds: [-1, 1], usual: 1 },
};

/** @param {"range" | "time" | "damping" | "band" | "dead_band"} key */
function regulatorFigure(key) {
  return () => {
    const q = /** @type {any} */ (partPreset("valves", "valve.preset"))?.regulator?.[key];
    return q ? siNumber(`${q.value} ${q.unit}`) : null;
  };
}

/** @param {Spec} spec @param {string} path */
function usualOf(spec, path) {
  const base = siNumber(at(baseDrive.value, path), countedAt(baseDrive.value, path));
  if (base !== null) return base;
  return (typeof spec.usual === "function" ? spec.usual() : spec.usual) ?? null;
}

/** @param {string} path @param {Spec} [spec] */
export function driveField(path, spec = SPECS[path]) {
  const label = spec.label.toLowerCase();
  // No value is a value of its own where the field may be empty, whatever the scenario says.
  const value = () => numberAt(path) ?? (spec.empty ? null : usualOf(spec, path));
  const { bounds, empty } = spec;
  const scale = () =>
    spec.unit ? { unit: spec.unit, factor: 1, digits: 4 } : scaleOf(spec.quantity, units.value);
  /** @param {import("../../../types.js").Drive} d */
  const inWords = (d) => {
    const si = siNumber(at(d, path), countedAt(d, path)) ?? usualOf(spec, path), s = scale();
    return si === null ? empty ?? "–" : `${number(toShown(si, s), s.digits)}\u00a0${s.unit}`.trim();
  };
  return quantityField({
    key: path,
    label: spec.label,
    symbol: spec.symbol ? subscript(spec.symbol) : undefined,
    quantity: spec.quantity,
    log: spec.log,
    hint: spec.hint,
    slider: spec.slider,
    scale,
    bounds: typeof bounds === "function" ? bounds : () => bounds,
    counted: () => countedAt(drive.peek(), path),
    empty,
    clear: empty ? () => setDrive(path, undefined, `${label} ${empty}`) : undefined,
    get: value,
    put: (si, done) => setDrive(path, si, label, done, inWords),
    changed: () => {
      const set = numberAt(path), usual = usualOf(spec, path);
      if (empty && (set === null || usual === null)) return set !== usual;
      return set !== null && usual !== null &&
        Math.abs(set - usual) > 1e-6 * Math.max(Math.abs(set), Math.abs(usual));
    },
    reset: () => setDrive(path, at(baseDrive.peek(), path), `reset ${label}`),
    message: () => messageFor(path),
  });
}

/** The message about a part of the drive as a whole. @param {string} path */
export const partMessage = (path) => h("p", { class: "error" }, () => messageFor(path) ?? "");

/** A field that is a choice from a list. @template {string} T
 * @param {string} label @param {() => [T, string][]} options @param {() => T} get
 * @param {(value: T) => void} set
 * @param {string} key */
export function choiceField(label, options, get, set, key) {
  const id = `c-${key.replace(/\W/g, "-")}`;
  return h(
    "div",
    { class: "field choice", "data-field": key },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: id }, label),
      h("select", {
        id,
        onchange: (/** @type {Event} */ e) =>
          set(/** @type {T} */ (/** @type {HTMLSelectElement} */ (e.target).value)),
      }, () => options().map(([value, text]) => h("option", { value, selected: value === get() }, text))),
    ),
    h("p", { class: "error" }, () => messageFor(key) ?? ""),
  );
}
