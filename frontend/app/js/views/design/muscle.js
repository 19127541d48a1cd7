// @ts-check
// The muscle card: preset, three forms of geometry, each value with slider, typed units and reset.
import { h } from "../../dom.js";
import { computed } from "../../reactive.js";
import { figure } from "../../facts.js";
import { commit, preview, units } from "../../state.js";
import { design, editDesign, patchDesign } from "../../muscle/document.js";
import { muscles } from "../../store.js";
import { scaleOf, siOf, withUnit } from "../../format.js";
import { quantityField, subscript } from "../../ui/field.js";
import { unverifiedBadge } from "../../ui/sources.js";
import { curves, FORM_KEYS, geometryValue, inForm, messageFor, presetValue } from "./model.js";
import { muscle, preset, usePreset } from "../../muscle/preset.js";
import { segments } from "../../ui/segments.js";

/** @typedef {import("../../types.js").Form} Form */
/** @typedef {{label: string, symbol: string, quantity: import("../../format.js").Quantity,
 *   bounds: [number, number], log?: boolean}} Spec */

const DEG = Math.PI / 180;
/** @param {string} key @param {[number, number]} bounds @param {boolean} [log] @returns {Spec} */
function spec(key, bounds, log) {
  const { label, symbol, quantity } = figure(`geometry.${key}`);
  return { label, symbol, quantity, bounds, log };
}

/** Slider ranges cover usual muscles; the field accepts any value the model accepts.
 * @type {Record<string, Spec>} */
const SPECS = {
  nominal_length: spec("nominal_length", [0.02, 10], true),
  braid_diameter: spec("braid_diameter", [3e-3, 0.1], true),
  braid_angle: spec("braid_angle", [10 * DEG, 54 * DEG]),
  thread_length: spec("thread_length", [0.02, 12], true),
  turns: spec("turns", [0.1, 100], true),
  side: spec("side", [5e-4, 0.02], true),
  along: spec("along", [2, 3000], true),
  around: spec("around", [2, 200], true),
  inside_diameter: spec("inside_diameter", [2e-3, 0.1], true),
  wall_thickness: spec("wall_thickness", [0, 5e-3]),
};

/** @type {[Form, string, string][]} */
const FORMS = [
  ["braid", "Angle", "Diameter, braid angle and length"],
  ["thread", "Thread", "Thread length, turns and length"],
  ["rhombus", "Rhombus", "Rhombi of the lattice and length"],
];

const form = computed(() => muscle.value.form);
const presetId = computed(() => muscle.value.preset);

/** @param {string} key @param {number} si @param {boolean} done */
function put(key, si, done) {
  const { muscle: m } = design.peek();
  preview(patchDesign({ muscle: { ...m, values: { ...m.values, [key]: si } } }));
  const { label, quantity } = SPECS[key];
  if (done) {
    commit(
      label.toLowerCase(),
      (d) => withUnit(d.design.muscle.values[key] ?? presetValue(key), quantity, units.peek()),
    );
  }
}

/** @param {string} key */
const isChanged = (key) => {
  const set = muscle.value.values[key], usual = presetValue(key);
  return set !== undefined && usual !== null && Math.abs(set - usual) > 1e-6 * Math.abs(usual);
};

/** @param {string} key */
function reset(key) {
  const { muscle: m } = design.peek();
  const values = { ...m.values };
  const usual = presetValue(key);
  if (usual !== null && m.form !== "braid" && FORM_KEYS[m.form].includes(key)) values[key] = usual;
  else delete values[key];
  editDesign({ muscle: { ...m, values } }, `reset ${SPECS[key].label.toLowerCase()}`);
}

/** @param {string} key @param {boolean} [slider] */
function field(key, slider) {
  const spec = SPECS[key];
  return quantityField({
    key,
    label: spec.label,
    symbol: subscript(spec.symbol),
    quantity: spec.quantity,
    log: spec.log,
    slider,
    scale: () => scaleOf(spec.quantity, units.value),
    bounds: () => sliderBounds(key, spec),
    get: () => geometryValue(key),
    put: (si, done) => put(key, si, done),
    changed: () => isChanged(key),
    reset: () => reset(key),
    message: () => messageFor(key),
  });
}

/** The range of lengths the maker offers, if it is known. @param {string} key @param {Spec} spec
 * @returns {[number, number]} */
function sliderBounds(key, spec) {
  const limits = preset.value?.limits ?? {};
  if (key !== "nominal_length" || !limits.min_nominal_length || !limits.max_nominal_length) {
    return spec.bounds;
  }
  return [siOf(limits.min_nominal_length), siOf(limits.max_nominal_length)];
}

/** @param {string} id "": own geometry, the muscle as it is now without its preset */
function choose(id) {
  const { reference } = design.peek();
  const g = curves.peek()?.geometry;
  if (id) usePreset(id);
  else if (g) {
    const { nominal_length, braid_diameter, braid_angle, inside_diameter, wall_thickness } = g;
    const values = { nominal_length, braid_diameter, braid_angle };
    if (inside_diameter) Object.assign(values, { inside_diameter });
    if (wall_thickness) Object.assign(values, { wall_thickness });
    const active = curves.peek()?.model.effects ?? {};
    const points = reference === "auto" ? null : reference;
    editDesign(
      { muscle: { preset: null, form: "braid", values }, effects: active, reference: points },
      "own geometry",
    );
  }
}

function presetSelect() {
  const options = () => {
    /** @type {Map<string, import("../../types.js").Preset[]>} */
    const groups = new Map();
    for (const m of muscles.value) {
      const name = [m.maker, m.series].filter((x, i, all) => x && all.indexOf(x) === i).join(" · ") ||
        "Other";
      const group = m.origin === "user" ? "My presets" : name;
      groups.set(group, [...groups.get(group) ?? [], m]);
    }
    const chosen = presetId.value;
    return [
      h("option", { value: "", selected: chosen === null }, "Own geometry"),
      ...[...groups].map(([name, list]) =>
        h(
          "optgroup",
          { label: name },
          ...list.map((m) => h("option", { value: m.id, selected: m.id === chosen }, m.title)),
        )
      ),
    ];
  };
  return h("select", {
    id: "preset",
    onchange: (/** @type {Event} */ e) => choose(/** @type {HTMLSelectElement} */ (e.target).value),
  }, options);
}

function resetAll() {
  const keys = Object.keys(SPECS).filter(isChanged);
  if (keys.length < 2) return null;
  const back = () => {
    const { muscle: m } = design.peek();
    editDesign({ muscle: { preset: m.preset, form: "braid", values: {} } }, "reset geometry");
  };
  return h("button", { type: "button", class: "link", onclick: back }, `Reset all ${keys.length} changes`);
}

export const muscleCard = () =>
  h(
    "section",
    { class: "card", "aria-label": "Geometry" },
    h("div", { class: "card-head" }, h("h2", null, "Geometry"), () => unverifiedBadge(preset.value)),
    segments(
      "Form of the geometry",
      FORMS,
      () => form.value,
      (id) => editDesign({ muscle: inForm(design.peek().muscle, id) }, `${id} form`),
    ),
    () => FORM_KEYS[form.value].map((key) => field(key)),
    field("inside_diameter"),
    field("wall_thickness"),
    resetAll,
  );

/** Which muscle, in the row of fields. */
export const muscleFields = () => [
  h(
    "div",
    { class: "field", "data-field": "preset" },
    h("div", { class: "field-head" }, h("label", { for: "preset" }, "Muscle"), presetSelect()),
    () => messageFor("preset") ? h("p", { class: "error" }, messageFor("preset")) : null,
  ),
  field("nominal_length", false),
];
