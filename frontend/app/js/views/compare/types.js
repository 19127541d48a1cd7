// @ts-check
// Names for what the server answers in this view.

/** @typedef {Record<string, Record<string, number | string>>} Effects  id -> parameter -> SI value or text */
/** @typedef {{value: number, stderr: number | null, unit: string, at_bound: boolean,
 *   fitted: boolean}} Fitted */
/** A model as the next request takes it.
 * @typedef {{effects: Effects, muscle?: Record<string, any> | null}} Model */

/** The residual over one variable, in bins.
 * @typedef {{over: string, share_explained: number, worst: string, rmse: number, unit: string,
 *   edges: number[], mean: number[], rms: number[], count: number[]}} Where */
/** @typedef {{x: string, y: string, x_edges: number[], y_edges: number[], mean: (number | null)[][],
 *   rms: (number | null)[][], count: number[][]}} HeatMap */
/** @typedef {{label: string, channel: string, unit: string, use: "fit" | "validation",
 *   pressure: number | null, time: (number | null)[] | null, contraction: (number | null)[],
 *   length: (number | null)[], x_pressure: (number | null)[], velocity: (number | null)[] | null,
 *   direction: (number | null)[] | null, measured: (number | null)[], predicted: (number | null)[],
 *   residual: (number | null)[]}} Series */
/** @typedef {{rmse: number | null, unit: string, noise_floor: number | null,
 *   full_scale: number | null}} Channel */
/** @typedef {{rmse: number | null, nrmse_percent: number | null, rows_used: number,
 *   series?: Series[]}} Validation */
/** @typedef {{kind: string, rows: number, rows_used: number, predicted: string, unit: string,
 *   rmse: number | null, nrmse_percent: number | null, holdout_rmse: number | null,
 *   noise_floor: number | null, noise_how?: string | null, residual_mean: number | null,
 *   parameters: Record<string, Record<string, Fitted>>, correlations: Correlation[],
 *   excluded: Record<string, number>, messages: string[], geometry: Record<string, any>,
 *   channels?: Record<string, Channel> | null, where?: Where[], heat_map?: HeatMap | null,
 *   validation?: Validation | null, sentences?: string[], series: Series[],
 *   muscle?: Record<string, any> | null}} Comparison */
/** @typedef {{a: string, b: string, value: number}} Correlation */

/** @typedef {{effect: string, title: string, rmse: number, holdout_rmse: number | null,
 *   gain_percent: number, delta_bic: number, parameters: Record<string, Fitted>, twins: string[],
 *   why: string, equation: string, freed: string[], model: Model,
 *   next_measurement: string | null}} Candidate */
/** @typedef {{added: string | null, rmse: number, holdout_rmse: number | null, model: Model,
 *   freed: string[]}} PathStep */
/** @typedef {{formula: string, coefficients: Record<string, number>, share: number, model: Model,
 *   curve: {x: string, values: number[], term: number[], residual: number[]} | null}} ProposedTerm */
/** @typedef {"adequate" | "missing_effects" | "ambiguous" | "unknown_effect"} Status */
/** @typedef {{status: Status, effects: string[], indistinguishable: string[][],
 *   unexplained_share: number | null, unexplained_in: string[], proposed_term: ProposedTerm | null,
 *   next_measurement: string | null, sentence: string,
 *   experiments?: {pair: string[], declared: string, protocol: string, separation: number}[]}} Verdict */
/** @typedef {{kind: string, rows: number, rows_used: number, predicted: string, unit: string,
 *   baseline: {rmse: number, nrmse_percent: number | null, holdout_rmse: number | null},
 *   noise_floor: {rmse: number | null, how: string} | null, where: Where[], candidates: Candidate[],
 *   path: PathStep[], verdict: Verdict, parameters: Record<string, Record<string, Fitted>>,
 *   correlations: Correlation[], model: Model, freed: string[], messages: string[]}} Diagnosis */
/** @typedef {{share: number, stage: string, found?: Candidate | null}} Progress */

/** @typedef {import("../../types.js").S} S */
/** @typedef {S["MeasurementAnswer"]} FileInfo */
/** @typedef {{header: string, channel: string | null, unit: string | null, unit_given: boolean,
 *   absolute: boolean | null, minimum: number | null, maximum: number | null,
 *   why: string | null}} PreviewColumn */
/** @typedef {{key: string, unit: string, why: string, example: string,
 *   alternatives: string[]}} Missing */
/** @typedef {{name: string, format: string, columns: PreviewColumn[], sample: string[][], rows: number,
 *   valid_rows: number, skipped: {reason: string, rows: number, first: string}[], kind: string | null,
 *   kind_detected: boolean, kind_reason: string, conditions: Record<string, string | number | null>,
 *   missing: Missing[], problem: {message: string, field: string | null, hint: string | null} | null,
 *   only_bad_rows: boolean, messages: string[],
 *   channel_choices: {name: string, si_unit: string, units: string[]}[],
 *   kind_choices: string[]}} Preview */
/** What the user says beyond a file.
 * @typedef {{columns?: Record<string, {channel: string, unit?: string, absolute?: boolean} | null>,
 *   kind?: string, conditions?: Record<string, string | null>, bad_rows?: "skip"}} Mapping */

/** @typedef {{id: string, title: string, story: string, kind: string, muscle: Record<string, any> | null,
 *   drive: Record<string, any> | null, measurement: string}} Mystery */
/** @typedef {{hidden: {title: string, what: string, effects: string[]}[], found: boolean[],
 *   text: string}} Revealed */

export {};
