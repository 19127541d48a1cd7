// @ts-check
// What leaves the Design view: the curves as CSV, the plots.
import { saveSheet } from "../../plots/export.js";
import { design, muscleInput } from "../../muscle/document.js";
import { status } from "../../store.js";
import { openTakeAlong } from "../../ui/take-along.js";
import { downloadText, fileName, toCsv } from "../../ui/table.js";
import { charts } from "./charts.js";
import { curvesTable } from "./curves-table.js";

export const saveCsv = () => downloadText(fileName("curves", "csv"), toCsv(curvesTable()), "text/csv");

/** The muscle with its effects for other programs. */
export const takeAlong = () =>
  openTakeAlong({
    what: "This muscle with its effects",
    body: () => ({ muscle: muscleInput(design.peek().muscle), effects: design.peek().effects }),
  });

/** @param {"png" | "svg"} format */
export const savePlots = (format) =>
  saveSheet(charts, format, fileName("plots")).catch((error) => {
    status.value = `The plots could not be saved: ${error.message}`;
  });
