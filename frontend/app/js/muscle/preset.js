// @ts-check
// The preset of the muscle that is designed, and the effects it brings.
import { siOf } from "../format.js";
import { computed } from "../reactive.js";
import { musclesById } from "../store.js";
import { design, editDesign } from "./document.js";

/** @typedef {import("../types.js").Preset} Preset */

export const muscle = computed(() => design.value.muscle);
export const preset = computed(() => musclesById.value.get(muscle.value.preset ?? "") ?? null);

/** The effects of a preset with their values in SI.
 * @param {Preset | null} p @returns {Record<string, Record<string, number>>} */
export const effectValues = (p) =>
  Object.fromEntries(
    Object.entries(p?.effects ?? {}).map(([id, values]) => [
      id,
      Object.fromEntries(Object.entries(values).map(([name, value]) => [name, siOf(value)])),
    ]),
  );

/** The effects that come with the preset. */
export const presetEffects = computed(() => effectValues(preset.value));

/** The effects of the model now: the user's choice, or the preset's. */
export const activeEffects = computed(() => design.value.effects ?? presetEffects.value);

/** Takes a preset with its effects and points; a length the user set stays. @param {string} id */
export function usePreset(id) {
  const length = design.peek().muscle.values.nominal_length;
  /** @type {Record<string, number>} */
  const values = {};
  if (length !== undefined) values.nominal_length = length;
  editDesign(
    { muscle: { preset: id, form: "braid", values }, effects: null, reference: "auto" },
    `preset ${id}`,
  );
}
