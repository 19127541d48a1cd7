// @ts-check
// The error of the model against measured points, in newtons and in % of the largest force, beside the ideal braid.
import { h, icon } from "../../dom.js";
import { units } from "../../state.js";
import { design, editDesign } from "../../muscle/document.js";
import { presets, references } from "../../store.js";
import { brief, capitalized, readable, siOf, withUnit } from "../../format.js";
import { curves, errorFault, errors, errorsOutdated, fault, reference, referenceId } from "./model.js";
import { preset } from "../../muscle/preset.js";

/** @typedef {import("../../types.js").Comparison} Comparison */

const NONE = "none";

function referenceSelect() {
  /** @param {import("../../types.js").Preset} r */
  const option = (r) => h("option", { value: r.id, selected: r.id === referenceId.value }, r.title);
  /** @param {string} label @param {import("../../types.js").Preset[]} list */
  const group = (label, list) => list.length ? h("optgroup", { label }, ...list.map(option)) : null;
  return h("select", {
    "aria-label": "Points to compare with",
    onchange: (/** @type {Event} */ e) => {
      const id = /** @type {HTMLSelectElement} */ (e.target).value;
      editDesign({ reference: id === NONE ? null : id }, "points to compare with");
    },
  }, () => {
    const ofMuscle = references.value.filter((r) => r.muscle === preset.value?.id);
    return [
      h("option", { value: NONE, selected: !referenceId.value }, "No points"),
      group("Of this muscle", ofMuscle),
      group("Of other muscles", references.value.filter((r) => !ofMuscle.includes(r))),
    ];
  });
}

/** @param {string} name @param {Comparison} c @param {boolean} first @param {number} widest */
function figure(name, c, first, widest) {
  return h(
    "div",
    { class: `rmse${first ? " first" : ""}` },
    h("span", null, name),
    h("span", { class: "bar" }, h("i", { style: `width:${(100 * (c.rmse ?? 0)) / widest}%` })),
    h(
      "b",
      { class: "num", title: `${brief(c.nrmse_percent ?? NaN)} % of the largest force` },
      withUnit(c.rmse, "force", units.value),
    ),
  );
}

/** The error beside the largest force. @param {Comparison} c */
const relative = ({ nrmse_percent }) =>
  h("p", { class: "muted" }, `${brief(nrmse_percent ?? NaN)} % of the largest force`);

function source() {
  const r = reference.value;
  return r?.source ? h("li", null, `Source: ${r.source}`, r.verified ? "." : " (unverified).") : null;
}

function body() {
  const { model: now, ideal } = errors.value ?? {};
  const isComing = design.value.reference !== null && !references.value.length;
  if (!reference.value && !isComing) {
    return h("p", { class: "muted" }, "Choose points above to see the error of the model.");
  }
  if (errorFault.value) return h("p", { class: "error" }, errorFault.value.words);
  if (!now || !ideal) return h("p", { class: "muted comparing" }, "Comparing…");
  const widest = Math.max(now.rmse ?? 0, ideal.rmse ?? 0, 1e-9);
  return [
    figure("This model", now, true, widest),
    figure("Ideal braid", ideal, false, widest),
    relative(now),
  ];
}

/** Which points the error is of. */
export function pointsUsed() {
  const now = errors.value?.model;
  if (!reference.value || !now || errorFault.value) return null;
  const left = Object.entries(now.excluded).filter(([, n]) => n > 0);
  return h(
    "details",
    { class: "notes" },
    h("summary", null, `${now.rows_used} of ${now.rows} points used`),
    h(
      "ul",
      { class: "plain muted" },
      ...left.map(([why, n]) => h("li", null, `Left out: ${n} ${readable(why)}.`)),
      h("li", null, `Mean residual ${withUnit(now.residual_mean, "force", units.value)}.`),
      ...now.messages.map((m) => h("li", null, capitalized(m))),
      source(),
    ),
  );
}

/** Points of a muscle of another length do not compare, which the number alone would not show. */
function lengthNote() {
  const at = reference.value?.nominal_length, length = curves.value?.geometry.nominal_length;
  if (!at || !length || Math.abs(siOf(at) / length - 1) < 0.002) return null;
  const measured = siOf(at);
  return h(
    "p",
    { class: "flag note" },
    icon("info"),
    h(
      "span",
      null,
      `The points were measured on a muscle ${withUnit(measured, "length", units.value)} long. Yours is `,
      `${withUnit(length, "length", units.value)} long, so the error compares different muscles. `,
      h("button", {
        type: "button",
        class: "link",
        onclick: () => {
          const { muscle } = design.peek();
          const values = { ...muscle.values, nominal_length: measured };
          editDesign({ muscle: { ...muscle, values } }, "measured length");
        },
      }, "Use the measured length"),
    ),
  );
}

export const errorPart = () => [
  h("div", { class: "card-head" }, h("h2", null, "How sure"), referenceSelect()),
  h("div", { class: "found", id: "rmse", "aria-busy": () => String(errorsOutdated.value) }, body),
  lengthNote,
];

export const saveButton = () =>
  h("button", {
    type: "button",
    disabled: () => !curves.value || Boolean(fault.value) || !presets.value.muscles,
    onclick: async () => (await import("./save-preset.js")).saveDialog(),
  }, "Save as my preset…");
