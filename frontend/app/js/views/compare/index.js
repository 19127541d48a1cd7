// @ts-check
// The Compare & diagnose view as the program sees it; its page is fetched when it is first shown.
import { later } from "../../ui/later.js";
import { goTo, view } from "../../state.js";
import "./cases.js";
import "./document.js";

export { listenToDrops } from "./measurement/drop.js";

/** @param {string} key */
const inView = (key) => (/** @type {KeyboardEvent} */ e) =>
  view.peek() === "compare" && e.key.toLowerCase() === key && !e.ctrlKey && !e.metaKey && !e.altKey;

/** @type {import("../../ui/shortcuts.js").Shortcut[]} */
export const COMPARE_KEYS = [
  {
    keys: "B",
    what: "Compare: switch between the model before and after",
    match: inView("b"),
    run: async () => (await import("./where/overlay.js")).toggleBefore(),
  },
  {
    keys: "R",
    what: "Compare: fit the parameters of the model again",
    match: inView("r"),
    run: async () => (await import("./model/history.js")).refitByKey(),
  },
];

/** Asks for a file that the server has no more. */
export const chooseAgain = async () => {
  goTo("compare");
  (await import("./measurement/card.js")).chooseFiles();
};

/** What the command palette offers for the cases of the project. */
export const caseCommands = async () => (await import("./case-menu.js")).caseCommands();

/** @returns {import("../../ui/menu.js").Item[]} */
export const compareExports = () => [
  {
    label: "Take it along…",
    note: "code, tables, equations of this model",
    run: async () => (await import("./exports.js")).takeAlong(),
  },
  {
    label: "Data and residuals as CSV",
    note: "every point, shown units",
    run: async () => (await import("./exports.js")).saveCsv(),
  },
  {
    label: "Report as HTML",
    note: "data, model, plots, verdict",
    run: async () => (await import("./exports.js")).saveReport(),
  },
  {
    label: "Model as JSON",
    note: "muscle and effects, for --model",
    run: async () => (await import("./exports.js")).saveModel(),
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
    label: "Use this model in Design",
    note: "muscle and effects",
    run: async () => (await import("./exports.js")).useInDesign(),
  },
];

export const compareView = later(async () => (await import("./page.js")).comparePage);
