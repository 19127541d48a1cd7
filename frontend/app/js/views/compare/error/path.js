// @ts-check
// The error after each effect: a row for each model so far and each one the diagnosis proposes.
import { h, icon } from "../../../dom.js";
import { future, past, units } from "../../../state.js";
import { redoAndReport, undoAndReport } from "../../../ui/history.js";
import { goBack, here } from "../model/history.js";
import { ahead, answer, stale, steps } from "../answers.js";
import { errorText, errorUnit, titleOf } from "../words.js";

/** @typedef {{label: string, rmse: number | null, holdout: number | null,
 *   kind: "past" | "now" | "ahead", index: number}} Row */

/** @returns {Row[]} */
function rows() {
  const now = here();
  const proposed = stale.value ? [] : ahead.value;
  return [
    ...steps.value.map((s, index) => ({ ...s, kind: /** @type {const} */ ("past"), index })),
    { ...now, rmse: stale.value ? null : now.rmse, kind: "now", index: -1 },
    ...proposed.map((s) => ({
      label: s.added ? `+ ${titleOf(s.added)}` : "Values fitted",
      rmse: s.rmse,
      holdout: s.holdout_rmse,
      kind: /** @type {const} */ ("ahead"),
      index: -1,
    })),
  ];
}

/** @param {Row} row @param {number} most @param {number | null} noise */
function pathRow(row, most, noise) {
  const a = answer.value;
  const asText = (/** @type {number | null} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, false);
  const share = (/** @type {number | null} */ si) => `${si === null ? 0 : Math.min(100, (100 * si) / most)}%`;
  return h(
    "tr",
    { class: row.kind },
    h(
      "th",
      { scope: "row" },
      row.kind === "past"
        ? h("button", {
          type: "button",
          class: "link",
          title: "Back to this model",
          onclick: () => goBack(row.index),
        }, row.label)
        : row.label,
      row.kind === "now" ? h("small", null, " now") : null,
      row.kind === "ahead" ? h("small", null, " proposed") : null,
    ),
    h(
      "td",
      { class: "bars" },
      h(
        "span",
        { class: "track", "aria-hidden": "true" },
        h("i", { class: "fill", style: `width:${share(row.rmse)}` }),
        row.holdout === null ? null : h("i", { class: "holdout", style: `left:${share(row.holdout)}` }),
        noise === null ? null : h("i", { class: "noise", style: `left:${share(noise)}` }),
      ),
    ),
    h("td", null, asText(row.rmse)),
    h("td", null, asText(row.holdout)),
  );
}

/** @param {"undo" | "redo"} name @param {() => string | undefined} label @param {() => void} run */
const historyButton = (name, label, run) => {
  const text = () => `${name === "undo" ? "Undo" : "Redo"} ${label() ?? ""}`.trim();
  return h("button", {
    type: "button",
    class: "mini",
    "aria-label": () => `${text()} in the history`,
    title: text,
    disabled: () => !label(),
    onclick: run,
  }, icon(name));
};

export function pathCard() {
  const body = () => {
    const all = rows(), a = answer.value;
    const most = Math.max(...all.map((r) => Math.max(r.rmse ?? 0, r.holdout ?? 0)), 1e-12) * 1.02;
    const noise = a?.channels && Object.keys(a.channels).length ? 1 : a?.noise_floor ?? null;
    return all.map((row) => pathRow(row, most, noise));
  };
  const unit = () => errorUnit(answer.value?.unit ?? "N", answer.value?.predicted ?? "force", units.value);
  return h(
    "section",
    { class: "card path", "aria-label": "Error after each effect" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Error after each effect"),
      h(
        "ul",
        { class: "legend" },
        h("li", null, h("i", { class: "fill" }), "fit"),
        h("li", null, h("i", { class: "tick" }), "hold-out"),
        h("li", null, h("i", { class: "noise" }), "noise"),
      ),
      historyButton("undo", () => past.value.at(-1)?.label, undoAndReport),
      historyButton("redo", () => future.value.at(-1)?.label, redoAndReport),
    ),
    h(
      "table",
      { class: "data path-table" },
      h("caption", { class: "unseen" }, "Models in order, with their errors"),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("th", { scope: "col", class: "text" }, "Model"),
          h("td", null),
          h("th", { scope: "col" }, "Error", h("small", null, unit)),
          h("th", { scope: "col" }, "Hold-out", h("small", null, unit)),
        ),
      ),
      h("tbody", null, body),
    ),
  );
}
