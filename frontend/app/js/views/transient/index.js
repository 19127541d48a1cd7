// @ts-check
// The Transient view as the program sees it; its page is fetched when it is first shown.
import { later } from "../../ui/later.js";
import { isDriveDocument } from "../../drive/document.js";
import { goTo, view } from "../../state.js";
import "./document.js";

/** Whether a key is free: a focused control uses the space bar itself. @param {KeyboardEvent} e */
const free = (e) =>
  view.peek() === "transient" && !e.ctrlKey && !e.metaKey && !e.altKey &&
  !(/** @type {HTMLElement} */ (e.target)).closest?.("button, summary, a, input, label");

/** @type {import("../../ui/shortcuts.js").Shortcut[]} */
export const TRANSIENT_KEYS = [
  {
    keys: "P",
    what: "Transient: pin this run",
    match: (e) => e.key.toLowerCase() === "p" && free(e),
    run: async () => (await import("./pinned/card.js")).pin(),
  },
];

/** Asks for the measured trace that the server has no more. */
export const chooseTrace = () => {
  goTo("transient");
  document.getElementById("measured-file")?.click();
};

/** @returns {import("../../ui/menu.js").Item[]} */
export const transientExports = () => [
  {
    label: "Take it along…",
    note: "code and equations of this drive",
    run: async () => (await import("./exports.js")).takeAlong(),
  },
  {
    label: "Run as CSV",
    note: "every column, 2001 rows",
    run: async () => (await import("./exports.js")).saveCsv(),
  },
  {
    label: "Plots as PNG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("png"),
  },
  {
    label: "Plots as SVG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("svg"),
  },
  {
    label: "Drive as JSON",
    note: "opens here, runs with “mckibben simulate”",
    run: async () => (await import("./exports.js")).saveDrive(),
  },
];

/** Drive documents, opened from a file. @type {import("../../ui/files.js").Opener} */
export const driveFiles = {
  reads: isDriveDocument,
  open: async (raw, label) => (await import("../../drive/open.js")).openDrive(raw, { label }),
};

export const transientView = later(async () => (await import("./page.js")).transientPage);
