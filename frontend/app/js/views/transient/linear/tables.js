// @ts-check
// The tables of the linear view: poles, margins, controllers, robustness.
import { h } from "../../../dom.js";
import { units } from "../../../state.js";
import { withUnit } from "../../../format.js";

/** @typedef {import("./model.js").Linear} Linear */
/** @typedef {import("./model.js").Design} Design */
/** @typedef {import("./model.js").Trial} Trial */
/** @typedef {NonNullable<Linear["loop"]>["margins"]} Margins */

const DEGREES = 180 / Math.PI;
/** @param {number | null} x @param {string} [unit] */
export const figure = (x, unit = "") =>
  x === null || !Number.isFinite(x) ? "–" : `${Number(x.toPrecision(3))}${unit}`.replace("-", "−");
/** @param {number | null} share */
const percent = (share) => figure(share === null ? null : 100 * share, " %");
/** @param {number | null} factor */
const decibels = (factor) => figure(factor && factor > 0 ? 20 * Math.log10(factor) : null, " dB");
/** @param {number | null} angle */
const degrees = (angle) => figure(angle === null ? null : angle * DEGREES, "°");

/** @param {string} caption @param {string[]} heads @param {string[][]} rows */
const table = (caption, heads, rows) =>
  h(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    h(
      "table",
      { class: "data" },
      h("caption", { class: "unseen" }, caption),
      h(
        "thead",
        null,
        h("tr", null, ...heads.map((head) => head ? h("th", { scope: "col" }, head) : h("td", null))),
      ),
      h(
        "tbody",
        null,
        ...rows.map(([first, ...cells]) =>
          h("tr", null, h("th", { scope: "row" }, first), ...cells.map((cell) => h("td", null, cell)))
        ),
      ),
    ),
  );

/** @param {Linear} answer */
export function polesTable(answer) {
  const model = answer.models.find((m) => m.primary) ?? answer.models[0];
  const rows = model.poles.map((pole) => [
    pole.cancelled ? `${pole.kind}, hidden` : pole.kind,
    figure(pole.frequency, " Hz"),
    figure(pole.damping),
    pole.time_constant === null ? "–" : figure(1e3 * pole.time_constant, " ms"),
  ]);
  const zeros = model.zeros.map((zero) => {
    const size = Math.hypot(zero.real, zero.imaginary);
    return ["zero", figure(size / (2 * Math.PI), " Hz"), figure(size ? -zero.real / size : null), "–"];
  });
  return table(`Poles and zeros, ${model.name}`, ["Pole", "Frequency", "Damping", "Time constant"], [
    ...rows,
    ...zeros,
  ]);
}

/** Entries of a matrix differ by many powers of ten. @param {number} x */
const entry = (x) =>
  x !== 0 && (Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3) ? x.toExponential(2).replace(/-/g, "−") : figure(x);

/** The matrices of the model that loop and design use, their columns named by states and inputs.
 * @param {Linear} answer */
export function matrixTables(answer) {
  const m = answer.models.find((each) => each.primary) ?? answer.models[0];
  const named = (/** @type {{name: string, unit: string}[]} */ ports) =>
    ports.map(({ name, unit }) => unit === "1" ? name : `${name} (${unit})`);
  const states = named(m.states), inputs = named(m.inputs), outputs = named(m.outputs);
  const part = (
    /** @type {string} */ of,
    /** @type {string[]} */ rows,
    /** @type {number[][]} */ left,
    /** @type {number[][]} */ right,
  ) =>
    table(
      `${of}, ${m.name}`,
      ["", ...states, ...inputs],
      rows.map((row, i) => [row, ...[...left[i], ...right[i]].map(entry)]),
    );
  return [
    h("p", { class: "hint" }, `${m.name}, SI: dx/dt = A x + B u, columns are states, then inputs`),
    part("A and B", states, m.a, m.b),
    h("p", { class: "hint" }, "y = C x + D u"),
    part("C and D", outputs, m.c, m.d),
  ];
}

/** @param {Linear} answer */
export function modelsTable(answer) {
  const unit = ` ${answer.output.unit}`;
  return table(
    "Models",
    ["Model", "Static gain", "Bandwidth"],
    answer.models.map((m) => [
      m.primary && answer.models.length > 1 ? `${m.name} (used)` : m.name,
      m.static_gain === null ? "integrates" : figure(m.static_gain, unit),
      figure(m.bandwidth, " Hz"),
    ]),
  );
}

/** @param {Margins} m */
export const marginsTable = (m) =>
  table("Loop with the controller of the drive", ["Loop", "", ""], [
    ["closed loop", m.stable ? "stable" : "unstable", ""],
    ["gain margin", decibels(m.gain_margin), figure(m.gain_margin_at, " Hz")],
    ["phase margin", degrees(m.phase_margin), figure(m.crossover, " Hz")],
    ["delay margin", m.delay_margin === null ? "–" : figure(1e3 * m.delay_margin, " ms"), ""],
    ["least distance from −1", figure(m.modulus_margin), ""],
    ["bandwidth", figure(m.bandwidth, " Hz"), ""],
  ]);

/** @type {Record<string, string>} */
export const TRIALS = { own: "own", rule: "by the rule", refined: "refined" };

/** @param {Design} design */
export function trialsTable(design) {
  const system = units.value;
  /** @type {[string, (t: Trial) => string][]} */
  const rows = [
    ["kp (%/mm)", (t) => figure(t.controller.kp / 10)],
    ["ki (%/(mm s))", (t) => figure(t.controller.ki / 10)],
    ["kd (% s/mm)", (t) => figure(t.controller.kd / 10)],
    ["overshoot", (t) => percent(t.figures.overshoot)],
    ["settling time", (t) => figure(t.figures.settling, " s")],
    ["rise time", (t) => figure(t.figures.rise, " s")],
    ["time at the limits", (t) => percent(t.figures.saturated)],
    ["linear loop", (t) => t.margins.stable ? "stable" : "unstable"],
    ["gain margin", (t) => decibels(t.margins.gain_margin)],
    ["phase margin", (t) => degrees(t.margins.phase_margin)],
    ["meets the goals", (t) => t.figures.meets ? "yes" : "no"],
  ];
  return table(
    `Controllers: steps of ${withUnit(design.goals.step, "length", system)}`,
    ["", ...design.trials.map((t) => TRIALS[t.name])],
    rows.map(([name, cell]) => [name, ...design.trials.map(cell)]),
  );
}

/** @param {Design} design */
export const robustTable = (design) =>
  table(
    "The refined controller with another mass and supply",
    ["Mass", "Supply", "Overshoot", "Settling", "Goals"],
    design.robust.map((v) => [
      percent(v.mass),
      percent(v.supply),
      percent(v.figures.overshoot),
      figure(v.figures.settling, " s"),
      v.figures.meets ? "met" : "missed",
    ]),
  );
