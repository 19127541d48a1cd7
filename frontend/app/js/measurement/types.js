// @ts-check
// Names of what an import works with.

/** @typedef {import("../types.js").S} S */
/** @typedef {S["PreviewAnswer"] & {experiment?: Field[]}} Preview */
/** @typedef {S["PreviewColumn"]} Column */
/** @typedef {S["OpenQuestion"]} OpenQuestion */
/** A field of the experiment. @typedef {{field: string, title: string, value: number | string | null,
 *   unit: string, units: string[], origin: "file" | "you" | "preset" | "suggested" | "assumed" | null,
 *   where: string, required: boolean, unanswered: boolean, question: string, why: string,
 *   proposed: number | string | null, least: number | null, most: number | null, choices: string[],
 *   closed: boolean, example: string, option: string}} Field */
/** @typedef {import("../server/measurements.js").Mapping} Mapping */
/** @typedef {import("../server/measurements.js").Choice} Choice */
/** What the user says of a field of the experiment, as requests take it. @typedef {import("../types.js").Said} Said */
/** @typedef {import("../types.js").Experiment} Experiment */
/** How a file is read with the mapping of now; `wrong`: why it cannot be, then the preview is the last one.
 * @typedef {{preview: Preview, wrong: string}} Outcome */
/** A file as the user wants it read. @typedef {{file: File, mapping: Mapping, experiment: Experiment,
 *   kept: import("./memory.js").Kept | null}} Imported */

export {};
