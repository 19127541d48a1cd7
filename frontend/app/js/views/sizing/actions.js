// @ts-check
// What can be done with a proposal: open it in the Design or Transient view, write a report, save a table.
import { inSentence } from "../../facts.js";
import { signal } from "../../reactive.js";
import { units } from "../../state.js";
import { ApiError, postForText } from "../../server/client.js";
import { BAR, scaleOf, toShown } from "../../format.js";
import { musclesById, status } from "../../store.js";
import { downloadText, fileName, toCsv } from "../../ui/table.js";
import { openDrive } from "../../drive/open.js";
import { openDesign } from "../../muscle/document.js";
import { answeredTask, proposals, sizing } from "./model.js";
import { requestOf } from "../../drive/task.js";
import { driveWords, limitName, sizingFigure } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */
/** @typedef {import("../../format.js").Quantity} Quantity */

const NEAR = 0.3 * BAR;
/** Pressures of the curves: whole bars up to the pressure of the proposal, and that itself.
 * @param {number} most */
function pressuresUpTo(most) {
  const whole = Array.from({ length: Math.ceil(most / BAR) }, (_, i) => (i + 1) * BAR);
  return [...whole.filter((p) => p < most - NEAR), most];
}

/** Points to compare with: the maker’s curve, which holds for any length; a measurement is of one length.
 * @param {Proposal} p */
const reference = (p) => musclesById.peek().get(p.muscle)?.reference_curve ?? null;

/** @param {Proposal} p */
const oneOf = ({ parallel }) =>
  parallel > 1 ? ` One of ${parallel} parallel muscles, with its share of the load.` : "";

/** @param {Proposal} p */
export function openInDesign(p) {
  openDesign({
    muscle: { preset: p.muscle, form: "braid", values: { nominal_length: p.nominal_length } },
    effects: null,
    reference: reference(p),
    pressures: pressuresUpTo(p.pressure),
    direction: -1, // the branch on which the proposal carries its load
    load: Math.max(0, Number(p.static_load.toPrecision(5))),
    range: null,
  }, `proposal ${driveWords(p)}`);
  status.value = `${driveWords(p)} at its load at the end of the stroke.${oneOf(p)}`;
}

/** @param {Proposal} p */
export function openInTransient(p) {
  openDrive(p.drive, { label: `proposal ${driveWords(p)}`, reference: reference(p) });
  status.value = `${driveWords(p)}, filled and vented once.${oneOf(p)}`;
}

/** Whether a report is being written, which takes a while. */
export const writing = signal(false);

/** Saves the report of a proposal as one file. @param {number} index of the proposal, from 0 */
export async function saveReport(index) {
  const task = answeredTask();
  writing.value = true;
  try {
    const text = await postForText("/api/sizings/reports", {
      task,
      proposal: index + 1,
      title: task.title ?? "",
    });
    downloadText(fileName("sizing", "html"), text, "text/html");
    status.value = "The report is saved.";
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    status.value = `The report could not be written: ${error.words}`;
  } finally {
    writing.value = false;
  }
}

/** Saves the task as "mckibben size" reads it. */
export function saveTask() {
  const text = JSON.stringify({ schema: 1, ...requestOf(sizing.peek()) }, null, 2) + "\n";
  downloadText(fileName("task", "json"), text, "application/json");
}

/** Figures of the saved table. */
const COLUMNS = [
  "nominal_length",
  "pressure",
  "air_volume_anr",
  "time",
  "installed_length",
  "force_reserve",
  "stiffness",
  "probability",
  "impact_energy",
  "impact_energy_stroke",
  "impact_energy_return",
  "outer_diameter",
];

/** @returns {import("../../ui/table.js").Table} */
function proposalTable() {
  const figures = COLUMNS.map(sizingFigure);
  const scales = figures.map(({ quantity }) => scaleOf(/** @type {Quantity} */ (quantity), units.peek()));
  return {
    columns: [
      ...["rank", "muscle", "muscles", "valve", "tube"].map((title) => ({ title, text: true })),
      ...figures.map(({ label }, i) => ({ title: inSentence(label), unit: scales[i].unit })),
      { title: inSentence(sizingFigure("binding").label), text: true },
    ],
    rows: proposals.peek().map((p, i) => [
      String(i + 1),
      p.muscle,
      String(p.muscles),
      p.valve,
      p.tube ?? "",
      ...COLUMNS.map((name, k) => {
        const value = /** @type {Record<string, any>} */ (p)[name];
        return value === null ? null : toShown(value, scales[k]);
      }),
      limitName(p.binding),
    ]),
  };
}

export const saveCsv = () => downloadText(fileName("proposals", "csv"), toCsv(proposalTable()), "text/csv");
