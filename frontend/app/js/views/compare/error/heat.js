// @ts-check
// Where the model fails: a map of the residual over two variables, and sentences.
import { h } from "../../../dom.js";
import { units } from "../../../state.js";
import { number, scaleOf, toShown } from "../../../format.js";
import { bin, scaleNote, scaleOf as heatScaleOf, scaleSwitch } from "./heat-scale.js";
import { brush, fault, lookCompare, shown, stale } from "../answers.js";
import { channelScale, errorText, rangeText, VARIABLES } from "../words.js";

/** @typedef {import("../types.js").HeatMap} HeatMap */
/** @typedef {import("../types.js").Where} Where */
/** @typedef {import("../types.js").Comparison} Comparison */

/** @param {number} share −1…1 of the full colour */
const tint = (share) => {
  const size = Math.round(100 * Math.min(1, Math.abs(share)));
  return `background:color-mix(in srgb, var(${
    share < 0 ? "--heat-low" : "--heat-high"
  }) ${size}%, var(--heat-zero))`;
};

/** @param {HeatMap} map @param {number} ix @param {number} iy */
const isChosen = (map, ix, iy) => {
  const b = brush.value;
  return JSON.stringify([b?.[map.x], b?.[map.y]]) ===
    JSON.stringify([bin(map.x_edges, ix), bin(map.y_edges, iy)]);
};

/** @param {KeyboardEvent} event */
function walk(event) {
  const cell = /** @type {HTMLElement} */ (event.target);
  const [ix, iy] = (cell.dataset.at ?? "0,0").split(",").map(Number);
  /** @type {Record<string, [number, number]>} */
  const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  if (event.key === "Escape") lookCompare({ brush: null });
  const move = by[event.key];
  if (!move) return;
  event.preventDefault();
  const grid = cell.closest("table");
  const next = grid?.querySelector(`[data-at="${ix + move[0]},${iy + move[1]}"]`);
  if (!(next instanceof HTMLElement)) return;
  cell.tabIndex = -1;
  next.tabIndex = 0;
  next.focus();
}

/** @param {Comparison} a @param {HeatMap} map */
function grid(a, map) {
  const system = units.value, spanned = heatScaleOf(a, map), { most } = spanned;
  const xs = VARIABLES[map.x], ys = VARIABLES[map.y];
  if (!xs || !ys) return null;
  const asText = (/** @type {typeof xs} */ v, /** @type {number} */ si) =>
    number(toShown(si, scaleOf(v.quantity, system)), 1);
  const rows = [...map.mean.keys()].reverse();
  const columns = [...Array(map.x_edges.length - 1).keys()];
  /** @param {number} ix @param {number} iy */
  const cell = (ix, iy) => {
    const mean = map.mean[iy]?.[ix], count = map.count[iy]?.[ix] ?? 0;
    const at = `${rangeText(map.x, bin(map.x_edges, ix), system)}, ${
      rangeText(map.y, bin(map.y_edges, iy), system)
    }`;
    if (mean == null || !count) return h("td", null, h("span", { class: "none" }));
    const text = `${at}: mean ${errorText(mean, a.unit, a.predicted, system)}, RMS ${
      errorText(map.rms[iy][ix], a.unit, a.predicted, system)
    }, ${count} rows`;
    return h(
      "td",
      null,
      h("button", {
        type: "button",
        style: tint(mean / most),
        title: text,
        "aria-label": text,
        "aria-pressed": () => String(isChosen(map, ix, iy)),
        "data-at": `${ix},${iy}`,
        tabindex: -1,
        onkeydown: walk,
        onclick: () =>
          lookCompare({
            brush: isChosen(map, ix, iy)
              ? null
              : { [map.x]: bin(map.x_edges, ix), [map.y]: bin(map.y_edges, iy) },
          }),
      }),
    );
  };
  const table = h(
    "table",
    { class: "heat" },
    h(
      "caption",
      { class: "unseen" },
      `Mean residual over ${xs.title.toLowerCase()} and ${ys.title.toLowerCase()}`,
    ),
    h(
      "tbody",
      null,
      ...rows.map((iy) =>
        h(
          "tr",
          null,
          h("th", { scope: "row" }, asText(ys, bin(map.y_edges, iy)[0])),
          ...columns.map((ix) => cell(ix, iy)),
        )
      ),
      h(
        "tr",
        null,
        h("td", null),
        ...columns.map((ix) => h("th", { scope: "col" }, asText(xs, bin(map.x_edges, ix)[0]))),
      ),
    ),
  );
  table.querySelector("button")?.setAttribute("tabindex", "0");
  const s = channelScale(a.unit, a.predicted, system);
  const end = errorText(most, a.unit, a.predicted, system);
  return [
    h(
      "p",
      { class: "axis-note" },
      `↑ ${ys.title.toLowerCase()} (${scaleOf(ys.quantity, system).unit})`,
      h("span", { class: "space" }),
      `→ ${xs.title.toLowerCase()} (${scaleOf(xs.quantity, system).unit})`,
    ),
    table,
    h(
      "p",
      { class: "heat-key" },
      `−${end}`,
      h("i", { class: "ramp", "aria-hidden": "true" }),
      `+${end}`,
      h("small", null, s.unit ? "measured − model" : "measured − model, over noise"),
    ),
    h("p", { class: "heat-note muted" }, scaleNote(a, map, spanned)),
  ];
}

/** @param {Where} w @param {Comparison} a */
const sentenceOf = (w, a) =>
  `${Math.round(100 * w.share_explained)} % of the error depends on the ${
    VARIABLES[w.over]?.title.toLowerCase() ?? w.over
  }; ` +
  `worst at ${w.worst}, RMS ${errorText(w.rmse, a.unit, a.predicted, units.value)}.`;

/** @param {Comparison} a */
function inWords(a) {
  const where = a.where ?? [];
  const sentences = a.sentences?.length
    ? a.sentences.map((text) => ({ text, over: "" }))
    : where.filter((w) => w.share_explained > 0.03).slice(0, 4).map((w) => ({
      text: sentenceOf(w, a),
      over: w.over,
    }));
  const clickable = where.filter((w) => ["contraction", "pressure", "velocity", "time"].includes(w.over))
    .slice(0, 4);
  return [
    sentences.length
      ? h(
        "ul",
        { class: "where-words" },
        ...sentences.map(({ text }) => h("li", null, text.replace(/(^| )-(?=\d)/g, "$1−"))),
      )
      : h("p", { class: "muted" }, "The residual depends on none of the measured quantities."),
    clickable.length
      ? h(
        "div",
        { class: "where-links" },
        h("span", { class: "muted" }, "Show the residual over"),
        ...clickable.map((w) =>
          h("button", {
            type: "button",
            class: "link",
            onclick: () => lookCompare({ tab: /** @type {any} */ (w.over) }),
          }, VARIABLES[w.over].title.toLowerCase())
        ),
      )
      : null,
  ];
}

export function whereCard() {
  return h(
    "section",
    { class: () => `card where${stale.value ? " stale" : ""}`, "aria-label": "Where it fails" },
    h("div", { class: "card-head" }, h("h2", null, "Where it fails"), scaleSwitch()),
    () => {
      const a = shown.value;
      if (!a && fault.value) return h("p", { class: "muted" }, "There is no comparison yet.");
      if (!a) return h("div", { class: "skeleton block-tall" });
      return [a.heat_map ? grid(a, a.heat_map) : null, inWords(a)].flat();
    },
  );
}
