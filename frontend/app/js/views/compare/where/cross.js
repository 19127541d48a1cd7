// @ts-check
// The correlation of the residual with the input of the test: after the input it shows what the model misses of how
// the input acts, before it that the input follows the muscle.
import { h } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { capitalized } from "../../../format.js";
import { channelWords } from "../words.js";
import { correlations, FOR_LABEL } from "./leftover.js";

/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {Comparison["cross"][number]} Cross */

const CORRELATION = figure("residual.correlation");
/** Share of the lags that are outside the band by chance, and from which on there are more. */
const CHANCE = 0.05, MORE = 0.15;

/** @param {Comparison} a @param {string} channel @returns {import("./leftover.js").Picture} */
export function crossCorrelation(a, channel) {
  const found = a.cross.find((one) => one.channel === channel);
  if (!found) {
    return {
      spec: null,
      words: [`${capitalized(CORRELATION.otherwise)}.`],
    };
  }
  const total = found.lags.length, out = Math.round(found.outside * total);
  const before =
    found.correlation.filter((r, i) => found.lags[i] < 0 && Math.abs(r ?? 0) > found.band).length;
  const where = out > before
    ? `${out - before} after the input, ${before} before it`
    : `all before the input`;
  return {
    spec: (p) => spec(found, p),
    words: [
      h(
        "b",
        { id: "cross-words" },
        found.outside <= MORE
          ? "The residual does not follow the input: "
          : `The residual follows the input, ${channelWords(found.input)}: `,
      ),
      `${out} of ${total} lags outside the 95 % band${out ? `, ${where}` : ""} (${
        Math.round(CHANCE * total)
      } by chance).`,
    ],
  };
}

/** @param {Cross} found @param {Palette} p @returns {Spec} */
function spec({ lags, correlation, band, input }, p) {
  const ends = lags.map((lag, i) => /** @type {[number, number]} */ ([lag, correlation[i] ?? 0]));
  const size = Math.min(1.05, 1.15 * Math.max(band, ...ends.map(([, r]) => Math.abs(r))));
  return {
    x: {
      title: `Residual after the ${channelWords(input)} (rows)`,
      range: [lags[0] - 1, FOR_LABEL * (lags.at(-1) ?? 1)],
    },
    y: { title: CORRELATION.label, range: [-size, size] },
    traces: correlations(ends, band, p),
    zones: [{ x: null, y: [-band, band], text: "95 % of independent" }],
    revision: `cross${input}${lags.length}`,
    table: {
      columns: [{ title: "lag", unit: "rows" }, { title: "correlation" }, { title: "band" }],
      rows: ends.map(([lag, r]) => [lag, r, band]),
    },
  };
}
