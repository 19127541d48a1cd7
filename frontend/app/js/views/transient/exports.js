// @ts-check
// What the Export menu offers in this view: the run as CSV, the plots, the drive document.
import { units } from "../../state.js";
import { ApiError } from "../../api.js";
import { scaleOf, toShown } from "../../format.js";
import { status } from "../../store.js";
import { saveSheet } from "../../plots/export.js";
import { downloadText, toCsv } from "../../ui/table.js";
import { charts } from "./charts.js";
import { documentNow, openDrive, simulate } from "./model.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../format.js").Quantity} Quantity */

const ROWS = 2001;

/** Column of the file, quantity, column of the answer; the names are those a measurement file is read by.
 * @type {[string, Quantity, keyof Run][]} */
const COLUMNS = [
  ["displacement", "length", "position"],
  ["velocity", "speed", "velocity"],
  ["acceleration", "acceleration", "acceleration"],
  ["pressure", "pressure", "pressure"],
  ["tube_pressure", "pressure", "tube_pressure"],
  ["regulator_pressure", "pressure", "regulator_pressure"],
  ["force", "force", "force"],
  ["mass_flow", "flow", "mass_flow"],
  ["supply_flow", "flow", "supply_flow"],
  ["exhaust_flow", "flow", "exhaust_flow"],
  ["reference", "length", "reference"],
  ["valve_opening", "ratio", "opening"],
  ["command_given", "ratio", "command"],
  ["length", "length", "length"],
  ["contraction", "ratio", "contraction"],
  ["diameter", "length", "diameter"],
  ["volume", "volume", "volume"],
  ["load_force", "force", "load_force"],
  ["gas_temperature", "temperature", "temperature"],
];

/** @param {Run} r @returns {import("../../ui/table.js").Table} every column of a run in shown units */
export function runTable(r) {
  const system = units.peek();
  const present = COLUMNS.filter(([, , key]) => Array.isArray(r[key]));
  return {
    columns: [
      { title: "time", unit: "s" },
      ...present.map(([title, quantity]) => ({ title, unit: scaleOf(quantity, system).unit })),
      { title: "contact", unit: "" },
    ],
    rows: r.time.map((t, i) => [
      t,
      ...present.map(([, quantity, key]) => {
        const value = /** @type {(number | null)[]} */ (r[key])[i];
        return value === null ? null : toShown(value, scaleOf(quantity, system));
      }),
      r.contact[i] ? 1 : 0,
    ]),
  };
}

const stamp = () => new Date().toISOString().slice(0, 10);

/** The whole run, finer than the plots show it. */
async function saveCsv() {
  try {
    const whole = await simulate({ drive: documentNow(), points: ROWS });
    downloadText(`mckibben-run-${stamp()}.csv`, toCsv(runTable(whole)), "text/csv");
  } catch (error) {
    status.value = `The run could not be saved: ${error instanceof ApiError ? error.words : error}`;
  }
}

/** @param {"png" | "svg"} format */
const savePlots = (format) => () =>
  saveSheet(charts, format, `mckibben-run-${stamp()}`).catch((error) => {
    status.value = `The plots could not be saved: ${error.message}`;
  });

const saveDrive = () =>
  downloadText(
    `mckibben-drive-${stamp()}.json`,
    JSON.stringify(documentNow(), null, 2) + "\n",
    "application/json",
  );

/** @param {import("./document.js").Drive} raw @param {string} name */
export function openDriveFile(raw, name) {
  openDrive(raw, null, `open ${name}`);
}

/** @returns {import("../../ui/menu.js").Item[]} */
export const transientExports = () => [
  { label: "Run as CSV", note: `every column, ${ROWS} rows`, run: saveCsv },
  { label: "Plots as PNG", note: "one sheet", run: savePlots("png") },
  { label: "Plots as SVG", note: "one sheet", run: savePlots("svg") },
  { label: "Drive as JSON", note: "opens here, runs with “mckibben simulate”", run: saveDrive },
];
