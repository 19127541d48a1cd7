// @ts-check
// What the command palette offers, from what the views and the server have.
import { openExample as openDesign } from "./views/design/examples.js";
import { openExample as openTask } from "./views/sizing/model.js";
import { effectsToAdd } from "./muscle/effects.js";
import { usePreset } from "./muscle/preset.js";
import { showMuscle } from "./muscle/document.js";
import { goTo, look, view } from "./state.js";
import { effects, musclesById, presets } from "./store.js";
import { openPalette } from "./ui/palette.js";

/** @typedef {import("./ui/palette.js").Command} Command */

/** @param {import("./shell.js").View[]} views @param {import("./ui/shortcuts.js").Shortcut[]} keys
 * @param {Command[]} actions */
export function showCommands(views, keys, actions) {
  /** @type {Command[]} */
  const all = [
    ...views.map(({ id, title }) => ({ label: title, kind: "view", run: () => goTo(id) })),
    ...["muscle", "task"].map((mode) => ({
      label: mode === "task" ? "Find a drive for a task" : "What a muscle does",
      kind: "view",
      run: () =>
        look((d) => ({
          ...d,
          view: "design",
          sizing: { ...d.sizing, mode: /** @type {"muscle" | "task"} */ (mode) },
        })),
    })),
    {
      label: "Effects: what each leaves in a residual",
      kind: "view",
      run: () => look((d) => ({ ...d, view: "catalogue", catalogue: { ...d.catalogue, kind: "effects" } })),
    },
    ...actions,
    ...effectsToAdd(),
    ...views.filter(({ id }) => id === view.peek()).flatMap(({ exports }) =>
      exports().flatMap((item) =>
        "run" in item ? [{ label: item.label, kind: "export", note: item.note, run: item.run }] : []
      )
    ),
    ...keys.filter(({ keys }) => keys.length > 1 || !/[1-9?]/.test(keys)).map(({ what, keys, run }) => ({
      label: what,
      kind: "action",
      note: keys.replaceAll(" ", "+"),
      run,
    })),
    ...[...musclesById.peek().values()].map((p) => ({
      label: p.title,
      kind: "muscle",
      run: () => {
        usePreset(p.id);
        showMuscle();
      },
    })),
    ...(presets.peek().tasks ?? []).map((p) => ({
      label: p.title,
      kind: "example task",
      run: () => openTask(p),
    })),
    ...(presets.peek().designs ?? []).map((p) => ({
      label: p.title,
      kind: "example design",
      run: () => openDesign(p),
    })),
    ...effects.peek().map((e) => ({
      label: `About ${e.title}`,
      kind: "effect in the atlas",
      run: () =>
        look((d) => ({
          ...d,
          view: "catalogue",
          catalogue: { ...d.catalogue, kind: "effects", selected: e.id },
        })),
    })),
  ];
  openPalette(all);
}
