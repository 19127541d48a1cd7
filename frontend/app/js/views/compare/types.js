// @ts-check
// Names for the answers of the server in this view.

/** @typedef {import("../../types.js").S} S */
/** @typedef {import("../../types.js").Effects} Effects */
/** A model as requests take it.
 * @typedef {{effects: Effects, muscle?: Record<string, any> | null}} Model */
/** @typedef {S["ParameterValue"]} Fitted */
/** @typedef {S["ComparisonResult"]} Comparison */
/** @typedef {S["ComparedSeries"]} Series */
/** @typedef {S["ComparedReversals"]} Reversals */
/** @typedef {S["ResidualMap"]} Grid */
/** @typedef {S["MapRow"]} Row */
/** @typedef {S["MapCell"]} Cell */
/** @typedef {S["Profile"]} Where */
/** @typedef {S["DiagnosisResult"]} Diagnosis */
/** @typedef {S["CandidateResult"]} Candidate */
/** @typedef {S["PathPoint"]} PathStep */
/** @typedef {S["TermProposal"]} ProposedTerm */
/** @typedef {S["Verdict"]["status"]} Status */
/** @typedef {{share: number, stage?: string, found?: Candidate | null,
 *   waiting?: import("../../server/waiting.js").Waiting}} Progress */

/** @typedef {S["MeasurementSummary"]} FileInfo */
/** @typedef {import("../../server/measurements.js").Mapping} Mapping */

/** A measurement with a hidden cause.
 * @typedef {{id: string, title: string, story: string, kind: string, muscle: Record<string, any> | null,
 *   drive: Record<string, any> | null,
 *   effects?: Record<string, any> | null, measurement: string}} Mystery */
/** @typedef {{hidden: {title: string, what: string, effects: string[]}[], found: boolean[],
 *   text: string}} Revealed */

export {};
