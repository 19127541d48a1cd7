// @ts-check
// The effects of the muscle in the Design view.
import { effectsRow, isStatic } from "../../muscle/effects.js";
import { activeEffects, presetEffects } from "../../muscle/preset.js";
import { curves, messageFor } from "./model.js";

export const designEffects = () =>
  effectsRow("design", {
    preset: presetEffects,
    active: activeEffects,
    defaults: () => curves.value?.model.defaults,
    message: messageFor,
    idle: (e) =>
      isStatic(e) ? null : "It acts while the muscle moves or fills: these static curves do not show it.",
  });
