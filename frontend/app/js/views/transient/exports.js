// @ts-check
// Exports of this view: the run as CSV, the plots, the drive document.
import { figuresOf, hasFigure } from "../../facts.js";
import { units } from "../../state.js";
import { ApiError } from "../../server/client.js";
import { scaleOf, toShown } from "../../format.js";
import { status } from "../../store.js";
import { saveSheet } from "../../plots/export.js";
import { downloadText, fileName, headOf, toCsv } from "../../ui/table.js";
import { openTakeAlong } from "../../ui/take-along.js";
import { shownCharts } from "./plots/charts.js";
import { documentNow, simulate } from "./model.js";

/** @typedef {import("../../types.js").Run} Run */

const ROWS = 2001;

/** The columns of a run in shown units, and what its file states. Only what bears the name of a channel is read
 * from the file as a measurement. @param {Run} r @returns {import("../../ui/table.js").Table} */
function runTable(r) {
  const system = units.peek();
  const present = [...figuresOf("run"), ...figuresOf("joint")].flatMap((one) => {
    const [group, name] = one.key.split("."), holder = group === "joint" ? r.joint : r;
    const values = /** @type {Record<string, unknown> | null} */ (holder)?.[name];
    if (!one.column || !Array.isArray(values)) return [];
    return [{ title: one.column, scale: scaleOf(one.quantity, system), values }];
  });
  const heads = present.filter(({ title }) => !hasFigure(`channel.${title}`)).map(({ title, scale }) =>
    headOf({ title, unit: scale.unit })
  );
  return {
    columns: present.map(({ title, scale }) => ({ title, unit: scale.unit })),
    rows: r.time.map((_, i) =>
      present.map(({ scale, values }) => values[i] === null ? null : toShown(values[i], scale))
    ),
    notes: Object.entries({ ...r.conditions, ignore: heads.join(", ") }).map(([key, value]) =>
      `${key}: ${value}`
    ),
  };
}

/** Saves the whole run with more rows than the plots show. */
export async function saveCsv() {
  try {
    const whole = await simulate({ drive: documentNow(), points: ROWS });
    downloadText(fileName("run", "csv"), toCsv(runTable(whole)), "text/csv");
  } catch (error) {
    status.value = `The run could not be saved: ${error instanceof ApiError ? error.words : error}`;
  }
}

/** @param {"png" | "svg"} format */
export const savePlots = (format) =>
  saveSheet(shownCharts(), format, fileName("run")).catch((error) => {
    status.value = `The plots could not be saved: ${error.message}`;
  });

/** The drive for other programs. */
export const takeAlong = () =>
  openTakeAlong({ what: "This drive", drive: true, body: () => ({ drive: documentNow() }) });

export const saveDrive = () =>
  downloadText(
    fileName("drive", "json"),
    JSON.stringify(documentNow(), null, 2) + "\n",
    "application/json",
  );
