// @ts-check
// The pulley of an antagonist pair: plots, values at the cursor, card.
import { h } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief, scaleOf, toShown, withUnit } from "../../../format.js";
import { run, timeWindow } from "../model.js";
import { overTime, pinLines } from "./specs.js";

/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {NonNullable<Run["joint"]>} Joint */
/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../plots/theme.js").Palette} Palette */
/** @typedef {import("./specs.js").View} View */
/** @typedef {"angle" | "torque" | "stiffness"} Column */

/** @type {Record<Column, {title: string, quantity: Quantity}>} */
export const JOINT = /** @type {Record<Column, {title: string, quantity: Quantity}>} */ (Object.fromEntries(
  ["angle", "torque", "stiffness"].map((key) => {
    const { label, quantity } = figure(`joint.${key}`);
    return [key, { title: label, quantity }];
  }),
));

/** The set point of a column, where it is controlled. @param {View} v @param {Palette} p @param {Column} key
 * @returns {import("./specs.js").Line[]} */
function setPoint(v, p, key) {
  const values = key === "torque" ? null : v.run.joint?.[`${key}_reference`];
  return values
    ? [{ id: "reference", name: "set point", values, color: p.soft, dash: "dash", width: 1.5 }]
    : [];
}

/** @param {Column} key */
const spec = (key) => (/** @type {View} */ v, /** @type {Palette} */ p) =>
  overTime(v, p, {
    key: `joint ${key}`,
    quantity: JOINT[key].quantity,
    title: JOINT[key].title.replace(/^Joint s/, "S"),
    lines: [
      ...pinLines(v, p, (r) => r.joint?.[key] ?? null),
      ...setPoint(v, p, key),
      { id: key, name: JOINT[key].title.toLowerCase(), values: v.run.joint?.[key] ?? [], color: p.accent },
    ],
    zero: true,
  });

export const angleSpec = spec("angle");
export const torqueSpec = spec("torque");
export const stiffnessSpec = spec("stiffness");

/** @param {Joint} joint
 * @param {(name: string, values: (number | null)[], q: Quantity) => HTMLElement} cell */
export const jointCells = (joint, cell) => [
  cell("φ", joint.angle, "angle"),
  cell("M", joint.torque, "torque"),
  cell("k", joint.stiffness, "rotary"),
  ...(joint.counter_diameter ? [cell("Ø2", joint.counter_diameter, "length")] : []),
];

/** The value of a column with the largest magnitude; null without a joint. @param {Run} r @param {Column} key */
export function greatestOf(r, key) {
  const [low, high] = r.joint?.[`${key}_range`] ?? [null, null];
  return low === null || high === null ? null : Math.abs(high) >= Math.abs(low) ? high : low;
}

/** Smallest and largest values in the time shown. */
export function jointCard() {
  const r = run.value;
  if (!r?.joint) return null;
  const { joint } = r;
  const of = joint.counter_pressure
    ? " The plotted air flow is that of the first muscle; the air in the table of both."
    : "";
  return h(
    "section",
    { class: "card", "aria-label": "Joint" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Joint"),
      timeWindow.value ? h("span", { class: "muted" }, "in the window") : null,
    ),
    h(
      "dl",
      null,
      .../** @type {Column[]} */ (Object.keys(JOINT)).flatMap((key) => {
        const { title, quantity } = JOINT[key], s = scaleOf(quantity, units.value);
        const [low, high] = joint[`${key}_range`].map((si) => si === null ? "–" : brief(toShown(si, s)));
        return [h("dt", null, title), h("dd", null, `${low} to ${high} ${s.unit}`)];
      }),
    ),
    h(
      "p",
      { class: "hint" },
      joint.stiffness_error == null
        ? `Stiffness at constant pressures.${of}`
        : `Stiffness at constant pressures; it misses its set point by ${
          withUnit(joint.stiffness_error, "rotary", units.value)
        } rms.${of}`,
    ),
  );
}
