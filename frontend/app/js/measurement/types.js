// @ts-check
// Names of what an import works with.

/** @typedef {import("../types.js").S} S */
/** @typedef {S["PreviewResult"]} Preview */
/** @typedef {S["PreviewColumn"]} Column */
/** @typedef {S["OpenQuestion"]} OpenQuestion */
/** @typedef {S["FormField"]} Field */
/** @typedef {import("../server/measurements.js").Mapping} Mapping */
/** @typedef {import("../server/measurements.js").Choice} Choice */
/** What the user says of a field of the experiment, as requests take it. @typedef {import("../types.js").Said} Said */
/** @typedef {import("../types.js").Experiment} Experiment */
/** How a file is read with the mapping of now; `wrong`: why it cannot be, then the preview is the last one.
 * @typedef {{preview: Preview, wrong: string}} Outcome */
/** A file as the user wants it read. @typedef {{file: File, mapping: Mapping, experiment: Experiment,
 *   kept: import("./memory.js").Kept | null}} Imported */

export {};
