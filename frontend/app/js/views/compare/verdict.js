// @ts-check
// What the diagnosis concludes: a sentence, all effects at once, what to measure next; while it runs, how far.
import { h, icon } from "../../dom.js";
import { units } from "../../state.js";
import { spoken } from "../../ui/sources.js";
import { addAll, titleOf } from "./history.js";
import { again, answer, cancel, diagnosis, fault, found, progress, stage, stale, trouble } from "./model.js";
import { errorText } from "./words.js";

/** @typedef {import("./types.js").Status} Status */
/** @typedef {import("./types.js").Diagnosis} Diagnosis */

/** @type {Record<Status, [string, string]>} */
const BADGES = {
  adequate: ["good", "Adequate"],
  missing_effects: ["warn", "Effects are missing"],
  ambiguous: ["warn", "Not decidable from these data"],
  unknown_effect: ["bad", "Unknown effect"],
};

function running() {
  const { share } = progress.value, tried = found.value.length;
  return [
    h(
      "div",
      {
        class: "bar",
        role: "progressbar",
        "aria-label": "Diagnosis",
        "aria-valuenow": Math.round(100 * share),
      },
      h("i", { style: `width:${Math.max(3, 100 * share)}%` }),
    ),
    h(
      "div",
      { class: "running" },
      h(
        "span",
        { class: "muted" },
        tried ? `${tried} effects tried…` : "Trying every effect of the catalogue…",
      ),
      h("button", { type: "button", class: "link", onclick: cancel }, "Cancel"),
    ),
  ];
}

/** @param {string} words @param {string} button */
const halted = (words, button) =>
  h(
    "div",
    { class: "notice" },
    h("span", null, words),
    h("button", { type: "button", onclick: again }, button),
  );

/** Every effect found missing, in one click. */
function allButton() {
  const path = diagnosis.value?.path.slice(1) ?? [], a = answer.value;
  if (path.length < 2) return null;
  const last = path[path.length - 1];
  const error = errorText(last.rmse, a?.unit ?? "N", a?.predicted ?? "force", units.value);
  return h("button", {
    type: "button",
    class: "primary block",
    id: "add-all",
    disabled: () => stale.value,
    onclick: addAll,
    title: path.map((s) => titleOf(s.added ?? "")).join(", "),
  }, `Add all ${path.length} effects: error ${error}`);
}

/** What would decide between effects that look alike. @param {Diagnosis["verdict"]} verdict */
function next({ experiments, next_measurement: told }) {
  if (!experiments.length) {
    return told ? h("p", { class: "next" }, h("b", null, "Measure next: "), told) : null;
  }
  const items = experiments.map((e) =>
    h(
      "li",
      null,
      h("b", null, e.pair.map(titleOf).join(" or ")),
      `: ${e.declared || e.protocol}.`,
      e.declared && e.protocol
        ? h(
          "small",
          null,
          ` Best of the simulated tests: ${e.protocol} (${Math.round(e.separation)} σ apart).`,
        )
        : null,
    )
  );
  return h(
    "details",
    { class: "next" },
    h(
      "summary",
      null,
      `What to measure next: ${items.length} ${items.length > 1 ? "tests" : "test"} would decide`,
    ),
    h("ul", { class: "plain" }, ...items),
  );
}

export function verdictCard() {
  const body = () => {
    if (stage.value === "failed") return halted(trouble.value?.words ?? "The diagnosis failed.", "Try again");
    if (stage.value === "cancelled") return halted("The diagnosis was cancelled.", "Diagnose");
    const told = diagnosis.value;
    if (!told) {
      return fault.value ? h("p", { class: "muted" }, "There is no comparison to diagnose.") : running();
    }
    const { verdict, messages } = told;
    const [tone, label] = BADGES[verdict.status] ?? ["warn", spoken(verdict.status)];
    return [
      h(
        "p",
        { class: `verdict ${tone}` },
        icon(tone === "good" ? "check" : "warn"),
        h("span", null, h("b", { id: "verdict-status" }, label), h("br"), verdict.sentence),
      ),
      allButton(),
      next(told.verdict),
      messages.length
        ? h(
          "details",
          null,
          h("summary", null, "Notes"),
          h("ul", { class: "plain muted" }, ...messages.map((m) => h("li", null, m))),
        )
        : null,
    ];
  };
  return h(
    "section",
    {
      class: "card verdict-card",
      "aria-label": "Verdict",
      "aria-busy": () => String(stage.value === "running"),
    },
    h("div", { class: "card-head" }, h("h2", null, "Verdict")),
    body,
  );
}
