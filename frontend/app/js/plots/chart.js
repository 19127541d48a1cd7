// @ts-check
// One plot: a specification drawn by Plotly; when only data changed, its lines are moved in place (patch.js).
import { palette } from "./theme.js";
import { canPatch, patch } from "./patch.js";
import { plotly } from "./library.js";

/** @typedef {import("./theme.js").Palette} Palette */
/** `marks`: where it has marks, with their texts, instead of round numbers.
 * `bare`: without its numbers, which stand below the last of several plots.
 * @typedef {{title: string, range: [number, number], right?: boolean, bare?: boolean,
 *   marks?: {at: number, text: string}[]}} Axis */
/** A line or a set of points. `axis: 2` draws against the right axis; `column` is its name in the table.
 * @typedef {{id: string, x: (number | null)[], y: (number | null)[], line?: {color: string, width?: number,
 *   dash?: string}, marker?: {size: number, symbol: string | string[], color: string | string[],
 *   edge?: string}, axis?: 2, column?: string}} Trace */
/** `above`: its name stands above or below it, because points fill it.
 * @typedef {{x: [number, number] | null, y: [number, number] | null, text: string, above?: boolean}} Zone */
/** `end`: the other end of the line; `along`: its points, where the name may go too.
 * @typedef {{text: string, x: number, y: number, color: string, end?: {x: number, y: number},
 *   along?: (readonly [number | null | undefined, number | null | undefined])[]}} Label */
/** A shaded range of x; `kind` is its CSS class. @typedef {{x: [number, number], kind: string}} Band */
/** What both axes show, in shown units. @typedef {{x: [number, number], y: [number, number]}} Ranges */
/** `room`: width at the right for names of the lines; `level`: the load line; `marks`: vertical lines; `brush`: dragging chooses a range of x, null: all of it;
 * `zoomed`: called with the zoom, which the caller gives back as the ranges of the axes; `table`: the values to
 * export if they are not simply the lines.
 * @typedef {{x: Axis, y: Axis, y2?: Axis, traces: Trace[], zones: Zone[], labels?: Label[],
 *   revision: string, room?: number, level?: {y: number, text: string}, bands?: Band[], marks?: number[],
 *   states?: {title: string, isSo: boolean[]}[],
 *   brush?: (range: [number, number] | null) => void, zoomed?: (ranges: Ranges | null) => void,
 *   table?: import("../ui/table.js").Table}} Spec */

const SETTLE_MS = 300;

/** @param {Axis} axis @param {Palette} p @param {boolean} [small] */
const axisLayout = (axis, p, small) => ({
  title: { text: small ? "" : axis.title, font: { size: 12, color: p.soft }, standoff: 8 },
  range: axis.range,
  gridcolor: p.grid,
  linecolor: p.line,
  tickcolor: p.line,
  ticks: "outside",
  ticklen: 4,
  showline: true,
  zeroline: axis.range[0] < 0 && !axis.right,
  zerolinecolor: p.line,
  nticks: small ? 5 : 7,
  ...(axis.marks
    ? {
      tickmode: "array",
      tickvals: axis.marks.map((m) => m.at),
      ticktext: axis.marks.map((m) => m.text),
    }
    : { tickmode: "auto" }),
  tickfont: { color: p.soft },
  automargin: false,
  showticklabels: !axis.bare,
  showgrid: !axis.right,
});

/** Plotly's data and layout of a specification.
 * @param {Spec} spec @param {Palette} p @param {{width: number, height: number, font: string, small?: boolean}} box
 * `small`: a strip, whose head says what its axes are */
export function figure(spec, p, box) {
  const data = spec.traces.map((t) => {
    const common = { uid: t.id, x: t.x, y: t.y, yaxis: t.axis === 2 ? "y2" : "y", type: "scatter" };
    const look = { hoverinfo: "skip", name: t.column ?? t.id };
    if (!t.marker) {
      return { ...common, ...look, mode: "lines", line: { simplify: false, width: 2, ...t.line } };
    }
    const { size, symbol, color, edge } = t.marker;
    return {
      ...common,
      ...look,
      mode: "markers",
      marker: { size, symbol, color, line: { width: 1.4, color: edge ?? color } },
    };
  });
  const layout = {
    width: box.width,
    height: box.height,
    margin: box.small
      ? { l: 44, r: spec.y2 ? 34 : spec.room ?? 8, t: 6, b: spec.x.bare ? 5 : 20 }
      : { l: 58, r: spec.y2 ? 54 : spec.room ?? 14, t: 10, b: 44 },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: box.font, size: 12, color: p.ink },
    showlegend: false,
    hovermode: false,
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    uirevision: spec.revision,
    xaxis: axisLayout(spec.x, p, box.small),
    yaxis: { ...axisLayout(spec.y, p, box.small), fixedrange: Boolean(spec.brush) },
    ...(spec.y2 ? { yaxis2: { ...axisLayout(spec.y2, p, box.small), overlaying: "y", side: "right" } } : {}),
    shapes: spec.zones.map((z) => ({
      type: "rect",
      layer: "below",
      xref: z.x ? "x" : "paper",
      yref: z.y ? "y" : "paper",
      x0: z.x?.[0] ?? 0,
      x1: z.x?.[1] ?? 1,
      y0: z.y?.[0] ?? 0,
      y1: z.y?.[1] ?? 1,
      fillcolor: p.zone,
      line: { width: 0 },
    })),
  };
  return { data, layout };
}

/** Everything of a figure except the numbers of its lines: if this stays the same, the plot can be patched.
 * @param {{data: any[], layout: any}} fig */
const signature = ({ data, layout }) =>
  JSON.stringify([layout, data.map(({ x: _x, y: _y, ...style }) => style)]);

/** When the browser has time; Safari has no idle callbacks. @param {() => void} fn */
const whenIdle = (fn) => "requestIdleCallback" in globalThis ? requestIdleCallback(fn) : setTimeout(fn);

export class Chart {
  /** @param {HTMLElement} host the element that becomes the plot @param {string} name used in file names
   * @param {boolean} [small] */
  constructor(host, name, small = false) {
    this.small = small;
    this.host = host;
    this.name = name;
    /** @type {((p: Palette) => Spec) | null} */
    this.build = null;
    /** @type {Spec | null} */
    this.spec = null;
    /** @type {Set<() => void>} called after every drawing, for overlays */
    this.after = new Set();
    this.drawnAs = "";
    this.settle = 0;
    /** @type {{data: any[], layout: any} | null} */
    this.newest = null;
    this.canvas = document.createElement("div");
    this.canvas.className = "canvas";
    this.canvas.setAttribute("aria-hidden", "true");
    this.over = document.createElement("div");
    this.over.className = "over";
    host.append(this.canvas, this.over);
    this.width = 0;
    this.height = 0;
    // Reading the size during a redraw would make the browser lay out the page in the middle of it.
    new ResizeObserver(([entry]) => {
      this.width = Math.round(entry.contentRect.width);
      this.height = Math.round(entry.contentRect.height);
      this.draw();
    }).observe(host);
  }

  /** @param {(p: Palette) => Spec} build */
  show(build) {
    this.build = build;
    this.draw();
  }

  draw() {
    const { width, height } = this;
    if (!this.build || !plotly() || width < 60 || height < 60) return;
    this.spec = this.build(palette.peek());
    const font = "Inter, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";
    const fig = figure(this.spec, palette.peek(), { width, height, font, small: this.small });
    const now = signature(fig);
    clearTimeout(this.settle);
    this.newest = fig;
    if (now === this.drawnAs && canPatch(this.canvas, fig.data)) {
      patch(this.canvas, fig.data);
      this.settle = setTimeout(() => whenIdle(() => this.newest === fig && this.full(fig, now)), SETTLE_MS);
    } else this.full(fig, now);
    this.after.forEach((fn) => fn());
  }

  /** @param {{data: any[], layout: any}} fig @param {string} now */
  full(fig, now) {
    const first = !this.drawnAs;
    this.drawnAs = now;
    const doubleClick = this.spec?.brush || this.spec?.zoomed ? false : "reset";
    plotly().react(this.canvas, fig.data, fig.layout, { displayModeBar: false, doubleClick });
    if (!first) return;
    const canvas = /** @type {any} */ (this.canvas);
    canvas.on("plotly_relayout", (/** @type {Record<string, number>} */ change) => {
      this.after.forEach((fn) => fn());
      const from = change["xaxis.range[0]"], to = change["xaxis.range[1]"];
      if (from !== undefined) this.spec?.brush?.([from, to]);
      const { xaxis, yaxis } = this.axes;
      this.spec?.zoomed?.({ x: [xaxis.range[0], xaxis.range[1]], y: [yaxis.range[0], yaxis.range[1]] });
    });
    canvas.on("plotly_doubleclick", () => (this.spec?.brush ?? this.spec?.zoomed)?.(null));
  }

  unzoom() {
    const spec = this.spec;
    if (!spec) return;
    const kept = spec.brush ?? spec.zoomed;
    if (kept) return kept(null);
    const y2 = spec.y2 ? { "yaxis2.range": spec.y2.range } : {};
    plotly().relayout(this.canvas, { "xaxis.range": spec.x.range, "yaxis.range": spec.y.range, ...y2 });
  }

  /** Pixel geometry of the axes as they are now, zoomed or not. @returns {any | null} */
  get axes() {
    const layout = /** @type {any} */ (this.canvas)._fullLayout;
    return layout?.xaxis?._length ? layout : null;
  }
}
