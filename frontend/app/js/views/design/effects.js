// @ts-check
// The effects card of the Design view: which effects there are and in which order.
import { effectsCard, isStatic } from "../../muscle/effects.js";
import { activeEffects, presetEffects } from "../../muscle/preset.js";
import { curves, messageFor } from "./model.js";

/** @typedef {import("../../types.js").Effect} Effect */

const LATER = "Only over time";

/** What moves nothing in static curves stands last, under one heading. @param {Effect[]} all */
function byFamily(all) {
  /** @type {Map<string, Effect[]>} */
  const families = new Map();
  for (const e of [...all].sort((a, b) => Number(isStatic(b)) - Number(isStatic(a)))) {
    const name = isStatic(e) ? e.family : LATER;
    families.set(name, [...families.get(name) ?? [], e]);
  }
  return families;
}

/** @type {Parameters<typeof effectsCard>[0]} */
const PANEL = {
  own: presetEffects,
  chosen: activeEffects,
  count: () => Object.keys(curves.value?.model.effects ?? activeEffects.value).length,
  message: messageFor,
  families: byFamily,
  hints: { [LATER]: "These act while the muscle moves or fills; the curves here do not show them." },
};

export const designEffectsCard = () => effectsCard(PANEL);
