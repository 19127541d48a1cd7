// @ts-check
// The effects in the model: values with standard errors and bounds; they can be changed, removed, fitted again.
import { h, icon, mathml } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { computed, signal } from "../../../reactive.js";
import { commit, preview, units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import {
  brief,
  capitalized,
  number,
  plainScale,
  quantityOf,
  readable,
  scaleOf,
  toShown,
} from "../../../format.js";
import { quantityField } from "../../../ui/field.js";
import { fitting, refit, remove } from "./history.js";
import { answer, compare, diagnosis, messageFor, patchCompare, preset } from "../answers.js";
import { fitOf, surer } from "../document.js";
import { effectValues } from "../../../muscle/preset.js";
import { newTerm } from "./own-term.js";
import { FORMULA, OWN_TERM, sigmaText, titleOf } from "../words.js";

/** What a field needs of a parameter.
 * @typedef {Pick<import("../../../types.js").Parameter,
 *   "name" | "unit" | "symbol_mathml" | "lower" | "upper" | "grows" | "default">} Field */

/** The effects of the model with their values. */
const effects = computed(() => compare.value.effects ?? effectValues(preset.value));
const ids = computed(() => Object.keys(effects.value).join());

/** @param {Field} p */
const scale = (p) => {
  const quantity = quantityOf(p.unit, p.name);
  return quantity ? scaleOf(quantity, units.value) : plainScale(p.unit);
};

/** A diagnosis that adds no effect has fitted the current model. */
const lastFit = computed(() =>
  diagnosis.value?.verdict.effects.length === 0 ? fitOf(diagnosis.value.parameters) : {}
);

const MOST_DIGITS = 5;

/** @param {string} id @param {Field} p */
const fitOfField = (id, p) => surer(compare.value.fit[id]?.[p.name], lastFit.value[id]?.[p.name]);

/** The scale of a value, with the digits that its standard error allows. @param {string} id @param {Field} p */
function fittedScale(id, p) {
  const s = scale(p), sigma = (fitOfField(id, p)?.stderr ?? 0) / s.factor;
  const places = sigma > 0 ? 1 - Math.floor(Math.log10(sigma)) : 0;
  return places > s.digits ? { ...s, digits: Math.min(places, MOST_DIGITS) } : s;
}

/** @param {string} id @param {Field} p */
function range(id, p) {
  const s = scale(p), fit = fitOfField(id, p);
  const asText = (/** @type {number} */ si) => number(toShown(si, s), s.digits);
  const bounds = Number.isFinite(p.lower)
    ? `${asText(p.lower)} … ${asText(p.upper)} ${s.unit}`.trim()
    : "in SI";
  return h(
    "p",
    { class: "hint" },
    fit?.stderr == null ? "" : sigmaText(fit.stderr / s.factor).replace(
      /^± (.*)$/,
      `± $1 (${inSentence(figure("parameter.stderr").label).replace("± ", "")}) · `,
    ),
    bounds,
    fit?.at_bound ? h("span", { class: "at-bound" }, " · at its bound") : null,
  );
}

/** @param {string} id @param {Field} p */
function parameterField(id, p) {
  const value = () => {
    const set = effects.value[id]?.[p.name];
    return typeof set === "number" ? set : answer.value?.parameters[id]?.[p.name]?.value ?? p.default;
  };
  return h(
    "div",
    { class: "parameter" },
    quantityField({
      key: `compare.${id}.${p.name}`,
      label: p.symbol_mathml ? capitalized(readable(p.name)) : p.name,
      symbol: p.symbol_mathml ? mathml(p.symbol_mathml) : null,
      quantity: quantityOf(p.unit, p.name),
      slider: false,
      strict: Number.isFinite(p.lower) && !p.grows,
      scale: () => fittedScale(id, p),
      bounds: Number.isFinite(p.lower) ? () => [p.lower, p.upper] : undefined,
      get: value,
      put: (si, done) => {
        preview((d) => {
          const all = d.compare.effects ?? effectValues(preset.peek());
          const { [p.name]: _outdated, ...fit } = d.compare.fit[id] ?? {};
          return patchCompare({
            effects: { ...all, [id]: { ...all[id], [p.name]: si } },
            fit: { ...d.compare.fit, [id]: fit },
            holdout: null,
          })(d);
        });
        if (done) commit(`${titleOf(id)}: ${readable(p.name)}`);
      },
      message: () => messageFor(`effects.${id}.${p.name}`),
    }),
    () => range(id, p),
  );
}

const editing = signal(false);
const closeEditor = () => (editing.value = false);

/** A formula of the user with its constants. @param {string} id */
function typedTerm(id) {
  const names = computed(() =>
    Object.entries(effects.value[id] ?? {}).filter(([, v]) => typeof v === "number").map(([name]) => name)
      .join()
  );
  return [
    () =>
      editing.value ? newTerm(closeEditor) : h(
        "div",
        { class: "typed" },
        h("code", { tabindex: 0 }, () => String(effects.value[id]?.[FORMULA] ?? "")),
        h("button", { type: "button", class: "link", onclick: () => (editing.value = true) }, "Edit…"),
      ),
    () => names.value ? names.value.split(",").map((name) => parameterField(id, constant(id, name))) : null,
  ];
}

/** A constant of a formula, described like a parameter of the catalogue.
 * @param {string} id @param {string} name @returns {Field} */
const constant = (id, name) => ({
  name,
  unit: "1",
  symbol_mathml: "",
  lower: -Infinity,
  upper: Infinity,
  grows: false,
  default: Number(effects.peek()[id]?.[name] ?? 1),
});

/** The button or form for a term of the user, of which a model has one at most. */
function ownTerm() {
  if (OWN_TERM in effects.value) return null;
  return editing.value ? newTerm(closeEditor) : h(
    "button",
    {
      type: "button",
      class: "link",
      id: "add-own-term",
      disabled: () => !answer.value,
      onclick: () => (editing.value = true),
    },
    "Add a term of your own…",
  );
}

/** @param {string} id */
function row(id) {
  const known = effectsById.value.get(id);
  return h(
    "li",
    { class: "in-model", "data-effect-in": id },
    h(
      "div",
      { class: "effect-head" },
      h("b", null, titleOf(id)),
      h("button", {
        type: "button",
        class: "mini",
        "aria-label": `Remove ${titleOf(id)}`,
        title: "Remove it and fit the others again",
        disabled: () => fitting.value,
        onclick: () => remove(id),
      }, icon("close")),
    ),
    h("p", { class: "error" }, () => messageFor(`effects.${id}`) ?? ""),
    ...(id === OWN_TERM ? typedTerm(id) : (known?.parameters ?? []).map((p) => parameterField(id, p))),
  );
}

/** Strongly correlated parameters. */
function correlated() {
  const pairs = (diagnosis.value?.correlations ?? answer.value?.correlations ?? [])
    .filter((c) => Math.abs(c.value) > 0.95 && [c.a, c.b].every((key) => key.split(".")[0] in effects.value));
  if (!pairs.length) return null;
  const name = (/** @type {string} */ key) => {
    const [id, parameter] = key.split(".");
    return parameter ? `${titleOf(id)}: ${readable(parameter)}` : readable(key);
  };
  return h(
    "details",
    null,
    h(
      "summary",
      null,
      `${pairs.length} pair${pairs.length > 1 ? "s" : ""} of parameters strongly correlated`,
    ),
    h(
      "ul",
      { class: "plain muted" },
      ...pairs.map((c) => h("li", null, `${name(c.a)} and ${name(c.b)}: correlation ${brief(c.value)}`)),
    ),
  );
}

export function modelCard() {
  return h(
    "section",
    { class: "card model-card", "aria-label": "Effects in the model" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Effects in the model"),
      h("button", {
        type: "button",
        class: "small",
        title: "Fit their parameters again  (R)",
        disabled: () => fitting.value || !ids.value || !answer.value,
        onclick: refit,
      }, "Refit"),
    ),
    () =>
      ids.value
        ? h("ul", { class: "plain" }, ...ids.value.split(",").map(row))
        : h("p", { class: "muted" }, "None: the ideal muscle."),
    ownTerm,
    correlated,
  );
}
