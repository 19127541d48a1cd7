// @ts-check
// The table of all runs: sorted by its heads, filtered by one column, each run can be pinned and opened.
import { h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { changeText } from "../../format.js";
import { units } from "../../state.js";
import { columnField } from "./fields.js";
import { shown, study } from "./model.js";
import { openRun } from "./open.js";
import { filter, front, pin, pins, places, sortBy, sorting, valueAt } from "./rows.js";
import { columnText, outcomeText, scaleFor, titleOf } from "./words.js";

/** @typedef {import("./model.js").Column} Column */

const PAGE = 100;
const most = signal(PAGE);

/** @param {string} name @param {string} title @param {string} [unit] */
function head(name, title, unit) {
  const isBy = () => sorting.value.name === name;
  const order = () => !isBy() ? "none" : sorting.value.descending ? "descending" : "ascending";
  return h(
    "th",
    { scope: "col", "aria-sort": order },
    h(
      "button",
      { type: "button", class: "sort", onclick: () => sortBy(name) },
      title,
      h(
        "span",
        { class: "arrow", "aria-hidden": "true" },
        () => isBy() ? sorting.value.descending ? " ▼" : " ▲" : "",
      ),
    ),
    unit ? h("small", null, unit) : null,
  );
}

export const openWord = () => study.value.subject === "task" ? "Design" : "Transient";

/** How the values of each column on screen are written. @param {Column[]} columns @param {number[]} rows
 * @returns {Map<string, (si: number | null | undefined) => string>} */
const writers = (columns, rows) =>
  new Map(columns.map((c) => {
    const numbers = rows.map((place) => valueAt(c.name, place)).map((v) => typeof v === "number" ? v : null);
    return [c.name, columnText(numbers, scaleFor(c.name, c.unit, units.value))];
  }));

/** Digits of the largest number of a run: the buttons behind the numbers stand below each other. */
const numberWidth = () => String(shown.value?.table.run.length ?? 0).length;

/** @param {number} place @param {Column[]} columns @param {ReturnType<typeof writers>} written */
function row(place, columns, written) {
  const run = Number(valueAt("run", place)), outcome = String(valueAt("outcome", place));
  const message = String(valueAt("message", place) ?? "");
  const isPinned = () => pins.value.includes(run);
  return h(
    "tr",
    { class: () => `${isPinned() ? "chosen" : ""}${front.value.has(run) ? " on-front" : ""}` },
    h(
      "th",
      { scope: "row" },
      h("span", { class: "nr", style: `min-width:${numberWidth()}ch` }, String(run + 1)),
      h(
        "span",
        { class: "acts" },
        h("button", {
          type: "button",
          class: "mini",
          "aria-pressed": () => String(isPinned()),
          "aria-label": `Pin run ${run + 1}`,
          title: "Pin to compare",
          onclick: () => pin(run),
        }, icon("pin")),
        h("button", {
          type: "button",
          class: "mini",
          "aria-label": `Open run ${run + 1} in ${openWord()}`,
          title: `Open this run in ${openWord()}`,
          onclick: () => openRun(place),
        }, icon("export")),
      ),
    ),
    ...columns.map((c) => {
      const value = valueAt(c.name, place);
      return h(
        "td",
        null,
        typeof value === "string" ? value : written.get(c.name)?.(value),
      );
    }),
    h(
      "td",
      { class: `text outcome${outcome === "completed" ? "" : " bad"}`, title: message || null },
      outcomeText(outcome).split(":")[0],
      message ? h("span", { class: "unseen" }, `: ${message}`) : null,
    ),
  );
}

/** @param {Column[]} columns */
function filterLine(columns) {
  const list = h(
    "select",
    {
      class: "small",
      "aria-label": "Show only runs by",
      onchange: () => (filter.value = { name: list.value, least: null, most: null }),
    },
    h("option", { value: "" }, "All runs"),
    ...columns.filter((c) => c.unit !== null).map((c) =>
      h("option", { value: c.name, selected: () => filter.value.name === c.name }, titleOf(c.name))
    ),
  );
  const name = computed(() => filter.value.name);
  /** @param {"least" | "most"} end @param {string} label */
  const field = (end, label) => {
    const column = columns.find((c) => c.name === name.value);
    return column
      ? columnField({
        key: `filter.${end}`,
        label,
        path: column.name,
        unit: column.unit,
        empty: "any",
        get: () => filter.value[end],
        put: (si) => (filter.value = { ...filter.peek(), [end]: si }),
        clear: () => (filter.value = { ...filter.peek(), [end]: null }),
      })
      : null;
  };
  return h(
    "div",
    { class: "filter" },
    list,
    () => name.value ? [field("least", "At least"), field("most", "At most")] : null,
    h("span", { class: "muted" }, () => {
      const all = shown.value?.table.run.length ?? 0, left = places.value.length;
      return left === all ? `${all} runs` : `${left} of ${all} runs`;
    }),
  );
}

export function tableCard() {
  const columnsText = computed(() => JSON.stringify(shown.value?.columns ?? []));
  effect(() => {
    columnsText.value;
    most.value = PAGE;
  });
  return h(
    "section",
    { class: "card runs-table", "aria-label": "Runs" },
    h("div", { class: "card-head" }, h("h2", null, "Runs")),
    () => {
      /** @type {Column[]} */
      const columns = JSON.parse(columnsText.value);
      return [
        filterLine(columns),
        h(
          "div",
          { class: "scroll", tabindex: 0, role: "region", "aria-label": "Table of runs" },
          h(
            "table",
            { class: "data" },
            h("caption", { class: "unseen" }, "Runs of the study"),
            h(
              "thead",
              null,
              h(
                "tr",
                null,
                head("run", "Run"),
                () =>
                  columns.map((c) =>
                    head(c.name, titleOf(c.name), scaleFor(c.name, c.unit, units.value).unit)
                  ),
                head("outcome", "Outcome"),
              ),
            ),
            h("tbody", null, () => {
              const rows = places.value.slice(0, most.value), written = writers(columns, rows);
              return rows.map((place) => row(place, columns, written));
            }),
          ),
        ),
      ];
    },
    () =>
      places.value.length > most.value
        ? h(
          "button",
          { type: "button", class: "link", onclick: () => (most.value += PAGE) },
          `Show ${Math.min(PAGE, places.value.length - most.value)} more`,
        )
        : null,
  );
}

/** The pinned runs beside each other, with their difference from the first. */
export function pinsCard() {
  /** @param {Column} c @param {number} place @param {number} first */
  const change = (c, place, first) => {
    const a = valueAt(c.name, first), b = valueAt(c.name, place);
    if (place === first) return null;
    if (typeof a !== "number" || typeof b !== "number" || a === 0) return h("small");
    return h("small", null, changeText(a, b));
  };
  return h(
    "section",
    { class: "card pinned-runs", "aria-label": "Pinned runs", hidden: () => !pins.value.length },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Pinned runs"),
      h("span", { class: "muted" }, "change from the first"),
    ),
    () => {
      const now = shown.value;
      if (!now || !pins.value.length) return null;
      const at = pins.value.map((run) => now.table.run.indexOf(run)).filter((i) => i >= 0);
      const written = writers(now.columns, at);
      /** @param {Column} c @param {number} place */
      const text = (c, place) => {
        const value = valueAt(c.name, place);
        return typeof value === "string" ? value : written.get(c.name)?.(value);
      };
      return h(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "Pinned runs compared" },
        h(
          "table",
          { class: "data", style: `--runs:${at.length}` },
          h("caption", { class: "unseen" }, "Pinned runs"),
          h(
            "thead",
            null,
            h(
              "tr",
              null,
              h("td", null),
              ...at.map((i) =>
                h(
                  "th",
                  { scope: "col" },
                  `Run ${Number(now.table.run[i]) + 1} `,
                  h("button", {
                    type: "button",
                    class: "mini",
                    "aria-label": `Unpin run ${Number(now.table.run[i]) + 1}`,
                    onclick: () => pin(Number(now.table.run[i])),
                  }, icon("close")),
                )
              ),
            ),
          ),
          h(
            "tbody",
            null,
            ...now.columns.map((c) =>
              h(
                "tr",
                null,
                h(
                  "th",
                  { scope: "row", class: "text" },
                  titleOf(c.name),
                  h("small", null, ` ${scaleFor(c.name, c.unit, units.value).unit}`),
                ),
                ...at.map((i) => h("td", null, text(c, i), " ", change(c, i, at[0]))),
              )
            ),
          ),
        ),
      );
    },
  );
}
