// @ts-check
// The Design view: inputs, plots, results.
import { h } from "../../dom.js";
import { muscleCard } from "./muscle.js";
import { operationCard } from "./operation.js";
import { effectsCard } from "./effects.js";
import { chartColumn } from "./charts.js";
import { resultCards } from "./results.js";
import { inverseCard } from "./inverse.js";
import { errorCard } from "./errors.js";
import { fault, startModel } from "./model.js";

export function designView() {
  const verdict = resultCards();
  const view = h(
    "div",
    { class: "design" },
    h("div", { class: "column inputs" }, muscleCard(), operationCard(), effectsCard()),
    chartColumn(),
    h(
      "div",
      { class: () => `column results${fault.value ? " stale" : ""}` },
      errorCard(),
      ...verdict,
      inverseCard(),
    ),
  );
  startModel();
  return view;
}
