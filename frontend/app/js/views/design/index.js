// @ts-check
// The muscle side of the Design view: inputs, plots, results.
import { h } from "../../dom.js";
import { presets } from "../../store.js";
import { chartColumn } from "./charts.js";
import { designEffectsCard } from "./effects.js";
import { errorCard } from "./errors.js";
import { exampleNote, openExample } from "./examples.js";
import { inverseCard } from "./inverse.js";
import { curvesAreCurrent, fault, startModel } from "./model.js";
import { muscleCard } from "./muscle.js";
import { operationCard } from "./operation.js";
import { resultCards } from "./results.js";

export function designView() {
  const verdict = resultCards();
  const view = h(
    "div",
    { class: "design" },
    h("div", { class: "column inputs" }, muscleCard(), operationCard(), designEffectsCard()),
    chartColumn(),
    h(
      "div",
      { class: () => `column results${fault.value || !curvesAreCurrent.value ? " stale" : ""}` },
      errorCard(),
      exampleNote,
      ...verdict,
      inverseCard(),
    ),
  );
  startModel();
  return view;
}

/** @returns {import("../../ui/menu.js").Item[]} */
export const designExports = () => [
  {
    label: "Take it along…",
    note: "code, tables, equations of this muscle",
    run: async () => (await import("./exports.js")).takeAlong(),
  },
  {
    label: "Curves as CSV",
    note: "all values, shown units",
    run: async () => (await import("./exports.js")).saveCsv(),
  },
  {
    label: "Plots as PNG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("png"),
  },
  {
    label: "Plots as SVG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("svg"),
  },
];

/** The example designs of the server. @returns {import("../../ui/menu.js").Item[]} */
export function designExamples() {
  const designs = presets.peek().designs ?? [];
  if (!designs.length) return [{ heading: "No example documents on this server" }];
  return designs.map((d) => ({
    label: d.title,
    note: d.description,
    run: () => openExample(d),
  }));
}
