// @ts-check
// Inverse calculations: which pressure, contraction or range is needed. Repeated whenever the model changes.
import { h } from "../../dom.js";
import { signal } from "../../reactive.js";
import { figure } from "../../facts.js";
import { units } from "../../state.js";
import { design, modelInput } from "../../muscle/document.js";
import { scaleOf, withUnit } from "../../format.js";
import { post } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { quantityField } from "../../ui/field.js";
import { flag } from "../../ui/flag.js";
import { curves, curvesAreCurrent } from "./model.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../types.js").Answer} Answer */
/** @typedef {{label: string, short: string, inputs: string[]}} Inverse */

/** @type {Record<string, Inverse>} */
const QUESTIONS = {
  pressure: {
    label: "Pressure for a force at a length",
    short: "Pressure",
    inputs: ["force", "length"],
  },
  contraction: {
    label: "Contraction for a force at a pressure",
    short: "Contraction",
    inputs: ["force", "pressure"],
  },
  stroke_pressure: {
    label: "Pressure for a stroke under load",
    short: "Stroke",
    inputs: ["load", "stroke"],
  },
  working_range: {
    label: "Working range between preload and load",
    short: "Range",
    inputs: ["preload", "load", "pressure"],
  },
};

/** @type {Record<string, {label: string, quantity: Quantity}>} */
const INPUTS = {
  force: { label: "Force", quantity: "force" },
  length: { label: "Length", quantity: "length" },
  pressure: { label: "Pressure", quantity: "pressure" },
  load: { label: "Load", quantity: "force" },
  stroke: { label: "Stroke", quantity: "length" },
  preload: { label: "Preload", quantity: "force" },
};

/** Questions whose answer is on the branch of the operation; the others have their own. */
const BOTH_WAYS = new Set(["pressure", "contraction"]);

const ASK_AFTER_MS = 90;

const kind = signal("pressure");
const values = signal(/** @type {Record<string, number>} */ ({}));

/** The start value of each input, from the design. @param {string} key */
function start(key) {
  const d = design.value, length = curves.value?.geometry.nominal_length ?? 0.3;
  /** @type {Record<string, number>} */
  const all = { force: d.load, load: d.load, preload: 0, length: 0.9 * length, stroke: 0.1 * length };
  return all[key] ?? d.pressures.at(-1) ?? 6e5;
}
/** @param {string} key */
const value = (key) => values.value[key] ?? start(key);

const inverse = new Question(
  (text, signal) => /** @type {Promise<Answer>} */ (post("/api/inverse", JSON.parse(text), signal)),
);

/** @param {string} key */
const inputField = (key) =>
  quantityField({
    key: `ask.${key}`,
    label: INPUTS[key].label,
    quantity: INPUTS[key].quantity,
    slider: false,
    counted: () => INPUTS[key].quantity === "pressure" ? { reference: "gauge" } : {},
    bounds: () => [0, Math.max(2 * start(key), 1e-3)],
    scale: () => scaleOf(INPUTS[key].quantity, units.value),
    get: () => value(key),
    put: (si) => (values.value = { ...values.peek(), [key]: si }),
  });

function shown() {
  if (inverse.error.value) return h("p", { class: "error" }, inverse.error.value.words);
  const got = inverse.answer.value;
  if (!got || got.question !== kind.value) return h("p", { class: "muted" }, "…");
  const { label, definition, quantity, otherwise } = figure(`inverse.${got.question}`);
  const details = Object.entries(got.details).filter(([, v]) => v != null);
  return [
    h(
      "p",
      { class: "answer" },
      h("span", { title: definition }, label),
      h(
        "b",
        { title: got.value == null ? otherwise : null },
        got.value == null ? "none" : withUnit(got.value, quantity, units.value),
      ),
    ),
    h("p", { class: "muted" }, got.branch),
    details.length
      ? h(
        "dl",
        null,
        ...details.flatMap(([name, v]) => {
          const detail = figure(`inverse_details.${name}`);
          return [
            h("dt", { title: detail.definition }, detail.label),
            h("dd", null, withUnit(v, detail.quantity, units.value)),
          ];
        }),
      )
      : null,
    ...got.flags.map((f) => flag(f, f.code === "unverified")),
  ];
}

export function inverseCard() {
  inverse.follow(() => {
    const inputs = QUESTIONS[kind.value].inputs.map((key) => [key, value(key)]);
    const { direction, ...model } = modelInput(design.value);
    return JSON.stringify({
      ...model,
      ...(BOTH_WAYS.has(kind.value) ? { direction } : {}),
      question: kind.value,
      ...Object.fromEntries(inputs),
    });
  }, { delay: ASK_AFTER_MS, active: () => curvesAreCurrent.value });
  return h(
    "section",
    { class: "card", "aria-label": "Inverse calculation" },
    h("div", { class: "card-head" }, h("h2", null, "Inverse calculation")),
    h(
      "div",
      { class: "segments", role: "radiogroup", "aria-label": "Question" },
      ...Object.entries(QUESTIONS).map(([id, q]) =>
        h("button", {
          type: "button",
          role: "radio",
          title: q.label,
          "aria-checked": () => String(kind.value === id),
          onclick: () => (kind.value = id),
        }, q.short)
      ),
    ),
    h("p", { class: "muted" }, () => QUESTIONS[kind.value].label),
    () => QUESTIONS[kind.value].inputs.map(inputField),
    h("div", { class: "found", "aria-live": "polite" }, shown),
  );
}
