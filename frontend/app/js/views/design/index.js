// @ts-check
// The Design view: from a muscle (inputs, plots, results), or from a task.
import { h } from "../../dom.js";
import { muscleCard } from "./muscle.js";
import { operationCard } from "./operation.js";
import { effectsCard } from "../../muscle/effects.js";
import { chartColumn } from "./charts.js";
import { resultCards } from "./results.js";
import { inverseCard } from "./inverse.js";
import { errorCard } from "./errors.js";
import { fault, startModel } from "./model.js";
import { inTask, modeSwitch, taskSide } from "../sizing/index.js";

export function designView() {
  const verdict = resultCards();
  const muscle = h(
    "div",
    { class: "design", hidden: () => inTask.value },
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
  return h("div", { class: "start-from" }, modeSwitch(), muscle, taskSide());
}
