// @ts-check
// The rows of the table of pinned runs: different inputs, and figures with their change from the baseline.
import { figure } from "../../../facts.js";
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import {
  brief,
  capitalized,
  number,
  plainScale,
  quantityOf,
  readable,
  scaleOf,
  toShown,
} from "../../../format.js";
import { at } from "../../../paths.js";
import { SPECS } from "../inputs/fields.js";
import { greatestOf, JOINT } from "../plots/joint.js";
import { timeWindow } from "../model.js";
import { signalField } from "../inputs/signals.js";
import { figureName, figureOf, TIMING } from "../figures/timing.js";
import { siNumber } from "../../../quantities.js";
import { pins } from "../pinned-runs.js";

/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../format.js").Scale} Scale */
/** @typedef {import("../../../types.js").Drive} Drive */
/** @typedef {{name: string, drive: Drive, run: Run | null, color: string, wrong: string | null}} Column */
/** @typedef {{label: string, unit: string, texts: string[], deltas: (number | null)[]}} Row */

/** All values of a document by their path. @param {any} part @param {string} [path]
 * @returns {Record<string, unknown>} */
function flat(part, path = "") {
  if (typeof part !== "object" || part === null || Array.isArray(part)) return { [path]: part };
  const kids = Object.entries(part);
  if (!kids.length) return { [path]: "on" };
  return Object.assign({}, ...kids.map(([key, value]) => flat(value, path ? `${path}.${key}` : key)));
}

/** @type {Record<string, string>} */
const NAMES = {
  "muscle.preset": "Muscle",
  "muscle.nominal_length": figure("geometry.nominal_length").label,
  "valve.preset": "Valve",
  "tube.preset": "Tube",
  "command.shape": "Command",
  "controller.reference.shape": "Reference",
  "load.force.shape": "External force",
  "load.arrangement": "Arrangement",
};

/** Name and scale of an input. @param {string} path @param {Drive} drive
 * @returns {{label: string, scale: Scale | null}} */
function inputOf(path, drive) {
  const system = units.value;
  const [part, id, name] = path.split(".");
  const effect = part === "effects" ? effectsById.value.get(id) : null;
  if (effect) {
    const unit = effect.parameters.find((p) => p.name === name)?.unit ?? "1";
    const quantity = quantityOf(unit, name);
    const label = name ? `${effect.title}: ${readable(name)}` : effect.title;
    return { label, scale: quantity ? scaleOf(quantity, system) : plainScale(unit) };
  }
  const spec = SPECS[path];
  if (spec) {
    const scale = spec.unit ? { unit: spec.unit, factor: 1, digits: 4 } : scaleOf(spec.quantity, system);
    return { label: spec.label, scale };
  }
  const signal = signalField(path, at(drive, path.replace(/\.[^.]*$/, "")));
  if (signal) return { label: signal.label, scale: scaleOf(signal.quantity, system) };
  const isLength = /length|diameter|thickness/.test(path);
  const label = NAMES[path] ?? capitalized(readable(path.replaceAll(".", ", ")));
  return { label, scale: isLength ? scaleOf("length", system) : null };
}

/** @param {unknown} value @param {Scale | null} scale */
function inputText(value, scale) {
  if (value === undefined || value === null) return "–";
  if (Array.isArray(value)) return `${value.length} values`;
  const si = siNumber(value);
  if (si === null) return String(value);
  return scale ? `${number(toShown(si, scale), scale.digits)} ${scale.unit}`.trim() : number(si, 6);
}

const MOST_NAMED = 2;

/** What sets a drive apart from another, in a few words: "Supply 5.5 → 6 bar". @param {Drive} base @param {Drive} drive */
export function differenceText(base, drive) {
  const [from, to] = [flat(base), flat(drive)];
  const paths = [...new Set([...Object.keys(from), ...Object.keys(to)])].filter((path) =>
    path !== "schema" && path !== "title" &&
    JSON.stringify(from[path] ?? null) !== JSON.stringify(to[path] ?? null)
  );
  const named = paths.slice(0, MOST_NAMED).map((path) => {
    const { label, scale } = inputOf(path, from[path] === undefined ? drive : base);
    const [before, after] = [inputText(from[path], scale), inputText(to[path], scale)];
    const unit = scale?.unit && before.endsWith(` ${scale.unit}`) && after.endsWith(` ${scale.unit}`);
    return `${label} ${unit ? before.slice(0, -scale.unit.length - 1) : before} → ${after}`;
  });
  const more = paths.length - named.length;
  return named.join(", ") + (more > 0 ? `, ${more} more` : "");
}

/** Names of the pinned runs: the first by its drive, the others by what they change of it. */
export const pinNames = computed(() =>
  pins.value.map((pin, i) =>
    i ? differenceText(pins.value[0].drive, pin.drive) || "the same again" : pin.name
  )
);

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
