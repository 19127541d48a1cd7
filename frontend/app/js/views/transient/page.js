// @ts-check
// The page of the Transient view: inputs, motion and plots, figures.
import { append, h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { stageCard } from "./motion/animation.js";
import { paired, plotCards } from "./plots/charts.js";
import { figureCards } from "./figures/figures.js";
import { measuredCard } from "./measured.js";
import { fault, fieldOf, retry, run, startRuns } from "./model.js";
import { inputCards } from "./inputs/panel.js";
import { startPins } from "./pinned-runs.js";
import { compareCard } from "./pinned/card.js";
import { startStatics } from "./statics.js";

/** @param {string} path */
function goToField(path) {
  const root = document.querySelector(".transient");
  for (let key = fieldOf(path); key; key = key.replace(/\.?[^.]*$/, "")) {
    const box = root?.querySelector(`[data-field="${CSS.escape(key)}"]`);
    box?.closest("details")?.setAttribute("open", "");
    const input = box?.querySelector("input, select");
    if (input instanceof HTMLElement) return input.focus();
  }
}

function notice() {
  const told = fault.value;
  if (!told) return null;
  const { field } = told;
  return h(
    "div",
    { class: "notice bad", role: "alert" },
    icon("warn"),
    h("span", null, told.words, run.value ? " The plots show the last run that was possible." : ""),
    field
      ? h("button", { type: "button", onclick: () => goToField(field) }, "Go to the field")
      : h("button", { type: "button", onclick: retry }, "Try again"),
  );
}

export function transientPage() {
  const stale = computed(() => Boolean(fault.value));
  const results = h("div", { class: () => `column results${stale.value ? " stale" : ""}` });
  figureCards().forEach((card) => append(results, card));
  results.append(measuredCard());
  const page = h(
    "div",
    { class: "transient" },
    h("div", { class: "column inputs" }, ...inputCards()),
    h(
      "div",
      { class: () => `column runs${stale.value ? " stale" : ""}${paired.value ? " paired" : ""}` },
      notice,
      stageCard(),
      ...plotCards(),
      compareCard(),
    ),
    results,
  );
  startRuns();
  startStatics();
  startPins();
  return page;
}
