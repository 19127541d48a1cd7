// @ts-check
// The rows of the table of pinned runs: different inputs, and figures with their change from the baseline.
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief, scaleOf } from "../../../format.js";
import { greatestOf, JOINT } from "../plots/joint.js";
import { timeWindow } from "../model.js";
import { figureName, figureOf, TIMING } from "../figures/timing.js";
import { flat, inputOf, inputText } from "../run-names.js";

/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../types.js").Drive} Drive */
/** @typedef {{name: string, drive: Drive, run: Run | null, color: string, wrong: string | null}} Column */
/** @typedef {{label: string, unit: string, texts: string[], deltas: (number | null)[]}} Row */

/** Rows of the inputs that are not the same in all runs. @param {Column[]} all @returns {Row[]} */
export function inputRows(all) {
  // Effects that come with presets are not in the document, but in the model that was simulated.
  const flats = all.map((c) => flat({ ...c.drive, effects: c.run?.model.effects ?? c.drive.effects }));
  const paths = [...new Set(flats.flatMap((f) => Object.keys(f)))];
  const differ = (/** @type {string} */ path) =>
    new Set(flats.map((f) => JSON.stringify(f[path] ?? null))).size > 1;
  return paths.filter((path) => path !== "schema" && path !== "title" && differ(path)).map((path) => {
    const holder = all[flats.findIndex((f) => f[path] !== undefined)];
    const { label, scale } = inputOf(path, holder.drive);
    return {
      label,
      unit: "",
      texts: flats.map((f) => inputText(f[path], scale)),
      deltas: flats.map(() => null),
    };
  });
}

/** @typedef {{label: string, quantity: Quantity, of: (r: Run) => number | null}} Compared */

/** @type {Compared[]} */
const TRACKING = [
  { label: figure("tracking.rms").label, quantity: "length", of: (r) => r.tracking?.rms ?? null },
  { label: figure("tracking.max").label, quantity: "length", of: (r) => r.tracking?.max ?? null },
  { label: figure("tracking.lag").label, quantity: "lapse", of: (r) => r.tracking?.lag ?? null },
];

/** Figures of the pulley, for the time shown. @returns {Compared[]} */
const joined = () =>
  /** @type {import("../plots/joint.js").Column[]} */ (Object.keys(JOINT)).map((key) => ({
    label: `Largest ${JOINT[key].title.toLowerCase()}${timeWindow.value ? ", in the window" : ""}`,
    quantity: JOINT[key].quantity,
    of: (r) => greatestOf(r, key),
  }));

/** @type {Compared[]} */
const TIMED = /** @type {("extend" | "retract")[]} */ (["extend", "retract"]).flatMap((phase) =>
  TIMING.map((each) => ({
    label: figureName(each, phase),
    quantity: /** @type {Quantity} */ (each.quantity),
    of: (/** @type {Run} */ r) => figureOf(r, phase, each),
  }))
);

/** Numbers of a row with one number of decimals: that of the smallest, but at most one more than the largest needs.
 * @param {(number | null)[]} values */
function alike(values) {
  const placesOf = (/** @type {number} */ size) => brief(size).split(".")[1]?.length ?? 0;
  const sizes = values.map((v) => Math.abs(v ?? 0)).filter(Boolean);
  const places = Math.min(placesOf(Math.min(...sizes)), placesOf(Math.max(...sizes)) + 1);
  return values.map((v) =>
    v === null ? "–" : v.toFixed(sizes.length ? places : 0).replace("-", "−").replace(/^−?0(\.0+)?$/, "0")
  );
}

/** Rows of the figures that at least one run has. @param {Column[]} all @returns {Row[]} */
export function figureRows(all) {
  const tracked = all.some((c) => c.run?.tracking);
  return [...joined(), ...(tracked ? TRACKING : []), ...TIMED].map(({ label, quantity, of }) => {
    const values = all.map((c) => c.run && of(c.run));
    const s = quantity === "lapse" ? { unit: "ms", factor: 1e-3 } : scaleOf(quantity, units.value);
    const base = values[0];
    return {
      label,
      unit: s.unit,
      texts: alike(values.map((v) => v === null ? null : v / s.factor)),
      deltas: values.map((v, i) => i && v !== null && base ? v / base - 1 : null),
    };
  }).filter((r) => r.texts.some((text) => text !== "–"));
}
