// @ts-check
// Exports of this view: runs as CSV, results as JSON, the study document.
import { toShown } from "../../format.js";
import { postForFile } from "../../server/client.js";
import { doc, units } from "../../state.js";
import { status } from "../../store.js";
import { download, downloadText, fileName, toCsv } from "../../ui/table.js";
import { answer, askedText, hasParquet, shown, studyRequest } from "./model.js";
import { scaleFor } from "./words.js";

/** Says that a saved table is not all of its study.
 * @param {import("./model.js").Shown} now */
function sayIfPartial({ table, planned }) {
  const made = table.run.length;
  if (made < planned) status.value = `Saved ${made} of ${planned} runs: the study was not finished.`;
}

export function saveCsv() {
  const now = shown.peek();
  if (!now) return void (status.value = "There are no runs to save.");
  const scales = now.columns.map((c) => scaleFor(c.name, c.unit, units.peek()));
  const { run, outcome, message } = now.table;
  const table = {
    columns: [
      { title: "run" },
      ...now.columns.map((c, i) => ({ title: c.name, unit: scales[i].unit })),
      { title: "outcome", text: true },
      { title: "message", text: true },
    ],
    rows: run.map((number, i) => [
      Number(number) + 1,
      ...now.columns.map((c, k) => {
        const value = now.table[c.name][i];
        return typeof value === "number" ? toShown(value, scales[k]) : value;
      }),
      outcome[i],
      message[i],
    ]),
  };
  downloadText(fileName("study", "csv"), toCsv(table), "text/csv");
  sayIfPartial(now);
}

/** @param {string} name @param {unknown} content */
const save = (name, content) =>
  downloadText(fileName(name, "json"), `${JSON.stringify(content, null, 2)}\n`, "application/json");

export function saveJson() {
  const result = answer.peek() ?? shown.peek();
  if (!result) return void (status.value = "There are no runs to save.");
  save("study-results", result);
}

/** Written by the server, from the runs that it kept. */
export async function saveParquet() {
  const now = shown.peek();
  if (!now) return void (status.value = "There are no runs to save.");
  if (!hasParquet.peek()) {
    return void (status.value =
      'Parquet needs pyarrow where mckibben runs: pip install "mckibben[parquet]". CSV and JSON need nothing.');
  }
  try {
    const { blob } = await postForFile("/api/studies/parquet", JSON.parse(askedText.peek() ?? "null"));
    download(fileName("study", "parquet"), blob);
    sayIfPartial(now);
  } catch (error) {
    status.value = error instanceof Error ? error.message : String(error);
  }
}

export const saveStudy = () => save("study", studyRequest(doc.peek()));
