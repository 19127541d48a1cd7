// @ts-check
// The task side of the Design view as the program sees it: its page is fetched when it is first shown.
import { h } from "../../dom.js";
import { apart, effect } from "../../reactive.js";
import { view } from "../../state.js";
import { later } from "../../ui/later.js";
import { inTask, isTaskDocument } from "./document.js";

/** @returns {HTMLElement} */
export function taskView() {
  const page = later(async () => (await import("./page.js")).taskPage);
  const place = h("div", { class: "task-side", hidden: () => !inTask.value });
  effect(() => {
    if (inTask.value && !place.hasChildNodes()) place.append(apart(page));
  });
  return place;
}

/** Task documents, opened from a file. @type {import("../../ui/files.js").Opener} */
export const taskFiles = {
  reads: isTaskDocument,
  open: async (raw, label) => (await import("./model.js")).openTask(raw, label),
};

/** @type {import("../../ui/shortcuts.js").Shortcut[]} */
export const TASK_KEYS = [{
  keys: "Ctrl Enter",
  what: "Design, Task: propose drives",
  typing: true,
  match: (e) => e.key === "Enter" && (e.ctrlKey || e.metaKey) && view.peek() === "design" && inTask.peek(),
  run: async () => {
    document.activeElement?.dispatchEvent(new Event("change")); // takes what is still being typed
    (await import("./model.js")).propose();
  },
}];
