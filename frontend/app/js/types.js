// @ts-check
// Names for the shapes the server answers with, and for the document kept in the browser.

/** @typedef {{value: number, unit: string, source: string, grade: string, note?: string}} PresetValue */
/** @typedef {{text: string, grade: string}} Source */
/** @typedef {Record<string, PresetValue>} Values */
/** @typedef {{unit: string, values: number[]}} Column */
/** A preset file as the server lists it; which of the optional parts are there depends on the kind.
 * @typedef {{kind: string, id: string, title: string, maker?: string, series?: string, description?: string,
 *   function?: string, muscle?: string, geometry?: Values, limits?: Values, tolerance?: Values, data?: Values,
 *   effects?: Record<string, Values>, reference_curve?: string | null, measurement?: string | null,
 *   references?: string[], verified: boolean, origin: string, data_columns?: Record<string, Column>,
 *   nominal_length?: PresetValue, excluded?: {index: number, why: string}[], slack?: number[],
 *   source?: string, grade?: string, note?: string, document?: Partial<Design>}} Preset */
/** @typedef {{file: string, field?: string | null, message: string, hint?: string | null}} Problem */
/** @typedef {{name: string, symbol: string, symbol_mathml: string, unit: string, default: number, lower: number,
 *   upper: number, off: number | null, fitted: boolean, description: string, source: Source}} Parameter */
/** @typedef {{id: string, title: string, family: string, type: string, cause: string, equation: string,
 *   equation_mathml: string, parameters: Parameter[], kinds: string[], signature: {text: string},
 *   confused_with: {effect: string, separated_by: string}[], references: Source[], slots: string[]}} Effect */
/** @typedef {{side: number, along: number, around: number}} Rhombus */
/** @typedef {{braid_diameter: number, braid_angle: number, nominal_length: number, inside_diameter: number | null,
 *   wall_thickness: number | null, thread_length: number, turns: number, rhombus: Rhombus | null}} Geometry */
/** @typedef {{contraction: (number | null)[], length: (number | null)[], diameter: (number | null)[]}} Path */
/** @typedef {{code: string, message: string, field?: string | null}} Flag */
/** @typedef {{pressure: number, contraction: number | null, length: number | null, force: number | null,
 *   stiffness: number | null, stiffness_closed: number | null, diameter: number | null,
 *   flags: string[]}} OperatingPoint */
/** @typedef {{pressure: number, blocked_force: number | null, free_contraction: number | null,
 *   free_contraction_flag: string | null, max_work: number | null,
 *   thread_tension_total: number | null}} Characteristic */
/** @typedef {{pressure: number[], load: number | null, filling: Path, venting: Path,
 *   fixed_length: number | null,
 *   force_at_fixed_length: {filling: number[], venting: number[]} | null}} OverPressure */
/** @typedef {{pressure: number[], length: number[], contraction: number[], braid_angle: number[],
 *   force: number[][], stiffness: number[][], stiffness_closed: number[][], volume: number[],
 *   diameter: number[], limits: {max_pressure: number | null, max_force: number | null,
 *   max_contraction: number | null, max_pretension: number | null, ideal_max_contraction: number | null,
 *   braid_lock_force: number[]}, characteristics: Characteristic[], geometry: Geometry,
 *   model: {effects: Record<string, Record<string, number>>}, over_pressure: OverPressure | null,
 *   operating_points: OperatingPoint[], flags: Flag[]}} Curves */
/** @typedef {{question: string, value: number | null, unit: string, details: Record<string, number | null>,
 *   flags: Flag[]}} Answer */
/** @typedef {{rows: number, rows_used: number, rmse: number, nrmse_percent: number, full_scale: number,
 *   excluded: Record<string, number>, messages: string[], residual_mean: number}} Comparison */

/** @typedef {"braid" | "thread" | "rhombus"} Form */
/** @typedef {{preset: string | null, form: Form, values: Record<string, number>}} Muscle */
/** @typedef {"contraction" | "length" | "braid_angle"} Across */
/** @typedef {"contraction" | "length" | "diameter" | "force"} Over */
/** The Design view's part of the document; SI throughout.
 * @typedef {{muscle: Muscle, effects: Record<string, Record<string, number>> | null, pressures: number[],
 *   load: number, direction: -1 | 0 | 1, temperature: number, dead_volume: number, fixed_length: number | null,
 *   range: [number, number] | null, clipped: boolean, across: Across, over: Over,
 *   reference: string | null}} Design */
/** @typedef {{kind: string, search: string, maker: string, from: number | null, to: number | null, sort: string,
 *   descending: boolean, selected: string | null}} CatalogueFilter */
/** @typedef {{schema: 1, view: string, units: import("./format.js").System, design: Design,
 *   catalogue: CatalogueFilter}} Doc */

export {};
