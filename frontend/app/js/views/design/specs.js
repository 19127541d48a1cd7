// @ts-check
// What the plots of stiffness, volume and pressure show: from the server's answer to lines, points and shaded
// zones in the user's units. Pure functions.
import { scaleOf, toShown } from "../../format.js";
import { figure } from "../../facts.js";
import { atFixedLength, OVER, xAxis, xColumn } from "../../muscle/curve-axes.js";
import { curveFamily, limitZones } from "../../muscle/force-plot.js";
import { axisTitle, extent, shown, steadyRange, steadyX } from "../../plots/axes.js";

export { forceSpec } from "../../muscle/force-plot.js";

/** @typedef {import("../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../plots/chart.js").Zone} Zone */
/** @typedef {import("../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../muscle/curve-axes.js").View} View */

/** @param {View} v @param {Palette} p @returns {Spec} */
export function stiffnessSpec(v, p) {
  const x = xAxis(v, "stiffness");
  // Another definition is compared with the tangent; the tangent with that of a closed valve.
  const other = v.definition && v.definition !== "tangent"
    ? /** @type {const} */ (`stiffness_${v.definition}`)
    : null;
  const traces = other && v.curves[other]
    ? [...curveFamily(v, p, other, "stiffness"), ...curveFamily(v, p, "stiffness", "stiffness", "dash")]
    : [
      ...curveFamily(v, p, "stiffness", "stiffness"),
      ...curveFamily(v, p, "stiffness_closed", "stiffness", "dash"),
    ];
  const [low, high] = extent(traces.map((t) => t.y));
  return {
    x,
    y: {
      title: axisTitle("Stiffness", "stiffness", v.system),
      range: steadyRange(`${v.place}stiffness${other ?? ""}${v.system}`, Math.min(0, low), high),
    },
    zones: limitZones(v, x.range, true),
    traces,
    revision: `${v.across}${other ?? ""}${v.system}`,
  };
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function volumeSpec(v, p) {
  const { curves, system } = v;
  const x = xAxis(v, "volume"), column = xColumn(v);
  const volume = shown(curves.volume, "volume", system), diameter = shown(curves.diameter, "length", system);
  const [, most] = extent([volume]), [, widest] = extent([diameter]);
  return {
    x,
    y: {
      title: axisTitle(figure("curves.volume").label, "volume", system),
      range: steadyRange(`${v.place}volume${system}`, 0, most),
    },
    y2: {
      title: axisTitle(figure("curves.diameter").label, "length", system),
      range: steadyRange(`${v.place}diameter${system}`, 0, widest),
      right: true,
    },
    zones: limitZones(v, x.range),
    traces: [
      { id: "volume", x: column, y: volume, line: { color: p.accent }, column: "volume" },
      {
        id: "diameter",
        x: column,
        y: diameter,
        line: { color: p.second, dash: "dash" },
        axis: 2,
        column: "diameter",
      },
    ],
    revision: `${v.across}${system}`,
  };
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function overPressureSpec(v, p) {
  const { curves, over, system } = v;
  const { title, axis, quantity } = OVER[over];
  const o = curves.over_pressure;
  const branch = (/** @type {"filling" | "venting"} */ way) => {
    if (over === "force") return o?.force_at_fixed_length?.[way] ?? [];
    if (over === "outer_diameter_at_fixed_length") return o?.[over] ?? []; // the same both ways
    return o?.[way]?.[over] ?? [];
  };
  const x = shown(o?.pressure ?? [], "pressure", system);
  const filling = shown(branch("filling"), quantity, system),
    venting = shown(branch("venting"), quantity, system);
  const dots = atFixedLength(over) || over === "outer_diameter" ? [] : curves.operating_points;
  const y = shown(
    dots.map((d) => atFixedLength(over) || over === "outer_diameter" ? null : d[over]),
    quantity,
    system,
  );
  const [low, high] = extent([filling, venting, y]);
  const [first, last] = extent([x]);
  const limit = curves.limits.max_pressure;
  const top = limit == null ? Infinity : toShown(limit, scaleOf("pressure", system));
  /** @type {Zone[]} */
  const zones = top < last ? [{ x: [top, last], y: null, text: "pressure limit" }] : [];
  return {
    x: {
      title: axisTitle(figure("over_pressure.pressure").label, "pressure", system),
      range: steadyX(`${v.place}over${system}`, first, last),
    },
    y: {
      title: axisTitle(axis ?? title, quantity, system),
      range: steadyRange(`${v.place}over${over}${system}`, low, high),
    },
    zones,
    traces: [
      { id: "filling", x, y: filling, line: { color: p.accent }, column: "filling" },
      { id: "venting", x, y: venting, line: { color: p.second, dash: "dash" }, column: "venting" },
      {
        id: "operating-points",
        x: shown(dots.map((d) => d.pressure), "pressure", system),
        y,
        marker: { size: 9, symbol: "circle", color: p.load, edge: p.card },
      },
    ],
    revision: `${over}${system}`,
  };
}
