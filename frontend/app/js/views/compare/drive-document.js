// @ts-check
// The rig of a transient measurement: valve, tube, supply, load, without the muscle. Pure functions.
import { isDriveDocument, takenApart } from "../../drive/document.js";

/** @typedef {import("../../types.js").Drive} Drive */
/** @typedef {import("./types.js").FileInfo} FileInfo */

/** Parts a measurement replaces: what was commanded is in the file. */
const MEASURED = new Set(["command", "controller", "duration"]);

/** @param {Drive} drive @returns {Drive} */
const rigOf = (drive) => Object.fromEntries(Object.entries(drive).filter(([key]) => !MEASURED.has(key)));

/** A run over time that a valve made: without the rig it cannot be computed. @param {FileInfo} info */
export const needsDrive = (info) =>
  info.kind === "transient" && info.channels.some((c) => c.name === "command");

/** The rig of the Transient view with what the file says of its own.
 * @param {Drive} drive @param {Record<string, unknown>} conditions @returns {Drive} */
export function driveFor(drive, conditions) {
  const { load_mass: mass, load_force: force, supply_pressure: pressure, start_pressure: start } = conditions;
  const { start_pressure: _other, ...rig } = rigOf(drive);
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
  };
}

const FIRST_ROWS = 5;

/** The pressure a run begins at, the middle one of its first rows. @param {unknown} column
 * @returns {number | null} */
export function startOf(column) {
  const first = Array.isArray(column) ? column.slice(0, FIRST_ROWS).filter((p) => typeof p === "number") : [];
  return first.length ? first.sort((a, b) => a - b)[first.length >> 1] : null;
}

/** Reads a drive document that was pasted or opened; `effects`: null = it says nothing of them.
 * @param {string} text
 * @returns {{drive: Drive, muscle: import("../../types.js").Muscle,
 *   effects: import("../../types.js").Effects | null}}
 * @throws {Error} says what is wrong with it */
export function readDrive(text) {
  let raw;
  try {
    raw = JSON.parse(text);
  } catch {
    throw new Error("it is not JSON");
  }
  if (!isDriveDocument(raw)) throw new Error("it is no drive document: it needs “muscle”, “supply”, “valve”");
  const { muscle, effects, transient } = takenApart(raw, null);
  return { drive: rigOf(transient.drive ?? {}), muscle, effects };
}
