// @ts-check
// The rows of what varies: for each quantity a form, and the fields of that form.
import { h, icon } from "../../dom.js";
import { toShown, toSi } from "../../format.js";
import { units } from "../../state.js";
import { columnField, countField } from "./fields.js";
import { FORM_NAMES, formsOf, inForm } from "./forms.js";
import { editQuantity, editStudy, messageWithin, quantityOptions, study } from "./model.js";
import { scaleFor, titleOf, withUnitOf } from "./words.js";

/** @typedef {import("../../types.js").Varied} Varied */

const MOST_POINTS = 1000;
/** @type {Record<Varied["form"], [("from" | "to" | "mean" | "deviation"), string][]>} */
const FIELDS = {
  range: [["from", "From"], ["to", "To"]],
  logarithmic: [["from", "From"], ["to", "To"]],
  values: [],
  uniform: [["from", "From"], ["to", "To"]],
  triangular: [["from", "From"], ["mean", "Most probable"], ["to", "To"]],
  normal: [["mean", "Mean"], ["deviation", "Standard deviation"]],
  lognormal: [["mean", "Median"]],
};

/** Numbers in the unit on screen, separated by commas or spaces.
 * @param {{place: number, title: string, path: string, unit: string | null, now: () => Varied}} o */
function listField({ place, title, path, unit, now }) {
  const scale = () => scaleFor(path, unit, units.value), id = `study-values-${place}`;
  const shown = () => now().values.map((v) => String(Number(toShown(v, scale()).toPrecision(9)))).join(", ");
  const input = h("input", {
    type: "text",
    id,
    autocomplete: "off",
    value: shown,
    onchange: () => {
      const texts = input.value.split(/[;,\s]+/).filter(Boolean).map(Number);
      if (texts.length && texts.every(Number.isFinite)) {
        editQuantity(place, { values: texts.map((x) => toSi(x, scale())) }, `${title}, values`);
      }
      input.value = shown();
    },
  });
  return h(
    "div",
    { class: "list-field", "data-field": `quantities.${place}.values` },
    h("label", { for: id }, () => `Values${scale().unit ? ` (${scale().unit})` : ""}`),
    input,
  );
}

/** @param {Varied} start @param {number} place */
export function quantityRow(start, place) {
  const { path, form } = start, title = titleOf(path), method = study.peek().method.type;
  const now = () => study.value.quantities[place] ?? start;
  const option = quantityOptions.value.get(path), unit = option?.unit ?? null;
  /** @param {"from" | "to" | "mean" | "deviation" | "log_deviation" | "least" | "most"} name
   * @param {string} label */
  const field = (name, label) =>
    columnField({
      key: `quantities.${place}.${name}`,
      label,
      path: name === "log_deviation" ? name : path,
      unit: name === "log_deviation" ? "1" : unit,
      difference: name === "deviation",
      get: () => now()[name],
      put: (si) => editQuantity(place, { [name]: si }, `${title}, ${label.toLowerCase()}`),
      ...(name === "least" || name === "most"
        ? {
          empty: "no bound",
          clear: () => editQuantity(place, { [name]: null }, `${title}, ${label.toLowerCase()}`),
        }
        : {}),
    });
  const present = () =>
    !option
      ? quantityOptions.value.size ? `${path}: the subject has no such quantity` : path
      : option.value === null
      ? path
      : `now ${withUnitOf(option.value, scaleFor(path, unit, units.value))}`;
  const isRange = form === "range" || form === "logarithmic";
  return h(
    "div",
    { class: "varied", role: "group", "aria-label": title, "data-field": `quantities.${place}` },
    h(
      "div",
      { class: "varied-head" },
      h("div", null, h("b", null, title), h("small", null, present)),
      h("button", {
        type: "button",
        class: "mini",
        "aria-label": `Remove ${title}`,
        onclick: () =>
          editStudy({ quantities: study.peek().quantities.filter((_, i) => i !== place) }, `remove ${title}`),
      }, icon("close")),
    ),
    h(
      "select",
      {
        class: "small",
        "aria-label": `${title}: how it varies`,
        onchange: (/** @type {Event} */ e) => {
          const wanted = /** @type {Varied["form"]} */ (/** @type {HTMLSelectElement} */ (e.target).value);
          editQuantity(place, inForm(now(), wanted), `${title}, distribution`);
        },
      },
      ...formsOf(method).map((id) => h("option", { value: id, selected: id === form }, FORM_NAMES[id])),
    ),
    ...FIELDS[form].map(([name, label]) => field(name, label)),
    form === "values" ? listField({ place, title, path, unit, now }) : null,
    form === "lognormal" ? field("log_deviation", "Spread of the logarithm") : null,
    form === "normal" || form === "lognormal"
      ? h(
        "details",
        { class: "bounds", open: start.least !== null || start.most !== null },
        h("summary", null, "Cut off"),
        field("least", "Never below"),
        field("most", "Never above"),
      )
      : null,
    isRange && ["grid", "robust"].includes(method)
      ? countField({
        key: `quantities.${place}.points`,
        label: "Points",
        get: () => now().points,
        put: (points) => editQuantity(place, { points }, `${title}, points`),
        least: 2,
        most: MOST_POINTS,
      })
      : null,
    h("p", { class: "error" }, () => messageWithin(`quantities.${place}`) ?? ""),
  );
}

/** What the rows are made of; a change of a number alone leaves the fields in place. */
export const formsText = () =>
  JSON.stringify([
    study.value.quantities.map((q) => [q.path, q.form]),
    study.value.method.type,
    [...quantityOptions.value.values()].filter((o) => study.value.quantities.some((q) => q.path === o.path)),
  ]);
