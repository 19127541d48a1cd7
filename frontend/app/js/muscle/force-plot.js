// @ts-check
// The force of a muscle over its contraction: one line per pressure, measured points, limits. Pure functions.
import { scaleOf, siOf, toShown, withUnit } from "../format.js";
import { figure } from "../facts.js";
import { axisTitle, extent, shown, steadyRange } from "../plots/axes.js";
import { pressureColour } from "../plots/theme.js";
import { ACROSS, acrossAt, pressureName, shareOf, xAxis, xColumn } from "./curve-axes.js";

/** @typedef {import("../plots/chart.js").Spec} Spec */
/** @typedef {import("../plots/chart.js").Trace} Trace */
/** @typedef {import("../plots/chart.js").Zone} Zone */
/** @typedef {import("../plots/theme.js").Palette} Palette */
/** @typedef {import("../format.js").Quantity} Quantity */
/** @typedef {import("./curve-axes.js").View} View */

/** Contractions outside the limits of the maker. @param {View} v @param {[number, number]} range
 * @param {boolean} [fitted] whether the plot shows what the model was fitted to: then also those where it was not
 * @returns {Zone[]} */
export function limitZones(v, range, fitted = false) {
  const { max_contraction, max_pretension, stretched } = v.curves.limits;
  const s = scaleOf(ACROSS[v.across].quantity, v.system);
  const { contraction } = v.curves;
  const first = contraction[0], last = contraction[contraction.length - 1];
  /** Where the zone beyond a limit begins; NaN, no zone, where the curves do not reach it.
   * @param {number} k */
  const at = (k) => {
    const value = acrossAt(v.curves, v.across, k);
    return value === null ? NaN : toShown(value, s);
  };
  /** @type {Zone[]} */
  const zones = [];
  const rising = v.across !== "length";
  /** @param {number} from @param {boolean} up @param {string} text */
  const add = (from, up, text) => {
    const to = up ? range[1] : range[0];
    if (up ? from < to : from > to) zones.push({ x: from < to ? [from, to] : [to, from], y: null, text });
  };
  if (max_contraction != null) add(at(Math.max(max_contraction, first)), rising, "contraction limit");
  if (max_pretension != null) add(at(Math.min(-max_pretension, last)), !rising, "pretension limit");
  if (fitted && stretched && first < 0) add(at(0), !rising, "not fitted");
  return zones;
}

/** What a column of a table of the curves is called before its pressure. */
const COLUMN_OF = {
  force: "",
  stiffness: "",
  stiffness_closed: "closed valve, ",
  stiffness_from_force: "of the force, ",
  stiffness_secant: "secant, ",
};

/** @typedef {keyof typeof COLUMN_OF} Family */
/** @param {View} v @param {Palette} p @param {Family} what
 * @param {Quantity} quantity
 * @param {string} [dash] @returns {Trace[]} */
export function curveFamily(v, p, what, quantity, dash) {
  const x = xColumn(v);
  // A slack muscle has no stiffness; a line down to zero would look like a jump.
  const slack = (/** @type {number} */ i, /** @type {number} */ k) =>
    what !== "force" && v.curves.force[i][k] === 0;
  return (v.curves[what] ?? []).map((row, i) => ({
    id: `${what}${i}`,
    x,
    y: shown(row.map((y, k) => slack(i, k) ? null : y), quantity, v.system),
    line: {
      color: pressureColour(shareOf(v.curves.pressure[i], v.curves), p),
      width: dash ? 1.5 : v.curves.lift?.pressure === v.curves.pressure[i] ? 3 : v.curves.lift ? 1.5 : 2,
      dash,
    },
    column: `${COLUMN_OF[what]}${pressureName(v, v.curves.pressure[i])}`,
  }));
}

/** Ends of the range of new readings, where the model was fitted. @param {View} v @param {Palette} p
 * @returns {Trace[]} */
function intervalTraces(v, p) {
  const { interval, pressure, force } = v.curves;
  if (!interval) return [];
  const x = xColumn(v);
  return pressure.flatMap((level, i) => {
    const color = pressureColour(shareOf(level, v.curves), p);
    // Where the muscle hangs slack there is no reading.
    const pulling = (/** @type {(number | null)[]} */ row) => row.map((y, k) => force[i][k] === 0 ? null : y);
    return /** @type {const} */ (["low", "high"]).map((end) => ({
      id: `${end}${i}`,
      x,
      y: shown(pulling(interval[end][i]), "force", v.system),
      line: { color, width: 1, dash: "dot" },
    }));
  });
}

/** The measured points or the curve of the maker; `left`: indices of those left out. @param {View} v */
function referencePoints(v) {
  const columns = v.reference?.data_columns;
  if (!columns?.force || !columns.pressure) return null;
  const si = (/** @type {string} */ name) =>
    columns[name]?.values.map((value) => siOf({ value, unit: columns[name].unit }));
  const measuredLength = v.reference?.nominal_length;
  const nominal = measuredLength ? siOf(measuredLength) : v.curves.geometry.nominal_length;
  const contraction = si("contraction") ?? si("length")?.map((length) => 1 - length / nominal);
  if (!contraction) return null;
  const left = new Set(v.reference?.excluded?.map((e) => e.index) ?? []);
  v.reference?.slack?.forEach((flag, i) => flag && left.add(i));
  return {
    contraction,
    pressure: /** @type {number[]} */ (si("pressure")),
    force: /** @type {number[]} */ (si("force")),
    left,
  };
}

/** @param {View} v @param {Palette} p @param {[number, number]} range @returns {Trace[]} */
function pointTraces(v, p, range) {
  const points = referencePoints(v);
  if (!points) return [];
  const x = shown(
    points.contraction.map((k) => acrossAt(v.curves, v.across, k)),
    ACROSS[v.across].quantity,
    v.system,
  );
  const y = shown(points.force, "force", v.system);
  const inside = x.map((at) => at !== null && at >= range[0] - 1e-9 && at <= range[1] + 1e-9);
  /** @param {boolean} excluded @param {string} id @param {string} symbol @param {number} size
   * @returns {Trace} */
  const trace = (excluded, id, symbol, size) => {
    const keep = [...x.keys()].filter((i) => inside[i] && points.left.has(i) === excluded);
    return {
      id,
      x: keep.map((i) => x[i]),
      y: keep.map((i) => y[i]),
      marker: {
        size,
        symbol,
        color: excluded ? p.soft : keep.map((i) => pressureColour(shareOf(points.pressure[i], v.curves), p)),
      },
    };
  };
  return [trace(true, "left-out", "x-thin-open", 4), trace(false, "points", "circle-open", 5)];
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function forceSpec(v, p) {
  const { curves, across, system } = v;
  const x = xAxis(v, "force");
  const lines = curveFamily(v, p, "force", "force");
  const points = pointTraces(v, p, x.range);
  const load = toShown(curves.over_pressure?.load ?? 0, scaleOf("force", system));
  const [low, high] = extent([...lines.map((t) => t.y), ...points.map((t) => t.y), [load * 1.02, 0]]);
  const y = {
    title: axisTitle(figure("curves.force").label, "force", system),
    range: steadyRange(`${v.place}force${system}`, low, Math.max(high, 1e-3)),
  };
  const dots = curves.operating_points.map((o) => o.contraction);
  const zones = limitZones(v, x.range, true);
  const most = curves.limits.max_force;
  const top = most == null ? Infinity : toShown(most, scaleOf("force", system));
  if (top < y.range[1]) zones.push({ x: null, y: [top, y.range[1]], text: "force limit" });
  return {
    x,
    y,
    zones,
    revision: `${across}${system}`,
    level: curves.over_pressure
      ? { y: load, text: `Load ${withUnit(curves.over_pressure.load, "force", system)}` }
      : undefined,
    traces: [
      ...points,
      ...intervalTraces(v, p),
      ...lines,
      {
        id: "operating-points",
        x: shown(dots.map((k) => acrossAt(curves, across, k)), ACROSS[across].quantity, system),
        y: dots.map(() => load),
        marker: { size: 9, symbol: "circle", color: p.load, edge: p.card },
      },
    ],
    labels: lines.map((t, i) => lineLabel(t, i, v, x.range, across === "length")).filter((l) => l !== null),
  };
}

/** The pressure, written beside the start of its line. @param {Trace} t @param {number} i @param {View} v
 * @param {[number, number]} range @param {boolean} fromRight */
function lineLabel(t, i, v, range, fromRight) {
  const at = range[fromRight ? 1 : 0];
  let best = 0;
  t.x.forEach((value, k) => {
    const nearest = /** @type {number} */ (t.x[best]);
    if (value != null && Math.abs(value - at) < Math.abs(nearest - at)) best = k;
  });
  const y = t.y[best], x = t.x[best];
  if (y == null || x == null || y <= 0) return null;
  const along = t.x.map((at, k) => /** @type {const} */ ([at, t.y[k]]));
  return { text: pressureName(v, v.curves.pressure[i]), x, y, color: t.line?.color ?? "", along };
}
