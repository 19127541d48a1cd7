// @ts-check
// One part in full: every value with unit, source and grade; references; for muscles a force plot.
import { h, icon } from "../../dom.js";
import { effect } from "../../reactive.js";
import { units } from "../../state.js";
import { effectTitle } from "../../store.js";
import { post } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { readable, siOf } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { writeLabels } from "../../plots/overlay.js";
import { palette } from "../../plots/theme.js";
import { gradeTag, unverifiedBadge } from "../../ui/sources.js";
import { plotlyReady } from "../../plots/library.js";
import { usePreset } from "../../muscle/preset.js";
import { forceSpec } from "../../muscle/force-plot.js";
import { showMuscle } from "../../muscle/document.js";
import { shownValue } from "./columns.js";
import { selected } from "./table.js";

/** @typedef {import("../../types.js").Preset} Preset */
/** @typedef {import("../../types.js").Values} Values */
/** @typedef {import("../../types.js").Curves} Curves */

/** @param {string} title @param {Values | undefined} values */
function valueTable(title, values) {
  const entries = Object.entries(values ?? {});
  if (!entries.length) return null;
  return h(
    "div",
    null,
    h("h3", null, title),
    h(
      "ul",
      { class: "values" },
      ...entries.map(([key, q]) =>
        h(
          "li",
          null,
          h("span", null, readable(key)),
          h("b", null, () => {
            const { text, unit } = shownValue(q, units.value, key);
            return `${text} ${unit}`;
          }),
          h("small", { class: "source" }, q.source, " ", gradeTag(q.grade), q.note ? ` ${q.note}` : ""),
        )
      ),
    ),
  );
}

/** The columns of measured points and reference curves. @param {Preset} p */
function columnList(p) {
  const entries = Object.entries(p.data_columns ?? {});
  if (!entries.length) return null;
  return h(
    "ul",
    { class: "values" },
    ...entries.map(([key, c]) =>
      h(
        "li",
        null,
        h("span", null, readable(key)),
        h("b", null, `${Math.min(...c.values)} … ${Math.max(...c.values)} ${c.unit}`),
        h("small", { class: "source" }, `${c.values.length} values`),
      )
    ),
  );
}

/** @param {Preset} p */
const badge = (p) =>
  unverifiedBadge(p) ?? h("span", { class: "badge good" }, icon("check"), "all values sourced");

const SHOWN = 6;

/** Curves at even steps up to the highest pressure. @param {Preset} p */
function request(p) {
  const most = p.limits?.max_pressure ? siOf(p.limits.max_pressure) : 6e5;
  const pressures = Array.from({ length: SHOWN }, (_, i) => ((i + 1) * most) / SHOWN);
  return { muscle: { preset: p.id }, pressures, points: 60, contraction_from: 0 };
}

function smallPlot() {
  const host = h("div", {
    class: "plot",
    role: "figure",
    "aria-label": "Force over contraction of this muscle",
  });
  const chart = new Chart(host, "catalogue-force");
  writeLabels(chart);
  const curves = new Question(
    (text, signal) => /** @type {Promise<Curves>} */ (post("/api/curves", JSON.parse(text), signal)),
  );
  curves.follow(() => {
    const p = selected.value;
    return p?.kind === "muscle" ? JSON.stringify(request(p)) : null;
  });
  effect(() => {
    const answer = curves.error.value ? null : curves.answer.value;
    palette.value;
    /** @type {Omit<import("../../muscle/curve-axes.js").View, "curves">} */
    const view = {
      place: "catalogue",
      across: "contraction",
      over: "contraction",
      system: units.value,
      reference: null,
    };
    if (answer && plotlyReady.value) chart.show((p) => forceSpec({ ...view, curves: answer }, p));
  });
  return h("div", { class: () => curves.stale.value ? "stale" : "" }, host);
}

/** @param {Preset} p */
function facts(p) {
  return [
    p.kind === "muscle"
      ? h(
        "button",
        {
          type: "button",
          class: "primary block",
          onclick: () => {
            usePreset(p.id);
            showMuscle();
          },
        },
        "Use in design",
      )
      : null,
    valueTable("Geometry", p.geometry),
    valueTable("Limits", p.limits),
    valueTable(p.kind === "muscle" ? "Further data" : "Data", p.data),
    ...Object.entries(p.effects ?? {}).map(([id, values]) => valueTable(effectTitle(id), values)),
    columnList(p),
    p.source ? h("p", { class: "muted" }, p.source, " ", gradeTag(p.grade ?? "")) : null,
    p.note ? h("p", { class: "muted" }, p.note) : null,
    p.references?.length ? h("h3", null, "References") : null,
    h("ul", { class: "plain" }, ...(p.references ?? []).map((r) => h("li", { class: "muted" }, r))),
  ];
}

export function detailPanel() {
  const plot = smallPlot();
  return h(
    "section",
    { class: "card detail", "aria-label": "Detail" },
    () => {
      const p = selected.value;
      if (!p) return h("p", { class: "muted" }, "Select a part to see all its values.");
      return [
        h("div", { class: "card-head" }, h("h2", null, p.title), badge(p)),
        h("p", { class: "muted" }, [p.maker, p.function, p.description].filter(Boolean).join(" · ")),
      ];
    },
    h("div", { hidden: () => selected.value?.kind !== "muscle" }, plot),
    () => selected.value ? facts(selected.value) : null,
  );
}
