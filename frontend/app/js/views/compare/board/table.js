// @ts-check
// The table of the open board: a column for each model, a row for each error, value and effect.
import { h, icon } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { computed, effect, signal } from "../../../reactive.js";
import { downloadText, fileName, toCsv } from "../../../ui/table.js";
import { compare } from "../answers.js";
import { caseId } from "../cases.js";
import { fitting } from "../model/history.js";
import { isQuiet, mapScale, placeOf } from "../where/scale.js";
import { tint } from "../where/colours.js";
import { changeText } from "../../../format.js";
import { columns, draw, unpin, useModel } from "./columns.js";
import { rowsOf } from "./rows.js";

/** @typedef {import("./columns.js").Column} Column */
/** @typedef {import("./rows.js").Row} Row */

/** The row by which the columns are sorted; null: as they were pinned. */
const sorted = signal(/** @type {{label: string, falling: boolean} | null} */ (null));
/** The column that the others are compared with; its index. */
const baseline = signal(/** @type {number | null} */ (null));
effect(() => void (caseId.value, baseline.value = null)); // the columns of another case are others

const order = computed(() => {
  const all = columns.value, by = sorted.value;
  const row = by && rowsOf(all).find((one) => one.label === by.label);
  if (!row) return all;
  const at = (/** @type {Column} */ c) => row.numbers[all.indexOf(c)];
  const sign = by.falling ? -1 : 1;
  return [...all].sort((one, other) => {
    const a = at(one), b = at(other);
    return a === null ? 1 : b === null ? -1 : sign * (a - b);
  });
});

const rows = computed(() => rowsOf(order.value));
export const hidden = computed(() => rows.value.filter((row) => !row.differs).length);

/** The map of a model in small, on the scale of the case. @param {Column} c */
function mini(c) {
  const map = c.comparison?.heat_map ?? null, s = mapScale.value;
  if (!map || !s) return h("div", { class: "mini-map" });
  return h(
    "div",
    {
      class: "mini-map",
      "aria-hidden": "true",
      style: `grid-template-columns:repeat(${map.edges.length - 1},1fr)`,
    },
    ...map.rows.flatMap((row) =>
      row.cells.map((cell) =>
        h(
          "span",
          null,
          ...(cell ? map.split ? [cell.lengthening, cell.shortening] : [cell.mean] : []).map((mean) =>
            h("i", { style: `background:${tint(mean === null || isQuiet(mean, s) ? 0 : placeOf(mean, s))}` })
          ),
        )
      )
    ),
  );
}

/** @param {Column} c */
function head(c) {
  const isCase = c.index < 0, drawn = compare.value.traces.includes(c.index);
  return h(
    "th",
    { scope: "col", class: isCase ? "me" : "" },
    h("b", null, c.name),
    h("small", null, c.note),
    mini(c),
    h(
      "div",
      { class: "pin-acts" },
      h("button", {
        type: "button",
        class: "small",
        "aria-pressed": String(baseline.value === c.index),
        "aria-label": `Baseline: compare the others with ${c.name}`,
        onclick: () => (baseline.value = baseline.peek() === c.index ? null : c.index),
      }, "Baseline"),
      isCase ? null : h("button", {
        type: "button",
        class: "small",
        "aria-pressed": String(drawn),
        "aria-label": `Draw ${c.name} in the overlay`,
        onclick: () => draw(c.index),
      }, "Draw"),
      isCase ? null : h("button", {
        type: "button",
        class: "small",
        "aria-label": `Use ${c.name}`,
        disabled: () => fitting.value,
        onclick: () => useModel(c.index),
      }, "Use"),
      isCase ? null : h("button", {
        type: "button",
        class: "mini",
        "aria-label": `Unpin ${c.name}`,
        onclick: () => unpin(c.index),
      }, icon("close")),
    ),
  );
}

/** The lowest held-out error. @param {Row} row */
const lowest = (row) => {
  const known = row.numbers.filter((x) => x !== null);
  return row.label === figure("comparison.holdout_rmse").label && known.length > 1
    ? Math.min(...known)
    : null;
};

/** @param {Row} row */
function line(row) {
  const all = order.value, base = all.findIndex((c) => c.index === baseline.value), best = lowest(row);
  const from = base < 0 ? null : row.numbers[base];
  const isSorted = sorted.value?.label === row.label;
  const sort =
    () => (sorted.value = isSorted
      ? sorted.value?.falling ? null : { label: row.label, falling: true }
      : { label: row.label, falling: false });
  return h(
    "tr",
    { class: `row-${row.group}` },
    h(
      "th",
      { scope: "row" },
      h(
        "button",
        {
          type: "button",
          class: "sort",
          "aria-label": `${row.label}${row.unit ? ` ${row.unit}` : ""}: sort the models`,
          "aria-pressed": String(isSorted),
          title: row.title ?? null,
          onclick: sort,
        },
        row.label,
        row.unit ? [" ", h("small", null, row.unit)] : null,
        isSorted ? h("small", { "aria-hidden": "true" }, sorted.value?.falling ? "▼" : "▲") : null,
      ),
    ),
    ...row.texts.map(([text, beside], i) => {
      const value = row.numbers[i];
      const share = row.compared && from && value !== null && i !== base ? changeText(from, value) : "";
      return h(
        "td",
        { class: all[i].index < 0 ? "me" : "" },
        best !== null && value === best ? h("span", { class: "best" }, "lowest") : null,
        h("b", null, text),
        beside || share ? h("small", null, ` ${beside || share}`) : null,
      );
    }),
  );
}

export const table = () =>
  h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": "Models" },
    h(
      "table",
      { class: "board-table", style: `--models:${order.value.length}` },
      h("caption", { class: "unseen" }, "Pinned models and the case"),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("td", null, h("small", null, "Maps: mean residual, same colours in every column")),
          ...order.value.map(head),
        ),
      ),
      h("tbody", null, ...rows.value.filter((row) => row.differs || !compare.value.differing).map(line)),
    ),
  );

export function saveTable() {
  const all = order.peek();
  const made = {
    columns: [
      { title: "row", text: true },
      { title: "unit", text: true },
      ...all.flatMap((
        c,
      ) => [{ title: c.name, text: true }, {
        title: `${c.name}: ${inSentence(figure("parameter.stderr").label)}`,
        text: true,
      }]),
    ],
    rows: rows.peek().map((row) => [row.label, row.unit, ...row.texts.flat()]),
  };
  downloadText(fileName("models", "csv"), toCsv(made), "text/csv");
}
