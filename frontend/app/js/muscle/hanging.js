// @ts-check
// A muscle with its load, drawn as it hangs: without pressure and at the pressure, to scale in length.
import { svg } from "../dom.js";

/** @typedef {{length: number, width: number, below: string, filled?: boolean}} Hanging  in m; `below`: its caption */
/** @typedef {{load: string, rise: string | null}} Labels  `rise`: null without an arrow */

const WIDTH = 172, TOP = 12, BOX = 22, FOOT = 18;

/** The outline of a muscle that hangs at x, with caps at both ends. @param {number} x @param {number} length
 * @param {number} bulge half width */
function outline(x, length, bulge) {
  const cap = 5, bend = Math.min(0.2 * length, 26), top = TOP + 6, end = TOP + length;
  const side = (/** @type {1 | -1} */ s) =>
    [
      `C${x + s * cap} ${top + bend / 2} ${x + s * bulge} ${top + bend / 2} ${x + s * bulge} ${top + bend}`,
      `L${x + s * bulge} ${end - bend}`,
      `C${x + s * bulge} ${end - bend / 2} ${x + s * cap} ${end - bend / 2} ${x + s * cap} ${end}`,
    ].join("");
  const back = `L${x - cap} ${end}C${x - cap} ${end - bend / 2} ${x - bulge} ${end - bend / 2} ${x - bulge} ${
    end - bend
  }L${x - bulge} ${top + bend}C${x - bulge} ${top + bend / 2} ${x - cap} ${top + bend / 2} ${
    x - cap
  } ${top}Z`;
  return `M${x - cap} ${top}L${x + cap} ${top}${side(1)}${back}`;
}

/** @param {Hanging[]} states the first one without pressure @param {Labels} labels @param {number} height [px] */
export function hanging(states, { load, rise }, height = 236) {
  const longest = Math.max(...states.map(({ length }) => length));
  const scale = (height - TOP - 2 * FOOT - BOX) / longest;
  const spread = WIDTH / (states.length + 0.9);
  const at = (/** @type {number} */ i) => spread * (i + 0.72);
  const box = Math.min(60, Math.max(34, 7 * load.length + 10));
  const nodes = states.flatMap(({ length, width, below, filled }, i) => {
    const x = at(i), end = TOP + length * scale;
    return [
      svg("path", {
        class: filled ? "muscle filled" : "muscle",
        d: outline(x, length * scale, Math.max(6, Math.min(20, (width * scale) / 2 * 1.4))),
      }),
      svg("path", { class: "rod", d: `M${x} ${end}v8` }),
      svg("rect", { class: "mass", x: x - box / 2, y: end + 8, width: box, height: BOX - 2, rx: 4 }),
      svg("text", { class: "mass-text", x, y: end + 22, "text-anchor": "middle" }, load),
      svg("text", { class: "caption", x, y: height - 3, "text-anchor": "middle" }, below),
    ];
  });
  const [low, high] = [states[0], states[states.length - 1]].map(({ length }) => TOP + length * scale);
  const right = at(states.length - 1) + box / 2 + 7;
  if (rise !== null && states.length > 1 && low > high) {
    nodes.push(
      svg("path", {
        class: "level",
        d: `M${at(0) + 12} ${low}H${right + 4}M${at(1) + 12} ${high}H${right + 4}`,
      }),
      svg("path", { class: "rise", d: `M${right} ${low}V${high + 2}m-4 6l4 -6l4 6` }),
    );
  }
  return svg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${height}`, width: WIDTH, height, class: "hanging", "aria-hidden": "true" },
    svg("path", { class: "ceiling", d: `M14 ${TOP}H${WIDTH - 14}` }),
    ...Array.from({ length: 18 }, (_, i) => svg("path", { class: "hatch", d: `M${18 + i * 8} ${TOP}l6 -6` })),
    ...nodes,
  );
}
