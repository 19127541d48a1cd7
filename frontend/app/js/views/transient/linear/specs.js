// @ts-check
// The plots of the linear view: gain and phase with the nonlinear drive's points, steps of the controllers.
import { figure } from "../../../facts.js";
import { plainScale, scaleOf, toShown } from "../../../format.js";
import { axisTitle, extent, shown } from "../../../plots/axes.js";
import { units } from "../../../state.js";

/** @typedef {import("./model.js").Linear} Linear */
/** @typedef {import("./model.js").Design} Design */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("../../../plots/chart.js").Spec} Spec */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {{name: string, color: string, dash?: string, symbol?: string}} Entry */

const DASHES = ["dash", "dot", "dashdot", "longdash"];
const SYMBOLS = ["circle", "square", "diamond", "triangle-up", "cross", "x"];
/** Place of a frequency on its axis; above 0, where a plot draws a line. @param {number} frequency */
const place = (frequency) => Math.log10(frequency) + 3;
/** Gain and phase in shown units. @param {(number | null)[]} values */
const decibels = (values) => shown(values, figure("linear_model.gain").quantity, units.value);
const degrees = (/** @type {(number | null)[]} */ values) =>
  shown(values, figure("linear_model.phase").quantity, units.value);

/** Lines and points of the answer with their looks. @param {Linear} answer @param {Palette} p */
function looks(answer, p) {
  let other = 0;
  const models = answer.models.map((m) => ({
    model: m,
    color: m.primary ? p.accent : p.soft,
    dash: m.primary ? undefined : DASHES[other++ % DASHES.length],
  }));
  const amplitudes = [...new Set(answer.describing.map((d) => d.amplitude))].sort((a, b) => a - b);
  const colours = [p.second, p.load, p.ink];
  const points = amplitudes.map((amplitude, i) => ({
    amplitude,
    color: colours[i % colours.length],
    symbol: SYMBOLS[i % SYMBOLS.length],
    rows: answer.describing.filter((d) => d.amplitude === amplitude && d.gain !== null),
  }));
  return { models, points };
}

/** @param {Linear} answer @param {number} amplitude */
const amplitudeText = (answer, amplitude) => {
  const scale = answer.input.unit === "1" ? scaleOf("ratio", units.value) : plainScale(answer.input.unit);
  return `${Number(toShown(amplitude, scale).toPrecision(3))} ${scale.unit}`;
};

/** @param {Linear} answer @param {Palette} p @returns {Entry[]} */
export function legendOfBode(answer, p) {
  const { models, points } = looks(answer, p);
  return [
    ...models.map(({ model, color, dash }) => ({ name: model.name, color, dash })),
    ...points.map(({ amplitude, color, symbol }) => ({
      name: `nonlinear, ${amplitudeText(answer, amplitude)}`,
      color,
      symbol,
    })),
  ];
}

/** @param {Linear} answer @returns {Spec["x"]} the logarithm of the frequency with decades as marks */
function frequencyAxis(answer) {
  const low = place(answer.frequency[0]), high = place(answer.frequency.at(-1) ?? 1);
  const marks = [];
  for (let decade = -3; decade <= 3; decade++) {
    for (const digit of [1, 2, 5]) {
      const frequency = Number((digit * 10 ** decade).toPrecision(1)), at = place(frequency);
      if (at >= low && at <= high) marks.push({ at, text: String(frequency) });
    }
  }
  return { title: "Frequency (Hz)", range: [low, high], marks };
}

/** @param {(number | null)[][]} rows @param {number} step @returns {[number, number]} */
function roundRange(rows, step) {
  const [low, high] = extent(rows);
  return [Math.floor(low / step) * step, Math.max(Math.ceil(high / step), Math.floor(low / step) + 1) * step];
}

/** @param {Linear} answer @param {Palette} p
 * @param {{title: string, step: number, least?: number, line: (m: Linear["models"][number]) => (number | null)[],
 *   dot: (d: Linear["describing"][number]) => number | null}} o @returns {Spec} */
function bode(answer, p, o) {
  const { models, points } = looks(answer, p);
  const x = answer.frequency.map(place);
  const lines = models.map(({ model, color, dash }) => ({
    id: `model ${model.name}`,
    column: model.name,
    x,
    y: o.line(model),
    line: { color, dash, width: model.primary ? 2.4 : 1.6 },
  }));
  const dots = points.map(({ amplitude, color, symbol, rows }) => ({
    id: `sine ${amplitude}`,
    column: `nonlinear, ${amplitudeText(answer, amplitude)}`,
    x: rows.map((d) => place(d.frequency)),
    y: rows.map(o.dot),
    marker: { size: 7, symbol, color, edge: p.card },
  }));
  const [low, high] = roundRange([...lines, ...dots].map((t) => t.y), o.step);
  return {
    x: frequencyAxis(answer),
    y: { title: o.title, range: [Math.max(low, high - (o.least ?? Infinity)), high] },
    traces: [...lines, ...dots],
    zones: [],
    revision: `linear ${answer.input.name} ${answer.output.name}`,
    table: {
      columns: [{ title: "Frequency", unit: "Hz" }, ...[...lines, ...dots].map((t) => ({ title: t.column }))],
      rows: tableRows(answer.frequency, lines, points, o.dot),
    },
  };
}

/** Rows of the models, then those of the sines. @param {number[]} frequency @param {{y: (number | null)[]}[]} lines
 * @param {ReturnType<typeof looks>["points"]} points
 * @param {(d: Linear["describing"][number]) => number | null} dot @returns {(number | null)[][]} */
function tableRows(frequency, lines, points, dot) {
  const models = frequency.map((f, i) => [f, ...lines.map((t) => t.y[i]), ...points.map(() => null)]);
  const sines = points.flatMap(({ rows }, k) =>
    rows.map((d) => [d.frequency, ...lines.map(() => null), ...points.map((_, j) => j === k ? dot(d) : null)])
  );
  return [...models, ...sines];
}

/** @param {Linear} answer @param {Palette} p */
export const gainSpec = (answer, p) =>
  bode(answer, p, {
    title: `Gain (dB re 1 ${answer.gain_unit})`,
    step: 20,
    least: 140,
    line: (m) => decibels(m.gain),
    dot: (d) => decibels([d.gain])[0],
  });

/** @param {Linear} answer @param {Palette} p */
export const phaseSpec = (answer, p) =>
  bode(answer, p, {
    title: "Phase (°)",
    step: 90,
    least: 720,
    line: (m) => degrees(m.phase),
    dot: (d) => degrees([d.phase])[0],
  });

/** Colour and dash of each controller. @param {Design} design @param {Palette} p */
export function trialLooks(design, p) {
  const looks = {
    own: { color: p.load, dash: "dot" },
    rule: { color: p.second, dash: "dash" },
    refined: { color: p.accent, dash: undefined },
  };
  return design.trials.map((trial) => ({ trial, ...looks[trial.name] }));
}

/** @param {Design} design @param {Palette} p @param {System} system @returns {Spec} */
export function stepSpec(design, p, system) {
  const position = figure("run.position");
  const inUnits = (/** @type {(number | null)[]} */ values) => shown(values, position.quantity, system);
  const last = design.trials[design.trials.length - 1];
  const reference = inUnits(last.reference);
  const lines = trialLooks(design, p).map(({ trial, color, dash }) => ({
    id: trial.name,
    column: trial.name,
    x: trial.time,
    y: inUnits(trial.position),
    line: { color, dash, width: trial.name === "refined" ? 2.4 : 1.8 },
  }));
  const [bottom, top] = extent([reference]), room = 0.6 * (top - bottom || 1);
  const [low, high] = extent(lines.map((t) => t.y));
  return {
    x: { title: "Time (s)", range: [0, last.time.at(-1) ?? 1] },
    y: {
      title: axisTitle(position.label, position.quantity, system),
      range: [Math.max(low, bottom - room) - 0.05 * room, Math.min(high, top + room) + 0.05 * room],
    },
    traces: [
      { id: "reference", x: last.time, y: reference, line: { color: p.soft, width: 1.4 } },
      ...lines,
    ],
    zones: [],
    revision: "linear design",
  };
}
