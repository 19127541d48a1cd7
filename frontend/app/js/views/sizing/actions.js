// @ts-check
// What can be done with a proposal: open it in the Design or Transient view, write a report, save a table.
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
import { AIMS, driveWords, limitName } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */

const GRAVITY = 9.80665, NEAR = 0.3 * BAR;
/** What one muscle holds at the end of the stroke at rest [N]. @param {Proposal} p */
function staticLoad({ drive, nominal_length: length, contraction }) {
  const { mass = 0, force = 0, spring = 0, inclination = 0, lever_ratio: ratio = 1 } =
    /** @type {Record<string, number | undefined>} */ (drive.load);
  const stroke = (length * contraction) / ratio;
  return (mass * GRAVITY * Math.sin(inclination) + force + spring * stroke) / ratio;
}

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
    load: Math.max(0, Number(staticLoad(p).toPrecision(5))),
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

/** @returns {import("../../ui/table.js").Table} */
function proposalTable() {
  const system = units.peek(), fittings = answeredTask().limits?.end_fittings ?? 0;
  const aims = Object.values(AIMS), pressure = scaleOf("pressure", system);
  const length = scaleOf("length", system);
  return {
    columns: [
      ...["rank", "muscle", "muscles", "valve", "tube"].map((title) => ({ title, text: true })),
      { title: "nominal length", unit: length.unit },
      { title: "supply pressure", unit: pressure.unit },
      ...aims.map((a) => ({ title: a.title.toLowerCase(), unit: scaleOf(a.quantity, system).unit })),
      { title: "probability", unit: "%" },
      { title: "impact energy", unit: "J" },
      { title: "binding limit", text: true },
    ],
    rows: proposals.peek().map((p, i) => [
      String(i + 1),
      p.muscle,
      String(p.muscles),
      p.valve,
      p.tube ?? "",
      toShown(p.nominal_length, length),
      toShown(p.pressure, pressure),
      ...aims.map((a) => toShown(a.of(p, fittings), scaleOf(a.quantity, system))),
      p.probability === null ? null : 100 * p.probability,
      p.impact_energy,
      limitName(p.binding),
    ]),
  };
}

export const saveCsv = () => downloadText(fileName("proposals", "csv"), toCsv(proposalTable()), "text/csv");
