// @ts-check
// Requests that carry a file.
import { sendFile } from "../../../server/client.js";

/** @typedef {import("../types.js").FileInfo} FileInfo */
/** @typedef {import("../types.js").Preview} Preview */
/** @typedef {import("../types.js").Mapping} Mapping */

/** @param {File} file @param {Mapping} mapping */
const query = (file, mapping) => {
  const said = Object.keys(mapping).length ? `&mapping=${encodeURIComponent(JSON.stringify(mapping))}` : "";
  return `?name=${encodeURIComponent(file.name)}${said}`;
};

/** How a file would be read. @param {File} file @param {Mapping} mapping @param {AbortSignal} [control]
 * @returns {Promise<Preview>} */
export const previewOf = (file, mapping, control) =>
  sendFile("POST", `/api/measurements/preview${query(file, mapping)}`, file, control);

/** Sends a file to be kept. @param {File} file @param {Mapping} mapping @returns {Promise<FileInfo>} */
export const keep = (file, mapping) => sendFile("PUT", `/api/measurements${query(file, mapping)}`, file);
