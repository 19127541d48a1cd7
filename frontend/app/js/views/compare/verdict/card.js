// @ts-check
// The verdict of the diagnosis: conclusion, adding all effects at once, what to measure next; and its progress.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { brief, capitalized } from "../../../format.js";
import { addAll } from "../model/history.js";
import {
  again,
  ahead,
  answer,
  cancel,
  candidates,
  diagnosis,
  diagnosisError,
  fault,
  progress,
  stage,
  stale,
} from "../answers.js";
import { entryQuestions, isDoubted } from "./entries.js";
import { errorText, titleOf, whatIsLeft } from "../words.js";

/** @typedef {import("../types.js").Status} Status */
/** @typedef {import("../types.js").Diagnosis} Diagnosis */

/** @type {Record<Status, string>} Tone of each status; its words are the server's. */
const TONES = { adequate: "good", missing_effects: "warn", ambiguous: "warn", unknown_effect: "bad" };

function running() {
  const { share } = progress.value, tried = candidates.value.length;
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

/** Adds all missing effects at once. */
function allButton() {
  const path = ahead.value, a = answer.value;
  const added = path.filter((step) => step.added);
  if (added.length < 2) return null;
  const last = path[path.length - 1];
  const error = errorText(last.rmse, a?.unit ?? "N", a?.predicted ?? "force", units.value);
  return h("button", {
    type: "button",
    class: diagnosis.value && isDoubted(diagnosis.value) ? "block" : "primary block",
    id: "add-all",
    disabled: () => stale.value,
    onclick: addAll,
    title: added.map((s) => titleOf(s.added ?? "")).join(", "),
  }, `Add all ${added.length} effects: error ${error}`);
}

const AT_FLOOR = 1.15;

/** "127 N → 3.09 N, which is the noise" @param {Diagnosis} result */
function fall(result) {
  const asText = (/** @type {number | null} */ si) =>
    errorText(si, result.unit, result.predicted, units.value);
  const scaled = Object.keys(result.channels).length > 1;
  const floor = scaled ? 1 : result.noise_floor.rmse, end = result.path.at(-1)?.rmse ?? null;
  const isNoise = floor !== null && end !== null && end <= AT_FLOOR * floor;
  return h(
    "p",
    { class: "verdict-fall", id: "verdict-fall" },
    `With ${result.verdict.effects.length > 1 ? "them" : "it"} the error falls `,
    h("b", null, `${asText(result.baseline.rmse)} → ${asText(end)}`),
    isNoise
      ? `: the noise of the data${scaled ? "" : ` (${asText(floor)})`}.`
      : floor === null || scaled
      ? "."
      : `; the noise is ${asText(floor)}.`,
  );
}

/** The missing effects, and the effects that explain the data as well. @param {Diagnosis["verdict"]} verdict */
function missing({ effects, indistinguishable }, doubted = false) {
  return h(
    "ul",
    { class: "plain found-missing" },
    ...effects.map((id) => {
      const twins = indistinguishable.find(([one]) => one === id)?.slice(1) ?? [];
      return h(
        "li",
        { class: twins.length || doubted ? "unsure" : "sure" },
        icon(twins.length || doubted ? "info" : "check"),
        h(
          "span",
          null,
          h("b", null, titleOf(id)),
          doubted
            ? h("small", null, "only if all entries are right")
            : twins.length
            ? h("small", null, `or ${twins.map(titleOf).join(", ")}: these data cannot tell them apart`)
            : h("small", null, "no other effect fits as well"),
        ),
      );
    }),
  );
}

/** @param {string} text */
const sentence = (text) => `${capitalized(text).replace(/\.$/, "")}.`;

const FEW = 2;

/** Measurements that would tell similar effects apart. @param {Diagnosis["verdict"]} verdict */
function next({ experiments, next_measurement: advice }) {
  if (!experiments.length) {
    return advice ? h("p", { class: "next" }, h("b", null, "Measure next: "), advice) : null;
  }
  const items = experiments.map((e) =>
    h(
      "li",
      null,
      h("b", null, e.pair.map(titleOf).join(" or ")),
      e.declared ? h("p", null, sentence(e.declared)) : null,
      h(
        "p",
        { class: "muted" },
        e.protocol
          ? `Best of the simulated tests: ${e.protocol}, difference ${brief(e.separation)}\u00a0σ.`
          : "No simulated force test tells them apart.",
      ),
    )
  );
  return h(
    "details",
    { class: "next", open: items.length <= FEW },
    h("summary", null, `Measure next: ${items.length} ${items.length > 1 ? "tests" : "test"} would decide`),
    h("ol", { class: "experiments" }, ...items),
  );
}

/** @param {Diagnosis} result */
function conclusion(result) {
  const { verdict } = result;
  const tone = TONES[verdict.status];
  const some = verdict.effects.length > 0, unknown = verdict.status === "unknown_effect";
  const rest = `No catalogued effect explains the rest: ${whatIsLeft(verdict)}.`;
  return h(
    "div",
    { class: `verdict ${tone}` },
    icon(tone === "good" ? "check" : "warn"),
    h(
      "div",
      null,
      h("b", { id: "verdict-status" }, verdict.title),
      ...some
        ? [missing(verdict, isDoubted(result)), fall(result), unknown ? h("p", null, rest) : null]
        : [h("p", null, verdict.sentence)],
    ),
  );
}

export function verdictCard() {
  const body = () => {
    if (stage.value === "failed") {
      return halted(diagnosisError.value?.words ?? "The diagnosis failed.", "Try again");
    }
    if (stage.value === "cancelled") return halted("The diagnosis was cancelled.", "Diagnose");
    const result = diagnosis.value;
    if (!result) {
      return fault.value ? h("p", { class: "muted" }, "There is no comparison to diagnose.") : running();
    }
    const { messages } = result;
    return [
      entryQuestions(result),
      conclusion(result),
      allButton(),
      next(result.verdict),
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
