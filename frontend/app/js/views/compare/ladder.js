// @ts-check
// From the start to the noise: a row for each step so far and each one proposed, with the way back for each.
import { h, icon, mathml } from "../../dom.js";
import { figure, inSentence } from "../../facts.js";
import { changeText } from "../../format.js";
import { units } from "../../state.js";
import { effectsById } from "../../store.js";
import { ahead, answer, compare, diagnosis, preset, stale } from "./answers.js";
import { fitOf, surer } from "./document.js";
import { effectValues } from "../../muscle/preset.js";
import { addAll, entries } from "./list/plan.js";
import { state } from "./list/state.js";
import { fitting, goBack, here } from "./model/history.js";
import { addedBy, isContext, takeOut } from "./model/steps.js";
import { errorText, errorUnit, measuredText, parameterScale, titleOf } from "./words.js";

/** @typedef {import("../../types.js").Step} Step */
/** `from`: the error before; `index`: of the models so far, −1 for a proposed one.
 * @typedef {{label: string, note: import("../../dom.js").Child, rmse: number | null, holdout: number | null,
 *   from: number | null, kind: "past" | "now" | "ahead", isContext: boolean, index: number,
 *   choose?: {step: import("./types.js").PathStep, effects: number}}} Row `choose`: a proposed model that can be
 * taken with all before it. */

/** The fitted values that a step brought. @param {Step[]} all @param {number} i */
function valuesNote(all, i) {
  const last = all[all.length - 1], effects = last.effects ?? effectValues(preset.value);
  // A diagnosis that adds no effect has fitted the current model.
  const found = diagnosis.value?.verdict.effects.length === 0 ? fitOf(diagnosis.value.parameters) : {};
  const ids = i ? addedBy(all, i) : Object.keys(all[0].effects ?? effectValues(preset.value));
  const shown = ids.flatMap((id) => {
    const parameters = effectsById.value.get(id)?.parameters ?? [];
    return parameters.flatMap((p) => {
      const fit = surer(last.fit[id]?.[p.name], found[id]?.[p.name]), value = effects[id]?.[p.name];
      const now = answer.value?.parameters[id]?.[p.name];
      if (!fit || typeof value !== "number") return [];
      const s = parameterScale(p, units.value);
      const limit = fit.at_bound ? h("span", { class: "at-bound" }, " at its limit") : null;
      return [
        h(
          "span",
          { class: "pair" },
          mathml(p.symbol_mathml),
          " = ",
          measuredText(now?.value ?? value, fit.stderr, s),
          limit,
        ),
      ];
    });
  });
  return shown.length ? shown : null;
}

/** @returns {Row[]} */
function rows() {
  const now = { ...here(), rmse: stale.value ? null : here().rmse };
  const all = [...compare.value.history, now];
  const proposed = stale.value || state.value !== "verdict" ? [] : ahead.value;
  const done = all.map((step, index) => {
    const context = isContext(all, index);
    return {
      label: step.label.replace(/^\+ /, ""),
      note: context ? "an entry, not an effect" : valuesNote(all, index),
      rmse: step.rmse,
      holdout: step.holdout,
      from: index ? all[index - 1].rmse : null,
      kind: /** @type {"past" | "now"} */ (index === all.length - 1 ? "now" : "past"),
      isContext: context,
      index,
    };
  });
  return [
    ...done,
    ...proposed.map((step, i) => {
      const entry = entries.value.find((e) => e.step === step);
      return {
        label: entry ? `+ ${titleOf(entry.chosen)}` : "Values fitted",
        note: null,
        rmse: step.rmse,
        holdout: step.holdout_rmse,
        from: i ? proposed[i - 1].rmse : now.rmse,
        kind: /** @type {const} */ ("ahead"),
        isContext: false,
        index: -1,
        ...(i ? { choose: { step, effects: proposed.slice(0, i + 1).filter((s) => s.added).length } } : {}),
      };
    }),
  ];
}

/** @param {Row} row @param {number} most @param {number | null} noise */
function ladderRow(row, most, noise) {
  const a = answer.value;
  const asText = (/** @type {number | null} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, false);
  const share = (/** @type {number | null} */ si) => si === null ? 0 : Math.min(100, (100 * si) / most);
  const { from, rmse } = row, low = Math.min(from ?? 0, rmse ?? 0), high = Math.max(from ?? 0, rmse ?? 0);
  const isWorse = from !== null && rmse !== null && rmse > from;
  return h(
    "tr",
    { class: row.kind, "aria-current": row.kind === "now" ? "step" : null },
    h(
      "th",
      { scope: "row" },
      row.kind === "past"
        ? h("button", {
          type: "button",
          class: "link",
          title: "Back to this model: the later steps go",
          onclick: () => goBack(row.index),
        }, row.label)
        : h("b", null, row.label),
      row.kind === "now" ? h("span", { class: "now-tag" }, "now") : null,
      row.kind === "ahead" ? h("small", { class: "unseen" }, " proposed") : null,
      row.note ? h("small", { class: "note" }, row.note) : null,
    ),
    h(
      "td",
      { class: "fall-cell" },
      h(
        "span",
        { class: "fall-track", "aria-hidden": "true" },
        h("i", { class: "base", style: `width:${share(rmse)}%` }),
        from === null || rmse === null ? null : h("i", {
          class: `step-drop${row.isContext ? " entry" : ""}${isWorse ? " worse" : ""}`,
          style: `left:${share(low)}%;width:${share(high) - share(low)}%`,
        }),
        row.holdout === null || rmse === null ? null : h("u", { style: `left:${share(row.holdout)}%` }),
        noise === null ? null : h("s", { style: `left:${share(noise)}%` }),
        from === null || rmse === null || !from
          ? null
          : h("em", { style: `left:${share(high)}%` }, changeText(from, rmse)),
      ),
    ),
    h("td", null, asText(rmse)),
    h("td", { class: "held" }, asText(row.holdout)),
    h(
      "td",
      { class: "undo" },
      row.index > 0
        ? h("button", {
          type: "button",
          class: "mini",
          "aria-label": `Take out ${row.label}`,
          title: "Take out this step; the later ones stay and are fitted again",
          disabled: () => fitting.value,
          onclick: () => takeOut(row.index),
        }, icon("undo"))
        : row.choose
        ? h("button", {
          type: "button",
          class: "mini",
          "aria-label": `Add ${row.choose.effects} effects, up to ${row.label.replace(/^\+ /, "")}`,
          title: `Add the effects up to this one: ${asText(rmse)}, held-out ${asText(row.holdout)}`,
          disabled: () => stale.value || fitting.value,
          onclick: () => addAll(row.choose?.step),
        }, icon("plus"))
        : null,
    ),
  );
}

const ERROR = figure("comparison.rmse_beyond_accuracy"), HELD_OUT = figure("comparison.holdout_rmse");
const NOISE = figure("comparison.noise_floor");
const SKELETONS = 3;

export function ladderCard() {
  const noise = () => {
    const a = answer.value;
    return a && Object.keys(a.channels).length > 1
      ? 1
      : diagnosis.value?.noise_floor.rmse ?? a?.noise_floor ?? null;
  };
  const body = () => {
    const all = rows(), floor = noise();
    const most = Math.max(...all.map((r) => r.rmse ?? 0), 1e-12);
    const waiting = ["running", "comparing"].includes(state.value);
    const a = answer.value;
    return [
      ...all.map((row) => ladderRow(row, most, floor)),
      ...(waiting
        ? [...Array(SKELETONS).keys()].map(() =>
          h(
            "tr",
            { class: "waiting", "aria-hidden": "true" },
            h("th", null, h("i", { class: "bone" })),
            // One cell for each column: a wider one would add a column where "held-out" is not shown.
            h("td", null),
            h("td", null),
            h("td", { class: "held" }),
            h("td", { class: "undo" }),
          )
        )
        : []),
      floor === null ? null : h(
        "tr",
        { class: "floor" },
        h(
          "th",
          { scope: "row", colspan: 2, title: NOISE.definition },
          `${NOISE.label} `,
          h("small", null, a?.noise_how ?? ""),
        ),
        h(
          "td",
          { id: "noise-floor" },
          errorText(floor, a?.unit ?? "N", a?.predicted ?? "force", units.value, false),
        ),
        h("td", { class: "held" }),
        h("td", null),
      ),
    ];
  };
  const unit = () => errorUnit(answer.value?.unit ?? "N", answer.value?.predicted ?? "force", units.value);
  const remark = () =>
    state.value === "unknown"
      ? "values are biased while an effect is missing"
      : state.value === "verdict"
      ? "hatched: proposed"
      : "";
  const errors = inSentence(figure("parameter.stderr").label);
  return h(
    "section",
    { class: "card ladder", "aria-label": "From the start to the noise" },
    h("div", { class: "card-head" }, h("h2", null, "From the start to the noise"), h("small", null, remark)),
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
          h("th", { scope: "col", class: "text" }, "Step ", h("small", null, errors)),
          h("td", { class: "fall-cell" }, h("small", null, h("u", { class: "held-key" }), "held-out")),
          h(
            "th",
            { scope: "col", title: ERROR.definition },
            () => h("span", null, `${ERROR.label} ${unit()}`),
          ),
          h(
            "th",
            { scope: "col", class: "held", title: HELD_OUT.definition },
            () => h("span", null, `${HELD_OUT.label} ${unit()}`),
          ),
          h("td", { class: "undo" }),
        ),
      ),
      h("tbody", null, body),
    ),
  );
}
