// @ts-check
// The page of the Transient view: inputs, motion and plots, figures.
import { append, h } from "../../dom.js";
import { apart, computed, effect } from "../../reactive.js";
import { lostPresets } from "../../server/missing.js";
import { linearCard } from "./linear/card.js";
import { paired, plotCards } from "./plots/charts.js";
import { figureCards, verdictBar } from "./figures/figures.js";
import { measuredCard } from "./measured.js";
import { faultNotice, goToField } from "../../ui/fault.js";
import { fault, faultField, retry, run, stale, startRuns } from "./model.js";
import { driveEffects, inputCards } from "./inputs/panel.js";
import { startPins } from "./pinned-runs.js";
import { compareCard } from "./pinned/card.js";

function notice() {
  const error = fault.value, field = faultField();
  if (!error || lostPresets.value.length) return null; // the banner says what is gone
  return faultNotice(`${error.words}${run.value ? " The plots show the last valid run." : ""}`, {
    goTo: field === null ? null : () => goToField(field, ".transient"),
    retry,
  });
}

export function transientPage() {
  const isWhole = computed(() => !lostPresets.value.length);
  effect(() => {
    if (isWhole.value && fault.peek()) apart(retry);
  });
  const results = h("div", { class: () => `column results${stale.value ? " stale" : ""}` });
  figureCards().forEach((card) => append(results, card));
  results.append(measuredCard());
  const plots = plotCards();
  const page = h(
    "div",
    { class: "transient" },
    h("div", { class: () => `top${stale.value ? " stale" : ""}` }, notice, verdictBar()),
    h("div", { class: "column inputs" }, ...inputCards()),
    h(
      "div",
      { class: () => `column runs${stale.value ? " stale" : ""}${paired.value ? " paired" : ""}` },
      plots.strips,
      driveEffects(),
      plots.phase,
      compareCard(),
      linearCard(),
    ),
    results,
  );
  startRuns();
  startPins();
  return page;
}
