// @ts-check
// Take it along: the model as it is now, in the formats that exist.
import { h, icon } from "../../dom.js";
import { studyTolerance } from "../../drive/study.js";
import { signal } from "../../reactive.js";
import { answer, stale } from "./answers.js";
import {
  keepAsPreset,
  saveCsv,
  saveModel,
  savePlots,
  saveReport,
  takeAlong,
  useInDesign,
} from "./exports.js";
import { openSteps, state } from "./list/state.js";
import { hasAssumed } from "./strip/facts.js";

const writing = signal("");

/** Scrolls to the card and points at the report. */
export function showTake() {
  const card = document.getElementById("take-along");
  const smooth = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  card?.scrollIntoView({ behavior: smooth ? "smooth" : "auto", block: "center" });
  /** @type {HTMLElement | null | undefined} */ (card?.querySelector("button"))?.focus({
    preventScroll: true,
  });
}

/** @param {Parameters<typeof icon>[0]} symbol @param {string} name @param {string} note
 * @param {() => unknown} run */
const way = (symbol, name, note, run) =>
  h(
    "button",
    {
      type: "button",
      title: note,
      disabled: () => !answer.value || stale.value || writing.value !== "",
      onclick: async () => {
        writing.value = name;
        await run();
        writing.value = "";
      },
    },
    icon(symbol),
    h("b", null, () => writing.value === name ? "Writing…" : name),
    " ",
    h("small", null, note),
  );

/** What is not certain about the model. */
const caveat = () =>
  hasAssumed()
    ? "with assumed entries"
    : openSteps.value.length
    ? "with choices not proven"
    : "the model as it is now";

export const takeCard = () =>
  h(
    "section",
    {
      class: () => `card take${state.value === "adequate" ? " lit" : ""}`,
      id: "take-along",
      "aria-label": "Take it along",
    },
    h("div", { class: "card-head" }, h("h2", null, "Take it along"), h("small", null, caveat)),
    h(
      "div",
      { class: "ways" },
      way("page", "Report", "data, each step, values ± σ, verdict: one HTML file", saveReport),
      way("braces", "Model", "JSON: muscle and effects with their values", saveModel),
      way("code", "Code and tables", "C, MATLAB, Modelica, Python, LaTeX, lookup tables", takeAlong),
      way("table", "Data", "CSV: every point with its residual", saveCsv),
      way("wave", "Plots", "PNG: one sheet", () => savePlots("png")),
      way("pin", "My preset", "your own muscle: its curves and runs show how sure they are", keepAsPreset),
      way(
        "flask",
        "Tolerance",
        "how much load, supply pressure and length matter: a Monte Carlo study",
        () => studyTolerance("model"),
      ),
      way("export", "Use in Design", "predict other conditions", useInDesign),
    ),
  );
