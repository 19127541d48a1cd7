// @ts-check
// Names for the shapes the server answers with, and for the document kept in the browser.

/** What the server's own description of its interface says; generated into frontend/types.
 * @typedef {import("../../types/api.d.ts").components["schemas"]} S */
/** @typedef {S["Quantity"]} PresetValue */
/** @typedef {Record<string, PresetValue>} Values */
/** @typedef {{unit: string, values: number[]}} Column */
/** One loose shape for presets of every kind: tables and details walk over whatever parts one has.
 * @typedef {{kind: string, id: string, title: string, maker?: string, series?: string, description?: string,
 *   function?: string, muscle?: string, geometry?: Values, limits?: Values, tolerance?: Values, data?:
 * Values,
 *   effects?: Record<string, Values>, reference_curve?: string | null, measurement?: string | null,
 *   references?: string[], verified: boolean, origin: string, data_columns?: Record<string, Column>,
 *   nominal_length?: PresetValue, excluded?: S["Exclusion"][], slack?: number[],
 *   source?: string, grade?: string, note?: string, document?: Partial<Design>,
 *   view?: Partial<Design>, misprints?: string[]}} Preset */
/** @typedef {S["EffectProblem"] & Partial<S["LibraryProblem"]>} Problem */
/** @typedef {S["EffectParameter"]} Parameter */
/** @typedef {S["EffectAnswer"]} Effect */
/** @typedef {S["ExportFormat"]} ExportFormat */
/** @typedef {S["CurvesResult"]} Curves */
/** @typedef {S["InverseFinding"]} Answer */
/** @typedef {S["OrderedMuscle"]} OrderCode */
/** @typedef {S["ComparisonResult"]} Comparison */
/** @typedef {S["SimulationResult"]} Run */
/** @typedef {S["MeasurementDetails"]} Measured */
/** A figure of a phase in the timing table.
 * @typedef {Exclude<keyof S["PhaseFigures"], "state" | "motion">} PhaseFigure */

/** @typedef {"braid" | "thread" | "rhombus"} Form */
/** @typedef {{preset: string | null, form: Form, values: Record<string, number>}} Muscle */
/** @typedef {"contraction" | "length" | "braid_angle"} Across */
/** @typedef {"contraction" | "length" | "diameter" | "outer_diameter" | "outer_diameter_at_fixed_length" | "force"} Over */
/** @typedef {"tangent" | "from_force" | "secant"} StiffnessOf */
/** The Design view's part of the document; SI throughout. `pressure`: that which is asked about, null: the highest of
 * the curves; `contraction`: that whose pressure is asked for; `load_as`: what was stated.
 * @typedef {{muscle: Muscle, effects: Record<string, Record<string, number>> | null, pressures: number[],
 *   pressure: number | null, contraction: number | null, load: number, load_as: "force" | "mass", direction: -1 | 0 | 1, temperature: number, dead_volume: number,
 *   fixed_length: number | null, range: [number, number] | null, clipped: boolean, across: Across,
 *   over: Over, stiffness: StiffnessOf,
 *   reference: string | null}} Design */
/** @typedef {{kind: string, search: string, maker: string, from: number | null, to: number | null,
 *   sort: string, descending: boolean, selected: string | null}} CatalogueFilter */

/** Effect -> parameter -> SI value, or the text of a formula.
 * @typedef {Record<string, Record<string, number | string>>} Effects */
/** @typedef {"fit" | "validation" | "off"} Use */
/** What the user says of a field of the experiment: a value, or a proposal that was taken over.
 * @typedef {string | {value: string, origin: "suggested"}} Said */
/** @typedef {Record<string, Said>} Experiment */
/** A measurement file or preset; `prepare`: the steps that prepare its data, in their order.
 * @typedef {{id: string, name: string, use: Use, experiment?: Experiment, prepare?: string[]}} Chosen */
/** Errors of fitted values: effect -> parameter -> standard error, and whether the fit stopped at a bound.
 * @typedef {Record<string, Record<string, {stderr: number | null, at_bound: boolean}>>} Fit */
/** What is said of the data: the files with their experiments, and the decisions about doubtful entries.
 * @typedef {{files: Chosen[], decisions: Decisions}} Context */
/** A test that would tell two effects apart; `minutes` null: not known.
 * @typedef {{pair: string[], declared: string, protocol: string, separation: number | null,
 *   minutes: number | null}} Telling */
/** A model and its error; `values`: of the geometry; `label`: the change that led to this model; `context`: what
 * was said of the data, where that has changed since; `twins`: effects that the data cannot tell from the one this
 * step added, itself among them, and `tells`: the tests that would.
 * @typedef {{label: string, effects: Effects | null, freed: string[], values: Record<string, number>,
 *   fit: Fit, rmse: number | null, holdout: number | null, context?: Context, twins?: string[],
 *   tells?: Telling[]}} Step */
/** A model on the board, with the data it was fitted to. @typedef {Step & {name: string, of: string}} Pinned */
/** What the residual is plotted over; "auto": the variable of the overlay.
 * @typedef {"auto" | "angle" | "contraction" | "pressure" | "velocity" | "direction" | "time" | "histogram" |
 *   "autocorrelation" | "cross" | "loops"} Tab */
/** Ranges of variables in SI. @typedef {Record<string, [number, number]>} Brush */
/** Decisions about entries that may be wrong; they hold for the files `of`, their ids joined by commas.
 * @typedef {{of: string, use: string[], keep: string[]}} Decisions */
/** The Compare view's part of the document. `effects`: null = those of the preset. `history`: the models before
 * this one, the first one first. `twins`, `tells`: of the current step. `pins`: the models of the board; `board`:
 * it is open, with rows that differ only where `differing`; `traces`: indices of pins drawn in the overlay.
 * @typedef {{files: Chosen[], muscle: Muscle, start: "ideal" | "preset", effects: Effects | null,
 *   freed: string[], free: string[], fit: Fit, label: string, holdout: number | null, history: Step[],
 *   drive: Drive | null, noise: number | null, decisions: Decisions, mystery: string | null, tab: Tab,
 *   over: string | null, channel: string | null, brush: Brush | null, before: boolean, twins: string[],
 *   tells: Telling[], pins: Pinned[], board: boolean, differing: boolean, traces: number[]}} Compare */

/** Files, experiment and model under a name; `id` stays when it is renamed.
 * @typedef {{id: number, name: string, compare: Compare}} Case */
/** The cases of the document: number and name of the one at hand, which is the part "compare"; its place `at` among all;
 * the others in order.
 * @typedef {{id: number, name: string, at: number, rest: Case[]}} Cases */

/** Supply, valve, tube, load, command, controller, …; numbers in SI. @typedef {Record<string, any>} Drive */
/** How the load of a drive is arranged.
 * @typedef {"hanging" | "inclined" | "horizontal" | "lever" | "antagonist" | "joint"} DriveArrangement */
/** A whole drive document, muscle and effects included. @typedef {{name: string, drive: Drive}} Pin */
/** What the phase plot shows when it is zoomed.
 * @typedef {{pressure: [number, number], contraction: [number, number]}} Zoom */
/** The Transient view's part of the document. `signals`: the strips that are shown; `tolerance`: of the reference, as a
 * share of its range.
 * @typedef {{drive: Drive, mode: "command" | "controller", scenario: string | null, signals: string[], tolerance: number,
 *   window: [number, number] | null, phase: Zoom | null, pins: Pin[], differing: boolean,
 *   measurement: {id: string, name: string} | null}} Transient */

/** A task with some of its fields. @typedef {Record<string, any>} Task */
/** How muscle and load are arranged in a task. @typedef {"lift" | "lever" | "antagonist"} TaskArrangement */
/** What drives are compared by, and an axis of the trade-off plot.
 * @typedef {"air" | "time" | "length" | "reserve" | "stiffness"} Aim */
/** The part of the document about a task. `mode`: what the Design view starts from; `selected`: index of the
 * proposal shown.
 * @typedef {{mode: "muscle" | "task", arrangement: TaskArrangement, task: Task, selected: number,
 *   axes: [Aim, Aim]}} Sizing */

/** A varied quantity of a study, in SI. `form`: a range, a list, or a distribution. `mean`: also the median or the most
 * probable value. `least`, `most`: where a distribution is cut off.
 * @typedef {{path: string, form: "range" | "logarithmic" | "values" | "uniform" | "triangular" | "normal" | "lognormal",
 *   from: number | null, to: number | null, points: number, values: number[], mean: number | null,
 *   deviation: number | null, log_deviation: number | null, least: number | null, most: number | null}} Varied */
/** A figure of a study, in SI, with what is wanted of it.
 * @typedef {{path: string, goal: "minimise" | "maximise" | null, at_least: number | null,
 *   at_most: number | null}} Watched */
/** @typedef {"grid" | "list" | "monte_carlo" | "latin_hypercube" | "sobol" | "morris" | "optimisation" | "robust"} StudyMethod */
/** The part of the document about a study. `assumed`: the spread of the quantities is an assumption of this page.
 * @typedef {{subject: "drive" | "task" | "model", quantities: Varied[], figures: Watched[], assumed: boolean,
 *   method: {type: StudyMethod, runs: number, samples: number, trajectories: number, population: number,
 *   generations: number, seed: number}}} Study */

/** What undo steps through, links carry and saved files hold.
 * @typedef {{schema: 1, view: string, units: import("./format.js").System, design: Design, sizing: Sizing,
 *   transient: Transient, compare: Compare, cases: Cases, catalogue: CatalogueFilter, study: Study}} Doc */

export {};
