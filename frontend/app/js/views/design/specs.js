// @ts-check
// What the plots of stiffness, volume and pressure show: from the server's answer to lines, points and shaded
// zones in the user's units. Pure functions.
import { scaleOf, toShown } from "../../format.js";
import { figure } from "../../facts.js";
import { atFixedLength, OVER, STIFFNESS, xAxis, xColumn } from "../../muscle/curve-axes.js";
import { curveFamily, limitZones } from "../../muscle/force-plot.js";
import { axisTitle, extent, shown, steadyRange, steadyX } from "../../plots/axes.js";

export { forceSpec } from "../../muscle/force-plot.js";

/** @typedef {import("../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../plots/chart.js").Zone} Zone */
/** @typedef {import("../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../muscle/curve-axes.js").View} View */

/** The name of a line, at a share of its length. @param {import("../../plots/chart.js").Trace | undefined} trace
 * @param {number} share @param {string} text @returns {import("../../plots/chart.js").Label[]} */
function nameAt(trace, share, text) {
  if (!trace) return [];
  const there = trace.x.map((x, i) => /** @type {const} */ ([x, trace.y[i]])).filter(([x, y]) =>
    x != null && y != null
  );
  const [x, y] = there[Math.round(share * (there.length - 1))] ?? [null, null];
  return x == null || y == null ? [] : [{ text, x, y, color: trace.line?.color ?? "", along: there }];
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function stiffnessSpec(v, p) {
  const x = xAxis(v, "stiffness");
  // Another definition is compared with the tangent; the tangent with that of a closed valve.
  const other = v.definition && v.definition !== "tangent"
    ? /** @type {const} */ (`stiffness_${v.definition}`)
    : null;
  const [shownAs, comparedTo] = other && v.curves[other]
    ? /** @type {const} */ ([other, "stiffness"])
    : /** @type {const} */ (["stiffness", "stiffness_closed"]);
  // Of the pressure that is asked about; the table of all curves has the others.
  const at = v.curves.pressure.indexOf(v.curves.lift?.pressure ?? NaN);
  const one = (/** @type {import("../../muscle/force-plot.js").Family} */ what, /** @type {string} */ dash) =>
    curveFamily(v, p, what, "stiffness", dash).filter((_, i) => at < 0 || i === at);
  const first = one(shownAs, ""), second = one(comparedTo, "dash");
  const traces = [...first, ...second];
  const [low, high] = extent(traces.map((t) => t.y));
  return {
    x,
    y: {
      title: axisTitle("Stiffness", "stiffness", v.system),
      range: steadyRange(`${v.place}stiffness${other ?? ""}${v.system}`, Math.min(0, low), high),
    },
    zones: limitZones(v, x.range, true),
    traces,
    labels: [
      nameAt(
        first.at(-1),
        0.72,
        other ? STIFFNESS[/** @type {"tangent"} */ (v.definition)].title : "valve open",
      ),
      nameAt(second.at(-1), 0.3, other ? "tangent" : "closed"),
    ].flat(),
    revision: `${v.across}${other ?? ""}${v.system}`,
  };
}

/** @param {View} v @param {Palette} p @returns {Spec} */
export function volumeSpec(v, p) {
  const { curves, system } = v;
  const x = xAxis(v, "volume"), column = xColumn(v);
  const volume = shown(curves.volume, "volume", system), diameter = shown(curves.diameter, "length", system);
  const [, most] = extent([volume]), [, widest] = extent([diameter]);
  const range1 = steadyRange(`${v.place}volume${system}`, 0, most);
  const range2 = steadyRange(`${v.place}diameter${system}`, 0, widest);
  return {
    x,
    y: { title: axisTitle(figure("curves.volume").label, "volume", system), range: range1 },
    y2: {
      title: axisTitle(figure("curves.diameter").label, "length", system),
      range: range2,
      right: true,
    },
    zones: limitZones(v, x.range),
    labels: nameAt(
      { id: "", x: column, y: volume, line: { color: p.accent } },
      0.75,
      `volume, ${scaleOf("volume", system).unit}`,
    ).concat(
      nameAt(
        {
          id: "",
          x: column,
          // Its own axis: where it lies on that of the volume.
          y: diameter.map((d) => d === null ? null : (d / range2[1]) * range1[1]),
          line: { color: p.second },
        },
        0.12,
        `diameter, ${scaleOf("length", system).unit}`,
      ),
    ),
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
        marker: { size: 7, symbol: "circle", color: p.load, edge: p.card },
      },
    ],
    labels: filling.some((y, i) => y !== venting[i])
      ? [
        nameAt({ id: "", x, y: filling, line: { color: p.accent } }, 0.75, "filling"),
        nameAt({ id: "", x, y: venting, line: { color: p.second } }, 0.35, "venting"),
      ].flat()
      : [],
    revision: `${over}${system}`,
  };
}
