// @ts-check
// The Studies view as the program sees it; its page is fetched when it is first shown.
import { later } from "../../ui/later.js";
import "../../drive/study.js";

/** @returns {import("../../ui/menu.js").Item[]} */
export const studyExports = () => [
  {
    label: "Runs as CSV",
    note: "every run, shown units",
    run: async () => (await import("./exports.js")).saveCsv(),
  },
  {
    label: "Runs as Parquet",
    note: "every run, SI, exact; needs the extra “parquet”",
    run: async () => (await import("./exports.js")).saveParquet(),
  },
  {
    label: "Results as JSON",
    note: "every run and all statistics, SI",
    run: async () => (await import("./exports.js")).saveJson(),
  },
  {
    label: "Study as JSON",
    note: "runs with “mckibben study”, also on a cluster",
    run: async () => (await import("./exports.js")).saveStudy(),
  },
];

export const studiesView = later(async () => (await import("./page.js")).studiesPage);
