// @ts-check
// Fields of the study: quantities of any unit, counts, choices from long lists.
import { h } from "../../dom.js";
import { computed } from "../../reactive.js";
import { units } from "../../state.js";
import { quantityField } from "../../ui/field.js";
import { groupOf, kindOf, ofDifference, scaleFor, titleOf } from "./words.js";

/** A number with the unit of a column.
 * @param {{key: string, label: string, path: string, unit: string | null, get: () => number | null,
 *   put: (si: number) => void, clear?: () => void, difference?: boolean, empty?: string}} o */
export const columnField = ({ path, unit, difference, put, ...o }) =>
  quantityField({
    ...o,
    quantity: kindOf(path, unit),
    scale: () => {
      const scale = scaleFor(path, unit, units.value);
      return difference ? ofDifference(scale) : scale;
    },
    put: (si) => put(si),
    slider: false,
  });

/** A whole number. @param {{label: string, get: () => number, put: (n: number) => void, least: number,
 *   most: number, key: string}} o */
export function countField({ label, get, put, least, most, key }) {
  const input = h("input", {
    type: "text",
    inputmode: "numeric",
    autocomplete: "off",
    id: `study-${key}`,
    title: `A whole number, ${least} to ${most}`,
    value: () => String(get()),
    onchange: () => {
      const n = Math.round(Number(input.value));
      if (Number.isFinite(n)) put(Math.min(most, Math.max(least, n)));
      input.value = String(get());
    },
  });
  return h(
    "div",
    { class: "field", "data-field": key },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: `study-${key}` }, label),
      h("span", { class: "entry" }, input),
    ),
  );
}

/** A list to add one entry from, in groups.
 * @param {{label: string, paths: () => string[], add: (path: string) => void, id: string}} o */
export function addList({ label, paths, add, id }) {
  const groups = computed(() => {
    /** @type {Map<string, string[]>} */
    const found = new Map();
    for (const path of paths()) found.set(groupOf(path), [...found.get(groupOf(path)) ?? [], path]);
    return [...found];
  });
  const list = h(
    "select",
    {
      id,
      class: "add",
      "aria-label": label,
      onchange: () => {
        const { value } = list;
        list.value = "";
        if (value) add(value);
      },
    },
    h("option", { value: "" }, `${label}…`),
    () =>
      groups.value.map(([name, all]) =>
        h("optgroup", { label: name }, ...all.map((path) => h("option", { value: path }, titleOf(path))))
      ),
  );
  return list;
}
