// @ts-check
// The rows of the board: errors, fitted values, effects with their parameters, geometry.
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { brief, number, readable, scaleOf, toShown } from "../../../format.js";
import { answer, diagnosis } from "../answers.js";
import { entries } from "../list/plan.js";
import { likelyText } from "../list/entry.js";
import { allSeries } from "../where/pictures.js";
import {
  errorText,
  errorUnit,
  fitPercent,
  measuredText,
  overNoise,
  parameterScale,
  titleOf,
} from "../words.js";
import { aicOf, weightsOf } from "./weights.js";

/** @typedef {import("./columns.js").Column} Column */
/** `texts`: value and what stands beside it; `numbers`: to sort by; `share`: of the baseline, for a difference.
 * @typedef {{label: string, unit: string, group: "error" | "effect" | "geometry", texts: [string, string][],
 *   numbers: (number | null)[], differs: boolean, compared: boolean, title?: string}} Row */

/** @param {string} label @param {string} unit @param {(number | null)[]} numbers
 * @param {(x: number) => string} text @param {boolean} [compared] @returns {Row} */
function errorRow(label, unit, numbers, text, compared = true) {
  const texts = numbers.map((x) => /** @type {[string, string]} */ ([x === null ? "–" : text(x), ""]));
  return { label, unit, group: "error", texts, numbers, differs: isDifferent(texts), compared };
}

/** @param {[string, string][]} texts */
const isDifferent = (texts) => new Set(texts.map(([text]) => text)).size > 1;

const WEIGHT =
  "Weight among these models, 100 % together: exp(−S/2), S = n ln(error²) + k ln n, with k fitted values and n " +
  "independent rows. It says which of them the data favour, not that one of them is right.";

/** @param {Column} c */
const countOf = (c) => Object.values(c.fit).reduce((n, values) => n + Object.keys(values).length, 0);

/** "97.2", "< 0.1", "> 99.9" @param {number} share */
const shareText = (share) => share < 1e-3 ? "< 0.1" : share > 0.999 ? "> 99.9" : brief(100 * share);

const AIC =
  "Akaike's criterion n ln(error²) + 2k above that of the lowest model, with k fitted values and n independent rows: " +
  "models less than 2 apart do about equally well, one that is 10 above has no support.";

/** Weight and AIC of each model among those of the board; twice the same model counts once. None: there is no second one.
 * @param {Column[]} all @param {number | null} floor @returns {Row[]} */
function weightRows(all, floor) {
  const keys = all.map((c) => JSON.stringify([c.effects, c.comparison?.rmse]));
  const weighed = all.map((c, i) => {
    const found = c.comparison;
    if (!found?.rmse || !c.fitted || keys.indexOf(keys[i]) < i) return null;
    const autocorrelation = found.whiteness.autocorrelation.map((rho) => rho ?? 0);
    return { error: found.rmse, fitted: countOf(c), rows: found.rows_used, autocorrelation };
  });
  const own = weightsOf(weighed, floor), above = aicOf(weighed, floor);
  const ofEach = (/** @type {(number | null)[]} */ one) =>
    all.map((c, i) => c.fitted ? one[keys.indexOf(keys[i])] : null);
  if (own.every((w) => w === null)) return [];
  return [
    { ...errorRow("Weight", "% among these", ofEach(own), shareText, false), title: WEIGHT },
    { ...errorRow("AIC", "above the lowest", ofEach(above), brief, false), title: AIC },
  ];
}

/** @param {Column[]} all @returns {Row[]} */
function errorRows(all) {
  const a = answer.value, system = units.value;
  const unit = errorUnit(a?.unit ?? "N", a?.predicted ?? "force", system);
  const asText = (/** @type {number} */ si) =>
    errorText(si, a?.unit ?? "N", a?.predicted ?? "force", system, false);
  const floor = diagnosis.value?.noise_floor.rmse ?? a?.noise_floor ?? null;
  const errors = all.map((c) => c.comparison?.rmse ?? null);
  const fits = all.map((c) =>
    c.comparison ? fitPercent(allSeries(c.comparison).filter((s) => s.use !== "validation")) : null
  );
  return [
    errorRow("Error", `${unit} RMS`, errors, asText),
    errorRow("Held-out error", unit, all.map((c) => c.holdout), asText),
    errorRow("Fit", "%, 100 is perfect", fits, brief, false),
    ...(floor && a?.unit !== "1"
      ? [
        errorRow("Error over noise", "×", errors.map((e) => e === null ? null : e / floor), overNoise, false),
      ]
      : []),
    errorRow("Fitted values", "", all.map(countOf), String, false),
    ...weightRows(all, floor),
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
