// @ts-check
// The page of the Compare & diagnose view: data and model, overlay and residual, error and missing effects.
import { h, icon } from "../../dom.js";
import { computed, effect } from "../../reactive.js";
import { candidatesCard } from "./verdict/candidates.js";
import { emptyCard, guide } from "./measurement/empty.js";
import { errorCard } from "./error/card.js";
import { dropping } from "./measurement/drop.js";
import { followFiles } from "./measurement/files.js";
import { whereCard } from "./error/heat.js";
import { measurementsCard } from "./measurement/card.js";
import { faultNotice, goToField } from "../../ui/fault.js";
import {
  again,
  answer,
  chosen,
  diagnosis,
  fault,
  faultField,
  files,
  stage,
  startComparing,
} from "./answers.js";
import { modelCard } from "./model/card.js";
import { fetchMysteries, mysteryCard } from "./measurement/mysteries.js";
import { overlayCards } from "./error/overlay.js";
import { pathCard } from "./error/path.js";
import { residualCard } from "./error/residual.js";
import { rigCard } from "./model/rig.js";
import { setupCard } from "./model/setup.js";
import { unknownCard } from "./verdict/unknown.js";
import { verdictCard } from "./verdict/card.js";

/** The field of the page for a path of the request. @param {string} path */
const keyOf = (path) => path.replace(/^(muscle|effects)\./, "compare.").replace(/^drive\./, "rig.");

function notice() {
  const error = fault.value, field = faultField();
  if (!error) return null;
  const kept = answer.value ? " The plots show the last valid comparison." : "";
  return faultNotice(`${error.words}${kept}`, {
    goTo: field === null || field.includes("measurement")
      ? null
      : () => goToField(keyOf(field), ".compare") || goToField("compare-preset"),
    retry: again,
  });
}

export function comparePage() {
  const empty = computed(() => files.value.length === 0);
  const idle = computed(() => !empty.value && !chosen.value.some((f) => f.use === "fit"));
  const results = h(
    "div",
    { class: "column results", hidden: () => empty.value },
    errorCard(),
    verdictCard(),
    h("div", { class: "column" }, mysteryCard),
    // Missing effects of the catalogue come first.
    h(
      "div",
      { class: () => `column${diagnosis.value?.verdict.effects.length ? " after" : ""}` },
      unknownCard(),
    ),
    candidatesCard(),
  );
  const page = h(
    "div",
    { class: () => `compare${empty.value ? " is-empty" : ""}` },
    h(
      "div",
      { class: "column inputs" },
      measurementsCard(),
      setupCard(),
      h("div", { class: "column" }, rigCard),
      h("div", { hidden: () => empty.value }, modelCard()),
    ),
    h("div", { class: "column plots", hidden: () => !empty.value }, emptyCard()),
    h(
      "div",
      { class: "column plots", hidden: () => empty.value },
      guide,
      notice,
      () =>
        idle.value
          ? h(
            "p",
            { class: "notice" },
            icon("info"),
            h("span", null, "No file is used for the fit. Set one of them to “Fit”."),
          )
          : null,
      overlayCards(),
      residualCard(),
      h("div", { class: "pair-row" }, whereCard(), pathCard()),
    ),
    results,
    h(
      "div",
      { class: "drop-here", hidden: () => !dropping.value },
      h("b", null, "Drop the measurement files"),
    ),
  );
  followFiles();
  startComparing();
  fetchMysteries();
  effect(() => {
    document.documentElement.dataset.diagnosis = stage.value;
  });
  return page;
}
