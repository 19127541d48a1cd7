// @ts-check
// The test rig of a transient measurement: valve, tube, supply, load, without the muscle. Pure functions.
import { isDriveDocument, partsOfDrive } from "../../drive/document.js";

/** @typedef {import("../../types.js").Drive} Drive */
/** @typedef {import("./types.js").FileInfo} FileInfo */

/** Parts of a drive document that the measurement replaces: the file holds the command. */
const MEASURED = new Set(["command", "controller", "duration"]);

/** @param {Drive} drive @returns {Drive} */
const rigOf = (drive) => Object.fromEntries(Object.entries(drive).filter(([key]) => !MEASURED.has(key)));

/** Whether a measurement has a valve command: its simulation needs the test rig. @param {FileInfo} info */
export const needsDrive = (info) =>
  info.kind === "transient" && info.channels.some((c) => c.name === "command");

/** The rig of the Transient view with the conditions of the file.
 * @param {Drive} drive @param {Record<string, unknown>} conditions @returns {Drive} */
export function driveFor(drive, conditions) {
  const { load_mass: mass, load_force: force, supply_pressure: pressure, start_pressure: start } = conditions;
  const { start_pressure: _replaced, ...rig } = rigOf(drive);
  const load = {
    ...rig.load,
    ...(typeof mass === "number" ? { mass } : {}),
    ...(typeof force === "number" ? { force } : {}),
  };
  return {
    ...rig,
    load,
    ...(typeof pressure === "number" ? { supply: { ...rig.supply, pressure } } : {}),
    ...(typeof start === "number" ? { start_pressure: start } : {}),
    ...(typeof conditions.valve === "string" ? { valve: { preset: conditions.valve } } : {}),
  };
}

const FIRST_ROWS = 5;

/** The initial pressure of a run: the median of its first rows. @param {unknown} column
 * @returns {number | null} */
export function startOf(column) {
  const first = Array.isArray(column) ? column.slice(0, FIRST_ROWS).filter((p) => typeof p === "number") : [];
  return first.length ? first.sort((a, b) => a - b)[first.length >> 1] : null;
}

/** Reads a pasted or opened drive document; `effects`: null if it has none.
 * @param {string} text
 * @returns {{drive: Drive, muscle: import("../../types.js").Muscle,
 *   effects: import("../../types.js").Effects | null}}
 * @throws {Error} says what is wrong */
export function readDrive(text) {
  let raw;
  try {
    raw = JSON.parse(text);
  } catch {
    throw new Error("it is not JSON");
  }
  if (!isDriveDocument(raw)) {
    throw new Error("it is not a drive document: “muscle”, “supply” and “valve” are required");
  }
  const { muscle, effects, transient } = partsOfDrive(raw, null);
  return { drive: rigOf(transient.drive ?? {}), muscle, effects };
}
