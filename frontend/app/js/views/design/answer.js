// @ts-check
// The answer: what the muscle does with the load, in one sentence, with the figures it rests on and their
// definitions. All of it comes from one answer of the server.
import { h, icon } from "../../dom.js";
import { figure } from "../../facts.js";
import { commit, preview, units } from "../../state.js";
import { design, patchDesign } from "../../muscle/document.js";
import { hanging } from "../../muscle/hanging.js";
import { capitalized, parse, scaleOf, withUnit } from "../../format.js";
import { defined } from "../../ui/defined.js";
import { quantityField } from "../../ui/field.js";
import { flag } from "../../ui/flag.js";
import { answeredLoad, curves, fault, geometryValue, messageFor } from "./model.js";

/** @typedef {import("../../types.js").S["Lift"]} Lift */
/** @typedef {Exclude<keyof Lift, "flags">} LiftFigure */

/** Remarks that are no limits of the muscle. */
const NOTES = ["unverified", "outside_measured_range", "stretched"];

/** @type {Record<string, string>} */
const LIMIT_WORDS = { max_pressure: "pressure", max_force: "force", max_contraction: "contraction" };

/** @param {Lift} lift @param {LiftFigure} name */
const text = (lift, name) => withUnit(lift[name], figure(`lift.${name}`).quantity, units.value);

/** A figure in a sentence, with its definition. @param {Lift} lift @param {LiftFigure} name */
const inLine = (lift, name) => h("b", null, defined(figure(`lift.${name}`), text(lift, name)));

/** A large figure; it stays where it is while its value changes. @param {LiftFigure} name
 * @param {LiftFigure} other what stands below it @param {string} said after that
 * @param {import("../../dom.js").Child} [beside] */
function large(name, other, said, beside = null) {
  const one = figure(`lift.${name}`), lift = () => curves.value?.lift;
  return h(
    "div",
    { class: "large" },
    h("div", { class: "large-head" }, defined(one), beside),
    h("b", { class: "num", title: () => lift()?.[name] === null ? one.otherwise : null }, () => {
      const now = lift(), [value, unit = ""] = now ? text(now, name).split("\u00a0") : ["–"];
      return [value, h("small", null, ` ${unit}`)];
    }),
    h("span", { class: "muted" }, () => {
      const now = lift();
      return now && now[other] !== null ? `${text(now, other)} ${said}` : "";
    }),
  );
}

/** What the answer is worth: it holds, at which limit, or why not. @param {Lift} lift */
function states(lift) {
  const held = lift.length !== null, hard = lift.flags.filter(({ code }) => !NOTES.includes(code));
  const grade = !held || hard.length ? "bad" : "good";
  const reached = (curves.value?.limits_used ?? []).filter(({ share }) => share > 0.999 && share < 1.001);
  return [
    h(
      "span",
      { class: `verdict pill ${grade}` },
      icon(grade === "good" ? "check" : "warn"),
      grade === "good" ? "Within all limits" : held ? "Outside the limits" : "Does not hold",
    ),
    ...reached.map(({ name }) =>
      h("span", { class: "verdict pill warn" }, icon("warn"), `${LIMIT_WORDS[name]} at its limit`)
    ),
  ];
}

/** @param {Lift} lift */
function sentence(lift) {
  if (lift.length === null) {
    return h("p", { class: "sentence" }, `${answeredLoad.value} is not held at ${text(lift, "pressure")}.`);
  }
  return h(
    "p",
    { class: "sentence" },
    `${answeredLoad.value} ${design.value.load_as === "mass" ? "rests" : "is held"} at `,
    inLine(lift, "length"),
    lift.lift === null ? "." : [" and is lifted ", inLine(lift, "lift"), "."],
  );
}

/** @param {Lift} lift */
function picture(lift) {
  const c = curves.value;
  if (!c || lift.length === null) return null;
  const width = c.geometry.braid_diameter, system = units.value;
  const filled = {
    length: lift.length,
    width: c.holds?.diameter ?? width,
    below: text(lift, "pressure"),
    filled: true,
  };
  const bare = { length: lift.hanging_length ?? lift.length, width, below: withUnit(0, "pressure", system) };
  return hanging(lift.hanging_length === null ? [filled] : [bare, filled], {
    load: answeredLoad.value,
    rise: text(lift, "lift"),
  });
}

/** The contraction that is asked for: a share of the rest length, or a stroke from it. */
const asked = () =>
  quantityField({
    key: "at_contraction",
    label: "for",
    quantity: "ratio",
    slider: false,
    empty: "off",
    clear: () => {
      preview(patchDesign({ contraction: null }));
      commit("no contraction asked for");
    },
    bounds: () => [0, 0.3],
    scale: () => scaleOf("ratio", units.value),
    get: () => design.value.contraction,
    // A stroke counts from the rest length, as contraction does.
    reads: (typed) => {
      const got = parse(typed, scaleOf("length", units.peek()), "length"),
        length = geometryValue("nominal_length");
      return "value" in got && got.kind === "length" && length ? { value: got.value / length } : null;
    },
    put: (si, done) => {
      preview(patchDesign({ contraction: si }));
      if (done) commit(`pressure for ${withUnit(si, "ratio", units.peek())}`);
    },
    message: () => messageFor("at_contraction"),
  });

/** The used share of each limit as a bar, full at the limit. */
export function margins() {
  const used = curves.value?.limits_used ?? [];
  if (curves.value && !used.length) return null; // the muscle has no known limit
  return h(
    "div",
    { class: "margins" },
    ...used.map(({ name, used, limit, share }) => {
      const one = figure(`muscle_limits.${name}`);
      return h(
        "div",
        { class: share > 1.0001 ? "over" : "" },
        defined(one, capitalized(LIMIT_WORDS[name])),
        h("span", { class: "bar" }, h("i", { style: `width:${Math.min(100, share * 100)}%` })),
        h(
          "span",
          { class: "num" },
          `${withUnit(used, one.quantity, units.value)} of ${withUnit(limit, one.quantity, units.value)}`,
        ),
      );
    }),
  );
}

export function answerCard() {
  const head = () => {
    const lift = curves.value?.lift;
    return lift
      ? [h("div", { class: "states" }, states(lift)), sentence(lift)]
      : h("p", { class: "muted" }, fault.value ? "No valid model yet." : "Waiting for curves…");
  };
  return h(
    "section",
    { class: "card answer-card", "aria-label": "Answer" },
    h("div", { class: "answer-head", "aria-live": "polite" }, head),
    h(
      "div",
      { class: "answer-body" },
      h("div", { class: "drawing" }, () => curves.value?.lift ? picture(curves.value.lift) : null),
      h(
        "div",
        { class: "larges" },
        large("contraction", "contraction_vented", "after venting"),
        large("stiffness", "stiffness_closed", "valve closed"),
        large("pressure_filling", "pressure_venting", "while venting", asked()),
      ),
    ),
  );
}

/** Remarks on the answer and on the model, limits or others. @param {boolean} limits */
function remarks(limits) {
  const c = curves.value, all = [...(c?.lift?.flags ?? []), ...(c?.flags ?? [])];
  return all.filter((f, i) =>
    NOTES.includes(f.code) !== limits && all.findIndex((g) => g.message === f.message) === i
  );
}

export const crossedLimits = () =>
  h("div", { class: "verdicts" }, ...remarks(true).map((f) => flag(f, false)));

export function modelRemarks() {
  const notes = remarks(false);
  return notes.length
    ? h(
      "details",
      { class: "notes" },
      h("summary", null, notes.length === 1 ? "1 remark" : `${notes.length} remarks`),
      ...notes.map((f) => flag(f, true)),
    )
    : null;
}
