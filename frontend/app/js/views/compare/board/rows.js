// @ts-check
// The rows of the board: errors, fitted values, effects with their parameters, geometry.
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { brief, number, readable, scaleOf, toShown } from "../../../format.js";
import { answer } from "../answers.js";
import { entries } from "../list/plan.js";
import { likelyText } from "../list/entry.js";
import { errorText, errorUnit, measuredText, overNoise, parameterScale, titleOf } from "../words.js";

/** @typedef {import("./columns.js").Column} Column */
/** @typedef {import("../types.js").Comparison} Comparison */
/** `texts`: value and what stands beside it; `numbers`: to sort by; `share`: of the baseline, for a difference.
 * @typedef {{label: string, unit: string, group: "error" | "effect" | "geometry", texts: [string, string][],
 *   numbers: (number | null)[], differs: boolean, compared: boolean, title?: string}} Row */

/** @param {string} key of a figure @param {string} unit @param {(number | null)[]} numbers
 * @param {(x: number) => string} text @param {boolean} [compared] @returns {Row} */
function errorRow(key, unit, numbers, text, compared = true) {
  const { label, definition } = figure(key);
  const texts = numbers.map((x) => /** @type {[string, string]} */ ([x === null ? "–" : text(x), ""]));
  return {
    label,
    title: definition,
    unit,
    group: "error",
    texts,
    numbers,
    differs: isDifferent(texts),
    compared,
  };
}

/** @param {[string, string][]} texts */
const isDifferent = (texts) => new Set(texts.map(([text]) => text)).size > 1;

/** @param {Column} c */
const countOf = (c) => Object.values(c.fit).reduce((n, values) => n + Object.keys(values).length, 0);

/** @param {Column[]} all @returns {Row[]} */
function errorRows(all) {
  const a = answer.value, system = units.value;
  const unit = errorUnit(a?.unit ?? "N", a?.predicted ?? "force", system);
  const asText = (/** @type {number} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", system, false);
  const of = (/** @type {(a: Comparison) => number | null} */ value) =>
    all.map((c) => c.comparison && value(c.comparison));
  return [
    errorRow("comparison.rmse_beyond_accuracy", unit, of((c) => c.rmse_beyond_accuracy), asText),
    errorRow("comparison.holdout_rmse", unit, all.map((c) => c.holdout), asText),
    errorRow("comparison.fit_percent", "%", of((c) => c.fit_percent), brief, false),
    ...(a?.over_noise && a.unit !== "1"
      ? [errorRow("comparison.over_noise", "×", of((c) => c.over_noise), overNoise, false)]
      : []),
    errorRow("comparison.fitted", "", all.map(countOf), String, false),
  ];
}

/** How likely an effect is missing, where the diagnosis says it. @param {string} id */
const likely = (id) => {
  const found = entries.value.find((e) => e.group.includes(id))?.probability ?? null;
  return found === null ? "" : ` (${likelyText(found)})`;
};

/** @param {Column[]} all @returns {Row[]} */
function effectRows(all) {
  const ids = [...new Set(all.flatMap((c) => Object.keys(c.effects)))];
  return ids.flatMap((id) => {
    const known = effectsById.value.get(id)?.parameters ?? [];
    // A value that is off wherever it stands says nothing.
    const isOff = (/** @type {string} */ name) => {
      const off = known.find((p) => p.name === name)?.off ?? null;
      return off !== null &&
        all.every((c) => !c.fit[id]?.[name] && (c.effects[id]?.[name] ?? off) === off);
    };
    const names = [...new Set(all.flatMap((c) => Object.keys(c.effects[id] ?? {})))].filter((name) =>
      !isOff(name)
    );
    return names.map((name) => {
      const p = known.find((one) => one.name === name) ?? { unit: "1", name };
      const s = parameterScale(p, units.value);
      const numbers = all.map((c) => {
        const value = c.effects[id]?.[name];
        return typeof value === "number" ? value : null;
      });
      const texts = all.map((c, i) => {
        const value = c.effects[id]?.[name], fit = c.fit[id]?.[name], si = numbers[i];
        if (value === undefined) return /** @type {[string, string]} */ (["–", ""]);
        if (si === null) return /** @type {[string, string]} */ ([String(value), ""]);
        const [text, sigma] = measuredText(si, fit?.stderr ?? null, { ...s, unit: "" }).split(" ± ");
        return /** @type {[string, string]} */ ([text, fit ? sigma ? `± ${sigma}` : "" : "fixed"]);
      });
      const only = names.length === 1;
      return {
        label: only
          ? `${titleOf(id)}${likely(id)}`
          : `${titleOf(id)}: ${readable(name)}${name === names[0] ? likely(id) : ""}`,
        unit: s.unit,
        group: /** @type {const} */ ("effect"),
        texts,
        numbers,
        differs: isDifferent(texts),
        compared: false,
      };
    });
  });
}

/** @type {[string, string, "length" | "angle"][]} */
const GEOMETRY = [
  ["nominal_length", "Rest length", "length"],
  ["braid_diameter", "Braid diameter", "length"],
  ["braid_angle", "Braid angle", "angle"],
];

/** @param {Column[]} all @returns {Row[]} */
const geometryRows = (all) =>
  GEOMETRY.map(([key, label, quantity]) => {
    const s = scaleOf(quantity, units.value);
    const numbers = all.map((c) => {
      const found = /** @type {Record<string, unknown> | undefined} */ (c.comparison?.geometry)?.[key];
      return typeof found === "number" ? found : c.values[key] ?? null;
    });
    const texts = numbers.map((
      x,
    ) => /** @type {[string, string]} */ ([x === null ? "–" : number(toShown(x, s), s.digits), ""]));
    return {
      label,
      unit: s.unit,
      group: /** @type {const} */ ("geometry"),
      texts,
      numbers,
      differs: isDifferent(texts),
      compared: false,
    };
  });

/** @param {Column[]} all @returns {Row[]} */
export const rowsOf = (all) => [...errorRows(all), ...effectRows(all), ...geometryRows(all)];
