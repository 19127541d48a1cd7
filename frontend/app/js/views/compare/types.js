// @ts-check
// Names for the answers of the server in this view.

/** @typedef {import("../../types.js").S} S */
/** @typedef {import("../../types.js").Effects} Effects */
/** A model as requests take it.
 * @typedef {{effects: Effects, muscle?: Record<string, any> | null}} Model */
/** @typedef {S["FittedParameter"]} Fitted */
/** `rmse`: the error that the diagnosis counts, without what the accuracy of the readings explains; `rmse_of_all`:
 * with it. @typedef {S["ComparisonAnswer"] & {rmse_of_all: number | null}} Comparison */
/** @typedef {S["ComparisonSeries"]} Series */
/** @typedef {S["HeatMap"]} HeatMap */
/** @typedef {S["ResidualProfile"]} Where */
/** @typedef {S["DiagnosisAnswer"]} Diagnosis */
/** @typedef {S["Candidate"]} Candidate */
/** @typedef {S["PathStep"]} PathStep */
/** @typedef {S["ProposedTerm"]} ProposedTerm */
/** @typedef {S["Verdict"]["status"]} Status */
/** @typedef {{share: number, stage?: string, found?: Candidate | null,
 *   waiting?: import("../../server/waiting.js").Waiting}} Progress */

/** @typedef {S["MeasurementAnswer"]} FileInfo */
/** @typedef {import("../../server/measurements.js").Mapping} Mapping */

/** A measurement with a hidden cause.
 * @typedef {{id: string, title: string, story: string, kind: string, muscle: Record<string, any> | null,
 *   drive: Record<string, any> | null,
 *   effects?: Record<string, any> | null, measurement: string}} Mystery */
/** @typedef {{hidden: {title: string, what: string, effects: string[]}[], found: boolean[],
 *   text: string}} Revealed */

export {};
