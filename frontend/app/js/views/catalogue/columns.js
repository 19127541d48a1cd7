// @ts-check
// Which columns the table of each kind has, and how a value of a preset is read, sorted and written.
import {
  capitalized,
  number,
  quantityOf,
  quantityOfUnit,
  readable,
  scaleOf,
  siOf,
  tidyUnit,
  toShown,
} from "../../format.js";

/** @typedef {import("../../types.js").Preset} Preset */
/** @typedef {import("../../types.js").PresetValue} PresetValue */
/** @typedef {import("../../format.js").System} System */
/** `of` gives a text or a value with unit. @typedef {{key: string, title: string,
 *   of: (p: Preset) => string | PresetValue | null | undefined}} Column */

/** @type {Record<string, string>} */
export const KIND_TITLES = {
  muscles: "Muscles",
  valves: "Valves",
  tubes: "Tubes",
  fittings: "Fittings",
  measurements: "Measurements",
  curves: "Reference curves",
};

/** @type {Column} */
const maker = { key: "maker", title: "Maker", of: (p) => p.maker };
/** @param {string} key @param {string} title @param {"geometry" | "limits" | "data"} part
 * @returns {Column} */
const value = (key, title, part) => ({ key, title, of: (p) => p[part]?.[key] });
/** @param {Preset} p */
const points = (p) => Object.values(p.data_columns ?? {})[0]?.values.length ?? 0;
/** @type {Column[]} */
const POINT_COLUMNS = [
  { key: "muscle", title: "Muscle", of: (p) => p.muscle },
  { key: "points", title: "Points", of: (p) => ({ value: points(p), unit: "1", source: "", grade: "C" }) },
  { key: "grade", title: "Grade", of: (p) => p.grade },
];

/** @type {Record<string, Column[]>} */
const COLUMNS = {
  muscles: [
    maker,
    value("inside_diameter", "Bore", "geometry"),
    value("min_nominal_length", "L\u00a0from", "limits"),
    value("max_nominal_length", "L\u00a0to", "limits"),
    value("max_force", "F\u00a0max", "limits"),
    value("max_pressure", "P\u00a0max", "limits"),
    value("max_contraction", "ε\u00a0max", "limits"),
  ],
  measurements: POINT_COLUMNS,
  curves: POINT_COLUMNS,
};

const MOST_DATA = 4;

/** The columns of a kind; of parts, the data most of them have. @param {string} kind @param {Preset[]} list @returns {Column[]} */
export function columnsOf(kind, list) {
  if (COLUMNS[kind]) return COLUMNS[kind];
  /** @type {Map<string, number>} */
  const seen = new Map();
  for (const p of list) for (const key of Object.keys(p.data ?? {})) seen.set(key, (seen.get(key) ?? 0) + 1);
  const common = [...seen].sort((a, b) => b[1] - a[1]).slice(0, MOST_DATA).map(([key]) => key);
  const job = { key: "function", title: "Function", of: (/** @type {Preset} */ p) => p.function };
  return [
    maker,
    ...(kind === "valves" ? [job] : []),
    ...common.map((key) => value(key, capitalized(readable(key)), "data")),
  ];
}

/** A value in the user's units if its unit is known, else as it is in the file.
 * @param {PresetValue} q @param {System} system @param {string} [name]
 * @returns {{text: string, unit: string}} */
export function shownValue(q, system, name = "") {
  const measured = quantityOfUnit(q.unit);
  const quantity = measured === "pressure" ? quantityOf("Pa", name) : measured;
  if (!quantity) return { text: number(q.value, 4), unit: tidyUnit(q.unit) };
  const s = scaleOf(quantity, system);
  return { text: number(toShown(siOf(q), s), 3), unit: s.unit };
}

/** @param {ReturnType<Column["of"]>} cell @param {System} system */
export function cellText(cell, system) {
  if (cell == null || cell === "") return "–";
  if (typeof cell === "string") return cell;
  const { text, unit } = shownValue(cell, system);
  return unit ? `${text}\u00a0${unit}` : text;
}

/** @param {ReturnType<Column["of"]>} cell for sorting: numbers by SI value, missing last */
export const sortKey = (cell) =>
  cell == null ? null : typeof cell === "string" ? cell.toLowerCase() : siOf(cell);

/** The size for the filter: the inside diameter of a muscle or tube. @param {Preset} p */
export function sizeOf(p) {
  const q = p.geometry?.inside_diameter ?? p.data?.inside_diameter;
  return q ? siOf(q) : null;
}
