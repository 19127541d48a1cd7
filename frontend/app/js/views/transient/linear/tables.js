// @ts-check
// The tables of the linear view: poles, margins, controllers, robustness.
import { h } from "../../../dom.js";
import { units } from "../../../state.js";
import { figure as declared } from "../../../facts.js";
import { scaleOf, toShown } from "../../../format.js";

/** @typedef {import("./model.js").Linear} Linear */
/** @typedef {import("./model.js").Design} Design */
/** @typedef {import("./model.js").Trial} Trial */
/** @typedef {NonNullable<Linear["loop"]>["margins"]} Margins */

/** @param {number | null} x @param {string} [unit] */
export const figure = (x, unit = "") =>
  x === null || !Number.isFinite(x) ? "–" : `${Number(x.toPrecision(3))}${unit}`.replace("-", "−");

/** A value with the unit of its figure. @param {string} key @param {number | null} si */
function shownAs(key, si) {
  const scale = scaleOf(declared(key).quantity, units.value), { unit } = scale;
  return figure(si === null ? null : toShown(si, scale), unit && unit !== "°" ? `\u00a0${unit}` : unit);
}
/** @param {string} key */
const labelOf = (key) => declared(key).label;
/** A head or the name of a row with its definition. @param {string} key */
const named = (key) => ({ text: labelOf(key), title: declared(key).definition });

/** @typedef {string | {text: string, title: string}} Head */
/** @param {Head} head */
const textOf = (head) => typeof head === "string" ? head : head.text;
/** @param {Head} head */
const titleOf = (head) => typeof head === "string" ? null : head.title;

/** @param {string} caption @param {Head[]} heads @param {[Head, ...(string | HTMLElement)[]][]} rows */
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
        h(
          "tr",
          null,
          ...heads.map((head) =>
            head ? h("th", { scope: "col", title: titleOf(head) }, textOf(head)) : h("td", null)
          ),
        ),
      ),
      h(
        "tbody",
        null,
        ...rows.map(([first, ...cells]) =>
          h(
            "tr",
            null,
            h("th", { scope: "row", title: titleOf(first) }, textOf(first)),
            ...cells.map((cell) => h("td", null, cell)),
          )
        ),
      ),
    ),
  );

const OF_POLES = /** @type {const} */ (["frequency", "oscillation_frequency", "damping", "time_constant"]);

/** @param {Linear} answer */
export function polesTable(answer) {
  const model = answer.models.find((m) => m.primary) ?? answer.models[0];
  return table(`Poles and zeros, ${model.name}`, ["Pole", ...OF_POLES.map((name) => named(`pole.${name}`))], [
    ...model.poles.map((pole) => /** @type {[Head, ...string[]]} */ ([
      pole.cancelled ? `${pole.kind}, hidden` : pole.kind,
      ...OF_POLES.map((name) => shownAs(`pole.${name}`, pole[name])),
    ])),
    ...model.zeros.map((zero) => /** @type {[Head, ...string[]]} */ ([
      "zero",
      shownAs("pole.frequency", zero.frequency),
      ...OF_POLES.slice(1).map(() => "–"),
    ])),
  ]);
}

/** Entries of a matrix differ by many powers of ten. @param {number} x */
const entry = (x) =>
  x !== 0 && (Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3) ? x.toExponential(2).replace(/-/g, "−") : figure(x);

/** The matrices of the model that loop and design use, their columns named by states and inputs.
 * @param {Linear} answer */
export function matrixTables(answer) {
  const m = answer.models.find((each) => each.primary) ?? answer.models[0];
  const withUnits = (/** @type {{name: string, unit: string}[]} */ ports) =>
    ports.map(({ name, unit }) => unit === "1" ? name : `${name} (${unit})`);
  const states = withUnits(m.states), inputs = withUnits(m.inputs), outputs = withUnits(m.outputs);
  const part = (
    /** @type {string} */ of,
    /** @type {string[]} */ rows,
    /** @type {number[][]} */ left,
    /** @type {number[][]} */ right,
  ) =>
    table(
      `${of}, ${m.name}`,
      ["", ...states, ...inputs],
      rows.map((row, i) => [row, ...[...left[i], ...right[i]].map((x) => entry(x))]),
    );
  return [
    h("p", { class: "hint" }, `${m.name}, SI: dx/dt = A x + B u, columns are states, then inputs`),
    part("A and B", states, m.a, m.b),
    h("p", { class: "hint" }, "y = C x + D u"),
    part("C and D", outputs, m.c, m.d),
  ];
}

/** @param {Linear} answer */
export const modelsTable = (answer) =>
  table(
    "Models",
    ["Model", named("linear_model.static_gain"), named("linear_model.bandwidth")],
    answer.models.map((m) => [
      m.primary && answer.models.length > 1 ? `${m.name} (used)` : m.name,
      m.static_gain === null ? "integrates" : figure(m.static_gain, ` ${answer.gain_unit}`),
      m.bandwidth === null
        ? h("abbr", { title: m.bandwidth_note }, "–")
        : shownAs("linear_model.bandwidth", m.bandwidth),
    ]),
  );

const OF_LOOP = /** @type {const} */ (
  [
    "gain_margin",
    "gain_margin_at",
    "phase_margin",
    "crossover",
    "delay_margin",
    "modulus_margin",
    "bandwidth",
  ]
);

/** @param {Margins} m */
export const marginsTable = (m) =>
  table("Loop with the controller of the drive", ["Loop", ""], [
    ["Closed loop", m.stable ? "stable" : "unstable"],
    ...OF_LOOP.map((name) => /** @type {[Head, string]} */ ([
      named(`margins.${name}`),
      shownAs(`margins.${name}`, m[name]),
    ])),
  ]);

/** @type {Record<string, string>} */
export const TRIALS = { own: "own", rule: "by the rule", refined: "refined" };

/** @param {Design} design */
export function trialsTable(design) {
  /** @param {string} key @param {(t: Trial) => number | null} value @returns {[Head, ...string[]]} */
  const row = (key, value) => {
    const { text, title } = named(key), scale = scaleOf(declared(key).quantity, units.value);
    const inUnit = design.trials.map((t) => value(t)).map((si) =>
      figure(si === null ? null : toShown(si, scale))
    );
    return [{ text: `${text} ${scale.unit}`.trim(), title }, ...inUnit];
  };
  return table(`Controllers: steps of ${shownAs("design.step", design.goals.step)}`, [
    "",
    ...design.trials.map((t) => TRIALS[t.name]),
  ], [
    row("controller.kp", (t) => t.controller.kp),
    row("controller.ki", (t) => t.controller.ki),
    row("controller.kd", (t) => t.controller.kd),
    row("controller.feed_forward", (t) => t.controller.feed_forward),
    row("step_design.overshoot", (t) => t.figures.overshoot),
    row("step_design.settling", (t) => t.figures.settling),
    row("step_design.rise", (t) => t.figures.rise),
    row("step_design.saturated", (t) => t.figures.saturated),
    ["Linear loop", ...design.trials.map((t) => t.margins.stable ? "stable" : "unstable")],
    row("margins.gain_margin", (t) => t.margins.gain_margin),
    row("margins.phase_margin", (t) => t.margins.phase_margin),
    ["Meets the goals", ...design.trials.map((t) => t.figures.meets ? "yes" : "no")],
  ]);
}

/** @param {Design} design */
export const robustTable = (design) =>
  table(
    "The refined controller with another mass and supply",
    [
      ...["design.mass", "design.supply", "step_design.overshoot", "step_design.settling"].map(named),
      "Goals",
    ],
    design.robust.map((v) => [
      shownAs("design.mass", v.mass),
      shownAs("design.supply", v.supply),
      shownAs("step_design.overshoot", v.figures.overshoot),
      shownAs("step_design.settling", v.figures.settling),
      v.figures.meets ? "met" : "missed",
    ]),
  );
