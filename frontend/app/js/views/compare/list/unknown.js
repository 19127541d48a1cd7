// @ts-check
// An effect that the catalogue does not have: what is left, where, what to measure, and a formula as the last resort.
import { h, icon } from "../../../dom.js";
import { inSentence } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief, capitalized } from "../../../format.js";
import { answer, lookCompare } from "../answers.js";
import { proposedTerm } from "../model/own-term.js";
import { errorText, overNoise, titleOf, VARIABLES, whatIsLeft } from "../words.js";
import { tellingText } from "./entry.js";
import { refits } from "./plan.js";
import { openChoices, setAside } from "./adequate.js";
import { termPlot } from "./term-plot.js";

/** @typedef {import("../types.js").Diagnosis} Diagnosis */

/** Names of effects that a line has room for. */
const MOST_NAMES = 3;

/** Without times no direction of motion is known, and what depends on it or on the past cannot be tried.
 * @param {Diagnosis} result */
function timesFirst({ not_tried: left }) {
  const names = left.filter((each) => each.needs_time).map(({ effect }) => titleOf(effect));
  const more = names.length - MOST_NAMES;
  return names.length
    ? [{
      what: "Record the time of each row",
      why: `Without it no direction of motion is known, and what depends on the past was not tried: ${
        names.slice(0, MOST_NAMES).join(", ")
      }${more > 0 ? ` and ${more} more` : ""}.`,
    }]
    : [];
}

/** What to measure next, each with what it shows; `brief`: in few words, for the strip.
 * @param {Diagnosis} result @returns {{what: string, why: string, brief?: string}[]} */
export function plan(result) {
  const { verdict } = result;
  const steps = verdict.experiments.map((e) => ({
    what: e.pair.map(titleOf).join(" or "),
    why: tellingText({ ...e, minutes: null }),
  }));
  const look = verdict.where_to_look;
  return [
    ...(look
      ? [{ what: `Repeat ${where(look)} in finer steps`, why: "Shows the shape of what is left." }]
      : []),
    ...timesFirst(result),
    {
      what: "Repeat the whole run with the clamps turned or the sensor exchanged",
      brief: "Repeat the run with the clamps turned",
      why: "What moves with them belongs to the rig, what stays to the muscle.",
    },
    ...steps,
  ];
}

/** The place alone, of "look where it is largest: …". @param {string} text */
const where = (text) =>
  text.replace(/^[^:]*: */, "").replace(/ \([^)]*\)/g, "").replace(/\.$/, "").replace(/(^| )-(?=\d)/g, "$1−");

/** In few words, for the strip. @param {Diagnosis} result */
export const nextMeasurement = (result) => {
  const look = result.verdict.where_to_look, [first] = plan(result);
  return look
    ? `Measure ${
      where(look).split(" and ")[0].replace(/^contraction /, "ε ").replace(/ (?=\S+$)/, "\u00a0")
    } again`
    : capitalized(first.brief ?? first.what);
};

/** @param {Diagnosis} result */
export const copyPlan = (result) =>
  navigator.clipboard.writeText(plan(result).map((s, i) => `${i + 1}. ${s.what}. ${s.why}`).join("\n"));

/** The catalogued effect that comes closest, and why it was not added. @param {Diagnosis} result */
function nearest(result) {
  const best = [...result.candidates].sort((a, b) => a.rmse - b.rmse)[0];
  if (!best) return "";
  const asText = (/** @type {number} */ si) => errorText(si, result.unit, result.predicted, units.value);
  const worse = best.holdout_rmse >= result.baseline.holdout_rmse, floor = result.noise_floor.rmse;
  const remains = floor && !worse ? `, ${overNoise(best.rmse / floor)} × the noise remains` : "";
  return `${best.title}: ${asText(result.baseline.rmse)} → ${asText(best.rmse)}, held-out ${
    asText(best.holdout_rmse)
  }${worse ? ", which is no better" : ""}: not added${remains}`;
}

const FEWEST_ROWS = 3;

/** The range of a variable with the largest error. @param {string} name @returns {[number, number] | null} */
function worstRange(name) {
  const profile = answer.value?.where.find((one) => one.over === name);
  if (!profile || profile.edges.length < FEWEST_ROWS) return null;
  const sizes = profile.rms.map((rms, i) => (profile.count[i] ?? 0) >= FEWEST_ROWS ? rms ?? 0 : 0);
  const at = sizes.indexOf(Math.max(...sizes)), from = profile.edges[at], to = profile.edges[at + 1];
  return from == null || to == null ? null : [from, to];
}

/** Shows the residual over a variable, with the worst range chosen. @param {string} name */
function showWorst(name) {
  const range = worstRange(name);
  lookCompare({
    tab: /** @type {import("../../../types.js").Tab} */ (name),
    ...(range && name !== "direction" ? { brush: { [name]: range } } : {}),
  });
}

/** What a formula for the rest is worth. @param {NonNullable<Diagnosis["verdict"]["proposed_term"]>} term
 * @param {Diagnosis} result */
function describes(term, result) {
  const share = `${brief(100 * term.share)}\u00a0% of the remaining squared error`;
  const band = errorText(term.band, result.unit, result.predicted, units.value);
  return `${
    term.kind === "smooth"
      ? `No short formula is found. This smooth one follows ${share}`
      : `This formula takes ${share}`
  }, and leaves ${band} in the groups left out of its fit. It describes the unexplained rest, it does not ` +
    "explain it, and holds inside the measured range only.";
}

/** @param {Diagnosis} result */
export function unknown(result) {
  const { verdict } = result, a = answer.value;
  const over = result.unit !== "1" && a?.over_noise ? `, ${overNoise(a.over_noise)} × the noise` : "";
  if (verdict.status === "undecided") {
    return [
      h(
        "div",
        { class: "conclusion" },
        icon("flask"),
        h(
          "div",
          null,
          h("b", { id: "verdict-status" }, capitalized(verdict.title)),
          h("p", null, verdict.sentence),
        ),
      ),
      setAside(result),
      openChoices(),
    ];
  }
  const term = verdict.proposed_term, variable = verdict.unexplained_in.find((name) => name in VARIABLES);
  return [
    h(
      "div",
      { class: "conclusion bad" },
      icon("warn"),
      h(
        "div",
        null,
        h("b", { id: "verdict-status" }, capitalized(verdict.title)),
        h(
          "p",
          null,
          `${
            errorText(a?.rmse_beyond_accuracy, result.unit, result.predicted, units.value)
          } are left${over}.`,
        ),
      ),
    ),
    h(
      "section",
      { class: "list-part unknown", "aria-label": "What is left" },
      h("h3", null, "What is left"),
      h("p", { class: "why" }, `${whatIsLeft(verdict)}.`),
      verdict.where_to_look ? h("p", { class: "why" }, capitalized(verdict.where_to_look)) : null,
      refits.value
        ? h(
          "p",
          { class: "why" },
          `Fitting the values of the model again leaves ${
            errorText(refits.value.rmse, result.unit, result.predicted, units.value)
          }.`,
        )
        : null,
      h("p", { class: "why" }, `Nearest in the catalogue: ${nearest(result)}.`),
      variable
        ? h("button", {
          type: "button",
          class: "link",
          onclick: () => showWorst(variable),
        }, `Show where, over ${inSentence(VARIABLES[variable].title)}`)
        : null,
    ),
    h(
      "section",
      { class: "list-part", "aria-label": "Measure next" },
      h("h3", null, "Measure next"),
      h(
        "ol",
        { class: "plan" },
        ...plan(result).map((s) => h("li", null, h("b", null, s.what), h("p", { class: "why" }, s.why))),
      ),
    ),
    term
      ? h(
        "section",
        { class: "list-part unknown", "aria-label": "Describe it for now" },
        h("h3", null, "Or describe it for now"),
        h("p", { class: "why" }, describes(term, result)),
        term.curve ? termPlot() : null,
        proposedTerm(term, "Formula", true),
      )
      : null,
    setAside(result),
    openChoices(),
  ];
}
