// @ts-check
// Whether the residual is noise: histogram, autocorrelation and area of loops, each as a plot and in words.
import { h } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { brief, capitalized, figureText, scaleOf, toShown } from "../../../format.js";
import { channelScale, errorText } from "../words.js";

/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../plots/chart.js").Trace} Trace */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("./specs.js").View} View */
/** What a tab shows of the residual; `spec` null: nothing can be drawn, and `words` give the reason.
 * @typedef {{spec: ((p: Palette) => Spec) | null, words: import("../../../dom.js").Child[]}} Picture */

const RMS = figure("comparison.rmse"), AUTOCORRELATION = figure("residual.autocorrelation");
const SIGNS = figure("residual.sign_changes"), AREA = figure("residual.area");
const FRICTION = figure("residual.friction");
const BINS = 31;
/** Room on the right for the name of a band. */
export const FOR_LABEL = 1.14;
/** Standard deviations of the band of the noise. */
const BAND = 2;

/** @param {Comparison} a @param {View} v @returns {Picture} */
export function histogram(a, v) {
  const asText = (/** @type {number | null} */ si) => errorText(si, v.unit, v.channel, v.system);
  return {
    spec: (p) => histogramSpec(v, p),
    words: [
      `${RMS.label} ${asText(a.channels[v.channel]?.rmse ?? a.rmse)}`,
      v.noise === null ? "" : `; dashed: noise alone, σ ${asText(v.noise)}`,
    ],
  };
}

/** The histogram of the residual, with that of noise alone.
 * @param {View} v @param {Palette} p @returns {Spec} */
function histogramSpec(v, p) {
  const s = channelScale(v.unit, v.channel, v.system);
  const values = v.series.flatMap((one) => one.residual.flatMap((r) => r == null ? [] : [r / s.factor]));
  const most = Math.max(...values.map(Math.abs), v.noise === null ? 0 : (3 * v.noise) / s.factor) || 1;
  const width = (2 * most) / BINS;
  const counts = Array.from({ length: BINS }, () => 0);
  for (const r of values) counts[Math.min(BINS - 1, Math.max(0, Math.floor((r + most) / width)))]++;
  /** @type {Trace[]} */
  const traces = [{
    id: "histogram",
    x: counts.flatMap((_c, i) => [-most + i * width, -most + (i + 1) * width]),
    y: counts.flatMap((c) => [c, c]),
    line: { color: p.accent, width: 2 },
    column: "rows",
  }];
  if (v.noise) {
    const sigma = v.noise / s.factor, x = Array.from({ length: 121 }, (_, i) => -most + (i * 2 * most) / 120);
    const scale = (values.length * width) / (sigma * Math.sqrt(2 * Math.PI));
    traces.push({
      id: "normal",
      x,
      y: x.map((r) => scale * Math.exp(-((r / sigma) ** 2) / 2)),
      line: { color: p.second, width: 1.6, dash: "dash" },
      column: "noise alone",
    });
  }
  // A narrow peak of the noise must not make the histogram flat.
  const top = Math.max(...counts, 1) * 1.6;
  return {
    x: { title: s.unit ? `Residual (${s.unit})` : "Residual", range: [-most, most] },
    y: { title: "Rows", range: [0, top] },
    traces,
    zones: [],
    revision: `${v.picture}histogram${v.system}`,
    table: {
      columns: [{ title: "residual from", unit: s.unit }, { title: "to", unit: s.unit }, { title: "rows" }],
      rows: counts.map((c, i) => [-most + i * width, -most + (i + 1) * width, c]),
    },
  };
}

/** Sticks from zero, one line in pieces. @param {[number, number][]} ends */
const sticks = (ends) => ({
  x: ends.flatMap(([x]) => [x, x, null]),
  y: ends.flatMap(([, y]) => [0, y, null]),
});

/** The correlation of a row with the rows after it: none, if only noise is left. @param {Comparison} a
 * @returns {Picture} */
export function autocorrelation(a) {
  const { autocorrelation: rho, band, outside, sign_changes: signs, white } = a.whiteness;
  const known = rho.flatMap((r) => r === null ? [] : [r]);
  if (!known.length) return { spec: null, words: [`${capitalized(AUTOCORRELATION.otherwise)}.`] };
  const out = Math.round(outside * known.length);
  const lags = `${out} of ${known.length} lags outside the 95 % band`;
  return {
    spec: (p) => autocorrelationSpec(known, band, p),
    words: [
      h(
        "b",
        { id: "white", title: figure("residual.white").definition },
        white ? "Neighbouring rows are not correlated: " : "Neighbouring rows are correlated: ",
      ),
      h("span", { title: SIGNS.definition }, `${lags}; ${inSentence(SIGNS.label)} ${brief(signs)}.`),
    ],
  };
}

/** Correlations over their lags as sticks; those outside the band differ in colour and mark.
 * @param {[number, number][]} ends @param {number} band @param {Palette} p @returns {Trace[]} */
export function correlations(ends, band, p) {
  /** @param {string} id @param {boolean} beyond @param {string} color @returns {Trace[]} */
  const set = (id, beyond, color) => {
    const some = ends.filter(([, r]) => Math.abs(r) > band === beyond);
    if (!some.length) return [];
    return [
      { id: `${id}-stick`, ...sticks(some), line: { color, width: 3 }, column: `${id} the band` },
      {
        id,
        x: some.map(([lag]) => lag),
        y: some.map(([, r]) => r),
        marker: { size: 7, symbol: beyond ? "diamond" : "circle", color },
      },
    ];
  };
  return [...set("inside", false, p.soft), ...set("outside", true, p.load)];
}

/** @param {number[]} rho @param {number} band @param {Palette} p @returns {Spec} */
function autocorrelationSpec(rho, band, p) {
  const ends = rho.map((r, i) => /** @type {[number, number]} */ ([i + 1, r]));
  const low = Math.min(...rho, -band);
  return {
    x: { title: "Distance between rows (rows)", range: [0, FOR_LABEL * (rho.length + 1)] },
    y: { title: AUTOCORRELATION.label, range: [Math.max(-1.05, Math.min(-0.4, 1.2 * low)), 1.05] },
    traces: correlations(ends, band, p),
    zones: [{ x: null, y: [-band, band], text: "95 % of noise" }],
    revision: `autocorrelation${rho.length}`,
    table: {
      columns: [{ title: "distance", unit: "rows" }, { title: "autocorrelation" }, {
        title: "band of noise",
      }],
      rows: ends.map(([lag, r]) => [lag, r, band]),
    },
  };
}

/** A loop of the residual with its constant pressure.
 * @typedef {Comparison["loops"][number] & {pressure: number | null, label: string}} Cycle */

/** @param {Comparison} a @returns {Cycle[]} */
function cycles(a) {
  const curves = a.series.filter((s) => s.use !== "validation");
  return a.loops.map((loop, i) => ({
    ...loop,
    pressure: curves[loop.group]?.pressure ?? null,
    label: curves[loop.group]?.label ?? `loop ${i + 1}`,
  }));
}

/** The energy of the residual in each cycle. @param {Comparison} a @param {System} system
 * @returns {Picture} */
export function loops(a, system) {
  const all = cycles(a), mean = a.mean_loop;
  if (!mean) return { spec: null, words: [`${capitalized(AREA.otherwise)}.`] };
  const { area, area_noise: sigma, friction } = mean;
  const size = figureText(Math.abs(area), AREA, system);
  const like = `${inSentence(FRICTION.label)} ${figureText(Math.abs(friction), FRICTION, system)}`;
  const count = all.length === 1 ? "One loop" : `${all.length} loops`;
  return {
    spec: (p) => loopsSpec(all, system, p),
    words: [
      h(
        "b",
        { class: "loop-mean", title: AREA.definition },
        `${count}, mean ${area < 0 ? "−" : "+"}${size}. `,
      ),
      Math.abs(area) <= BAND * (sigma ?? 0) ? "This is within the noise." : h(
        "span",
        { title: FRICTION.definition },
        area >= 0
          ? `Positive: the muscle dissipates more than the model, ${like}.`
          : `Negative: the model dissipates more than the muscle, ${like}.`,
      ),
    ],
  };
}

/** @param {Cycle[]} all @param {System} system @param {Palette} p @returns {Spec} */
function loopsSpec(all, system, p) {
  const energy = scaleOf(/** @type {Quantity} */ (AREA.quantity), system),
    pressure = scaleOf("pressure", system);
  const hasPressure = all.every((c) => c.pressure !== null);
  const at = hasPressure ? all.map((c) => toShown(c.pressure ?? 0, pressure)) : all.map((_c, i) => i + 1);
  const low = hasPressure ? Math.min(...at) : 0, high = hasPressure ? Math.max(...at) : all.length + 1;
  const edge = hasPressure ? 0.08 * (high - low) || 0.5 : 0;
  // Loops at the same pressure are drawn side by side.
  const near = 0.012 * (high - low);
  const x = at.map((one, i) => {
    const same = [...at.keys()].filter((k) => Math.abs(at[k] - one) < near);
    return one + (same.indexOf(i) - (same.length - 1) / 2) * near;
  });
  const y = all.map((c) => toShown(c.area, energy));
  const band = toShown(BAND * Math.max(...all.map((c) => c.area_noise ?? 0)), energy);
  const most = Math.max(...y.map(Math.abs), band) || 1;
  /** @param {string} id @param {boolean} lost @param {string} color @returns {Trace[]} */
  const set = (id, lost, color) => {
    const some = x.map((one, i) => /** @type {[number, number]} */ ([one, y[i]]))
      .filter(([, area]) => area >= 0 === lost);
    if (!some.length) return [];
    const marker = { size: 8, symbol: lost ? "circle" : "diamond", color };
    return [
      { id: `${id}-stick`, ...sticks(some), line: { color, width: 4 }, column: `energy ${id}` },
      { id, x: some.map(([one]) => one), y: some.map(([, area]) => area), marker },
    ];
  };
  return {
    x: {
      title: hasPressure ? `Pressure of the loop (${pressure.unit})` : "Loop",
      range: [low - edge, low + FOR_LABEL * (high + edge - low)],
    },
    y: {
      title: `${AREA.label} (${energy.unit})`,
      range: [y.some((a) => a < -band) ? -1.15 * most : -1.6 * band, 1.15 * most],
    },
    traces: [...set("lost", true, p.load), ...set("gained", false, p.accent)],
    zones: band > 0 ? [{ x: null, y: [-band, band], text: "±2σ of the noise", above: true }] : [],
    revision: `loops${all.length}${system}`,
    table: {
      columns: [{ title: "loop", text: true }, { title: "area", unit: energy.unit }],
      rows: all.map((c, i) => [c.label, y[i]]),
    },
  };
}
