// @ts-check
// Measurement files on the server: read for a look, kept, fetched again.
import { get, sendFile } from "./client.js";
import { untilAnswered } from "./patience.js";

/** @typedef {import("../types.js").S} S */
/** @typedef {S["MeasurementSummary"]} FileInfo */
/** @typedef {S["PreviewResult"]} Preview */
/** What a column is; `sign` -1: the file counts it the other way; `assumed`: its unit is what was proposed.
 * @typedef {{channel: string, unit?: string, absolute?: boolean, sign?: number, assumed?: boolean,
 *   scale?: string}} Choice */
/** What the user says beyond a file; a column that is null is not used.
 * @typedef {{columns?: Record<string, Choice | null>, sheet?: string, head?: number,
 *   kind?: string, conditions?: Record<string, string | null>, bad_rows?: "skip",
 *   notes?: [string, string][]}} Mapping */

const MOST_BYTES = 64e6;

/** Why a file is not sent at all; null = it is. @param {File} file */
export const refusal = (file) => file.size > MOST_BYTES ? "The file is larger than 64 MB." : null;

/** @param {File} file @param {Mapping} mapping */
const query = (file, mapping) => {
  const said = Object.keys(mapping).length ? `&mapping=${encodeURIComponent(JSON.stringify(mapping))}` : "";
  return `?name=${encodeURIComponent(file.name)}${said}`;
};

/** How a file would be read. @param {File} file @param {Mapping} mapping @param {AbortSignal} [signal]
 * @param {string} [muscle] id of the muscle that was chosen, whose values the experiment then has
 * @returns {Promise<Preview>} */
export const previewOf = (file, mapping, signal, muscle) => {
  const chosen = muscle ? `&muscle=${encodeURIComponent(muscle)}` : "";
  const path = `/api/measurements/preview${query(file, mapping)}${chosen}`;
  return untilAnswered(() => sendFile("POST", path, file, signal), signal);
};

/** Sends a file to be kept. @param {File} file @param {Mapping} [mapping] @returns {Promise<FileInfo>} */
export const keep = (file, mapping = {}) =>
  untilAnswered(() => sendFile("PUT", `/api/measurements${query(file, mapping)}`, file));

/** A kept file with its columns. @param {string} id @param {AbortSignal} [signal]
 * @param {string[]} [steps] that prepare it
 * @returns {Promise<S["MeasurementDetails"]>} */
export const measurement = (id, signal, steps = []) => {
  const asked = steps.map((step) => `prepare=${encodeURIComponent(step)}`).join("&");
  return get(`/api/measurements/${id}${asked && `?${asked}`}`, signal);
};
