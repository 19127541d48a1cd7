// @ts-check
// Nothing is missing: what that rests on, what was chosen without proof, what this file never tested.
import { h, icon } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { goTo, units } from "../../../state.js";
import { capitalized, scaleOf, withUnit } from "../../../format.js";
import { answer, heldOut } from "../answers.js";
import { useInDesign } from "../exports.js";
import { exchange } from "../model/steps.js";
import { fitting, remove } from "../model/history.js";
import { errorText, titleOf } from "../words.js";
import { tellings, twinChoice } from "./entry.js";
import { openSteps, wideNoise } from "./state.js";

/** @typedef {import("../types.js").Diagnosis} Diagnosis */

/** Choices that the data do not decide: they stay open. */
export function openChoices() {
  if (!openSteps.value.length) return null;
  return h(
    "section",
    { class: "list-part", "aria-label": "Chosen, not proven" },
    h("h3", null, "Chosen, not proven"),
    h("p", { class: "why" }, "The data fit with either. Outside the measured range they differ."),
    ...openSteps.value.map(({ index, group, chosen, tells }) =>
      h(
        "div",
        { class: "twin-box" },
        twinChoice(`step${index}`, group, chosen, (id) => {
          if (!fitting.peek()) exchange(index, chosen, id);
        }, `${titleOf(chosen)}, or one that these data cannot tell from it`),
        ...tellings(tells),
      )
    ),
  );
}

/** Rows that do not fit, which count for nothing in the verdict. @param {Diagnosis} result */
export function setAside({ suspect_rows: rows, unit, predicted }) {
  if (!rows.length) return null;
  return h(
    "section",
    { class: "list-part", "aria-label": "Set aside" },
    h("h3", null, "Set aside"),
    h(
      "ul",
      { class: "plain" },
      ...rows.map((each) =>
        h(
          "li",
          null,
          `${capitalized(each.place)}: ${
            errorText(Math.abs(each.residual), unit, predicted, units.value)
          } off`,
          h("p", { class: "why" }, `${capitalized(each.why)}.`),
        )
      ),
    ),
  );
}

/** Effects of the model that the data do not need. @param {Diagnosis} result */
export function notNeeded({ verdict: { superfluous } }) {
  if (!superfluous.length) return null;
  return h(
    "section",
    { class: "list-part", "aria-label": "Not needed" },
    h("h3", null, "Not needed"),
    h("p", { class: "why" }, "Without it, and all else refitted, the model describes these data as well."),
    h(
      "ul",
      { class: "plain" },
      ...superfluous.map((id) =>
        h(
          "li",
          { class: "row" },
          titleOf(id),
          h("button", {
            type: "button",
            class: "small",
            "aria-label": `Take out ${titleOf(id)}`,
            disabled: () => fitting.value,
            onclick: () => remove(id),
          }, "Take out"),
        )
      ),
    ),
  );
}

/** What a file may vary, in the order in which it is said. */
const RANGES = ["pressure", "contraction", "speed", "temperature"].map((name) => {
  const each = figure(`measured.${name}`);
  const quantity = /** @type {import("../../../format.js").Quantity} */ (each.quantity);
  return { name, quantity, words: name === "contraction" ? each.symbol : inSentence(each.label) };
});

/** The range that the file covers, and what it does not show at all. @param {Diagnosis} result */
function covered({ envelope }) {
  const system = units.value;
  const known = RANGES.filter(({ name }) => name in envelope);
  const untested = RANGES.filter(({ name }) =>
    !(name in envelope) ||
    envelope[name].most - envelope[name].least <= 1e-9 * Math.abs(envelope[name].most)
  );
  const texts = known.map(({ name, quantity, words }) => {
    const range = envelope[name], { unit } = scaleOf(quantity, system);
    const least = withUnit(range.least, quantity, system).replace(new RegExp(`\u00a0${unit}$`), "");
    return `${words} ${least} to ${withUnit(range.most, quantity, system)}`;
  });
  return h(
    "section",
    { class: "list-part", "aria-label": "Measured range" },
    h("h3", null, "It holds where it was measured"),
    h("p", { class: "why" }, `${capitalized(texts.join(", "))}.`),
    untested.length
      ? h(
        "p",
        { class: "why" },
        `Never varied in this file: ${untested.map(({ words }) => words).join(", ")}.`,
      )
      : null,
    h(
      "div",
      { class: "row" },
      h("button", { type: "button", onclick: useInDesign }, "Predict other conditions"),
      h("button", { type: "button", class: "link", onclick: () => goTo("transient") }, "Transient view"),
    ),
  );
}

/** The place of the conclusion that is expected, while the diagnosis looks whether it holds. @param {Diagnosis} was */
export function settling(was) {
  const text = (/** @type {number | null | undefined} */ si) =>
    errorText(si, was.unit, was.predicted, units.value);
  return [
    h(
      "div",
      { class: "conclusion settling" },
      icon("flask"),
      h(
        "div",
        null,
        h("b", null, "Is anything still missing?"),
        // As long as what will stand here.
        h(
          "p",
          { "aria-hidden": "true" },
          sentenceOf(text(answer.value?.rmse_beyond_accuracy), text(heldOut())),
        ),
      ),
    ),
    openChoices(),
    h("div", { class: "settling", "aria-hidden": "true" }, covered(was)),
  ];
}

/** @param {string} error @param {string} held */
const sentenceOf = (error, held) =>
  `${error} is the noise of the data, held-out ${held}. No effect left lowers it by more than chance.`;

/** @param {Diagnosis} result */
export function adequate(result) {
  const a = answer.value, wide = wideNoise.value;
  const asText = (/** @type {number | null | undefined} */ si) =>
    errorText(si, result.unit, result.predicted, units.value);
  const held = asText(heldOut());
  return [
    h(
      "div",
      { class: "conclusion good" },
      icon("check"),
      h(
        "div",
        null,
        h("b", { id: "verdict-status" }, "Nothing is missing"),
        h(
          "p",
          null,
          wide || result.suspect_rows.length
            ? result.verdict.sentence
            : sentenceOf(asText(a?.rmse_beyond_accuracy), held),
        ),
      ),
    ),
    setAside(result),
    openChoices(),
    notNeeded(result),
    covered(result),
  ];
}
