// @ts-check
// Opening a run: the values of its row go into the drive or task that was studied.
import { partsOf } from "../../drive/study.js";
import { put } from "../../paths.js";
import { edit } from "../../state.js";
import { status } from "../../store.js";
import { options, ranOf, shown } from "./model.js";
import { quantities } from "./rows.js";

/** @typedef {import("../../types.js").Doc} Doc */

/** Path -> value of a run; a factor counts from what the run or the document has.
 * @param {number} place @returns {Map<string, number>} */
function valuesOf(place) {
  const { table } = /** @type {import("./model.js").Shown} */ (shown.peek());
  const stated = new Map((options.peek()?.quantities ?? []).map((q) => [q.path, q.value]));
  /** @type {Map<string, number>} */
  const found = new Map();
  const isFactor = (/** @type {string} */ name) => name.endsWith(" (factor)");
  const all = [...quantities.peek()].sort((a, b) => Number(isFactor(a.name)) - Number(isFactor(b.name)));
  for (const { name } of all) {
    const value = Number(table[name][place]), path = name.replace(/ \(factor\)$/, "");
    found.set(path, isFactor(name) ? value * (found.get(path) ?? stated.get(path) ?? 1) : value);
  }
  return found;
}

/** Effects with their values, as the server completed them. */
const statedEffects = () => /** @type {Record<string, Record<string, number>>} */ (
  /** @type {any} */ (options.peek()?.document)?.effects ?? {}
);

/** @param {number} place of the row in the table */
export function openRun(place) {
  const ran = ranOf.peek(), now = shown.peek();
  if (!ran || !now) return;
  const values = valuesOf(place), run = Number(now.table.run[place]) + 1;
  if (ran.study.subject === "task") {
    const task = [...values].reduce((all, [path, value]) => put(all, path, value), ran.sizing.task);
    edit((d) => ({
      ...d,
      view: "design",
      sizing: { ...d.sizing, mode: "task", arrangement: ran.sizing.arrangement, task },
    }), `run ${run} of the study`);
    status.value = `The task of run ${run}. Propose drives to see what fulfils it.`;
    return;
  }
  const { muscle, effects, transient } = partsOf(ran);
  let drive = transient.drive, geometry = muscle.values, chosen = /** @type {any} */ (effects);
  for (const [path, value] of values) {
    const [part, ...rest] = path.split(".");
    if (part === "muscle") geometry = { ...geometry, [rest.join(".")]: value };
    else if (part === "effects") chosen = put(chosen ?? statedEffects(), rest.join("."), value);
    else drive = put(drive, path, value);
  }
  edit((d) => ({
    ...d,
    view: "transient",
    design: { ...d.design, muscle: { ...muscle, values: geometry }, effects: chosen },
    transient: { ...d.transient, mode: transient.mode, scenario: null, window: null, phase: null, drive },
  }), `run ${run} of the study`);
  status.value = `Run ${run} of the study.`;
}
