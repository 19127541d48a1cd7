// @ts-check
// Plots as PNG, SVG, CSV or table: always on white, whatever the theme, with all data.
import { figure } from "./chart.js";
import { plotly } from "./library.js";
import { LIGHT } from "./theme.js";
import { openDialog } from "../ui/dialog.js";
import { dataTable, download, downloadText, toCsv } from "../ui/table.js";

/** @typedef {import("./chart.js").Chart} Chart */

const WIDTH = 800, HEIGHT = 480;
const FONT = "Arial, 'Liberation Sans', sans-serif";

/** @param {Chart} chart @param {string} title @returns {Promise<string>} SVG text */
async function svgOf(chart, title) {
  if (!chart.build) return "";
  const spec = chart.build(LIGHT);
  const { data, layout } = figure(spec, LIGHT, { width: WIDTH, height: HEIGHT, font: FONT });
  const x = chart.axes?.xaxis.range ?? spec.x.range, y = chart.axes?.yaxis.range ?? spec.y.range;
  const names = new Map((spec.labels ?? []).map((l) => [l.color, l.text]));
  const named = new Set(); // a line drawn in pieces has one entry in the legend
  for (const t of /** @type {any[]} */ (data)) {
    t.name = names.get(t.line?.color) ?? t.name;
    t.showlegend = !named.has(t.name) && (t.mode === "lines" || t.uid === "points");
    named.add(t.name);
  }
  const full = {
    ...layout,
    title: { text: title, x: 0.02, font: { size: 15 } },
    margin: { ...layout.margin, t: 44, r: 150 },
    paper_bgcolor: "#ffffff",
    showlegend: true,
    legend: { x: 1.1, y: 1, font: { size: 11 } },
    xaxis: { ...layout.xaxis, range: x },
    yaxis: { ...layout.yaxis, range: y },
    shapes: [...layout.shapes, ...bands(spec), ...(spec.level ? [level(spec.level.y)] : [])],
    annotations: notes(spec),
  };
  const url = await plotly().toImage({ data, layout: full }, { format: "svg", width: WIDTH, height: HEIGHT });
  return decodeURIComponent(url.slice(url.indexOf(",") + 1));
}

/** Bands along an edge of the plot, as shares of its height; all others fill it.
 * @type {Record<string, [number, number]>} */
const EDGES = { contact: [0, 0.03], slack: [0.04, 0.07], stuck: [0.08, 0.1] };

/** @type {Record<string, string>} */
const EDGES_COLOUR = { contact: LIGHT.soft, slack: LIGHT.ink, stuck: LIGHT.load };

/** Bands and marks, which the page draws under the plot. @param {import("./chart.js").Spec} spec */
const bands = (spec) => [
  ...(spec.bands ?? []).map(({ x, kind }) => ({
    type: "rect",
    layer: "below",
    yref: "paper",
    x0: x[0],
    x1: x[1],
    y0: EDGES[kind]?.[0] ?? 0,
    y1: EDGES[kind]?.[1] ?? 1,
    fillcolor: EDGES_COLOUR[kind] ?? LIGHT.zone,
    line: { width: 0 },
  })),
  ...(spec.marks ?? []).map((x) => ({
    type: "line",
    yref: "paper",
    x0: x,
    x1: x,
    y0: 0,
    y1: 1,
    line: { color: LIGHT.soft, dash: "dot", width: 1 },
  })),
];

/** @param {number} y */
const level = (y) => ({
  type: "line",
  xref: "paper",
  x0: 0,
  x1: 1,
  y0: y,
  y1: y,
  line: { color: LIGHT.load, dash: "dash", width: 2 },
});

/** The texts that the page writes over the plot: the load, and the names of the shaded zones.
 * @param {import("./chart.js").Spec} spec */
function notes(spec) {
  const common = { showarrow: false, font: { size: 11, color: LIGHT.soft } };
  const zones = spec.zones.map((zone) =>
    zone.x
      ? {
        ...common,
        text: zone.text,
        textangle: "90",
        x: (zone.x[0] + zone.x[1]) / 2,
        yref: "paper",
        y: 0.98,
        yanchor: "top",
      }
      : {
        ...common,
        text: zone.text,
        xref: "paper",
        x: 0.9,
        xanchor: "right",
        y: zone.y?.[0] ?? 0,
        yanchor: "bottom",
      }
  );
  if (!spec.level) return zones;
  const font = { size: 12, color: LIGHT.load };
  const load = {
    ...common,
    font,
    text: spec.level.text,
    xref: "paper",
    x: 1,
    xanchor: "right",
    y: spec.level.y,
  };
  return [...zones, { ...load, yanchor: "bottom" }];
}

/** @param {string} svg @param {number} width @param {number} height
 * @returns {Promise<Blob>} at twice the size */
async function pngOf(svg, width, height) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = 2 * width;
  canvas.height = 2 * height;
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  pen.fillStyle = "#ffffff";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, fail) =>
    canvas.toBlob((blob) => blob ? done(blob) : fail(new Error("The browser could not write the PNG.")))
  );
}

/** All plots on one sheet, two by two. @param {{title: string, chart: Chart}[]} charts */
async function sheet(charts) {
  const parts = await Promise.all(charts.map(({ chart, title }) => svgOf(chart, title)));
  const placed = parts.map((svg, i) =>
    svg.replace("<svg ", `<svg x="${(i % 2) * WIDTH}" y="${Math.floor(i / 2) * HEIGHT}" `)
      // Plotly numbers its clip paths per figure: two figures in one file must not share them.
      .replace(/(id="|url\(#|href="#)/g, `$1p${i}-`)
  );
  const width = 2 * WIDTH, height = Math.ceil(parts.length / 2) * HEIGHT;
  const open = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}">`;
  return { svg: `${open}${placed.join("")}</svg>`, width, height };
}

/** @param {{title: string, chart: Chart}[]} charts @param {"png" | "svg"} format @param {string} name */
export async function saveSheet(charts, format, name) {
  const { svg, width, height } = await sheet(charts);
  if (format === "svg") downloadText(`${name}.svg`, svg, "image/svg+xml");
  else download(`${name}.png`, await pngOf(svg, width, height));
}

/** The values of a plot: its own table, else one column for x and one for each line. @param {Chart} chart
 * @returns {import("../ui/table.js").Table} */
function chartTable(chart) {
  const spec = chart.spec;
  if (spec?.table) return spec.table;
  const lines = spec?.traces.filter((t) => t.line) ?? [], states = spec?.states ?? [];
  const [xTitle, xUnit] = split(spec?.x.title ?? "");
  const [, yUnit] = split(spec?.y.title ?? ""), [, rightUnit] = split(spec?.y2?.title ?? "");
  return {
    columns: [
      { title: xTitle, unit: xUnit },
      ...lines.map((t) => ({ title: t.column ?? t.id, unit: t.axis === 2 ? rightUnit : yUnit })),
      ...states.map(({ title }) => ({ title, text: true })),
    ],
    rows: (lines[0]?.x ?? []).map((x, i) => [
      x,
      ...lines.map((t) => t.y[i] ?? null),
      ...states.map(({ isSo }) => Number(isSo[i])),
    ]),
  };
}
/** "Force (N)" → ["Force", "N"]. @param {string} title */
const split = (title) => /^(.*?) \((.*)\)$/.exec(title)?.slice(1) ?? [title, ""];

/** @param {Chart} chart @param {string} title
 * @returns {import("../ui/menu.js").Item[]} */
export function chartMenu(chart, title) {
  const name = `mckibben-${chart.name}`;
  return [
    {
      label: "Show as table",
      run: () => openDialog({ title, wide: true }, dataTable(chartTable(chart), title)),
    },
    { label: "Save as CSV", run: () => downloadText(`${name}.csv`, toCsv(chartTable(chart)), "text/csv") },
    {
      label: "Save as PNG",
      run: async () => download(`${name}.png`, await pngOf(await svgOf(chart, title), WIDTH, HEIGHT)),
    },
    {
      label: "Save as SVG",
      run: async () => downloadText(`${name}.svg`, await svgOf(chart, title), "image/svg+xml"),
    },
    { label: "Reset zoom", note: "or double click", run: () => chart.unzoom() },
  ];
}
