// @ts-check
// The inputs of a study: subject, varied quantities, figures to watch, method.
import { h, icon } from "../../dom.js";
import { doc, units } from "../../state.js";
import { USUAL, watched } from "../../drive/study.js";
import { addList, columnField } from "./fields.js";
import { methodCard } from "./method.js";
import {
  addQuantity,
  cancel,
  editFigure,
  editStudy,
  figureOptions,
  messageWithin,
  optionsFault,
  plannedText,
  quantityOptions,
  run,
  spreadText,
  stage,
  study,
} from "./model.js";
import { formsText, quantityRow } from "./varied.js";
import { scaleFor, titleOf, withUnitOf } from "./words.js";

/** @typedef {import("../../types.js").Study} Study */

/** @type {[Study["subject"], string][]} */
const SUBJECTS = [
  ["drive", "The drive of Transient"],
  ["task", "The task of Design"],
  ["model", "The model of the open case"],
];

export const runButton = () =>
  h(
    "button",
    {
      type: "button",
      class: () => `block${stage.value === "running" ? "" : " primary"}`,
      disabled: () => stage.value !== "running" && !study.value.quantities.length,
      onclick: () => stage.peek() === "running" ? cancel() : run(),
    },
    () => stage.value === "running" ? "Cancel the study" : `Run ${plannedText.value || "the study"}`,
  );

/** @param {Study["subject"]} subject */
function chooseSubject(subject) {
  const now = study.peek(), isTask = (/** @type {string} */ s) => s === "task";
  if (isTask(subject) === isTask(now.subject)) return editStudy({ subject }, "subject of the study");
  editStudy(
    { subject, quantities: [], figures: USUAL[subject].map(watched), assumed: false },
    "subject of the study",
  );
}

const subjectCard = () =>
  h(
    "section",
    { class: "card study-head", "aria-label": "Study" },
    h("div", { class: "card-head" }, h("h2", null, "Study")),
    h("label", { for: "study-subject", class: "label" }, "Of"),
    h("select", {
      id: "study-subject",
      onchange: (/** @type {Event} */ e) =>
        chooseSubject(/** @type {Study["subject"]} */ (/** @type {HTMLSelectElement} */ (e.target).value)),
    }, () =>
      SUBJECTS.map(([id, title]) =>
        h("option", {
          value: id,
          selected: study.value.subject === id,
          disabled: id === "model" && !doc.value.compare.files.length && study.value.subject !== id,
        }, title)
      )),
    () =>
      study.value.subject === "model"
        ? h("p", { class: "hint" }, "Muscle and effects of the case, in the drive of Transient.")
        : null,
    () => {
      const error = optionsFault.value ?? null;
      return error ? h("p", { class: "error", role: "alert" }, error.words) : null;
    },
    runButton(),
  );

const quantitiesCard = (/** @type {import("../../reactive.js").Signal<string>} */ forms) =>
  h(
    "section",
    { class: "card", "aria-label": "Quantities" },
    h("div", { class: "card-head" }, h("h2", null, "What varies")),
    () =>
      study.value.assumed
        ? h(
          "p",
          { class: "hint" },
          `Assumed: ${spreadText} of the present value. Enter what your parts have.`,
        )
        : null,
    () => {
      forms.value;
      return study.peek().quantities.map(quantityRow);
    },
    addList({
      id: "study-add-quantity",
      label: "Add a quantity",
      paths: () => [...quantityOptions.value.keys()],
      add: addQuantity,
    }),
    h(
      "p",
      { class: "error" },
      () => messageWithin("quantities") && !study.value.quantities.length ? messageWithin("quantities") : "",
    ),
  );

/** @param {import("../../types.js").Watched} start @param {number} place */
function figureRow(start, place) {
  const { path } = start, title = titleOf(path), unit = figureOptions.value.get(path)?.unit ?? null;
  const now = () => study.value.figures[place] ?? start;
  /** @param {"at_least" | "at_most"} name @param {string} label */
  const limit = (name, label) =>
    columnField({
      key: `figures.${place}.${name}`,
      label,
      path,
      unit,
      empty: "no limit",
      get: () => now()[name],
      put: (si) => editFigure(place, { [name]: si }, `${title}, ${label.toLowerCase()}`),
      clear: () => editFigure(place, { [name]: null }, `${title}, ${label.toLowerCase()}`),
    });
  const summary = () => {
    const f = now(), scale = scaleFor(path, unit, units.value);
    return [
      f.goal,
      f.at_least === null ? null : `≥ ${withUnitOf(f.at_least, scale)}`,
      f.at_most === null ? null : `≤ ${withUnitOf(f.at_most, scale)}`,
    ].filter(Boolean).join(", ");
  };
  return h(
    "div",
    { class: "watched" },
    h(
      "details",
      { open: start.goal !== null || start.at_least !== null || start.at_most !== null },
      h("summary", null, h("b", null, title), h("small", null, summary)),
      h(
        "div",
        { class: "field-head" },
        h("label", { for: `goal-${place}` }, "Goal"),
        h(
          "select",
          {
            class: "small",
            id: `goal-${place}`,
            onchange: (/** @type {Event} */ e) =>
              editFigure(
                place,
                { goal: /** @type {any} */ (/** @type {HTMLSelectElement} */ (e.target).value || null) },
                `${title}, goal`,
              ),
          },
          ...[["", "none"], ["minimise", "minimise"], ["maximise", "maximise"]].map(([id, name]) =>
            h("option", { value: id, selected: () => (now().goal ?? "") === id }, name)
          ),
        ),
      ),
      limit("at_least", "At least"),
      limit("at_most", "At most"),
    ),
    h("button", {
      type: "button",
      class: "mini",
      "aria-label": `Remove ${title}`,
      onclick: () =>
        editStudy({ figures: study.peek().figures.filter((_, i) => i !== place) }, `remove ${title}`),
    }, icon("close")),
  );
}

const figuresText = () =>
  JSON.stringify(study.value.figures.map((f) => [f.path, figureOptions.value.get(f.path)?.unit]));

const figuresCard = (/** @type {import("../../reactive.js").Signal<string>} */ forms) =>
  h(
    "section",
    { class: "card", "aria-label": "Figures", "data-field": "figures" },
    h("div", { class: "card-head" }, h("h2", null, "What is watched")),
    h("p", { class: "hint" }, "Open a figure to give it a goal or limits."),
    () => {
      forms.value;
      return study.peek().figures.map(figureRow);
    },
    addList({
      id: "study-add-figure",
      label: "Add a figure",
      paths: () =>
        [...figureOptions.value.keys()].filter((path) => !study.value.figures.some((f) => f.path === path)),
      add: (path) =>
        editStudy({ figures: [...study.peek().figures, watched(path)] }, `watch ${titleOf(path)}`),
    }),
    h("p", { class: "error" }, () =>
      messageWithin("figures") ?? messageWithin("goals") ?? messageWithin("limits") ?? ""),
  );

/** @param {(text: () => string) => import("../../reactive.js").Signal<string>} computed */
export const inputCards = (computed) => [
  subjectCard(),
  quantitiesCard(computed(formsText)),
  figuresCard(computed(figuresText)),
  methodCard(computed(() => study.value.method.type)),
];
