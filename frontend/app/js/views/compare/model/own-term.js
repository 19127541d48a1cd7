// @ts-check
// A term of the user: a formula, typed or proposed by the diagnosis, checked by the server and fitted.
import { h } from "../../../dom.js";
import { signal } from "../../../reactive.js";
import { ApiError } from "../../../server/client.js";
import { addModel, fitting, takeFitted } from "./history.js";
import { compare, preset } from "../answers.js";
import { effectValues } from "../../../muscle/preset.js";
import { FORMULA, OWN_TERM } from "../words.js";

/** @typedef {import("../../../types.js").Effects} Effects */
/** @typedef {import("../types.js").ProposedTerm} ProposedTerm */

/** The variables of a term. @type {[string, string][]} */
const SYMBOLS = [
  ["P", "gauge pressure, Pa"],
  ["kappa", "contraction ratio, 0.1 = 10 %"],
  ["v", "dL/dt, m/s: positive when lengthening"],
  ["L", "length, m"],
  ["t", "time since the record began, s"],
];
const FUNCTIONS = ["sign(", "abs(", "exp(", "sqrt(", "sin(", "cos(", "tanh("];

let count = 0;

/** The model with this formula; constants that were in it before keep their values.
 * @param {Effects} effects @param {string} formula @returns {Effects} */
function withTerm(effects, formula) {
  const known = effects[OWN_TERM] ?? {};
  const names = new Set(formula.match(/[A-Za-z_]\w*/g) ?? []);
  const kept = Object.entries(known).filter(([name]) => names.has(name) && name !== FORMULA);
  return { ...effects, [OWN_TERM]: { [FORMULA]: formula, ...Object.fromEntries(kept) } };
}

const effectsNow = () => compare.peek().effects ?? effectValues(preset.peek());

/** The form for a formula, with its variables and functions.
 * @param {{label: string, formula: string, button: string, id: string, effects: () => Effects,
 *   plain?: boolean, unchanged?: () => void, done?: () => void, cancel?: () => void}} o  `effects`: the model it is added to;
 *   `unchanged`: what to do with a proposed formula that was not changed */
function termForm(o) {
  const wrong = signal("");
  const fieldId = `${o.id}-${++count}`;
  const field = h("textarea", {
    rows: Math.min(6, 2 + Math.floor(o.formula.length / 42)),
    id: fieldId,
    class: "formula",
    spellcheck: "false",
    autocomplete: "off",
    placeholder: "e.g. c1*sign(v)*P",
    "aria-describedby": `${fieldId}-wrong ${fieldId}-help`,
    "aria-invalid": () => wrong.value ? "true" : null,
  });
  field.value = o.formula;
  async function take() {
    const formula = field.value.trim();
    wrong.value = "";
    if (!formula) {
      wrong.value = "Enter a formula, for example c1*sign(v)*P.";
      return field.focus();
    }
    if (o.unchanged && formula === o.formula.trim()) return o.unchanged();
    const known = OWN_TERM in effectsNow();
    try {
      const label = known ? "Own term changed" : "Own term";
      await takeFitted(
        withTerm(o.effects(), formula),
        known ? "change own term" : "add own term",
        `+ ${label}`,
      );
      o.done?.();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      wrong.value = error.words;
      field.focus();
    }
  }
  /** @param {string} text */
  const insert = (text) => {
    field.focus();
    field.setRangeText(text, field.selectionStart, field.selectionEnd, "end");
  };
  return h(
    "form",
    {
      class: "term-form",
      onsubmit: (/** @type {Event} */ e) => {
        e.preventDefault();
        take();
      },
    },
    h("label", { for: fieldId, class: "label" }, o.label),
    field,
    h("p", { class: "error", role: "alert", id: `${fieldId}-wrong` }, () => wrong.value),
    h(
      "p",
      { class: "hint", id: `${fieldId}-help` },
      "A force in N that is added to the model. All other names are constants, which are fitted in SI units.",
    ),
    h(
      "details",
      { class: "symbols", open: !o.formula },
      h("summary", null, "Variables and functions"),
      h(
        "dl",
        null,
        ...SYMBOLS.flatMap(([symbol, meaning]) => [
          h(
            "dt",
            null,
            h(
              "button",
              { type: "button", "aria-label": `Insert ${symbol}`, onclick: () => insert(symbol) },
              symbol,
            ),
          ),
          h("dd", null, meaning),
        ]),
      ),
      h(
        "p",
        null,
        ...FUNCTIONS.map((name) =>
          h("button", {
            type: "button",
            "aria-label": `Insert ${name})`,
            onclick: () => insert(name),
          }, `${name})`)
        ),
      ),
    ),
    h(
      "div",
      { class: "foot" },
      o.cancel ? h("button", { type: "button", onclick: o.cancel }, "Cancel") : null,
      h(
        "button",
        { type: "submit", class: o.plain ? "" : "primary", disabled: () => fitting.value },
        () => fitting.value ? "Fitting…" : o.button,
      ),
    ),
  );
}

/** The form for a term the user types. @param {() => void} close */
export const newTerm = (close) =>
  termForm({
    id: "own-term",
    label: "Formula of your own term",
    formula: String(effectsNow()[OWN_TERM]?.[FORMULA] ?? ""),
    button: OWN_TERM in effectsNow() ? "Change and fit" : "Add and fit",
    effects: effectsNow,
    unchanged: OWN_TERM in effectsNow() ? close : undefined,
    done: close,
    cancel: close,
  });

/** The form for a term the diagnosis proposes. @param {ProposedTerm} proposed @param {string} label
 * @param {boolean} plain other things should be done first */
export const proposedTerm = (proposed, label, plain) =>
  termForm({
    id: "term",
    label,
    formula: proposed.formula,
    button: "Add as own term",
    plain,
    effects: () => proposed.model.effects,
    unchanged: () => addModel(proposed.model, "Own term"),
  });
