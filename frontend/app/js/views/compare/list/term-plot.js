// @ts-check
// The part of the residual that no effect of the catalogue explains, and a formula that would, over a variable.
import { h } from "../../../dom.js";
import { computed, effect } from "../../../reactive.js";
import { units } from "../../../state.js";
import { scaleOf, toShown } from "../../../format.js";
import { Chart } from "../../../plots/chart.js";
import { palette } from "../../../plots/theme.js";
import { extent } from "../../../plots/axes.js";
import { plotlyReady } from "../../../plots/library.js";
import { diagnosis } from "../answers.js";
import { padded } from "../where/specs.js";
import { channelScale, channelWords, VARIABLES } from "../words.js";

const term = computed(() => diagnosis.value?.verdict.proposed_term ?? null);

export function termPlot() {
  const host = h("div", { class: "plot", role: "figure", "aria-label": "Residual and proposed term" });
  const chart = new Chart(host, "compare-term");
  effect(() => {
    const curve = term.value?.curve, system = units.value, result = diagnosis.value;
    palette.value;
    if (!curve || !result || !plotlyReady.value) return;
    const v = VARIABLES[curve.x], s = channelScale(result.unit, result.predicted, system);
    const across = v ? scaleOf(v.quantity, system) : null;
    const x = curve.values.map((si) => across && si !== null ? toShown(si, across) : si);
    const y = (/** @type {(number | null)[]} */ values) =>
      values.map((one) => one === null ? null : one / s.factor);
    // Over a variable with few different values, the term has several values at each of them.
    const several = new Set(x).size < x.length / 2;
    chart.show((p) => ({
      x: { title: v ? `${v.title} (${across?.unit})` : channelWords(curve.x), range: padded(extent([x])) },
      y: { title: `Residual (${s.unit})`, range: extent([y(curve.residual), y(curve.term), [0]]) },
      traces: [
        {
          id: "left",
          x,
          y: y(curve.residual),
          marker: { size: 4, symbol: "circle", color: p.soft },
          column: "residual",
        },
        several
          ? {
            id: "term",
            x,
            y: y(curve.term),
            marker: { size: 9, symbol: "line-ew", color: p.accent },
            column: "term",
          }
          : { id: "term", x, y: y(curve.term), line: { color: p.accent, width: 2 }, column: "term" },
      ],
      zones: [],
      revision: `term${system}`,
    }));
  });
  return host;
}
