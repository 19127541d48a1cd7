// @ts-check
// Drive documents: supply, valve, tube, load, command or controller of a muscle, as scenarios, files and the
// server have them. Pure functions; the server checks what the numbers mean.
import { figure } from "../facts.js";
import { scaleOf, toShown } from "../format.js";
import { at, isObject } from "../paths.js";
import { ATMOSPHERE, siNumber } from "../quantities.js";

/** @typedef {import("../types.js").Drive} Drive */
/** @typedef {import("../types.js").DriveArrangement} Arrangement */
/** @typedef {import("../types.js").Transient} Transient */

/** @returns {Drive} an example: a weight is lifted and lowered once */
export const defaultDrive = () => ({
  supply: { pressure: 5.5e5 },
  valve: { preset: "MPYE-5-1/8-HF" },
  tube: { preset: "PUN-H-4x0.75", length: 1 },
  load: { mass: 50, arrangement: "hanging" },
  command: { shape: "pulse", on: 0, off: 1 },
  controller: {
    type: "pid",
    kp: 2,
    ki: 10,
    kd: 0.01,
    reference: { shape: "triangle", amplitude: 0.02, period: 1 },
  },
  stops: { max_contraction: 0.12 },
  duration: 2,
});

/** Gains without a unit are in the unit in which they are shown, percent of full command per millimetre. */
const GAINS = new Set(["kp", "ki", "kd", "feed_forward"]);
/** A gain as a document states it. @param {string} key of the controller @param {number} si */
export const statedGain = (key, si) => toShown(si, scaleOf(figure(`controller.${key}`).quantity, "bar"));
/** Texts that are names, not quantities. */
const NAMES = new Set([
  "shape",
  "preset",
  "arrangement",
  "meter",
  "valves",
  "type",
  "interpolation",
  "reached",
  "title",
  "curve_fit",
]);

/** SI units of the fields of drives and tasks, by their path; a text that does not fit stays for the server, which
 * says what is wrong with it. @type {Record<string, string>} */
const UNITS = {
  "supply.pressure": "Pa",
  "regulator.range": "Pa",
  "regulator.time": "s",
  "regulator.damping": "1",
  "regulator.band": "Pa",
  "regulator.dead_band": "Pa",
  start_pressure: "Pa",
  supply_pressure: "Pa",
  "start.position": "m",
  "valve.sonic_conductance": "m^3/(s*Pa)",
  "valve.exhaust_conductance": "m^3/(s*Pa)",
  "valve.critical_pressure_ratio": "1",
  "valve.exhaust_critical_pressure_ratio": "1",
  "valve.nominal_flow": "m^3/s",
  "pwm.frequency": "Hz",
  "pwm.min_on": "s",
  "pwm.min_off": "s",
  "flow_control.sonic_conductance": "m^3/(s*Pa)",
  "flow_control.free_conductance": "m^3/(s*Pa)",
  "flow_control.critical_pressure_ratio": "1",
  "quick_exhaust.sonic_conductance": "m^3/(s*Pa)",
  "quick_exhaust.critical_pressure_ratio": "1",
  "quick_exhaust.band": "Pa",
  "tube.inside_diameter": "m",
  "tube.length": "m",
  "load.mass": "kg",
  "load.force": "N",
  "load.inclination": "rad",
  "load.spring": "N/m",
  "load.lever_ratio": "1",
  "load.pulley_radius": "m",
  "load.precontraction": "1",
  "gas.polytropic_exponent": "1",
  "gas.wall_heat_transfer": "W/(m^2*K)",
  "gas.temperature": "K",
  "gas.ambient_pressure": "Pa",
  "gas.dead_volume": "m^3",
  "stops.min_contraction": "1",
  "stops.max_contraction": "1",
  "stops.restitution": "1",
  duration: "s",
  "muscle.nominal_length": "m",
  "muscle.braid_diameter": "m",
  "muscle.braid_angle": "rad",
  "muscle.thread_length": "m",
  "muscle.turns": "1",
  "muscle.inside_diameter": "m",
  "muscle.wall_thickness": "m",
};
const ABSOLUTE = "gas.ambient_pressure";

/** How a text at a path is read: its unit, and what a pressure is counted from. An ambient pressure that is a gauge
 * one is so relative to the standard atmosphere.
 * @param {Drive} document @param {string} path @returns {import("../quantities.js").Counted & {unit?: string}} */
export function countedAt(document, path) {
  const unit = UNITS[path];
  if (unit !== "Pa") return unit ? { unit } : {};
  if (path === ABSOLUTE) return { unit, reference: "absolute" };
  const ambient = siNumber(at(document, ABSOLUTE), countedAt(document, ABSOLUTE));
  return { unit, reference: "gauge", ambient: ambient ?? ATMOSPHERE };
}

/** A document or a part of one with every quantity such as "6 bar" as a number in SI; what cannot be read stays for
 * the server. @param {any} document @returns {any} */
export const inSi = (document) => converted(document, "", document);

/** @param {any} part @param {string} path @param {any} whole @returns {any} */
function converted(part, path, whole) {
  const key = path.slice(path.lastIndexOf(".") + 1);
  if (NAMES.has(key) || key === "fittings") return part;
  if (isObject(part)) {
    if (Array.isArray(part.values) && typeof part.unit === "string") {
      return part.values.map((/** @type {unknown} */ v) => siNumber(`${v} ${part.unit}`) ?? v);
    }
    return fieldsOfSignal(Object.fromEntries(
      Object.entries(part).map((
        [name, value],
      ) => [name, converted(value, path ? `${path}.${name}` : name, whole)]),
    ));
  }
  if (Array.isArray(part)) return part.map((value) => converted(value, path, whole));
  if (typeof part !== "string") return part;
  const si = siNumber(part, countedAt(whole, path));
  if (si === null) return part;
  const ofPosition = GAINS.has(key) && !path.includes(".stiffness.");
  return ofPosition && /[a-z%]/i.test(part) ? statedGain(key, si) : si;
}

/** A signal by the fields of this page, where a document may say the same by others: the period of a sine, the
 * amplitude of a square. Any other object stays as it is. @param {any} part @returns {any} */
function fieldsOfSignal(part) {
  const { period, amplitude, ...rest } = part;
  if (part.shape === "sine" && period > 0 && part.frequency === undefined) {
    return { ...rest, ...(amplitude === undefined ? {} : { amplitude }), frequency: 1 / period };
  }
  if (part.shape !== "square" || typeof amplitude !== "number") return part;
  const square = { ...rest, ...(period === undefined ? {} : { period }) };
  if (typeof part.initial === "number") return { ...square, level: part.initial + amplitude };
  return typeof part.level === "number" ? { ...square, initial: part.level - amplitude } : part;
}

/** Levels of a drive: the table of the path of a muscle of a joint is the deepest. */
const MOST_DEPTH = 10;

/** Only numbers, texts, lists and objects, not nested deeply.
 * @param {unknown} x @param {number} [depth] @returns {boolean} */
function isPlain(x, depth = 0) {
  if (x === null || typeof x === "boolean" || typeof x === "string") return true;
  if (typeof x === "number") return Number.isFinite(x);
  if (depth > MOST_DEPTH || typeof x !== "object") return false;
  return Object.values(x).every((/** @type {unknown} */ one) => isPlain(one, depth + 1));
}

/** @param {unknown} raw @returns {raw is Drive} */
export const isDrive = (raw) => isObject(raw) && isPlain(raw);

/** Whether this is a drive document, as opposed to a document of this page.
 * @param {unknown} raw @returns {raw is Drive} */
export const isDriveDocument = (raw) =>
  isObject(raw) && !("design" in raw) && (isObject(raw.muscle) || typeof raw.muscle === "string") &&
  isDrive(raw);

/** @param {string} text */
const named = (text) => ({ preset: text });
/** What a text stands for in a document, as `documents/shorthand.py` has it.
 * @type {Record<string, (text: string) => object>} */
const SHORT = {
  muscle: (text) => {
    const [preset, length] = text.split(":").map((part) => part.trim());
    return length ? { preset, nominal_length: length } : { preset };
  },
  valve: named,
  tube: named,
  supply: (text) => ({ pressure: text }),
  load: (text) => (/(N|lbf)$/.test(text.trim()) ? { force: text } : { mass: text }),
};

/** The document with its shorthands written out. @param {Drive} document @returns {Drive} */
const longForm = (document) =>
  Object.fromEntries(
    Object.entries(document).map(([key, part]) =>
      typeof part === "string" && key in SHORT ? [key, SHORT[key](part)] : [key, part]
    ),
  );

const UPRIGHT = Math.PI / 2, TILTED = Math.PI / 6, LEVER = 2, PULLEY = 0.03;
/** The inclination of the load in each arrangement, unless the document gives it.
 * @type {Record<Arrangement, number>} */
const INCLINED = {
  hanging: UPRIGHT,
  inclined: UPRIGHT,
  horizontal: 0,
  lever: UPRIGHT,
  antagonist: 0,
  joint: 0,
};
const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) < 1e-3;

/** The arrangement of the load, from its numbers if the document does not name it. @param {Drive | undefined} load
 * @returns {Arrangement} */
export function arrangementOf(load) {
  if (load?.arrangement) return load.arrangement;
  const angle = siNumber(load?.inclination) ?? UPRIGHT, ratio = siNumber(load?.lever_ratio);
  if (ratio !== null && ratio !== 1) return "lever";
  return near(angle, UPRIGHT) ? "hanging" : near(angle, 0) ? "horizontal" : "inclined";
}

/** The load with the name of its arrangement, so that moving a slider does not change the arrangement.
 * @param {Drive} load */
export function withArrangement(load) {
  const arrangement = arrangementOf(load), { inclination, ...rest } = load;
  const fixed = arrangement === "hanging" || arrangement === "horizontal";
  const isUsual = fixed && near(siNumber(inclination) ?? INCLINED[arrangement], INCLINED[arrangement]);
  return isUsual ? { ...rest, arrangement } : { ...load, arrangement };
}

/** The same load in another arrangement, with the fields that arrangement needs and without others.
 * @param {Drive} load @param {Arrangement} next @param {number} middle contraction in the middle between the stops
 * @returns {Drive} */
export function rearranged(load, next, middle) {
  const { pulley_radius: _r, precontraction: _e, lever_ratio: ratio, inclination, joint, ...rest } = load;
  const angle = siNumber(inclination);
  const tilted = angle === null || near(angle, 0) || near(angle, UPRIGHT) ? TILTED : angle;
  /** @type {Record<Arrangement, object>} */
  const fields = {
    hanging: {},
    horizontal: {},
    inclined: { inclination: tilted },
    lever: { lever_ratio: ratio ?? LEVER, ...(inclination === undefined ? {} : { inclination }) },
    antagonist: { pulley_radius: PULLEY, precontraction: middle },
    joint: { joint },
  };
  return { ...rest, arrangement: next, ...fields[next] };
}

const GEOMETRY = [
  "nominal_length",
  "braid_diameter",
  "braid_angle",
  "thread_length",
  "turns",
  "inside_diameter",
  "wall_thickness",
];

/** A muscle as documents state it, in SI, as the page edits it.
 * @param {Drive} muscle @returns {import("../types.js").Muscle} @throws {Error} names what cannot be read */
export function muscleParts({ preset = null, rhombus, ...geometry }) {
  const values = Object.fromEntries(
    [...Object.entries(geometry), ...Object.entries(rhombus ?? {})].filter(([, v]) => typeof v === "number"),
  );
  const unknown = Object.keys(geometry).filter((key) => !(key in values) || !GEOMETRY.includes(key));
  if (unknown.length) throw new Error(`“muscle.${unknown[0]}” cannot be read`);
  return {
    preset,
    form: rhombus ? "rhombus" : "turns" in values || "thread_length" in values ? "thread" : "braid",
    values,
  };
}

/** A drive document in parts: muscle and effects for the design, the rest for the Transient view.
 * @param {Drive} document @param {string | null} scenario
 * @returns {{muscle: import("../types.js").Muscle, effects: Record<string, Record<string, number>> | null,
 *   transient: Partial<Transient>}} @throws {Error} */
export function partsOfDrive(document, scenario) {
  const { schema: _schema, kind: _kind, muscle, effects, ...rest } = inSi(longForm(document));
  if (!isObject(muscle)) throw new Error("“muscle” is missing");
  if (isObject(rest.load)) rest.load = withArrangement(rest.load);
  const start = defaultDrive();
  return {
    muscle: muscleParts(muscle),
    effects: effects ?? null,
    transient: {
      drive: { command: start.command, controller: start.controller, ...rest },
      mode: rest.controller ? "controller" : "command",
      scenario,
      window: null,
      phase: null,
    },
  };
}

/** The complete drive document, as the server and the command line read it.
 * @param {Transient} t @param {object} muscle @param {object | null} effects @returns {Drive} */
export function driveDocument(t, muscle, effects) {
  const { command, controller, ...rest } = t.drive;
  const driven = t.mode === "controller" ? { controller } : { command };
  return { schema: 1, muscle, ...(effects ? { effects } : {}), ...rest, ...driven };
}
