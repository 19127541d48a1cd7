// @ts-check
// Exports of this view: the run as CSV, the plots, the drive document.
import { units } from "../../state.js";
import { ApiError } from "../../server/client.js";
import { scaleOf, toShown } from "../../format.js";
import { status } from "../../store.js";
import { saveSheet } from "../../plots/export.js";
import { downloadText, fileName, toCsv } from "../../ui/table.js";
import { openTakeAlong } from "../../ui/take-along.js";
import { shownCharts } from "./plots/charts.js";
import { STATES } from "./plots/specs.js";
import { documentNow, simulate } from "./model.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../format.js").Quantity} Quantity */

const ROWS = 2001;

/** Name of the column in the file, quantity, column of the answer. Measurement files are read by these names.
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
  ["friction", "force", "friction"],
  ["friction_share", "ratio", "friction_share"],
];

/** Columns of an antagonist pair. @type {[string, Quantity, keyof NonNullable<Run["joint"]>][]} */
const JOINT = [
  ["joint_angle", "angle", "angle"],
  ["joint_torque", "torque", "torque"],
  ["joint_stiffness", "rotary", "stiffness"],
  ["counter_pressure", "pressure", "counter_pressure"],
  ["counter_force", "force", "counter_force"],
  ["counter_command", "ratio", "counter_command"],
  ["counter_mass_flow", "flow", "counter_mass_flow"],
  ["counter_supply_flow", "flow", "counter_supply_flow"],
  ["counter_exhaust_flow", "flow", "counter_exhaust_flow"],
  ["counter_diameter", "length", "counter_diameter"],
  ["angle_reference", "angle", "angle_reference"],
  ["stiffness_reference", "rotary", "stiffness_reference"],
];

/** @param {Run} r @returns {import("../../ui/table.js").Table} every column of a run in shown units */
function runTable(r) {
  const system = units.peek();
  /** @param {string} title @param {Quantity} quantity @param {unknown} values
   * @returns {{title: string, quantity: Quantity, values: (number | null)[]}[]} */
  const column = (title, quantity, values) => Array.isArray(values) ? [{ title, quantity, values }] : [];
  const present = [
    ...COLUMNS.flatMap(([title, quantity, key]) => column(title, quantity, r[key])),
    ...JOINT.flatMap(([title, quantity, key]) => column(title, quantity, r.joint?.[key])),
  ];
  return {
    columns: [
      { title: "time", unit: "s" },
      ...present.map(({ title, quantity }) => ({ title, unit: scaleOf(quantity, system).unit })),
      ...STATES.map((title) => ({ title, unit: "" })),
    ],
    rows: r.time.map((t, i) => [
      t,
      ...present.map(({ quantity, values }) => {
        const value = values[i];
        return value === null ? null : toShown(value, scaleOf(quantity, system));
      }),
      ...STATES.map((key) => r[key][i] ? 1 : 0),
    ]),
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
