// @ts-check
// Inputs of a drive in words, and runs named by the inputs that differ.
import { figure } from "../../facts.js";
import { computed } from "../../reactive.js";
import { units } from "../../state.js";
import { effectsById } from "../../store.js";
import { capitalized, number, plainScale, quantityOf, readable, scaleOf, toShown } from "../../format.js";
import { at } from "../../paths.js";
import { siNumber } from "../../quantities.js";
import { SPECS } from "./inputs/fields.js";
import { signalField } from "./inputs/signals.js";
import { pins } from "./pinned-runs.js";

/** @typedef {import("../../format.js").Scale} Scale */
/** @typedef {import("../../types.js").Drive} Drive */

/** All values of a document by their path. @param {any} part @param {string} [path]
 * @returns {Record<string, unknown>} */
export function flat(part, path = "") {
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
export function inputOf(path, drive) {
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
export function inputText(value, scale) {
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
