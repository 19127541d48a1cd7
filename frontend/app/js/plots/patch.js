// @ts-check
// Moves the lines and points of a plot while a slider moves. Plotly.react spends 10 ms per plot on defaults, axes
// and text even if only numbers changed; the axes stay the same meanwhile, so it is enough to move the paths of
// the lines and the points: under 1 ms. Once the slider rests, chart.js lets Plotly draw the same data.

/** @param {any} axis @param {number} v */
const pixel = (axis, v) => Math.round(axis.c2p(v) * 100) / 100;

/** @param {Element} plot @param {string} uid */
const group = (plot, uid) => plot.querySelector(`.scatterlayer > .trace${uid}`);

/** True if Plotly's drawing has exactly the nodes that patch() moves.
 * @param {Element} plot @param {any[]} data */
export function canPatch(plot, data) {
  if (!(/** @type {any} */ (plot)._fullLayout?.xaxis)) return false;
  return data.every((t) => {
    const node = group(plot, t.uid);
    if (t.mode === "markers") return node?.querySelectorAll(".point").length === kept(t).length;
    return node?.querySelectorAll("path.js-line").length === 1;
  });
}

/** Indices of the points that exist. @param {{x: (number | null)[], y: (number | null)[]}} t */
const kept = (t) => [...t.x.keys()].filter((i) => t.x[i] != null && t.y[i] != null);

/** @param {Element} plot @param {any[]} data the traces, in the shape and number of the last full drawing */
export function patch(plot, data) {
  const layout = /** @type {any} */ (plot)._fullLayout;
  for (const t of data) {
    const node = /** @type {Element} */ (group(plot, t.uid));
    const xaxis = layout.xaxis, yaxis = t.yaxis === "y2" ? layout.yaxis2 : layout.yaxis;
    if (t.mode === "markers") {
      const points = node.querySelectorAll(".point");
      kept(t).forEach((i, k) =>
        points[k].setAttribute("transform", `translate(${pixel(xaxis, t.x[i])},${pixel(yaxis, t.y[i])})`)
      );
    } else node.querySelector("path.js-line")?.setAttribute("d", path(t, xaxis, yaxis));
  }
}

/** @param {{x: (number | null)[], y: (number | null)[]}} t @param {any} xaxis @param {any} yaxis */
function path(t, xaxis, yaxis) {
  let d = "", pen = "M";
  for (let i = 0; i < t.x.length; i++) {
    const x = t.x[i], y = t.y[i];
    if (x == null || y == null) pen = "M";
    else {
      d += `${pen}${pixel(xaxis, x)},${pixel(yaxis, y)}`;
      pen = "L";
    }
  }
  return d || "M0,0";
}
