// @ts-check
// What the residual plot shows: every residual with the band of the noise, on the scale of the case.
import { axisTitle, extent, shown, steadyX } from "../../../plots/axes.js";
import { colours, MANY, padded, table } from "./specs.js";
import { marksOf, placeOf } from "./scale.js";
import { channelScale, column, isInside, VARIABLES } from "../words.js";

/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("./specs.js").View} View */

const BAND = 2;
/** Where the points of a direction stand along the axis of directions. */
const JITTER = 0.18;

/** @param {View} v @param {View["series"]} series @returns {(number | null)[]} */
const acrossOf = (v, series) =>
  v.over === "direction"
    ? series.flatMap((one) =>
      one.direction.map((d, i) => d === null ? null : Math.sign(d) + JITTER * Math.sin(12.9898 * i))
    )
    : shown(series.flatMap((one) => column(one, v.over)), VARIABLES[v.over].quantity, v.system);

/** Signs of the residuals of pinned models. */
const PIN_SIGNS = ["x", "cross-thin", "triangle-down", "diamond", "star", "hexagon"];

/** The residuals of the models of the board that are drawn. @param {View} v @param {Palette} p
 * @param {(r: number | null) => number | null} at @returns {import("../../../plots/chart.js").Trace[]} */
const pinnedTraces = (v, p, at) =>
  v.pinned.map(({ name, series }, i) => ({
    id: `pin${i}`,
    x: acrossOf(v, series),
    y: series.flatMap((one) => one.residual.map(at)),
    marker: { size: 4, symbol: PIN_SIGNS[i % PIN_SIGNS.length], color: p.second },
    column: `residual of ${name}`,
  }));

/** The residual on the scale of the case: linear inside the noise, logarithmic outside.
 * @param {View} v @param {Palette} p @param {import("./scale.js").Scale} fixed @returns {Spec} */
export function residualSpec(v, p, fixed) {
  const { title, quantity } = VARIABLES[v.over], { system } = v;
  const s = channelScale(v.unit, v.channel, system), tints = colours(v.series, p);
  const at = (/** @type {number | null} */ r) => r == null ? null : placeOf(r, fixed);
  const y = v.series.flatMap((one) => one.residual.map(at));
  const band = v.noise === null ? null : placeOf(BAND * v.noise, fixed);
  const ways = v.over === "direction";
  const x = acrossOf(v, v.series);
  const [xLow, xHigh] = ways ? [-1.5, 1.5] : extent([x]);
  const others = v.pinned.flatMap((pin) => pin.series.flatMap((one) => one.residual.map(at)));
  const size = Math.max(1, ...[...y, ...others].map((r) => Math.abs(r ?? 0)));
  return {
    x: ways
      ? {
        title,
        range: [-1.5, 1.5],
        marks: [{ at: -1, text: "shortening" }, { at: 0, text: "at rest" }, { at: 1, text: "lengthening" }],
      }
      : {
        title: axisTitle(title, quantity, system),
        range: padded(steadyX(`res${v.picture}${v.over}`, xLow, xHigh)),
      },
    y: {
      title: `Residual (${s.unit || "× noise"})`,
      range: [-1.04 * size, 1.04 * size],
      marks: marksOf(fixed, s.factor),
    },
    traces: [...pinnedTraces(v, p, at), {
      id: "residual",
      x,
      y,
      marker: {
        size: y.length > MANY ? 4 : 5,
        symbol: v.series.flatMap((one) =>
          one.residual.map((_r, i) => (one.direction?.[i] ?? 0) < 0 ? "square-open" : "circle")
        ),
        color: v.series.flatMap((one, k) =>
          one.residual.map((_r, i) => isInside(one, i, v.brush) ? tints[k] : p.line)
        ),
      },
      column: "residual",
    }],
    zones: band === null ? [] : [{ x: null, y: [-band, band], text: "±2σ of the noise", above: true }],
    revision: `${v.picture}${v.over}${system}`,
    table: table(v, ["measured", "residual"]),
  };
}
