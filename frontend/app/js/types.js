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
 *   source?: string, grade?: string, note?: string, document?: Partial<Design>}} Preset */
/** @typedef {S["FileProblem"] & Partial<S["PresetProblem"]>} Problem */
/** @typedef {S["EffectParameter"]} Parameter */
/** @typedef {S["EffectAnswer"]} Effect */
/** @typedef {S["CurvesAnswer"]} Curves */
/** @typedef {S["InverseAnswer"]} Answer */
/** @typedef {S["ComparisonAnswer"]} Comparison */
/** @typedef {S["SimulationAnswer"]} Run */
/** @typedef {S["MeasurementDetail"]} Measured */

/** @typedef {"braid" | "thread" | "rhombus"} Form */
/** @typedef {{preset: string | null, form: Form, values: Record<string, number>}} Muscle */
/** @typedef {"contraction" | "length" | "braid_angle"} Across */
/** @typedef {"contraction" | "length" | "diameter" | "outer_diameter" | "force"} Over */
/** The Design view's part of the document; SI throughout.
 * @typedef {{muscle: Muscle, effects: Record<string, Record<string, number>> | null, pressures: number[],
 *   load: number, direction: -1 | 0 | 1, temperature: number, dead_volume: number,
 *   fixed_length: number | null, range: [number, number] | null, clipped: boolean, across: Across,
 *   over: Over,
 *   reference: string | null}} Design */
/** @typedef {{kind: string, search: string, maker: string, from: number | null, to: number | null,
 *   sort: string, descending: boolean, selected: string | null}} CatalogueFilter */
/** @typedef {import("./views/compare/document.js").Compare} Compare */
/** @typedef {{schema: 1, view: string, units: import("./format.js").System, design: Design,
 *   sizing: import("./views/sizing/document.js").Sizing,
 *   transient: import("./views/transient/document.js").Transient,
 *   compare: Compare, catalogue: CatalogueFilter}} Doc */

export {};
