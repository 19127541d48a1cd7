// @ts-check
// The task of a drive as requests take it. Pure functions.

/** @typedef {import("../types.js").Sizing} Sizing */
/** @typedef {import("../types.js").Task} Task */

export const LEVER = 0.5;

/** The body of a request: without fields that the arrangement does not use, which stay in the document.
 * @param {Sizing} sizing @returns {Task} */
export function requestOf({ arrangement, task }) {
  const { pair, lever_ratio: ratio, ...load } = task.load ?? {};
  const { stroke, speed, ...rest } = task;
  if (arrangement === "antagonist") return { ...rest, load: { pair } };
  const lever = arrangement === "lever" ? { lever_ratio: ratio ?? LEVER } : {};
  const way = { ...(stroke === undefined ? {} : { stroke }), ...(speed === undefined ? {} : { speed }) };
  return { ...rest, ...way, load: { ...load, ...lever } };
}
