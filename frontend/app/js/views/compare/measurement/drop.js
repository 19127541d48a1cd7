// @ts-check
// Measurement files dropped anywhere on the page, in any view.
import { signal } from "../../../reactive.js";
import { goTo, view } from "../../../state.js";

/** Files are being dragged over the page. */
export const dropping = signal(false);

export function listenToDrops() {
  const carriesFiles = (/** @type {DragEvent} */ e) => Boolean(e.dataTransfer?.types.includes("Files"));
  addEventListener("dragover", (event) => {
    if (!carriesFiles(event) || event.defaultPrevented) return;
    event.preventDefault();
    dropping.value = view.peek() === "compare";
  });
  addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) dropping.value = false;
  });
  addEventListener("drop", (event) => {
    dropping.value = false;
    if (event.defaultPrevented || !event.dataTransfer?.files.length) return;
    event.preventDefault();
    if (document.querySelector("dialog[open]")) return;
    if (view.peek() !== "compare") goTo("compare");
    const list = [...event.dataTransfer.files];
    import("./files.js").then(({ addFiles }) => addFiles(list));
  });
}
