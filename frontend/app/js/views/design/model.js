// @ts-check
// From the document to the server's answers: curves, errors against points, and which message belongs to
// which field.
import { GRAVITY, number, scaleOf, siOf, toShown, withUnit } from "../../format.js";
import { design, modelInput, muscleInput } from "../../muscle/document.js";
import { muscle, preset } from "../../muscle/preset.js";
import { computed } from "../../reactive.js";
import { fieldMessages, post } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { doc, units } from "../../state.js";
import { references } from "../../store.js";

/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {import("../../types.js").Design} Design */
/** @typedef {import("../../types.js").Muscle} Muscle */
/** @typedef {import("../../types.js").Comparison} Comparison */
/** @typedef {import("../../types.js").Form} Form */

const POINTS = 120;
const COMPARE_AFTER_MS = 40;

/** Fields of each form of the geometry besides the length. @type {Record<Form, string[]>} */
export const FORM_KEYS = {
  braid: ["braid_diameter", "braid_angle"],
  thread: ["thread_length", "turns"],
  rhombus: ["side", "along", "around"],
};

/** The pressure that is asked about: the stated one, else the highest of the curves. */
export const pressureNow = computed(() => design.value.pressure ?? Math.max(...design.value.pressures));
const MOST_CURVES = 12;
/** The pressures of the curves, that which is asked about among them. */
export const pressuresShown = computed(() => {
  const { pressures } = design.value, now = pressureNow.value;
  if (pressures.includes(now)) return pressures;
  return [...pressures.slice(0, MOST_CURVES - 1), now].sort((a, b) => a - b);
});
/** A load as it was stated, a mass or a force. @param {number} load @param {Design["load_as"]} as
 * @param {import("../../format.js").System} system */
function loadIn(load, as, system) {
  const mass = scaleOf("mass", system);
  return as === "mass"
    ? `${number(toShown(load / GRAVITY, mass), 2)}\u00a0${mass.unit}`
    : withUnit(load, "force", system);
}
/** @param {import("../../types.js").Doc} d */
export const loadOf = ({ units: system, design: { load, load_as } }) => loadIn(load, load_as, system);
export const loadText = computed(() => (design.value, units.value, loadOf(doc.peek())));

/** @param {Design} d */
const curvesRequest = (d) => ({
  ...modelInput(d),
  pressures: pressuresShown.value,
  at_pressure: pressureNow.value,
  at_contraction: d.contraction,
  points: POINTS,
  unclipped: !d.clipped,
  dead_volume: d.dead_volume,
  contraction_from: d.range?.[0] ?? null,
  contraction_to: d.range?.[1] ?? null,
  load: d.load,
  fixed_length: d.fixed_length,
  further_stiffness: d.stiffness !== "tangent",
});

const curvesQuestion = new Question(
  (text, signal) => /** @type {Promise<Curves>} */ (post("/api/curves", JSON.parse(text), signal)),
);
/** The newest curves, and why there are no newer ones: the plots then keep the last ones, dimmed. */
export const { answer: curves, error: fault } = curvesQuestion;
/** The load of the answer on screen: what is said beside its figures. */
export const answeredLoad = computed(() => {
  const load = curves.value?.over_pressure?.load;
  return load == null ? "–" : loadIn(load, design.value.load_as, units.value);
});
/** Asks once more, after the server was away. */
export const retry = () => curvesQuestion.again();
/** The curves on screen are those of the design now. */
export const curvesAreCurrent = computed(() => curvesQuestion.stage.value === "answered");

/** The geometry value shown in a field: what the user set, else that of the preset, else what the server derived.
 * @param {string} key @returns {number | null} */
export function geometryValue(key) {
  const set = muscle.value.values[key];
  if (set !== undefined) return set;
  const ofPreset = preset.value?.geometry?.[key];
  if (ofPreset) return siOf(ofPreset);
  return answeredValue(curves.value, key);
}

const presetQuestion = new Question(
  (text, signal) => /** @type {Promise<Curves>} */ (post("/api/curves", JSON.parse(text), signal)),
);
/** Asks for the geometry of the preset at the length of the muscle, where it is shown in another form. */
function presetText() {
  const { preset: id, form, values: { nominal_length } } = muscle.value;
  return id && form !== "braid"
    ? JSON.stringify({ muscle: { preset: id, nominal_length }, effects: {}, points: 2 })
    : null;
}

/** A value of an answer in any form of the geometry.
 * @param {Curves | null} answer @param {string} key @returns {number | null} */
function answeredValue(answer, key) {
  const geometry = /** @type {any} */ (answer?.geometry);
  return geometry?.[key] ?? geometry?.rhombus[key] ?? null;
}

/** The value of the preset in any form of the geometry, to mark and reset changed values. @param {string} key
 * @returns {number | null} */
export function presetValue(key) {
  const stated = preset.value?.geometry?.[key];
  return stated ? siOf(stated) : answeredValue(presetQuestion.answer.value, key);
}

/** The same muscle in another form of the geometry; unchanged while there is no answer of the server yet.
 * @param {Muscle} m @param {Form} form @returns {Muscle} */
export function inForm(m, form) {
  const g = curves.peek()?.geometry;
  if (!g || m.form === form) return m;
  const kept = Object.entries(m.values).filter(([key]) => !FORM_KEYS[m.form].includes(key));
  const values = Object.fromEntries(kept);
  if (form === "thread") Object.assign(values, { thread_length: g.thread_length, turns: g.turns });
  if (form === "rhombus") Object.assign(values, g.rhombus);
  if (form === "braid") {
    const { braid_diameter, braid_angle } = g;
    for (const [key, value] of Object.entries({ braid_diameter, braid_angle })) {
      const ofPreset = m.preset && presetValue(key);
      if (!ofPreset || Math.abs(value / ofPreset - 1) > 1e-6) values[key] = value;
    }
  }
  return { ...m, form, values };
}

/** The field on the page that a path of the request belongs to: "effects.a.b" → "a.b".
 * @param {string} path */
function fieldOf(path) {
  const [part, ...rest] = path.split(".");
  if (part === "effects") return rest.join(".");
  if (part === "at_pressure") return "pressure";
  if (part !== "muscle") return part;
  const key = rest.at(-1) ?? "preset";
  const { form } = muscle.peek();
  const elsewhere = Object.values(FORM_KEYS).flat().includes(key) && !FORM_KEYS[form].includes(key);
  return elsewhere || key === "rhombus" ? "nominal_length" : key;
}
export const { field: faultField, within: messageFor } = fieldMessages(() => fault.value, fieldOf);

// ---- the model's error against points

/** The points the model is compared with; "auto": the measurement of the preset, else its maker's curve. */
export const referenceId = computed(() => {
  const chosen = design.value.reference;
  if (chosen !== "auto") return chosen;
  return preset.value?.measurement ?? preset.value?.reference_curve ?? null;
});
export const reference = computed(() => references.value.find((r) => r.id === referenceId.value) ?? null);

/** The error of the model with its effects, and of the ideal braid.
 * @typedef {{model: Comparison, ideal: Comparison}} Errors */

/** What the model's error depends on. */
const errorText = computed(() => {
  const { muscle, effects } = design.value, points = reference.value;
  return points && JSON.stringify({ muscle: muscleInput(muscle), effects, measurement: points.id });
});
const errorQuestion = new Question(async (text, signal) => {
  const body = JSON.parse(text);
  const [model, ideal] = await Promise.all([
    post("/api/comparisons", { ...body, judge: false }, signal),
    post("/api/comparisons", { ...body, effects: {}, judge: false }, signal),
  ]);
  return /** @type {Errors} */ ({ model, ideal });
});
export const { answer: errors, error: errorFault } = errorQuestion;
/** The errors on screen are not yet those of the design now. */
export const errorsOutdated = computed(() => errorQuestion.stage.value === "asking");

/** Starts asking; called once, when the view is built. The curves come first. */
export function startModel() {
  curvesQuestion.follow(() => JSON.stringify(curvesRequest(design.value)));
  presetQuestion.follow(presetText);
  errorQuestion.follow(() => errorText.value, {
    delay: COMPARE_AFTER_MS,
    active: () => curvesAreCurrent.value,
  });
}
