// @ts-check
// Everything else that was tried, as one folded table; and effects that were no candidates, with the reason.
import { h } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { capitalized } from "../../../format.js";
import { answer, candidates, diagnosis, stage, stale } from "../answers.js";
import { fitting, geometryOf } from "../model/history.js";
import { errorText, errorUnit, titleOf } from "../words.js";
import { equationBox } from "../../../ui/equation.js";
import { glance } from "./entry.js";
import { addCandidate, entries } from "./plan.js";
import { state } from "./state.js";
import { valueList } from "./values.js";

/** @typedef {import("../types.js").Candidate} Candidate */

const ERROR = figure("diagnosis.rmse"), HELD_OUT = figure("diagnosis.holdout_rmse");

/** Candidates that are no entry of the list and no twin of one. */
const others = () => {
  const named = new Set(entries.value.flatMap((e) => e.group));
  return candidates.value.filter((c) => !named.has(c.effect));
};

/** @param {Candidate} c */
function row(c) {
  const a = answer.value, known = effectsById.value.get(c.effect);
  const asText = (/** @type {number} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, false);
  return h(
    "tr",
    { "data-candidate": c.effect },
    h(
      "th",
      { scope: "row", class: "text" },
      h(
        "details",
        null,
        h("summary", null, c.title),
        c.why ? h("p", { class: "why" }, c.why) : null,
        c.twins.length
          ? h("p", { class: "why" }, `These data cannot tell it from ${c.twins.map(titleOf).join(", ")}.`)
          : null,
        valueList(c.effect, c.parameters),
        equationBox(c.title, known?.equation_mathml, c.equation),
      ),
    ),
    h("td", null, asText(c.rmse)),
    h("td", null, asText(c.holdout_rmse)),
    h(
      "td",
      null,
      h("button", {
        type: "button",
        class: "small",
        "aria-label": `Add ${c.title}`,
        disabled: () => stale.value || fitting.value,
        onclick: () => addCandidate(c),
        ...glance(
          () => ({ effects: c.model.effects, freed: c.freed, values: geometryOf(c.model) }),
          `+ ${c.title}`,
        ),
      }, "Add"),
    ),
  );
}

/** Effects that were no candidates, by the reason. */
function notTried() {
  const left = diagnosis.value?.not_tried ?? [];
  if (stage.value !== "done" || !left.length) return null;
  /** @type {Map<string, string[]>} */
  const reasons = new Map();
  for (const { effect, why } of left) reasons.set(why, [...(reasons.get(why) ?? []), titleOf(effect)]);
  return h(
    "details",
    { class: "not-tried" },
    h(
      "summary",
      null,
      left.length === 1 ? "1 effect was not tried" : `${left.length} effects were not tried`,
    ),
    h(
      "ul",
      { class: "plain" },
      [...reasons].map(([why, names]) =>
        h("li", null, h("b", null, `${capitalized(why)}: `), names.join(", "))
      ),
    ),
  );
}

/** Why effects that leave less alone than an entry are none: the entries were chosen together.
 * @param {number} best error that the best of the others leaves alone */
function whyNone(best) {
  const a = answer.value, alone = entries.value.flatMap((e) => e.candidate ? [e.candidate] : []);
  const worst = alone.reduce((max, c) => c.rmse > (max?.rmse ?? 0) ? c : max, alone[0]);
  if (!entries.value.length || !alone.length) return null;
  const text = (/** @type {number} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value);
  const less = best < worst.rmse ? `, less than ${worst.title} alone (${text(worst.rmse)})` : "";
  return h(
    "p",
    { class: "why" },
    `Alone the best of them leaves ${text(best)}${less}. `,
    entries.value.length > 1
      ? "The effects above were chosen together: beside them none of these lowers the error by more than chance."
      : "Beside the effect above none of these lowers the error by more than chance.",
  );
}

/** "40 more tried: not needed beside those above", "40 more tried: the best alone leaves 86.8 N" */
export function triedFold() {
  const all = others();
  if (!all.length || stage.value !== "done") return notTried();
  const a = answer.value, unit = errorUnit(a?.unit ?? "N", a?.predicted ?? "force", units.value);
  const best = Math.min(...all.map((c) => c.rmse));
  const useful = all.some((c) => c.gain_percent >= 1);
  return [
    h(
      "details",
      { class: "tried" },
      h(
        "summary",
        null,
        `${all.length} more tried: `,
        entries.value.length
          ? `not needed beside ${entries.value.length > 1 ? "those" : "the one"} above`
          : state.value === "adequate"
          ? "none helps beyond chance"
          : useful
          ? `the best alone leaves ${errorText(best, a?.unit ?? "N", a?.predicted ?? "force", units.value)}`
          : "none lowers the error by 1 %",
      ),
      whyNone(best),
      h(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "Other effects that were tried" },
        h(
          "table",
          { class: "data" },
          h("caption", { class: "unseen" }, "Other effects, each added alone"),
          h(
            "thead",
            null,
            h(
              "tr",
              null,
              h("th", { scope: "col", class: "text" }, "Alone"),
              h("th", { scope: "col", title: ERROR.definition }, ERROR.label, h("small", null, unit)),
              h("th", { scope: "col", title: HELD_OUT.definition }, HELD_OUT.label, h("small", null, unit)),
              h("td", null),
            ),
          ),
          h("tbody", null, ...all.map(row)),
        ),
      ),
    ),
    notTried(),
  ];
}

/** How many effects were tried. */
export const triedText = () => candidates.value.length ? `${candidates.value.length} tried` : "";
