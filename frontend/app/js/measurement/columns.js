// @ts-check
// What each column of a file is: quantity, unit, who says so; and how pressure, stroke and force count.
import { h, icon } from "../dom.js";
import { brief, quantityOf, readable, scaleOf, toShown } from "../format.js";
import { units } from "../state.js";
import { channelOf, choiceOf, withColumns } from "./choices.js";
import { segments } from "../ui/segments.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Column} Column */
/** @typedef {import("./types.js").Choice} Choice */
/** @typedef {import("./model.js").Model} Model */

/** @param {Event} event */
export const valueOf = (event) => /** @type {HTMLSelectElement | HTMLInputElement} */ (event.target).value;

/** @param {Model} m @param {Column} column @param {Choice | null} choice */
const set = (m, column, choice) => m.change((mapping) => withColumns(mapping, { [column.header]: choice }));

/** @param {Model} m @param {Column} column */
export function quantitySelect(m, column) {
  const names = m.preview.value.channel_choices.map((one) => one.name);
  const all = column.channel && !names.includes(column.channel) ? [...names, column.channel] : names;
  return h(
    "select",
    {
      "aria-label": `Quantity of ${column.header}`,
      "data-key": `quantity ${column.header}`,
      class: column.channel ? "" : "unused",
      onchange: (/** @type {Event} */ e) => set(m, column, valueOf(e) ? { channel: valueOf(e) } : null),
    },
    h("option", { value: "", selected: !column.channel }, "not used"),
    ...all.map((name) => h("option", { value: name, selected: name === column.channel }, readable(name))),
  );
}

/** @param {Model} m @param {Column} column */
export function unitSelect(m, column) {
  const choice = channelOf(m.preview.value, column.channel);
  if (!choice || column.unit_origin === null) return null;
  const { unit } = column;
  const list = unit && !choice.units.includes(unit) ? [unit, ...choice.units] : choice.units;
  return h(
    "select",
    {
      "aria-label": `Unit of ${column.header}`,
      "data-key": `unit ${column.header}`,
      class: "unit-of",
      onchange: (/** @type {Event} */ e) => set(m, column, { ...choiceOf(column), unit: valueOf(e) }),
    },
    unit ? null : h("option", { value: "", selected: true }, "unit?"),
    ...list.map((one) =>
      h("option", { value: one, selected: one === unit }, one === "1" ? "1 (plain)" : one)
    ),
  );
}

/** Who says the unit of a column and what is wrong with it; on hover all that says what the column is.
 * @param {Column} column */
export function stateOf(column) {
  const state = stateWords(column);
  if (column.evidence.length) state.title = column.evidence.join("\n");
  return state;
}

/** @param {Column} column */
function stateWords(column) {
  if (column.why) return h("span", { class: "state bad" }, column.why);
  if (!column.channel) return h("span", { class: "state" }, "not read");
  if (column.unit_origin === "proposed") {
    return h("span", { class: "state proposed" }, icon("warn"), `${column.unit} is proposed`);
  }
  if (column.unit_origin === "assumed") {
    return h("span", { class: "state proposed" }, icon("warn"), `${column.unit} is assumed`);
  }
  if (column.unit_origin === "you") return h("span", { class: "state" }, "unit from you");
  const where = column.unit_where ? `unit from ${column.unit_where}` : "unit from the file";
  return column.unit_origin === null
    ? h("span", { class: "state" }, "without a unit")
    : h("span", { class: "state good" }, icon("check"), where);
}

/** The range of a column in shown units. @param {Preview} p @param {Column} column */
export function rangeOf(p, column) {
  if (column.minimum === null || column.maximum === null) return "";
  const quantity = quantityOf(channelOf(p, column.channel)?.si_unit ?? "");
  const share = column.channel === "contraction" ? "ratio" : null;
  const s = quantity && quantity !== "number"
    ? scaleOf(quantity, units.value)
    : share && scaleOf(share, units.value);
  const text = (/** @type {number} */ si) => brief(s ? toShown(si, s) : si);
  return `${text(column.minimum)} … ${text(column.maximum)}${s ? ` ${s.unit}` : ""}`;
}

const FIRST = 4;

/** The first values of a column as they are written. @param {Preview} p @param {Column} column */
function firstCells(p, column) {
  const { raw } = p, { place } = column, i = p.columns.indexOf(column);
  const cells = raw && place !== null
    ? raw.rows.filter(({ row }) => row > Math.max(raw.head ?? 0, raw.units ?? 0)).map((one) =>
      one.cells[place]
    )
    : p.sample.map((row) => row[i]);
  return cells.slice(0, FIRST).filter(Boolean);
}

/** Columns one below the other: on a phone, and those that stand in no column of the file.
 * @param {Model} m @param {Column[]} list */
export function columnList(m, list) {
  const p = m.preview.value;
  return h(
    "ol",
    { class: "plain column-list" },
    ...list.map((column) => {
      const first = firstCells(p, column);
      return h(
        "li",
        { "data-column": column.header },
        h("b", null, column.header),
        h("div", { class: "column-choice" }, quantitySelect(m, column), unitSelect(m, column)),
        h("p", { class: "sample" }, first.length ? `${first.join(" · ")} …` : "empty"),
        h("p", null, stateOf(column), " ", h("small", null, rangeOf(p, column))),
      );
    }),
  );
}

/** @param {string} label @param {[string, boolean, () => void][]} options @param {import("../dom.js").Child} note */
const choiceRow = (label, options, note) =>
  h(
    "div",
    { class: "counting" },
    h("span", { "aria-hidden": "true" }, label),
    segments(
      label,
      options.map(([text]) => [text, text]),
      () => options.find(([, checked]) => checked)?.[0] ?? null,
      (text) => options.find(([each]) => each === text)?.[2](),
    ),
    note,
  );

/** What a pressure counts from and which way stroke and force count. @param {Model} m */
export function countingRows(m) {
  return m.preview.value.columns.flatMap((column) => {
    const now = choiceOf(column);
    const turn = (/** @type {boolean} */ turned) => () => {
      const { sign: _, ...plain } = now;
      set(m, column, turned ? { ...plain, sign: -1 } : { ...plain, sign: 1 });
    };
    const signed = (/** @type {string} */ label, /** @type {[string, string]} */ [plain, turned]) =>
      choiceRow(label, [
        [plain, column.sign > 0, turn(false)],
        [turned, column.sign < 0, turn(true)],
      ], column.sign < 0 ? h("small", null, "sign reversed when read") : null);
    if (column.channel === "pressure") {
      const { absolute } = column;
      return [
        choiceRow("Pressure is", [
          ["gauge", !absolute, () => set(m, column, { ...now, absolute: false })],
          ["absolute", absolute === true, () => set(m, column, { ...now, absolute: true })],
        ], absolute === null ? h("span", { class: "origin assumed" }, "gauge is assumed") : null),
      ];
    }
    if (column.channel === "displacement") {
      return [signed("Stroke grows when the muscle", ["shortens", "lengthens"])];
    }
    if (column.channel === "contraction") {
      return [signed("Contraction grows when the muscle", ["shortens", "lengthens"])];
    }
    if (column.channel === "force") {
      return [signed("Force is positive when the muscle", ["pulls", "pushes"])];
    }
    return [];
  });
}
