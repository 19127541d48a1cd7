// @ts-check
// Fitted values in words: "C10 = 0.500 ± 0.002 N/mm²".
import { h, mathml } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { readable } from "../../../format.js";
import { measuredText, parameterScale } from "../words.js";

/** @typedef {{value: number, stderr: number | null, unit: string, at_bound: boolean}} Value */

/** @param {string} name @param {Value} p */
export function valueText(name, p) {
  const s = parameterScale({ unit: p.unit, name }, units.value);
  return [
    measuredText(p.value, p.stderr, s),
    p.at_bound
      ? h(
        "span",
        { class: "at-bound", title: "The fit stopped at the end of the allowed range" },
        " at its limit",
      )
      : null,
  ];
}

/** @param {string} id @param {Record<string, Value & {fitted: boolean}>} parameters */
export function valueList(id, parameters) {
  const known = effectsById.value.get(id)?.parameters ?? [];
  const fitted = Object.entries(parameters).filter(([, p]) => p.fitted);
  if (!fitted.length) return null;
  return h(
    "ul",
    { class: "found-values" },
    ...fitted.map(([name, p]) => {
      const symbol = known.find((one) => one.name === name)?.symbol_mathml;
      return h(
        "li",
        { title: `${readable(name)}; ${inSentence(figure("parameter.stderr").label)}` },
        symbol ? mathml(symbol) : readable(name),
        " = ",
        ...valueText(name, p),
      );
    }),
  );
}
