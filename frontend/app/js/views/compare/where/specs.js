// @ts-check
// What the overlay shows: measured points and model lines.
import { inSentence } from "../../../facts.js";
import { axisTitle, extent, shown, steadyRange, steadyX } from "../../../plots/axes.js";
import { capitalized, number, scaleOf, toShown } from "../../../format.js";
import { pressureColour } from "../../../plots/theme.js";
import { atReversals, channelScale, channelWords, column, isInside, VARIABLES } from "../words.js";

/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../plots/chart.js").Trace} Trace */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {import("../types.js").Series} Series */
/** @typedef {import("../../../types.js").Brush} Brush */
/** `ghost`: the series of the model one step before; `pinned`: those of models of the board; `picture`: changes
 * with the data.
 * @typedef {{series: Series[], ghost: Series[], pinned: {name: string, series: Series[]}[], channel: string,
 *   unit: string, over: string, system: System, brush: Brush | null, noise: number | null,
 *   reversals: import("../types.js").Reversals | null, picture: string}} View */

/** A single series without a pressure: data and model then have different colours.
 * @param {Series[]} series */
const isAlone = (series) => series.length === 1 && series[0].pressure === null;

/** Colour of each series, by its pressure or else by its index.
 * @param {Series[]} series @param {Palette} p */
export function colours(series, p) {
  const known = series.flatMap((s) => s.pressure === null ? [] : [s.pressure]);
  if (isAlone(series)) return [p.accent];
  const low = Math.min(...known), high = Math.max(...known);
  return series.map((s, i) => {
    if (s.pressure !== null && high > low) return pressureColour((s.pressure - low) / (high - low), p);
    return pressureColour(series.length > 1 ? i / (series.length - 1) : 0.6, p);
  });
}

/** A model line in pieces: a new piece starts where the motion reverses.
 * @param {Series} s @param {string} over @param {(sign: number) => boolean} belongs */
function pieces(s, over, belongs) {
  const x = column(s, over), turns = s.direction ?? [];
  /** @type {{x: (number | null)[], y: (number | null)[]}} */
  const line = { x: [], y: [] };
  const sorted = turns.every((d) => !d) && over !== "time";
  const rows = [...x.keys()].filter((i) => belongs(Math.sign(turns[i] ?? 0)) && x[i] != null);
  if (sorted) rows.sort((a, b) => (x[a] ?? 0) - (x[b] ?? 0));
  rows.forEach((i, k) => {
    if (k && !sorted && rows[k - 1] !== i - 1) {
      line.x.push(null);
      line.y.push(null);
    }
    line.x.push(x[i]);
    line.y.push(s.predicted[i]);
  });
  return line;
}

/** Whether each point has its own pressure: no line is drawn then. @param {Series} s @param {string} over */
const isScattered = (s, over) =>
  s.pressure === null && over !== "time" && !(s.direction ?? []).some((d) => d);

/** A range with room for the points at its ends. @param {[number, number]} range @returns {[number, number]} */
export const padded = ([low, high]) => [low - 0.015 * (high - low), high + 0.015 * (high - low)];

/** How the lines of pinned models are told apart. */
export const PIN_DASHES = ["dot", "dashdot", "longdash", "dash", "longdashdot", "5px,2px"];

/** More points than this are drawn small and faint, because they would hide the model. */
export const MANY = 300;

/** The colour half transparent. @param {string} color "rgb(…)" */
const faint = (color) => color.replace("rgb(", "rgba(").replace(")", ",0.5)");

/** @param {View} v @param {Palette} p @returns {Spec} */
export function overlaySpec(v, p) {
  const { title, quantity } = VARIABLES[v.over], { system } = v;
  const s = channelScale(v.unit, v.channel, system);
  const y = (/** @type {(number | null)[]} */ values) =>
    values.map((one) => one == null ? null : toShown(one, s));
  const x = (/** @type {(number | null)[]} */ values) => shown(values, quantity, system);
  const tints = colours(v.series, p);
  /** @type {Trace[]} */
  const traces = [];
  const old = v.ghost.map((one) => pieces(one, v.over, () => true));
  if (old.length) {
    traces.push({
      id: "ghost",
      x: x(old.flatMap((line) => [...line.x, null])),
      y: y(old.flatMap((line) => [...line.y, null])),
      line: { color: p.line, width: 1.6 },
      column: "other model",
    });
  }
  v.pinned.forEach(({ name, series }, i) => {
    const lines = series.map((one) => pieces(one, v.over, () => true));
    traces.push({
      id: `pin${i}`,
      x: x(lines.flatMap((line) => [...line.x, null])),
      y: y(lines.flatMap((line) => [...line.y, null])),
      line: { color: p.second, width: 1.6, dash: PIN_DASHES[i % PIN_DASHES.length] },
      column: name,
    });
  });
  traces.push(...ranges(v, p, x, y), points(v, p, tints, x, y));
  v.series.forEach((one, i) => {
    if (isScattered(one, v.over)) {
      traces.push({
        id: `m${i}`,
        x: x(column(one, v.over)),
        y: y(one.predicted),
        marker: { size: 8, symbol: "line-ew", color: p.ink },
        column: "model",
      });
      return;
    }
    const parts = /** @type {const} */ ([
      ["", undefined, (/** @type {number} */ sign) => sign >= 0],
      ["-", "dash", (/** @type {number} */ sign) => sign < 0],
    ]);
    for (const [suffix, dash, belongs] of parts) {
      const line = pieces(one, v.over, belongs);
      if (!line.x.length) continue;
      traces.push({
        id: `m${i}${suffix}`,
        x: x(line.x),
        y: y(line.y),
        line: { color: tints[i], width: 1.8, dash },
        column: `${one.label}${dash ? ", shortening" : ""}`,
      });
    }
  });
  const [xLow, xHigh] = extent(v.series.map((one) => x(column(one, v.over))));
  const [low, high] = extent([
    ...v.series.flatMap((one) => [y(one.measured), y(one.predicted)]),
    y(v.reversals?.measured ?? []),
    v.over === "time" ? [] : [0], // a small swing far from 0 would be a flat line
  ]);
  const name = capitalized(channelWords(v.channel));
  return {
    x: {
      title: axisTitle(title, quantity, system),
      range: padded(steadyX(`cmp${v.picture}${v.over}`, xLow, xHigh)),
    },
    y: {
      title: `${name} (${s.unit})`,
      range: steadyRange(`cmp${v.picture}${v.channel}${system}`, low, high),
    },
    traces,
    zones: brushZone(v),
    revision: `${v.picture}${v.over}${system}`,
    ...names(v, tints, x, y),
    table: table(v, ["measured", "predicted"]),
  };
}

/** Lines whose ends are this share of the axis apart end together. */
const TOGETHER = 0.2;
/** Room of a name beside its line, and of each letter of it. */
const ROOM_PX = 8, LETTER_PX = 8;

/** The pressure of each line: beside the axes where the lines end together, else at one of its ends.
 * @param {View} v @param {string[]} tints @param {(values: (number | null)[]) => (number | null)[]} x
 * @param {(values: (number | null)[]) => (number | null)[]} y
 * @returns {Pick<Spec, "room" | "labels">} */
function names(v, tints, x, y) {
  const isNamed = v.over !== "time" && v.series.length > 1 &&
    v.series.every((s) => s.pressure !== null && s.use !== "validation");
  if (!isNamed) return {};
  const ends = v.series.flatMap((s, i) => {
    const across = x(column(s, v.over)), up = y(s.predicted);
    const rows = [...across.keys()].filter((k) => across[k] !== null && up[k] !== null)
      .sort((a, b) => (across[a] ?? 0) - (across[b] ?? 0));
    const at = (/** @type {number | undefined} */ k) =>
      k === undefined ? null : { x: across[k] ?? 0, y: up[k] ?? 0 };
    const start = at(rows[0]), end = at(rows.at(-1));
    return start && end
      ? [{ start, end, text: pressureText(s.pressure ?? 0, v.system), color: tints[i] }]
      : [];
  });
  const all = ends.flatMap((e) => [e.start.x, e.end.x]), right = ends.map((e) => e.end.x);
  const span = Math.max(...all) - Math.min(...all);
  const together = Math.max(...right) - Math.min(...right) <= TOGETHER * span;
  return {
    room: ROOM_PX + LETTER_PX * Math.max(...ends.map((e) => e.text.length)),
    labels: ends.map(({ start, end, text, color }) =>
      together ? { ...end, text, color } : { ...start, text, color, end }
    ),
  };
}

/** Every point of a plot. @param {View} v @param {("measured" | "predicted" | "residual")[]} what
 * @returns {import("../../../ui/table.js").Table} */
export function table(v, what) {
  const { title, quantity } = VARIABLES[v.over], s = channelScale(v.unit, v.channel, v.system);
  const asText = (/** @type {number | null} */ si, /** @type {string} */ name) =>
    si == null ? null : name === "residual" ? si / s.factor : toShown(si, s);
  return {
    columns: [
      { title: "series", text: true },
      { title: inSentence(title), unit: scaleOf(quantity, v.system).unit },
      ...what.map((name) => ({ title: name, unit: s.unit })),
    ],
    rows: v.series.flatMap((one) => {
      const x = shown(column(one, v.over), quantity, v.system);
      return one.measured.map((
        _m,
        i,
      ) => [one.label, x[i], ...what.map((name) => asText(one[name][i], name))]);
    }),
  };
}

/** @param {View} v @param {Palette} p @param {string[]} tints
 * @param {(values: (number | null)[]) => (number | null)[]} x
 * @param {(values: (number | null)[]) => (number | null)[]} y @returns {Trace} */
function points(v, p, tints, x, y) {
  const each = (/** @type {(s: Series, i: number, k: number) => string} */ of) =>
    v.series.flatMap((s, k) => s.measured.map((_m, i) => of(s, i, k)));
  const alone = isAlone(v.series);
  const many = v.series.reduce((sum, s) => sum + s.measured.length, 0) > MANY;
  return {
    id: "points",
    x: x(v.series.flatMap((s) => column(s, v.over))),
    y: y(v.series.flatMap((s) => s.measured)),
    marker: {
      size: many ? 4 : 5,
      symbol: each((s, i) =>
        s.use === "validation" ? "triangle-up" : (s.direction?.[i] ?? 0) < 0 ? "square-open" : "circle"
      ),
      color: each((s, i, k) =>
        !isInside(s, i, v.brush) ? p.line : alone ? p.soft : many ? faint(tints[k]) : tints[k]
      ),
    },
    column: "measured",
  };
}

/** The range of friction at each reading where the motion turns, and the reading.
 * @param {View} v @param {Palette} p
 * @param {(values: (number | null)[]) => (number | null)[]} x
 * @param {(values: (number | null)[]) => (number | null)[]} y @returns {Trace[]} */
function ranges(v, p, x, y) {
  const r = v.reversals;
  if (!r) return [];
  const at = x(atReversals(r, v.over)), low = y(r.low), high = y(r.high);
  return [
    {
      id: "ranges",
      x: at.flatMap((one) => [one, one, null]),
      y: at.flatMap((_one, i) => [low[i], high[i], null]),
      line: { color: p.line, width: 4 },
      column: "range of friction",
    },
    {
      id: "reversals",
      x: at,
      y: y(r.measured),
      marker: { size: 7, symbol: "diamond-open", color: p.ink },
      column: "at a reversal",
    },
  ];
}

/** @param {View} v the brush as a shaded zone, if its variable is the x axis */
function brushZone({ brush, over, system }) {
  const range = brush?.[over];
  if (!range) return [];
  const [from, to] = shown(range, VARIABLES[over].quantity, system);
  return [{ x: /** @type {[number, number]} */ ([from, to]), y: null, text: "" }];
}

/** @param {number} pressure @param {System} system */
export function pressureText(pressure, system) {
  const s = scaleOf("pressure", system);
  return `${number(toShown(pressure, s), 2)} ${s.unit}`;
}
