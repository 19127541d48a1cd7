// @ts-check
// "Save as my preset": the muscle with its effects as it is now; values that were not changed keep their sources.
import { h } from "../../dom.js";
import { signal } from "../../reactive.js";
import { ApiError, post } from "../../server/client.js";
import { design, editDesign } from "../../muscle/document.js";
import { loadKind } from "../../server/presets.js";
import { effectsById, status } from "../../store.js";
import { openDialog } from "../../ui/dialog.js";
import { curves } from "./model.js";
import { muscle, preset } from "../../muscle/preset.js";

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

export function saveDialog() {
  const wrong = signal("");
  const start = `${preset.peek()?.id ?? "muscle"}-mine`;
  const id = h("input", { id: "save-id", type: "text", value: start, maxlength: 64, autocomplete: "off" });
  const title = h("input", {
    id: "save-title",
    type: "text",
    value: `${preset.peek()?.title ?? "Muscle"} (mine)`,
    maxlength: 120,
    autocomplete: "off",
  });
  /** @param {Event} event */
  const save = async (event) => {
    event.preventDefault();
    if (!/^[A-Za-z0-9][A-Za-z0-9-]{0,63}$/.test(id.value)) {
      wrong.value = "An id has letters, digits and hyphens, at most 64 of them, for example DMSP-20-mine.";
      return id.focus();
    }
    if (!title.value.trim()) {
      wrong.value = "Give the preset a title.";
      return title.focus();
    }
    try {
      await post("/api/presets/muscles", presetDocument(id.value, title.value.trim()));
      await loadKind("muscles");
      editDesign(
        { muscle: { preset: id.value, form: "braid", values: {} }, effects: null },
        `preset ${id.value}`,
      );
      status.value = `Saved as “${title.value}”.`;
      dialog.close();
    } catch (error) {
      wrong.value = error instanceof ApiError ? error.words : String(error);
    }
  };
  const dialog = openDialog(
    { title: "Save as my preset" },
    h(
      "form",
      { onsubmit: save },
      h(
        "p",
        { class: "muted" },
        "Saves geometry and effects as they are now. Values you did not change keep their sources.",
      ),
      h("label", { for: "save-id" }, "Id"),
      id,
      h("label", { for: "save-title" }, "Title"),
      title,
      h("p", { class: "error", role: "alert" }, () => wrong.value),
      h("div", { class: "foot" }, h("button", { type: "submit", class: "primary" }, "Save")),
    ),
  );
  id.select();
}
