// @ts-check
// The small picture of a file: force over stroke, or what else it holds, drawn from a few hundred readings.
import { capitalized, niceStep, number, quantityOf, scaleOf, toShown } from "../format.js";
import { palette, pressureColour } from "../plots/theme.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("../format.js").System} System */
/** Values of a channel. @typedef {(number | null)[]} Values */

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 340, HEIGHT = 190, LEFT = 52, RIGHT = 10, TOP = 8, BOTTOM = 34;
const STROKES = ["displacement", "contraction", "length"];
/** @type {Record<string, string>} */
const NAMES = {
  displacement: "Stroke",
  contraction: "Contraction",
  length: "Length",
  force: "Force",
  pressure: "Pressure",
  time: "Time",
  diameter: "Diameter",
}; // deno-fmt-ignore

/** @param {Values} values */
function spread(values) {
  const there = values.filter((v) => v !== null);
  return there.length ? Math.max(...there) - Math.min(...there) : 0;
}

/** Which channels are drawn over which. @param {Pick<Preview, "points" | "kind">} p
 * @returns {{x: string, ys: string[]} | null} null: there is nothing to draw */
export function axesOf(p) {
  const { points } = p;
  const moves = (/** @type {string} */ name) => points[name] !== undefined && spread(points[name]) > 0;
  const stroke = STROKES.find(moves);
  const ys = [stroke, "pressure", "force", "diameter"].flatMap((name) => name && moves(name) ? [name] : []);
  if (p.kind === "transient" && moves("time")) return { x: "time", ys: ys.slice(0, 2) };
  if (moves("force") && stroke && p.kind !== "isometric") return { x: stroke, ys: ["force"] };
  if (moves("force") && moves("pressure")) return { x: "pressure", ys: ["force"] };
  const [first, second] = ys;
  if (second) return { x: "pressure", ys: [first === "pressure" ? second : first] };
  return moves("time") && first ? { x: "time", ys: [first] } : null;
}

/** @param {string} tag @param {Record<string, string | number>} attributes @param {string} [text] */
function shape(tag, attributes, text) {
  const el = document.createElementNS(SVG, tag);
  for (const [key, value] of Object.entries(attributes)) el.setAttribute(key, String(value));
  if (text !== undefined) el.textContent = text;
  return el;
}

/** An axis in shown units: place of a value, ticks. @param {Values} values @param {string} si
 * @param {System} system @param {number} from @param {number} to px */
function axis(values, si, system, from, to) {
  const quantity = quantityOf(si) ?? "number";
  const s = scaleOf(quantity === "number" ? "ratio" : quantity, system);
  const all = values.flatMap((v) => v === null ? [] : [toShown(v, s)]);
  let low = Math.min(...all), high = Math.max(...all);
  if (high <= low) [low, high] = [low - 1, high + 1];
  // From zero, unless that leaves most of the picture empty.
  if (low > 0 && low < 0.6 * high) low = 0;
  const step = niceStep((high - low) / 2.5), pad = 0.03 * (high - low);
  const at = (/** @type {number} */ shown) =>
    from + ((shown - low + pad) / (high - low + 2 * pad)) * (to - from);
  const ticks = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high + 1e-9 * step; tick += step) ticks.push(tick);
  return { at: (/** @type {number} */ v) => at(toShown(v, s)), ticks, tickAt: at, unit: s.unit };
}

/** What a picture is made of. @typedef {Pick<Preview, "points" | "kind" | "channel_choices">} Drawn */

/** @param {Drawn} p @param {System} system
 * @param {Drawn["points"]} [before] of the same channels, drawn pale: the readings before a preparation */
export function picture(p, system, before = {}) {
  const axes = axesOf(p), colours = palette.value;
  const svg = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "thumbnail", role: "img" });
  svg.setAttribute("aria-label", axes ? `${titleOf(axes)} of the file` : "Nothing to draw yet");
  if (!axes) {
    svg.append(
      shape("text", { x: WIDTH / 2, y: HEIGHT / 2, "text-anchor": "middle" }, "Nothing to draw yet"),
    );
    return svg;
  }
  const { points } = p;
  const si = (/** @type {string} */ name) => p.channel_choices.find((c) => c.name === name)?.si_unit ?? "1";
  const both = (/** @type {string} */ name) => [...points[name], ...before[name] ?? []];
  const across = axis(both(axes.x), si(axes.x), system, LEFT, WIDTH - RIGHT);
  const height = (HEIGHT - TOP - BOTTOM - 8 * (axes.ys.length - 1)) / axes.ys.length;
  const pressure = points.pressure, range = pressure ? spread(pressure) : 0;
  const lowest = pressure ? Math.min(...pressure.flatMap((v) => v === null ? [] : [v])) : 0;
  axes.ys.forEach((name, i) => {
    const top = TOP + i * (height + 8), up = axis(both(name), si(name), system, top + height, top);
    for (const tick of up.ticks) {
      const y = up.tickAt(tick);
      svg.append(
        shape("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y, class: "tick" }),
        shape("text", { x: LEFT - 6, y: y + 4, "text-anchor": "end" }, number(tick, 4)),
      );
    }
    svg.append(
      shape("line", { x1: LEFT, x2: LEFT, y1: top, y2: top + height, class: "axis" }),
      shape("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: top + height, y2: top + height, class: "axis" }),
      shape(
        "text",
        {
          transform: `translate(11 ${top + height / 2}) rotate(-90)`,
          "text-anchor": "middle",
          class: "name",
        },
        `${NAMES[name] ?? name}${up.unit ? ` (${up.unit})` : ""}`,
      ),
    );
    before[name]?.forEach((value, k) => {
      const x = before[axes.x]?.[k] ?? null;
      if (value === null || x === null) return;
      const place = { cx: across.at(x).toFixed(1), cy: up.at(value).toFixed(1), r: 1.6 };
      svg.append(shape("circle", { ...place, class: "before" }));
    });
    points[name].forEach((value, k) => {
      const x = points[axes.x][k], level = pressure?.[k];
      if (value === null || x === null) return;
      const share = range && level != null ? (level - lowest) / range : 0.5;
      svg.append(shape("circle", {
        cx: across.at(x).toFixed(1),
        cy: up.at(value).toFixed(1),
        r: 1.6,
        fill: pressureColour(share, colours),
      }));
    });
  });
  for (const tick of across.ticks) {
    svg.append(
      shape(
        "text",
        { x: across.tickAt(tick), y: HEIGHT - BOTTOM + 14, "text-anchor": "middle" },
        number(tick, 4),
      ),
    );
  }
  const title = `${NAMES[axes.x] ?? axes.x}${across.unit ? ` (${across.unit})` : ""}`;
  svg.append(
    shape("text", { x: (LEFT + WIDTH) / 2, y: HEIGHT - 4, "text-anchor": "middle", class: "name" }, title),
  );
  return svg;
}

/** @param {string} channel */
const nameOf = (channel) => NAMES[channel] ?? channel;

/** @param {{x: string, ys: string[]}} axes */
export const titleOf = ({ x, ys }) =>
  capitalized(`${ys.map(nameOf).join(" and ")} over ${nameOf(x)}`.toLowerCase());

/** Whether the readings behave as a muscle does: pulled harder it is longer, with more air it pulls harder.
 * @param {Preview} p @returns {{good: boolean, text: string} | null} null: the readings do not show it */
export function plausibility(p) {
  const { force, pressure } = p.points, stroke = p.points[STROKES.find((s) => p.points[s]) ?? ""];
  if (!force || !stroke || !pressure || !spread(force) || !spread(stroke)) return null;
  const lengthens = p.points.displacement === undefined && p.points.contraction === undefined;
  const [overStroke, overPressure] = slopes(force, stroke, pressure);
  const falls = lengthens ? overStroke > 0 : overStroke < 0, rises = !spread(pressure) || overPressure > 0;
  const first = `force ${falls ? "falls" : "grows"} as the muscle shortens`;
  const second = spread(pressure) ? ` and ${rises ? "rises" : "falls"} with pressure` : "";
  const good = falls && rises;
  return {
    good,
    text: good ? `Plausible: ${first}${second}.` : `Check signs and units: ${first}${second}.`,
  };
}

/** Slopes of a plane through z over (x, y), by least squares over scaled values.
 * @param {Values} z @param {Values} x @param {Values} y */
function slopes(z, x, y) {
  const scaled = (/** @type {Values} */ v) => {
    const all = v.map((one) => one ?? 0), mean = all.reduce((a, b) => a + b, 0) / all.length;
    const range = spread(v) || 1;
    return all.map((one) => (one - mean) / range);
  };
  const [a, b, c] = [scaled(x), scaled(y), scaled(z)];
  const dot = (/** @type {number[]} */ u, /** @type {number[]} */ v) =>
    u.reduce((s, one, i) => s + one * v[i], 0);
  const aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ac = dot(a, c), bc = dot(b, c);
  const det = aa * bb - ab * ab;
  if (det < 1e-9 * aa * bb || !bb) return [aa ? ac / aa : 0, bb ? bc / bb : 0];
  return [(ac * bb - bc * ab) / det, (bc * aa - ac * ab) / det];
}
