// @ts-check
// The muscle side of the Design view: fields, answer, plots, effects, tables.
import { h } from "../../dom.js";
import { computed } from "../../reactive.js";
import { edit } from "../../state.js";
import { presets } from "../../store.js";
import { answerCard, crossedLimits, margins, modelRemarks } from "./answer.js";
import { chartColumn } from "./charts.js";
import { designEffects } from "./effects.js";
import { errorPart, pointsUsed, saveButton } from "./errors.js";
import { exampleNote, openExample } from "./examples.js";
import { curvesAreCurrent, fault, FORM_KEYS, messageFor, startModel } from "./model.js";
import { muscleCard, muscleFields } from "./muscle.js";
import { askedFields, operationCard } from "./operation.js";
import { tables } from "./tables.js";

export { askLine, muscleWords } from "./ask.js";

/** Whether a field that is folded away has something to say. */
const isWrongBelow = computed(() =>
  [
    ...Object.values(FORM_KEYS).flat(),
    "inside_diameter",
    "wall_thickness",
    "pressures",
    "temperature",
    "dead_volume",
    "fixed_length",
  ].some((key) => messageFor(key))
);

/** Puts what a typed line states into the fields. @param {import("../../types.js").S["AskedLine"]} line */
export function takeAsked({ muscle, nominal_length, pressure, load, mass, contraction, stroke }) {
  edit((d) => {
    const { design } = d, other = muscle !== null && muscle !== design.muscle.preset;
    const values = other ? {} : { ...design.muscle.values };
    const length = nominal_length ?? design.muscle.values.nominal_length;
    if (length !== undefined) values.nominal_length = length;
    const asked = contraction ?? (stroke !== null && length ? stroke / length : null);
    return {
      ...d,
      design: {
        ...design,
        muscle: other ? { preset: muscle, form: "braid", values } : { ...design.muscle, values },
        ...(other ? { effects: null, reference: "auto" } : {}),
        ...(pressure === null ? {} : { pressure }),
        ...(load === null ? {} : { load, load_as: mass === null ? "force" : "mass" }),
        ...(asked === null ? {} : { contraction: asked }),
      },
    };
  }, "asked");
}

export function designView() {
  const isStale = () => fault.value || !curvesAreCurrent.value ? " stale" : "";
  const view = h(
    "div",
    { class: "design" },
    h(
      "div",
      { class: "fields" },
      // Load and pressure come first: they are what is changed most.
      askedFields(),
      muscleFields(),
      h(
        "details",
        { class: "all-inputs", open: () => isWrongBelow.value },
        h("summary", null, "Geometry, curves, conditions"),
        h("div", { class: "two" }, muscleCard(), operationCard()),
        h("div", { class: "foot" }, saveButton()),
      ),
    ),
    h(
      "div",
      { class: () => `column results${isStale()}` },
      answerCard(),
      h(
        "section",
        { class: "card sureness", "aria-label": "Limits and error" },
        margins,
        crossedLimits,
        ...errorPart(),
        h(
          "div",
          { class: "folds" },
          pointsUsed,
          modelRemarks,
          exampleNote,
        ),
      ),
    ),
    chartColumn(),
    designEffects(),
    tables(),
  );
  startModel();
  return view;
}

/** @returns {import("../../ui/menu.js").Item[]} */
export const designExports = () => [
  {
    label: "Take it along…",
    note: "code, tables, equations of this muscle",
    run: async () => (await import("./exports.js")).takeAlong(),
  },
  {
    label: "Curves as CSV",
    note: "all values, shown units",
    run: async () => (await import("./exports.js")).saveCsv(),
  },
  {
    label: "Plots as PNG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("png"),
  },
  {
    label: "Plots as SVG",
    note: "one sheet",
    run: async () => (await import("./exports.js")).savePlots("svg"),
  },
];

/** The example designs of the server. @returns {import("../../ui/menu.js").Item[]} */
export function designExamples() {
  const designs = presets.peek().designs ?? [];
  if (!designs.length) return [{ heading: "No example documents on this server" }];
  return designs.map((d) => ({
    label: d.title,
    note: d.description,
    run: () => openExample(d),
  }));
}
