// @ts-check
// The page of the Studies view: inputs, progress, what the runs show, and the runs themselves.
import { h, icon } from "../../dom.js";
import { SPREAD, studyTolerance } from "../../drive/study.js";
import { computed } from "../../reactive.js";
import { faultNotice, goToField } from "../../ui/fault.js";
import { histogramCard, scatterCard } from "./charts.js";
import { inputCards } from "./inputs.js";
import {
  answer,
  cancel,
  fault,
  faultField,
  keptRuns,
  pace,
  planned,
  plannedText,
  remaining,
  run,
  shown,
  stage,
  stale,
  startStudies,
  study,
  waiting,
} from "./model.js";
import { parallelCard } from "./parallel.js";
import { startRows } from "./rows.js";
import { influenceCard, summaryCard } from "./summary.js";
import { pinsCard, tableCard } from "./table.js";

/** @param {import("../../dom.js").Child[]} body */
const notice = (...body) => h("div", { class: "notice", role: "status" }, icon("info"), ...body);

/** Runs of this study that were made before it was interrupted. */
const goOn = () =>
  notice(
    h("span", null, () => `${keptRuns.value} of ${plannedText.value} of this study are kept from before.`),
    h("button", { type: "button", onclick: run }, "Continue"),
  );

function notices() {
  if (stage.value === "running") return null;
  const error = fault.value, field = faultField();
  if (error) {
    return faultNotice(error.words, {
      goTo: field === null ? null : () => goToField(field, ".studies"),
      retry: run,
    });
  }
  const isPartlyKept = keptRuns.value > 0 && keptRuns.value < (planned.value ?? 0);
  if (isPartlyKept && (stale.value || !shown.value)) return goOn();
  if (stale.value) {
    return notice(
      h("span", null, "The study has changed. These runs belong to the previous one."),
      h("button", { type: "button", onclick: run }, "Run again"),
    );
  }
  if (stage.value === "cancelled") {
    return notice(
      h("span", null, "The study was cancelled. Its runs so far stay in the table and are kept."),
      h("button", { type: "button", onclick: run }, "Continue"),
    );
  }
  return answer.value?.message ? notice(h("span", null, answer.value.message)) : null;
}

const MINUTE = 60;
/** @param {number} seconds */
const lasting = (seconds) =>
  seconds < MINUTE ? `${Math.max(1, Math.round(seconds))} s` : `${Math.round(seconds / MINUTE)} min`;

function progressText() {
  if (waiting.value) return waiting.value;
  const { made, planned: all, kept } = pace.value, left = remaining.value;
  const before = kept ? `, ${kept} of them from before` : "";
  if (!made) return "Preparing the runs…";
  return `${made} of ${all} runs${before}${left === null ? "" : `, about ${lasting(left)} left`}`;
}

function progress() {
  if (stage.value !== "running") return null;
  return h(
    "section",
    { class: "card searching", "aria-label": "Progress" },
    h("p", null, progressText),
    h(
      "div",
      null,
      h("progress", {
        max: 1,
        value: () => pace.value.planned ? pace.value.made / pace.value.planned : 0,
        "aria-label": "Runs made",
      }),
      h("button", { type: "button", onclick: cancel }, icon("close"), "Cancel"),
    ),
  );
}

function start() {
  if (shown.value || stage.value === "running") return null;
  return h(
    "section",
    { class: "card empty-state", "aria-label": "Start" },
    h("h2", null, "Many runs, one answer"),
    h(
      "p",
      null,
      "Choose what varies and what is watched. You get the spread of every figure, what matters for it, the " +
        "probability of keeping limits, or the best values for your goals. Each run can be opened.",
    ),
    () =>
      study.value.subject === "task" || study.value.quantities.length ? null : h(
        "button",
        {
          type: "button",
          onclick: () => studyTolerance(study.peek().subject === "model" ? "model" : "drive"),
        },
        `Start with load, supply and length at ±${Math.round(100 * SPREAD)}\u00a0%`,
      ),
  );
}

export function studiesPage() {
  const dimmed = () => stale.value && stage.value !== "running" ? " stale" : "";
  const has = computed(() => shown.value !== null);
  const page = h(
    "div",
    { class: "studies" },
    h("div", { class: "column inputs" }, ...inputCards(computed)),
    h(
      "div",
      { class: "column answers" },
      h("div", { class: "column" }, notices),
      h("div", { class: "column" }, progress),
      h("div", { class: "column" }, start),
      h("div", { class: () => `column results-of${dimmed()}`, hidden: () => !answer.value }, summaryCard()),
      h(
        "div",
        { class: () => `column pictures${dimmed()}`, hidden: () => !has.value },
        histogramCard(),
        scatterCard(),
        influenceCard(),
        parallelCard(),
      ),
      h("div", { class: () => `column${dimmed()}`, hidden: () => !has.value }, pinsCard(), tableCard()),
    ),
  );
  startRows();
  startStudies();
  return page;
}
