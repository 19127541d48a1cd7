// @ts-check
// What the squared residual is made of: one bar of 100 %, never the same thing twice; and the errors of channels.
import { h } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief } from "../../../format.js";
import { shown } from "../answers.js";
import { channelWords, errorText, VARIABLES } from "../words.js";

/** @typedef {import("../types.js").Comparison} Comparison */

/** A part smaller than this share is not named. */
const LEAST = 0.005;

/** @type {Record<string, string>} */
const NAMES = {
  offset: "the same everywhere",
  noise: "noise",
  rest: "follows none of these",
  together: "follows several together",
};

/** @param {string} of */
function nameOf(of) {
  if (of in NAMES) return NAMES[of];
  return `follows ${VARIABLES[of]?.short ?? channelWords(of)}`;
}

/** Whole percents that add up to 100: the largest remainders are rounded up. @param {number[]} shares */
export function percents(shares) {
  const sum = shares.reduce((all, one) => all + one, 0);
  const exact = shares.map((one) => (100 * one) / sum), whole = exact.map(Math.floor);
  const left = 100 - whole.reduce((all, one) => all + one, 0);
  const order = [...exact.keys()].sort((i, k) => (exact[k] - whole[k]) - (exact[i] - whole[i]));
  for (const i of order.slice(0, left)) whole[i]++;
  return whole;
}

/** @param {Comparison} a */
function bar(a) {
  const parts = (a.parts ?? []).filter((part) => part.share >= LEAST);
  if (!parts.length) return null;
  const texts = percents(parts.map((part) => part.share));
  return [
    h(
      "div",
      { class: "parts-bar", "aria-hidden": "true" },
      ...parts.map((part) => h("i", { "data-part": part.of, style: `flex:${part.share} 0 0` })),
    ),
    h(
      "ul",
      {
        class: "parts-key",
        "aria-label": "What the squared error is made of",
        title: figure("residual.share").definition,
      },
      h("li", null, "The squared error is"),
      ...parts.flatMap((part, i) =>
        texts[i]
          ? [h(
            "li",
            null,
            h("i", { "data-part": part.of }),
            h("b", null, `${texts[i]} %`),
            ` ${nameOf(part.of)}`,
          )]
          : []
      ),
    ),
  ];
}

/** The error of each channel; that of a stroke also as its share. @param {Comparison} a */
function channels(a) {
  const all = Object.entries(a.channels);
  if (all.length < 2) return null;
  return h(
    "ul",
    {
      class: "parts-key",
      "aria-label": "Error of each channel",
      title: `${figure("comparison.rmse").definition} ${figure("comparison.stroke_percent").label}: ${
        figure("comparison.stroke_percent").definition
      }`,
    },
    ...all.map(([name, c]) => {
      const share = c.stroke_percent, percent = share === null ? "" : `, ${brief(share)} % of stroke`;
      return h(
        "li",
        null,
        h("b", null, `${channelWords(name)} `),
        `${errorText(c.rmse, c.unit, name, units.value)}${percent}, noise ${
          errorText(c.noise_floor, c.unit, name, units.value)
        }`,
      );
    }),
  );
}

/** What the error over windows says beside that of the run. @param {Comparison} a */
const overWindows = (a) =>
  a.windows === null ? null : h("p", {
    class: "over-windows",
    title: `${figure("windows.rmse").label}: ${figure("windows.rmse").definition} ${
      figure("windows.length").label
    }: ${figure("windows.length").definition}`,
  }, `${a.windows.sentence}.`);

/** Under the residual; of constant height. */
export const partsBar = () =>
  h("div", { class: "error-parts" }, () => {
    const a = shown.value;
    return a ? [bar(a), channels(a), overWindows(a)].flat() : null;
  });
