// @ts-check
// One picture of the atlas: the residual over what moves, a line for each run, the residual of the case as dots.
import { h, svg } from "../../../dom.js";
import { number, plainScale, quantityOf, readable, scaleOf, toShown } from "../../../format.js";
import { units } from "../../../state.js";
import { seen } from "../../../muscle/seen.js";

/** @typedef {import("./answers.js").Picture} Picture */

const WIDE = 240, HIGH = 96, EDGE = 5, AXIS = 34, MOST_DOTS = 250;
/** @type {Record<string, string>} */
const NAMES = { contraction: "ε", pressure: "P", time: "time", length: "L" };

/** @param {string} unit @param {string} name */
function scale(unit, name) {
  if (unit === "1") return scaleOf("ratio", units.value);
  const quantity = quantityOf(unit, name);
  return quantity ? scaleOf(quantity, units.value) : plainScale(unit);
}
/** Three significant figures. @param {number} value */
const short = (value) => number(Number(value.toPrecision(3)), 6);
/** @param {number} si @param {import("../../../format.js").Scale} s */
const shown = (si, s) => `${short(si / s.factor)}\u00a0${s.unit}`;

/** The residual of the case where it was seen in the same kind of test. @param {Picture} p */
function dots(p) {
  const now = seen.value, across = now?.points[p.x];
  if (!now || !across || now.kind !== p.kind || now.quantity !== p.quantity) return [];
  const every = Math.max(1, Math.ceil(now.residual.length / MOST_DOTS));
  return now.residual.flatMap((y, i) => {
    const x = across[i];
    return y === null || x == null || i % every ? [] : [[x, y]];
  });
}

/** The axis of the residual: its line, and numbers at both ends and at zero.
 * @param {number} most in the shown unit @param {number} left */
const axes = (most, left) => [
  svg("line", { class: "zero", x1: left, x2: left, y1: EDGE, y2: HIGH - EDGE }),
  ...[1, 0, -1].map((share) =>
    svg(
      "text",
      { class: "tick", x: left - 4, y: HIGH / 2 - share * (HIGH / 2 - EDGE - 4) + 3, "text-anchor": "end" },
      `${share > 0 ? "+" : ""}${short(share * most)}`,
    )
  ),
];

/** @param {Picture} p @param {string} title of the effect
 * @param {boolean} [named] whether the picture names the reading, because that beside it shows another
 * @param {boolean} [large] with axes */
export function picture(p, title, named = false, large = false) {
  const over = dots(p);
  const xs = [...p.curves.flatMap((c) => c.x), ...over.map(([x]) => x)];
  const ys = [...p.curves.flatMap((c) => c.y), ...over.map(([, y]) => y)];
  const low = Math.min(...xs), wide = Math.max(...xs) - low || 1;
  const most = Math.max(...ys.map(Math.abs)) || 1;
  const left = large ? AXIS : EDGE;
  const atX = (/** @type {number} */ x) => left + ((x - low) / wide) * (WIDE - EDGE - left);
  const atY = (/** @type {number} */ y) => HIGH / 2 - (y / most) * (HIGH / 2 - EDGE);
  const sx = scale(p.x_unit, p.x), sy = scale(p.unit, p.quantity), held = scale(p.held_unit, p.held);
  const words = `${title}, ${p.kind} test: residual of the ${p.quantity} over ${readable(p.x)}, rms ${
    shown(p.rms, sy)
  }`;
  const lines = p.curves.map((c, i) =>
    svg("polyline", {
      class: `run run-${p.curves.length < 2 ? 2 : i % 3}`,
      points: c.x.map((x, k) => `${atX(x).toFixed(1)},${atY(c.y[k]).toFixed(1)}`).join(" "),
    })
  );
  const drawing = svg(
    "svg",
    { viewBox: `0 0 ${WIDE} ${HIGH}`, role: "img", "aria-label": words, class: "signature" },
    svg("line", { class: "zero", x1: large ? left : 0, x2: WIDE, y1: HIGH / 2, y2: HIGH / 2 }),
    ...(large ? axes(most / sy.factor, left) : []),
    ...over.map(([x, y]) => svg("circle", { class: "seen", cx: atX(x), cy: atY(y), r: 1.6 })),
    ...lines,
  );
  const xName = NAMES[p.x] ?? readable(p.x);
  const levels = p.curves.map((c) => c.level).filter((level) => level !== null);
  return h(
    "figure",
    { class: "signature-figure" },
    h(
      "figcaption",
      null,
      h("b", null, p.kind, named ? `, ${readable(p.quantity)}` : ""),
      h("span", null, `±\u2009${shown(most, sy)}`),
    ),
    drawing,
    h(
      "small",
      null,
      h("span", { title: readable(p.x) }, `${xName} ${short(toShown(low, sx))} … ${shown(low + wide, sx)}`),
      levels.length
        ? h(
          "span",
          { title: `The lines: ${readable(p.held)}` },
          `at ${levels.map((v) => short(v / held.factor)).join(", ")}\u00a0${held.unit}`,
        )
        : null,
    ),
  );
}
