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
import { again, answer, chosen, diagnosis, fault, files, stage, startComparing } from "./answers.js";
import { modelCard } from "./model/card.js";
import { fetchMysteries, mysteryCard } from "./measurement/mysteries.js";
import { overlayCards } from "./error/overlay.js";
import { pathCard } from "./error/path.js";
import { residualCard } from "./error/residual.js";
import { rigCard } from "./model/rig.js";
import { setupCard } from "./model/setup.js";
import { unknownCard } from "./verdict/unknown.js";
import { verdictCard } from "./verdict/card.js";

/** @param {string} path */
function goToField(path) {
  const key = path.replace(/^body\./, "").replace(/^(muscle|effects)\./, "compare.").replace(
    /^drive\./,
    "rig.",
  );
  const box = document.querySelector(`.compare [data-field="${CSS.escape(key)}"]`);
  box?.closest("details")?.setAttribute("open", "");
  const input = box?.querySelector("input, select") ?? document.getElementById("compare-preset");
  if (input instanceof HTMLElement) input.focus();
}

function notice() {
  const told = fault.value;
  if (!told) return null;
  const { field } = told;
  return h(
    "div",
    { class: "notice bad", role: "alert" },
    icon("warn"),
    h("span", null, told.words, answer.value ? " The plots show the last comparison that was possible." : ""),
    field && !field.includes("measurement")
      ? h("button", { type: "button", onclick: () => goToField(field) }, "Go to the field")
      : h("button", { type: "button", onclick: again }, "Try again"),
  );
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
    // Where effects are missing too, they come first.
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
            h("span", null, "No file is used for the fit: set one of them to “Fit”."),
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
