// @ts-check
// The Transient view's part of the document: the drive as a drive document has it, without the muscle and its
// effects, which belong to the design; and what is shown of the run.
import { defaultDrive, inSi, isDrive, withArrangement } from "../../drive/document.js";
import { isObject } from "../../paths.js";
import { addPart } from "../../state.js";

/** @typedef {import("../../types.js").Pin} Pin */
/** @typedef {import("../../types.js").Transient} Transient */

export const MOST_PINS = 4;

/** @returns {Transient} */
export const defaultTransient = () => ({
  drive: defaultDrive(),
  mode: "command",
  scenario: null,
  signals: ["position", "valve", "pressure", "flow", "angle", "torque", "stiffness"], // the last three of joints only
  tolerance: 0.05,
  window: null,
  phase: null,
  pins: [],
  differing: false,
  measurement: null,
});

/** @param {unknown} x @returns {x is [number, number]} */
const isRange = (x) => Array.isArray(x) && x.length === 2 && x.every(Number.isFinite) && x[0] < x[1];

/** @param {unknown} x @returns {x is string[]} */
const isSignals = (x) => Array.isArray(x) && x.length > 0 && x.every((each) => typeof each === "string");

/** Reads the Transient part of a link or file; a missing part takes its default.
 * @param {unknown} raw @returns {Transient} @throws {Error} says which part is invalid */
function readTransient(raw) {
  const start = defaultTransient();
  if (raw === undefined) return start;
  if (!isObject(raw)) throw new Error("“transient” is not an object");
  if (raw.drive !== undefined && !isDrive(raw.drive)) throw new Error("“transient.drive” is invalid");
  const pins = Array.isArray(raw.pins) ? raw.pins : [];
  const sound = pins.filter((p) => isObject(p) && typeof p.name === "string" && isDrive(p.drive));
  const { window: w, measurement: m, phase: z } = raw;
  const drive = raw.drive ? inSi(raw.drive) : start.drive;
  const isZoomed = isObject(z) && isRange(z.pressure) && isRange(z.contraction);
  const isFile = isObject(m) && typeof m.id === "string" && typeof m.name === "string";
  return {
    drive: isObject(drive.load) ? { ...drive, load: withArrangement(drive.load) } : drive,
    mode: raw.mode === "controller" ? "controller" : "command",
    scenario: typeof raw.scenario === "string" ? raw.scenario : null,
    signals: isSignals(raw.signals) ? raw.signals : start.signals,
    tolerance: typeof raw.tolerance === "number" && raw.tolerance > 0 ? raw.tolerance : start.tolerance,
    window: isRange(w) ? [w[0], w[1]] : null,
    phase: isZoomed ? { pressure: z.pressure, contraction: z.contraction } : null,
    pins: /** @type {Pin[]} */ (sound.slice(0, MOST_PINS)),
    differing: raw.differing === true,
    measurement: isFile ? { id: m.id, name: m.name } : null,
  };
}

addPart("transient", { start: defaultTransient, read: readTransient });
