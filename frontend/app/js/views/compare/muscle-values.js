// @ts-check
// Which muscle a measurement was taken on. Pure functions.
import { siNumber } from "../../quantities.js";

/** @typedef {import("../../types.js").Preset} Preset */
/** @typedef {import("../../types.js").Muscle} Muscle */

/** The preset a file names, by id, title or the type code of a sample ("DMSP-20-300").
 * @param {Preset[]} muscles @param {unknown} name
 * @returns {{preset: Preset, length: number | null} | null} */
export function presetNamed(muscles, name) {
  if (typeof name !== "string" || !name.trim()) return null;
  const wanted = name.trim().toLowerCase().replace(/\s+/g, "-");
  const exact = muscles.find((m) =>
    [m.id, m.title].some((text) => text.toLowerCase().replace(/\s+/g, "-") === wanted)
  );
  if (exact) return { preset: exact, length: null };
  const longest = muscles.filter((m) => wanted.startsWith(`${m.id.toLowerCase()}-`))
    .sort((a, b) => b.id.length - a.id.length)[0];
  if (!longest) return null;
  const code = /^(\d+)/.exec(wanted.slice(longest.id.length + 1));
  return { preset: longest, length: code ? Number(code[1]) / 1000 : null };
}

/** The muscle named by the conditions of a measurement; null: none, or an unknown one.
 * @param {Preset[]} muscles @param {Record<string, unknown>} conditions @returns {Muscle | null} */
export function muscleOf(muscles, conditions) {
  const named = presetNamed(muscles, conditions.muscle) ?? presetNamed(muscles, conditions.sample);
  const { nominal_length: measured } = conditions;
  const length = typeof measured === "number" ? measured : named?.length;
  if (!named) return null;
  return { preset: named.preset.id, form: "braid", values: length ? { nominal_length: length } : {} };
}

/** What the user says of the experiment, as conditions of a file in SI.
 * @param {import("../../types.js").Experiment} experiment @returns {Record<string, number | string>} */
export function conditionsOf(experiment) {
  const text = (/** @type {string} */ key) => {
    const said = experiment[key];
    return said === undefined || typeof said === "string" ? said : said.value;
  };
  const si = (/** @type {string} */ key, /** @type {string} */ unit) => siNumber(text(key), { unit });
  /** @type {[string, number | string | null | undefined][]} */
  const all = [
    ["muscle", text("muscle")],
    ["nominal_length", si("rest_length", "m")],
    ["load_mass", si("load", "kg")],
    ["load_force", si("load", "N")],
    ["supply_pressure", si("supply", "Pa")],
    ["valve", text("valve")],
  ];
  return Object.fromEntries(all.flatMap(([key, value]) => value == null ? [] : [[key, value]]));
}

/** The muscle with the rest length of a specimen, where it is known. @param {Muscle} muscle
 * @param {Record<string, unknown>} conditions @returns {Muscle} */
export const withRestLength = (muscle, { nominal_length: length }) =>
  typeof length === "number" ? { ...muscle, values: { ...muscle.values, nominal_length: length } } : muscle;

/** The muscle of a request, with lengths such as "300 mm", as the document has it.
 * @param {Record<string, any>} input @returns {Muscle} */
export function muscleFrom({ preset = null, ...rest }) {
  const values = Object.fromEntries(
    Object.entries(rest).flatMap(([name, value]) => {
      const si = siNumber(value);
      return si === null ? [] : [[name, si]];
    }),
  );
  return { preset, form: "turns" in values || "thread_length" in values ? "thread" : "braid", values };
}
