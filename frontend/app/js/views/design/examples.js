// @ts-check
// Example designs of the server (presets/designs): one click replaces the design, in one undo step; while it is
// unchanged, the view says what it shows and what its source misprints.
import { h } from "../../dom.js";
import { computed } from "../../reactive.js";
import { muscleParts } from "../../drive/document.js";
import { defaultDesign, design, openDesign, readDesign } from "../../muscle/document.js";
import { presets, status } from "../../store.js";
import { misprintList } from "../../ui/misprints.js";

/** @typedef {import("../../types.js").Preset} Preset */

/** The design of an example: its question to the server, and how it is shown. @param {Preset} preset
 * @throws {Error} names what cannot be read */
function designOf({ document, view }) {
  const { muscle, contraction_from: from, contraction_to: to, unclipped, ...rest } =
    /** @type {import("../../types.js").Drive} */ (document);
  return readDesign({
    ...defaultDesign(),
    ...rest,
    ...view,
    muscle: muscleParts(muscle),
    range: from === undefined ? null : [from, to],
    clipped: !unclipped,
  });
}

/** @param {Preset} preset */
export function openExample(preset) {
  try {
    openDesign(designOf(preset), `example ${preset.title}`);
    status.value = preset.title;
  } catch (error) {
    const why = /** @type {Error} */ (error).message;
    status.value = `The example “${preset.title}” cannot be opened: ${why}.`;
  }
}

/** The examples with their designs as texts; one that cannot be read has none. */
const known = computed(() =>
  (presets.value.designs ?? []).map((preset) => {
    try {
      return { preset, text: JSON.stringify(designOf(preset)) };
    } catch {
      return { preset, text: "" };
    }
  })
);

/** What the example that is shown unchanged is, with the misprints of its source. */
export function exampleNote() {
  const text = JSON.stringify(design.value);
  const shown = known.value.find((each) => each.text === text)?.preset;
  if (!shown) return null;
  return h(
    "section",
    { "aria-label": "Example" },
    h(
      "details",
      { class: "notes" },
      h("summary", { title: shown.title }, "Example"),
      h("h3", null, shown.title),
      h("p", null, shown.description ?? ""),
      misprintList(shown),
    ),
  );
}
