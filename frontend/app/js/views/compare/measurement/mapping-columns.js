// @ts-check
// The columns of a file: channel, unit and first values of each.
import { h } from "../../../dom.js";
import { signal } from "../../../reactive.js";
import { brief, readable } from "../../../format.js";

/** @typedef {import("../types.js").Preview} Preview */
/** @typedef {import("../types.js").PreviewColumn} PreviewColumn */
/** @typedef {import("../types.js").Mapping} Mapping */
/** @typedef {{preview: import("../../../reactive.js").Signal<Preview>,
 *   mapping: import("../../../reactive.js").Signal<Mapping>,
 *   change: (patch: Mapping) => void}} Context */

const SAMPLE_ROWS = 5;

/** @param {Event} event */
export const valueOf = (event) => /** @type {HTMLSelectElement | HTMLInputElement} */ (event.target).value;

// Columns are side by side, but one below the other on a phone.
const phone = matchMedia("(max-width: 700px)");
const isPhone = signal(phone.matches);
phone.addEventListener("change", () => (isPhone.value = phone.matches));

/** @param {Context} c */
export function columnTable({ preview, mapping, change }) {
  const p = preview.value;
  /** @param {PreviewColumn} column @param {any} choice */
  const set = (column, choice) => change({ columns: { ...mapping.peek().columns, [column.header]: choice } });
  const names = p.channel_choices.map((one) => one.name);
  return isPhone.value ? stacked(p, names, set) : sideBySide(p, names, set);
}

/** @param {Preview} p @param {string[]} names
 * @param {(column: PreviewColumn, choice: object | null) => void} set */
const stacked = (p, names, set) =>
  h(
    "ol",
    { class: "plain map-list" },
    ...p.columns.map((column, i) => {
      const first = p.sample.slice(0, SAMPLE_ROWS).map((row) => row[i] ?? "");
      return h(
        "li",
        null,
        h("h3", null, column.header),
        h(
          "div",
          { class: "map-choice" },
          h("div", null, channelSelect(column, names, set)),
          h("div", null, unitSelect(column, p, set)),
        ),
        h("p", { class: "sample" }, `${first.filter((v) => v !== "").join(" · ") || "empty"} …`),
        h("p", { class: "range" }, h("small", null, rangeText(column, p))),
      );
    }),
  );

/** @param {Preview} p @param {string[]} names
 * @param {(column: PreviewColumn, choice: object | null) => void} set */
function sideBySide(p, names, set) {
  const row = (/** @type {number} */ k) => p.sample[k] ?? [];
  return h(
    "table",
    { class: "data" },
    h("caption", { class: "unseen" }, "What each column is, and the first rows"),
    h(
      "thead",
      null,
      h(
        "tr",
        null,
        ...p.columns.map((column) => h("th", { scope: "col", class: "text" }, column.header)),
      ),
    ),
    h(
      "tbody",
      null,
      h(
        "tr",
        null,
        ...p.columns.map((column) => h("td", { class: "text" }, channelSelect(column, names, set))),
      ),
      h(
        "tr",
        null,
        ...p.columns.map((column) => h("td", { class: "text" }, unitSelect(column, p, set))),
      ),
      ...Array.from(
        { length: Math.min(SAMPLE_ROWS, p.sample.length) },
        (_, k) =>
          h("tr", { class: "sample" }, ...p.columns.map((_column, i) => h("td", null, row(k)[i] ?? ""))),
      ),
      h(
        "tr",
        { class: "range" },
        ...p.columns.map((column) => h("td", null, h("small", null, rangeText(column, p)))),
      ),
    ),
  );
}

/** @param {PreviewColumn} column @param {Preview} p */
function rangeText(column, p) {
  if (column.why) return h("span", { class: "error" }, column.why);
  if (column.minimum === null || column.maximum === null) return "";
  const si = p.channel_choices.find((one) => one.name === column.channel)?.si_unit ?? "";
  return `${brief(column.minimum)} … ${brief(column.maximum)} ${si === "1" ? "" : si}`;
}

/** @param {PreviewColumn} column @param {string[]} names
 * @param {(column: PreviewColumn, choice: object | null) => void} set */
function channelSelect(column, names, set) {
  const all = column.channel && !names.includes(column.channel) ? [...names, column.channel] : names;
  return h(
    "select",
    {
      "aria-label": `Channel of ${column.header}`,
      onchange: (/** @type {Event} */ e) => set(column, valueOf(e) ? { channel: valueOf(e) } : null),
    },
    h("option", { value: "", selected: !column.channel }, "not used"),
    ...all.map((name) => h("option", { value: name, selected: name === column.channel }, readable(name))),
  );
}

/** @param {PreviewColumn} column @param {Preview} p
 * @param {(column: PreviewColumn, choice: object | null) => void} set */
function unitSelect(column, p, set) {
  const choice = p.channel_choices.find((one) => one.name === column.channel);
  if (!column.channel || !choice) return "";
  const { unit } = column;
  const units = unit && !choice.units.includes(unit) ? [unit, ...choice.units] : choice.units;
  const { absolute } = column;
  const keep = {
    channel: column.channel,
    ...(unit ? { unit } : {}),
    ...(absolute === null ? {} : { absolute }),
  };
  return [
    h(
      "select",
      {
        "aria-label": `Unit of ${column.header}`,
        onchange: (/** @type {Event} */ e) => set(column, { ...keep, unit: valueOf(e) }),
      },
      unit ? null : h("option", { value: "", selected: true }, "unit?"),
      ...units.map((one) =>
        h("option", { value: one, selected: one === unit }, one === "1" ? "1 (plain)" : one)
      ),
    ),
    column.unit_given ? null : h("small", { class: "guess" }, " guessed"),
    choice.si_unit === "Pa"
      ? h(
        "label",
        { class: "check" },
        h("input", {
          type: "checkbox",
          checked: absolute === true,
          onchange: (/** @type {Event} */ e) =>
            set(column, { ...keep, absolute: /** @type {HTMLInputElement} */ (e.target).checked }),
        }),
        h("small", null, "absolute"),
      )
      : null,
  ];
}
