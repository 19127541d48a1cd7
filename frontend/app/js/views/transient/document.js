// @ts-check
// The Transient view's part of the document: the drive as a drive document has it, without the muscle and its
// effects, which belong to the Design view. Pure functions; the server checks what the numbers mean.
import { siNumber } from "../../quantities.js";

/** @typedef {string | number | boolean | null} Leaf */
/** Supply, valve, tube, load, command, controller, …; numbers in SI. @typedef {Record<string, any>} Drive */
/** @typedef {{name: string, drive: Drive}} Pin  a whole drive document, muscle and effects included */
/** @typedef {"flow" | "force" | "valve"} Lower */
/** @typedef {{drive: Drive, mode: "command" | "controller", scenario: string | null, lower: Lower,
 *   window: [number, number] | null, phase: Zoom | null, pins: Pin[], differing: boolean,
 *   measurement: {id: string, name: string} | null}} Transient */
/** What the phase plot shows when it is zoomed.
 * @typedef {{pressure: [number, number], contraction: [number, number]}} Zoom */
/** @typedef {"hanging" | "inclined" | "horizontal" | "lever" | "antagonist"} Arrangement */

export const MOST_PINS = 4;

/** @returns {Drive} a weight lifted and let down once */
const defaultDrive = () => ({
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
  gas: { polytropic_exponent: 1.2 },
  duration: 2,
});

/** @returns {Transient} */
export const defaultTransient = () => ({
  drive: defaultDrive(),
  mode: "command",
  scenario: null,
  lower: "flow",
  window: null,
  phase: null,
  pins: [],
  differing: false,
  measurement: null,
});

/** @param {unknown} x @returns {x is Record<string, any>} */
const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);

/** @param {Drive} drive @param {string} path "load.mass" @returns {any} */
export const at = (drive, path) =>
  path.split(".").reduce((part, key) => (isObject(part) ? part[key] : undefined), /** @type {any} */ (drive));

/** The drive with one value replaced; undefined takes it out. @param {Drive} drive @param {string} path
 * @param {unknown} value @returns {Drive} */
export function put(drive, path, value) {
  const [key, ...rest] = path.split(".");
  const next = { ...drive };
  if (rest.length) next[key] = put(isObject(drive[key]) ? drive[key] : {}, rest.join("."), value);
  else if (value === undefined) delete next[key];
  else next[key] = value;
  return next;
}

/** Gains without a unit are percent of full command per millimetre. */
const GAINS = new Set(["kp", "ki", "kd", "feed_forward"]);
const PERCENT_PER_MM = 10;
/** Texts that are names, not quantities. */
const NAMES = new Set(["shape", "preset", "arrangement", "type", "interpolation", "title"]);

/** The same with every text of a quantity as a number in SI; what cannot be read stays, for the server.
 * @param {any} part @param {string} [key] @returns {any} */
export function inSi(part, key = "") {
  if (NAMES.has(key) || key === "fittings") return part;
  if (isObject(part)) {
    if (Array.isArray(part.values) && typeof part.unit === "string") {
      return part.values.map((/** @type {unknown} */ v) => siNumber(`${v} ${part.unit}`) ?? v);
    }
    return Object.fromEntries(Object.entries(part).map(([name, value]) => [name, inSi(value, name)]));
  }
  if (Array.isArray(part)) return part.map((value) => inSi(value, key));
  if (typeof part !== "string") return part;
  const si = siNumber(part);
  if (si === null) return part;
  return GAINS.has(key) && /[a-z%]/i.test(part) ? si / PERCENT_PER_MM : si;
}

/** Only what JSON of numbers and texts can hold, and not without end.
 * @param {unknown} x @param {number} [depth] @returns {boolean} */
function isPlain(x, depth = 0) {
  if (x === null || typeof x === "boolean" || typeof x === "string") return true;
  if (typeof x === "number") return Number.isFinite(x);
  if (depth > 6 || typeof x !== "object") return false;
  return Object.values(x).every((/** @type {unknown} */ one) => isPlain(one, depth + 1));
}

/** @param {unknown} x @returns {x is [number, number]} */
const isRange = (x) => Array.isArray(x) && x.length === 2 && x.every(Number.isFinite) && x[0] < x[1];

/** @param {unknown} raw @returns {raw is Drive} */
const isDrive = (raw) => isObject(raw) && isPlain(raw);

/** Reads the Transient part of a link or file; a missing part takes its default.
 * @param {unknown} raw @returns {Transient} @throws {Error} says which part makes no sense */
export function readTransient(raw) {
  const start = defaultTransient();
  if (raw === undefined) return start;
  if (!isObject(raw)) throw new Error("“transient” is not an object");
  if (raw.drive !== undefined && !isDrive(raw.drive)) throw new Error("“transient.drive” makes no sense");
  const pins = Array.isArray(raw.pins) ? raw.pins : [];
  const sound = pins.filter((p) => isObject(p) && typeof p.name === "string" && isDrive(p.drive));
  const { window: w, measurement: m, phase: z } = raw;
  const drive = raw.drive ?? start.drive;
  const isZoomed = isObject(z) && isRange(z.pressure) && isRange(z.contraction);
  const isFile = isObject(m) && typeof m.id === "string" && typeof m.name === "string";
  return {
    drive: isObject(drive.load) ? { ...drive, load: arranged(drive.load) } : drive,
    mode: raw.mode === "controller" ? "controller" : "command",
    scenario: typeof raw.scenario === "string" ? raw.scenario : null,
    lower: ["force", "valve"].includes(raw.lower) ? raw.lower : "flow",
    window: isRange(w) ? [w[0], w[1]] : null,
    phase: isZoomed ? { pressure: z.pressure, contraction: z.contraction } : null,
    pins: /** @type {Pin[]} */ (sound.slice(0, MOST_PINS)),
    differing: raw.differing === true,
    measurement: isFile ? { id: m.id, name: m.name } : null,
  };
}

/** A drive document of this program or of the command line, as opposed to a document of this page.
 * @param {unknown} raw @returns {raw is Drive} */
export const isDriveDocument = (raw) =>
  isObject(raw) && !("design" in raw) && isObject(raw.muscle) && isDrive(raw);

/** The complete document: what the server runs and the command line takes.
 * @param {Transient} t @param {object} muscle @param {object | null} effects @returns {Drive} */
export function driveDocument(t, muscle, effects) {
  const { command, controller, ...rest } = t.drive;
  const driven = t.mode === "controller" ? { controller } : { command };
  return { schema: 1, muscle, ...(effects ? { effects } : {}), ...rest, ...driven };
}

const UPRIGHT = Math.PI / 2, TILTED = Math.PI / 6, LEVER = 2, PULLEY = 0.03;
/** What an arrangement inclines the load by when the document does not say it.
 * @type {Record<Arrangement, number>} */
const INCLINED = { hanging: UPRIGHT, inclined: UPRIGHT, horizontal: 0, lever: UPRIGHT, antagonist: 0 };
const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) < 1e-3;

/** How the load is arranged; a document may leave it to its numbers. @param {Drive | undefined} load
 * @returns {Arrangement} */
export function arrangementOf(load) {
  if (load?.arrangement) return load.arrangement;
  const angle = siNumber(load?.inclination) ?? UPRIGHT, ratio = siNumber(load?.lever_ratio);
  if (ratio !== null && ratio !== 1) return "lever";
  return near(angle, UPRIGHT) ? "hanging" : near(angle, 0) ? "horizontal" : "inclined";
}

/** Of the way the load is pulled against the horizontal [rad]. @param {Drive | undefined} load */
export const inclinationOf = (load) =>
  siNumber(load?.inclination) ?? INCLINED[arrangementOf(load)] ?? UPRIGHT;

/** The load with its arrangement in a word, so that a slider cannot make another one of it.
 * @param {Drive} load */
function arranged(load) {
  const arrangement = arrangementOf(load), { inclination, ...rest } = load;
  const fixed = arrangement === "hanging" || arrangement === "horizontal";
  const told = fixed && near(siNumber(inclination) ?? INCLINED[arrangement], INCLINED[arrangement]);
  return told ? { ...rest, arrangement } : { ...load, arrangement };
}

/** The same load arranged otherwise, with what the arrangement needs and without what it does not know.
 * @param {Drive} load @param {Arrangement} next @param {number} middle contraction in the middle of the stops
 * @returns {Drive} */
export function rearranged(load, next, middle) {
  const { pulley_radius: _r, precontraction: _e, lever_ratio: ratio, inclination, ...rest } = load;
  const angle = siNumber(inclination);
  const tilted = angle === null || near(angle, 0) || near(angle, UPRIGHT) ? TILTED : angle;
  /** @type {Record<Arrangement, object>} */
  const own = {
    hanging: {},
    horizontal: {},
    inclined: { inclination: tilted },
    lever: { lever_ratio: ratio ?? LEVER, ...(inclination === undefined ? {} : { inclination }) },
    antagonist: { pulley_radius: PULLEY, precontraction: middle },
  };
  return { ...rest, arrangement: next, ...own[next] };
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

/** A drive document taken apart: the muscle and effects for the Design view, the rest for this one.
 * @param {Drive} document @param {string | null} scenario
 * @returns {{muscle: import("../../types.js").Muscle, effects: Record<string, Record<string, number>> | null,
 *   transient: Partial<Transient>}} @throws {Error} */
export function takenApart(document, scenario) {
  const { schema: _schema, muscle, effects, ...rest } = inSi(document);
  if (!isObject(muscle)) throw new Error("it names no muscle");
  const { preset = null, rhombus, ...given } = muscle;
  const values = Object.fromEntries(
    [...Object.entries(given), ...Object.entries(rhombus ?? {})].filter(([, v]) => typeof v === "number"),
  );
  const lost = Object.keys(given).filter((key) => !(key in values) || !GEOMETRY.includes(key));
  if (lost.length) throw new Error(`“muscle.${lost[0]}” cannot be read here`);
  if (isObject(rest.load)) rest.load = arranged(rest.load);
  const form = rhombus ? "rhombus" : "turns" in values || "thread_length" in values ? "thread" : "braid";
  const start = defaultDrive();
  return {
    muscle: { preset, form, values },
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
