// @ts-check
// The error of the model: RMS, change, fit, hold-out, validation, noise.
import { h } from "../../../dom.js";
import { computed, signal } from "../../../reactive.js";
import { units } from "../../../state.js";
import { brief, readable } from "../../../format.js";
import { answer, compare, diagnosis, fault, previous, stale, steps } from "../answers.js";
import { allSeries } from "./pictures.js";
import { fitting, refit } from "../model/history.js";
import { saveReport } from "../exports.js";
import { errorText, fitPercent, signed } from "../words.js";

/** @typedef {import("../types.js").Comparison} Comparison */

/** @param {number | null | undefined} si */
const asText = (si) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value);
};

/** @param {string} name @param {import("../../../dom.js").Child} value @param {string} [id] */
const row = (name, value, id) => [h("dt", null, name), h("dd", { id }, value)];

/** "118 N → 47.8 N, −60 %" */
function fall() {
  const a = answer.value, first = steps.value[0];
  const last = previous.value ?? steps.value.at(-1) ?? null;
  if (!a || a.rmse === null || !last || !last.rmse) return null;
  const change = 100 * (a.rmse / last.rmse - 1);
  return h(
    "p",
    { class: `fall ${change <= 0 ? "good" : "bad"}`, id: "error-change" },
    `${asText(last.rmse)} → ${asText(a.rmse)}`,
    h("b", null, ` ${signed(change)}`),
    steps.value.length > 1 && first.rmse
      ? h("small", null, `since the start ${signed(100 * (a.rmse / first.rmse - 1))}`)
      : null,
  );
}

/** @param {Comparison} a */
function facts(a) {
  const fit = fitPercent(allSeries(a).filter((s) => s.use !== "validation"));
  const check = a.validation ? fitPercent(allSeries(a).filter((s) => s.use === "validation")) : null;
  const noise = a.noise_floor;
  // The error of several channels is in units of their noise already.
  const scaled = Object.keys(a.channels ?? {}).length > 1;
  const holdout = compare.value.holdout ?? diagnosis.value?.baseline.holdout_rmse ?? a.holdout_rmse;
  const both = (/** @type {number | null | undefined} */ error, /** @type {number | null} */ percent) =>
    `${asText(error)}${percent === null ? "" : ` · fit ${brief(percent)} %`}`;
  return h(
    "dl",
    null,
    ...row("Fit (100 % is perfect)", fit === null ? "–" : `${brief(fit)} %`),
    ...row("Hold-out", asText(holdout)),
    ...(a.validation ? row("Validation", both(a.validation.rmse, check), "validation-error") : []),
    ...(scaled ? [] : [
      ...row("Noise floor", noise === null ? "not known" : asText(noise), "noise-floor"),
      ...(noise && a.rmse !== null ? row("Error over noise", `${brief(a.rmse / noise)} ×`) : []),
    ]),
  );
}

/** @param {Comparison} a */
function channelTable(a) {
  const all = Object.entries(a.channels ?? {});
  if (all.length < 2) return null;
  return h(
    "table",
    { class: "data" },
    h("caption", { class: "unseen" }, "Error of each channel"),
    h(
      "thead",
      null,
      h(
        "tr",
        null,
        ...["Channel", "Error", "Noise"].map((t, i) => h("th", { scope: "col", class: i ? "" : "text" }, t)),
      ),
    ),
    h(
      "tbody",
      null,
      ...all.map(([name, c]) =>
        h(
          "tr",
          null,
          h("th", { scope: "row", class: "text" }, readable(name)),
          h("td", null, errorText(c.rmse, c.unit, name, units.value)),
          h("td", null, errorText(c.noise_floor, c.unit, name, units.value)),
        )
      ),
    ),
  );
}

/** The newest error, for screen readers. */
const spokenError = computed(() => {
  const a = answer.value;
  if (!a || stale.value) return "";
  const last = previous.value?.rmse;
  return `Error ${asText(a.rmse)}${last ? `, before ${asText(last)}` : ""}`;
});

const reporting = signal(false);

export function errorCard() {
  return h(
    "section",
    { class: () => `card error-card${stale.value ? " stale" : ""}`, "aria-label": "Error" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Error"),
      h("button", {
        type: "button",
        class: "small",
        title: "Fit the parameters of the effects in the model again  (R)",
        disabled: () => !answer.value || fitting.value || !Object.keys(answer.value.parameters).length,
        onclick: refit,
      }, () => fitting.value ? "Fitting…" : "Refit"),
      h("button", {
        type: "button",
        class: "small",
        disabled: () => !answer.value || stale.value || reporting.value,
        onclick: async () => {
          reporting.value = true;
          await saveReport();
          reporting.value = false;
        },
      }, () => reporting.value ? "Writing…" : "Report"),
    ),
    h("p", { class: "unseen", "aria-live": "polite" }, () => spokenError.value),
    () => {
      const a = answer.value;
      if (!a && fault.value) return h("p", { class: "muted" }, "There is no comparison yet.");
      if (!a) return h("div", { class: "skeleton number" });
      return [
        h("p", { class: "big", id: "error-now" }, asText(a.rmse)),
        h("p", { class: "muted" }, `RMS over ${a.rows_used} points · ${a.kind}`),
        fall(),
        facts(a),
        channelTable(a),
      ];
    },
  );
}
