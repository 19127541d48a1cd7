// @ts-check
// Example designs of the server (presets/designs): one click replaces the design, in one undo step.
import { defaultDesign, openDesign, readDesign } from "../../muscle/document.js";
import { status } from "../../store.js";

/** @param {import("../../types.js").Preset} preset */
export function openExample(preset) {
  try {
    const design = readDesign({ ...defaultDesign(), ...preset.document });
    openDesign(design, `example ${preset.title}`);
    status.value = `${preset.title}: ${preset.description}`;
  } catch (error) {
    const why = /** @type {Error} */ (error).message;
    status.value = `The example “${preset.title}” cannot be opened: ${why}.`;
  }
}
