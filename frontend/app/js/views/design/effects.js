// @ts-check
// The effects card of the Design view: which effects there are and in which order.
import { effectsCard, isStatic } from "../../muscle/effects.js";
import { activeEffects, presetEffects } from "../../muscle/preset.js";
import { curves, messageFor } from "./model.js";

/** @typedef {import("../../types.js").Effect} Effect */

const DYNAMIC = "Dynamic effects";

/** Effects that do not change static curves come last, under one heading. @param {Effect[]} all */
function byFamily(all) {
  /** @type {Map<string, Effect[]>} */
  const families = new Map();
  for (const e of [...all].sort((a, b) => Number(isStatic(b)) - Number(isStatic(a)))) {
    const name = isStatic(e) ? e.family : DYNAMIC;
    families.set(name, [...families.get(name) ?? [], e]);
  }
  return families;
}

/** @type {Parameters<typeof effectsCard>[0]} */
const PANEL = {
  preset: presetEffects,
  active: activeEffects,
  count: () => Object.keys(curves.value?.model.effects ?? activeEffects.value).length,
  defaults: () => curves.value?.model.defaults,
  message: messageFor,
  families: byFamily,
  hints: {
    [DYNAMIC]: "They act while the muscle moves or fills. The curves here are static and do not show them.",
  },
};

export const designEffectsCard = () => effectsCard(PANEL);
