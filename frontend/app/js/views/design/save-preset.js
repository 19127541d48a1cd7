// @ts-check
// "Save as my preset": the muscle with its effects as it is now; values that were not changed keep their sources.
import { post } from "../../server/client.js";
import { design, editDesign } from "../../muscle/document.js";
import { effectsById } from "../../store.js";
import { curves } from "./model.js";
import { muscle, preset } from "../../muscle/preset.js";
import { presetDialog } from "../../muscle/preset-dialog.js";

/** @typedef {import("../../types.js").PresetValue} PresetValue */

const SOURCE = "set in the Design view";

/** @param {number} value in SI @param {string} unit @returns {PresetValue} */
const entered = (value, unit) => ({ value, unit: unit || "1", source: SOURCE, grade: "user" });

/** @param {string} id @param {string} title */
function presetDocument(id, title) {
  const answer = curves.peek(), base = preset.peek();
  if (!answer) throw new Error("There is no valid model to save.");
  const { values, form } = muscle.peek();
  /** @type {Record<string, PresetValue>} */
  const geometry = {};
  const units = { inside_diameter: "m", braid_diameter: "m", braid_angle: "rad", nominal_length: "m" };
  for (const [key, unit] of Object.entries({ ...units, wall_thickness: "m" })) {
    const value = /** @type {any} */ (answer.geometry)[key];
    const kept = key in values || form !== "braid" ? null : base?.geometry?.[key];
    if (value || kept) geometry[key] = kept ?? entered(value, unit);
  }
  const effects = Object.fromEntries(
    Object.entries(answer.model.effects).map(([effect, parameters]) => [
      effect,
      Object.fromEntries(
        Object.entries(parameters).map(([name, value]) => {
          const unit = effectsById.peek().get(effect)?.parameters.find((p) => p.name === name)?.unit ?? "1";
          const kept = design.peek().effects === null ? base?.effects?.[effect]?.[name] : null;
          return [name, kept ?? entered(value, unit)];
        }),
      ),
    ]),
  );
  return {
    schema: 1,
    kind: "muscle",
    id,
    title,
    maker: base?.maker ?? "",
    series: base?.series ?? "",
    description: base ? `Based on ${base.title}.` : "Saved from the Design view.",
    geometry,
    tolerance: base?.tolerance ?? {},
    limits: base?.limits ?? {},
    data: {},
    effects,
    reference_curve: base?.reference_curve ?? null,
    measurement: base?.measurement ?? null,
    references: base?.references ?? [],
  };
}

export const saveDialog = () =>
  presetDialog({
    id: `${preset.peek()?.id ?? "muscle"}-mine`,
    title: `${preset.peek()?.title ?? "Muscle"} (mine)`,
    note: "Saves geometry and effects as they are now. Values you did not change keep their sources.",
    save: (id, title) => post("/api/presets/muscles", presetDocument(id, title)),
    then: (id) =>
      editDesign({ muscle: { preset: id, form: "braid", values: {} }, effects: null }, `preset ${id}`),
  });
