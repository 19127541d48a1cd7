// @ts-check
// One entry of the list: an effect that is missing, what it would do, and what it cannot be told from.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { brief, capitalized, number, readable } from "../../../format.js";
import { aboutButton } from "../../../muscle/effects.js";
import { answer, preview, stale } from "../answers.js";
import { fitting } from "../model/history.js";
import { errorText, titleOf } from "../words.js";
import { equationBox } from "./equation.js";
import { add, addCandidate, choose, modelOf } from "./plan.js";
import { insideOf } from "./selection.js";
import { drawSketch, hasSketches, sketches } from "./sketch.js";
import { valueList } from "./values.js";

/** @typedef {import("./plan.js").Entry} Entry */
/** @typedef {import("../../../types.js").Telling} Telling */
/** @typedef {import("../types.js").Candidate} Candidate */

/** @param {number | null | undefined} si @param {boolean} [unit] */
const asText = (si, unit = true) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, unit);
};

/** "−220 N" @param {number} si */
const signedText = (si) => `${si < 0 ? "−" : "+"}${asText(Math.abs(si))}`;

/** "31.8 → 15.0 N" @param {number} from @param {number} to */
export const fallText = (from, to) => `${asText(from, false)} → ${asText(to)}`;

const CORRECTION =
  "Not called missing: a slightly inexact form of the effects above would explain as much. " +
  "The model keeps it because it predicts left-out groups better with it.";

/** How likely an effect is missing. @param {number} probability 0…1 */
export const likelyText = (probability) =>
  `${probability >= 0.995 ? "> 99" : Math.max(1, Math.round(100 * probability))} % likely`;

/** @param {Telling} t */
export function tellingText(t) {
  const told = t.declared ? `${capitalized(t.declared).replace(/\.$/, "")}.` : "";
  if (t.separation !== null && t.separation >= 1) {
    return `${told} Best simulated test: ${t.protocol}, difference ${brief(t.separation)}\u00a0σ.`.trim();
  }
  return told || "No simulated force test tells them apart.";
}

/** What would tell the effects of a group apart. @param {Telling[]} tells */
export const tellings = (tells) =>
  tells.map((t) =>
    h(
      "p",
      { class: "tell" },
      icon("flask"),
      h(
        "span",
        null,
        h(
          "b",
          null,
          `Would tell${t.minutes === null ? "" : ` (${number(t.minutes, t.minutes < 3 ? 1 : 0)} min)`}: `,
        ),
        tellingText(t),
      ),
    )
  );

/** The effects of a group as radio choices. @param {string} name of the radios @param {string[]} group
 * @param {string} chosen @param {(id: string) => void} take @param {string} [legend] */
export const twinChoice = (name, group, chosen, take, legend = "These data cannot tell which. Choose one:") =>
  h(
    "fieldset",
    { class: "twins" },
    h("legend", null, legend),
    ...group.map((id) => {
      const count = effectsById.value.get(id)?.parameters.filter((p) => p.fitted !== false).length ?? 0;
      return h(
        "label",
        { class: "pick" },
        h("input", {
          type: "radio",
          name: `twin-${name}`,
          value: id,
          checked: id === chosen,
          onchange: () => take(id),
        }),
        h("span", null, titleOf(id)),
        count ? h("small", null, `${count} value${count > 1 ? "s" : ""}`) : null,
      );
    }),
  );

/** Draws a model while its button is pointed at or focused.
 * @param {() => import("../request.js").Asked} model @param {string} label */
export const glance = (model, label) => ({
  onpointerenter: () => preview(model(), label),
  onpointerleave: () => preview(null),
  onfocus: () => preview(model(), label),
  onblur: () => preview(null),
});

/** @param {Entry} entry */
const details = ({ candidate }) =>
  candidate
    ? h(
      "details",
      null,
      h("summary", null, "Why, values, equation"),
      candidate.why ? h("p", { class: "why" }, candidate.why) : null,
      valueList(candidate.effect, candidate.parameters),
      candidate.freed.length
        ? h(
          "p",
          { class: "muted" },
          `Fitted with it: ${candidate.freed.map((name) => readable(name.replace(".", ": "))).join(", ")}.`,
        )
        : null,
      equationBox(
        candidate.title,
        effectsById.value.get(candidate.effect)?.equation_mathml,
        candidate.equation,
      ),
    )
    : null;

/** @param {number} from @param {number} to @param {number | null} noise */
const track = (from, to, noise) =>
  h(
    "span",
    { class: "after-bar", "aria-hidden": "true" },
    h("i", { style: `width:${Math.min(100, (100 * to) / (from || 1))}%` }),
    noise === null || noise > from ? null : h("u", { style: `left:${(100 * noise) / from}%` }),
  );

/** @param {Entry} entry @param {number} index @param {number | null} noise */
export function entryRow(entry, index, noise) {
  const { chosen, effect, group, from, to, holdout, probability } = entry, title = titleOf(chosen);
  const known = effectsById.value.get(chosen);
  const inside = insideOf(effect);
  return h(
    "li",
    { class: `missing${index ? "" : " first"}`, "data-candidate": chosen },
    h(
      "div",
      { class: "missing-head" },
      h("span", { class: "rank", "aria-hidden": "true" }, index + 1),
      h("h3", null, title),
      known ? aboutButton(known) : null,
      probability === null ? null : h(
        "span",
        { class: "likely" },
        `${entry.correction ? "correction, " : ""}${likelyText(probability)}`,
      ),
    ),
    h(
      "div",
      { class: `missing-row${hasSketches.value ? "" : " plain"}` },
      hasSketches.value ? drawSketch(sketches.value[effect], title) : null,
      h(
        "div",
        { class: "missing-numbers" },
        h("b", null, fallText(from, to)),
        track(from, to, noise),
        h("small", null, `held-out ${asText(holdout)}`),
      ),
      h("button", {
        type: "button",
        class: index ? "" : "primary",
        "aria-label": `Add ${title}`,
        disabled: () => stale.value || fitting.value,
        onclick: () => add(entry),
        ...glance(() => modelOf(entry), `+ ${title}`),
      }, "Add"),
    ),
    h("p", { class: "why" }, capitalized(known?.signature?.text ?? entry.candidate?.why ?? "")),
    inside === null ? null : h(
      "p",
      { class: "inside" },
      `Would explain ${signedText(inside.mean)} of the ${signedText(inside.seen)} there.`,
    ),
    entry.reason ? h("p", { class: "why" }, capitalized(entry.reason)) : null,
    entry.correction ? h("p", { class: "why" }, CORRECTION) : null,
    group.length > 1
      ? h(
        "div",
        { class: "twin-box" },
        twinChoice(effect, group, chosen, (id) => choose(effect, id)),
        ...tellings(entry.tells),
      )
      : null,
    details(entry),
  );
}

/** The best so far, while the others are tried. @param {Candidate} c */
export const soFarRow = (c) =>
  h(
    "li",
    { class: "missing first", "data-candidate": c.effect },
    h(
      "div",
      { class: "missing-head" },
      h("span", { class: "rank", "aria-hidden": "true" }, 1),
      h("h3", null, c.title),
      h("span", { class: "likely" }, "so far best"),
    ),
    h(
      "div",
      { class: "missing-row" },
      drawSketch(undefined, c.title),
      h(
        "div",
        { class: "missing-numbers" },
        h("b", null, fallText(answer.value?.rmse ?? c.rmse, c.rmse)),
        track(answer.value?.rmse ?? c.rmse, c.rmse, null),
        h("small", null, `held-out ${asText(c.holdout_rmse)}`),
      ),
      h("button", {
        type: "button",
        "aria-label": `Add ${c.title}`,
        disabled: () => stale.value || fitting.value,
        onclick: () => addCandidate(c),
      }, "Add"),
    ),
    h("p", { class: "why" }, capitalized(effectsById.value.get(c.effect)?.signature?.text ?? "")),
  );

/** The place of an entry that is not known yet. @param {number} index */
export const skeletonRow = (index) =>
  h(
    "li",
    { class: "missing waiting", "aria-hidden": "true" },
    h(
      "div",
      { class: "missing-head" },
      h("span", { class: "rank" }, index + 1),
      h("i", { class: "bone wide" }),
    ),
    h(
      "div",
      { class: "missing-row" },
      h("i", { class: "bone sketch" }),
      h("div", { class: "missing-numbers" }, h("i", { class: "bone" }), h("i", { class: "bone thin" })),
      h("i", { class: "bone button" }),
    ),
    h("i", { class: "bone full" }),
  );
