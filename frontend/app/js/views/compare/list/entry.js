// @ts-check
// One entry of the list: an effect that is missing, what it would do, and what it cannot be told from.
import { h, icon } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { brief, capitalized, number, probabilityText, readable } from "../../../format.js";
import { aboutButton } from "../../../muscle/effects.js";
import { answer, preview, stale } from "../answers.js";
import { fitting, refit } from "../model/history.js";
import { channelWords, errorText, titleOf } from "../words.js";
import { equationBox } from "../../../ui/equation.js";
import { add, addCandidate, choose, modelOf, refits } from "./plan.js";
import { insideOf } from "./selection.js";
import { drawSketch, sketches } from "./sketch.js";
import { valueList } from "./values.js";

/** @typedef {import("./plan.js").Entry} Entry */
/** @typedef {import("../../../types.js").Telling} Telling */
/** @typedef {import("../types.js").Candidate} Candidate */

/** @param {number | null | undefined} si @param {boolean} [unit] */
const asText = (si, unit = true) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, unit);
};

/** "Would explain −220 N of the −250 N there." For several channels each is named. @param {import("./selection.js").Inside} inside */
function insideText({ shares }) {
  const unitOf = (/** @type {string} */ channel) =>
    answer.value?.series.find((s) => s.channel === channel)?.unit ?? answer.value?.unit ?? "N";
  const text = (/** @type {string} */ channel, /** @type {number} */ si) =>
    `${si < 0 ? "−" : "+"}${errorText(Math.abs(si), unitOf(channel), channel, units.value)}`;
  const parts = shares.map(({ channel, mean, seen }) =>
    `${shares.length > 1 ? `${channelWords(channel)} ` : ""}${text(channel, mean)} of the ${
      text(channel, seen)
    }`
  );
  return `Would explain ${parts.join(", ")} there.`;
}

/** "31.8 → 15.0 N" @param {number} from @param {number} to */
export const fallText = (from, to) => `${asText(from, false)} → ${asText(to)}`;

/** What is to be done where the values of the model do not fit best. */
export const REFIT = "Refit the values of the model";

/** How likely an effect is missing. @param {number} probability 0…1 */
export const likelyText = (probability) => `${probabilityText(probability)} likely`;

/** A text of the catalogue as a sentence. @param {string} text */
const sentence = (text) => `${capitalized(text).replace(/\.$/, "")}.`;

const NO_TEST = "No test that this rig can run tells them";

/** A title without what it says in brackets. @param {string} id */
const plainTitle = (id) => titleOf(id).replace(/ \([^)]*\)$/, "");

/** Whether a test was simulated that separates the two; its minutes are those of that test.
 * @param {Telling} t */
const isDecided = (t) => (t.separation ?? 0) >= 1;

/** "Would tell (10 min): " of a pair; with more than two effects in the group, which pair is meant.
 * @param {Telling} t @param {boolean} several */
function tellingLead(t, several) {
  const time = isDecided(t) && t.minutes !== null
    ? ` (${number(t.minutes, t.minutes < 3 ? 1 : 0)}\u00a0min)`
    : "";
  return `${several ? t.pair.map(plainTitle).join(" or ") : "Would tell"}${time}: `;
}

/** @param {Telling} t */
export function tellingText(t) {
  const declared = t.declared ? sentence(t.declared) : "";
  return isDecided(t)
    ? `${declared} Best simulated test: ${t.protocol}, difference ${brief(t.separation ?? 0)}\u00a0σ.`.trim()
    : declared || `${NO_TEST} apart.`;
}

/** What would tell the effects of a group apart; those that nothing does are one line. @param {Telling[]} all */
export const tellings = (all) => {
  const tells = all.filter((t) => t.declared || isDecided(t)), never = all.filter((t) => !tells.includes(t));
  const names = [...new Set(never.map((t) => plainTitle(t.pair[1])))];
  return [
    ...testsOf(tells, all.length > 1),
    never.length
      ? h(
        "p",
        { class: "tell" },
        icon("flask"),
        h("span", null, `${NO_TEST} apart: ${[plainTitle(never[0].pair[0]), ...names].join(", ")}.`),
      )
      : null,
  ];
};

/** @param {Telling[]} tells @param {boolean} several whether the pair must be named */
const testsOf = (tells, several) =>
  tells.map((t) =>
    h(
      "p",
      { class: "tell" },
      icon("flask"),
      h(
        "span",
        null,
        h("b", null, tellingLead(t, several)),
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

/** @param {Entry} entry @param {number} index @param {number | null} noise
 * @param {Record<string, import("./sketch.js").Sketch> | null} [was] the sketches of the last verdict, whose entry
 *   stays while the next one is on its way: nothing recommends it meanwhile */
export function entryRow(entry, index, noise, was = null) {
  const { chosen, effect, group, from, to, holdout, probability } = entry, title = titleOf(chosen);
  const known = effectsById.value.get(chosen);
  const inside = was ? null : insideOf(effect), isFirst = !index && !refits.value;
  return h(
    "li",
    { class: `missing${was ? " kept" : isFirst ? " first" : ""}`, "data-candidate": chosen },
    h(
      "div",
      { class: "missing-head" },
      h("span", { class: "rank", "aria-hidden": "true" }, index + 1),
      h("h3", null, title),
      known ? aboutButton(known) : null,
      probability === null ? null : h(
        "span",
        { class: "likely", title: figure("diagnosis.probability").definition },
        `${was ? "was " : ""}${entry.correction ? "correction, " : ""}${likelyText(probability)}`,
      ),
    ),
    h(
      "div",
      { class: "missing-row" },
      drawSketch((was ?? sketches.value)[effect], title),
      h(
        "div",
        { class: "missing-numbers" },
        h("b", null, fallText(from, to)),
        track(from, to, noise),
        h("small", null, `held-out ${asText(holdout)}`),
      ),
      h("button", {
        type: "button",
        class: isFirst && !was ? "primary" : "",
        "aria-label": `Add ${title}`,
        disabled: () => stale.value || fitting.value,
        onclick: () => add(entry),
        ...glance(() => modelOf(entry), `+ ${title}`),
      }, "Add"),
    ),
    h("p", { class: "why" }, sentence(known?.signature?.text ?? entry.candidate?.why ?? "")),
    inside === null ? null : h(
      "p",
      { class: "inside" },
      insideText(inside),
    ),
    entry.reason ? h("p", { class: "why" }, sentence(entry.reason)) : null,
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

/** The model's own values fit better after a refit: the first thing to do where it is so.
 * @param {import("../types.js").PathStep} step @param {number} from @param {number | null} noise */
export const refitRow = (step, from, noise) =>
  h(
    "div",
    { class: "missing first refit" },
    h("div", { class: "missing-head" }, h("h3", null, REFIT)),
    h(
      "div",
      { class: "missing-row plain" },
      h(
        "div",
        { class: "missing-numbers" },
        h("b", null, fallText(from, step.rmse)),
        track(from, step.rmse, noise),
        h("small", null, `held-out ${asText(step.holdout_rmse)}`),
      ),
      h("button", {
        type: "button",
        class: "primary",
        disabled: () => stale.value || fitting.value,
        onclick: refit,
      }, "Refit"),
    ),
    h("p", { class: "why" }, "No new effect: the values that are in the model come closer to the data."),
  );

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
        h("b", null, fallText(answer.value?.rmse_beyond_accuracy ?? c.rmse, c.rmse)),
        track(answer.value?.rmse_beyond_accuracy ?? c.rmse, c.rmse, null),
        h("small", null, `held-out ${asText(c.holdout_rmse)}`),
      ),
      h("button", {
        type: "button",
        "aria-label": `Add ${c.title}`,
        disabled: () => stale.value || fitting.value,
        onclick: () => addCandidate(c),
      }, "Add"),
    ),
    h("p", { class: "why" }, sentence(effectsById.value.get(c.effect)?.signature?.text ?? "")),
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
