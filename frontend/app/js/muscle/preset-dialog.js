// @ts-check
// The dialog that saves a muscle as a preset of the user: id and title.
import { h } from "../dom.js";
import { signal } from "../reactive.js";
import { ApiError } from "../server/client.js";
import { loadKind } from "../server/presets.js";
import { status } from "../store.js";
import { openDialog } from "../ui/dialog.js";

/** @param {{id: string, title: string, note: string, save: (id: string, title: string) => Promise<unknown>,
 *   then?: (id: string) => void}} o  `then`: what follows once it is saved */
export function presetDialog(o) {
  const wrong = signal(""), saving = signal(false);
  const id = h("input", { id: "save-id", type: "text", value: o.id, maxlength: 64, autocomplete: "off" });
  const title = h("input", {
    id: "save-title",
    type: "text",
    value: o.title,
    maxlength: 120,
    autocomplete: "off",
  });
  /** @param {Event} event */
  const save = async (event) => {
    event.preventDefault();
    if (saving.peek()) return;
    if (!/^[A-Za-z0-9][A-Za-z0-9-]{0,63}$/.test(id.value)) {
      wrong.value = "An id has letters, digits and hyphens, at most 64 of them, for example DMSP-20-mine.";
      return id.focus();
    }
    if (!title.value.trim()) {
      wrong.value = "Give the preset a title.";
      return title.focus();
    }
    saving.value = true;
    try {
      await o.save(id.value, title.value.trim());
      await loadKind("muscles");
      o.then?.(id.value);
      status.value = `Saved as “${title.value}”.`;
      dialog.close();
    } catch (error) {
      wrong.value = error instanceof ApiError ? error.words : String(error);
    } finally {
      saving.value = false;
    }
  };
  const dialog = openDialog(
    { title: "Save as my preset" },
    h(
      "form",
      { onsubmit: save },
      h("p", { class: "muted" }, o.note),
      h("label", { for: "save-id" }, "Id"),
      id,
      h("label", { for: "save-title" }, "Title"),
      title,
      h("p", { class: "error", role: "alert" }, () => wrong.value),
      h(
        "div",
        { class: "foot" },
        h(
          "button",
          { type: "submit", class: "primary", disabled: () => saving.value },
          () => saving.value ? "Saving…" : "Save",
        ),
      ),
    ),
  );
  id.select();
}
