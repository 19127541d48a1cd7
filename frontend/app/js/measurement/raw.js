// @ts-check
// The first rows of a file as they stand in it, with the head row to move and the columns' quantities above.
import { h, icon } from "../dom.js";
import { signal } from "../reactive.js";
import { withPlace } from "./choices.js";
import { columnList, quantitySelect, rangeOf, stateOf, unitSelect } from "./columns.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Column} Column */
/** @typedef {import("./model.js").Model} Model */

const MOST_COLUMNS = 60;

// Columns are side by side, but one below the other on a phone.
const phone = matchMedia("(max-width: 700px)");
const isPhone = signal(phone.matches);
phone.addEventListener("change", () => (isPhone.value = phone.matches));

/** Columns and rows of the file that is shown. @param {Model} m */
export function rawTable(m) {
  const p = m.preview.value, raw = p.raw;
  const placed = p.columns.filter((column) => column.place !== null);
  if (isPhone.value || (raw && !placed.length)) {
    return [raw ? rowsTable(m, []) : null, columnList(m, p.columns)];
  }
  if (!raw) return [readingsTable(m)];
  const apart = p.columns.filter((column) => column.place === null);
  return [
    rowsTable(m, placed),
    apart.length
      ? [h("p", { class: "muted" }, "From titles and blocks of the file:"), columnList(m, apart)]
      : null,
  ].flat();
}

/** @param {import("../dom.js").Child[]} parts */
const region = (...parts) =>
  h("div", {
    class: "scroll raw-table",
    tabindex: 0,
    role: "region",
    "aria-label": "First rows of the file",
    "data-key": "rows",
  }, ...parts);

/** @param {Model} m @param {Column | undefined} column @param {boolean} [again] */
function headCell(m, column, again = false) {
  if (!column) return h("td", null, again ? h("span", { class: "state" }, "read like the first") : null);
  return h(
    "th",
    { scope: "col", "data-column": column.header },
    quantitySelect(m, column),
    unitSelect(m, column),
    stateOf(column),
    h("small", { class: "range" }, rangeOf(m.preview.value, column)),
  );
}

/** A format without rows: heads and first readings. @param {Model} m */
function readingsTable(m) {
  const p = m.preview.value;
  return region(h(
    "table",
    { class: "raw" },
    h("caption", { class: "unseen" }, "What each column is, and its first values"),
    h("thead", null, h("tr", null, h("td", { class: "row" }), ...p.columns.map((c) => headCell(m, c)))),
    h(
      "tbody",
      null,
      h(
        "tr",
        { class: "is-head" },
        h("td", { class: "row" }),
        ...p.columns.map((c) => h("td", null, c.header)),
      ),
      ...p.sample.map((cells, i) =>
        h(
          "tr",
          null,
          h("td", { class: "row" }, i + 1),
          ...p.columns.map((_, k) => h("td", null, cells[k] ?? "")),
        )
      ),
    ),
  ));
}

/** @param {Model} m @param {Column[]} placed */
function rowsTable(m, placed) {
  const raw = /** @type {NonNullable<Preview["raw"]>} */ (m.preview.value.raw);
  const width = Math.min(MOST_COLUMNS, Math.max(1, ...raw.rows.map(({ cells }) => cells.length)));
  const places = Array.from({ length: width }, (_, i) => i);
  const columns = new Map(placed.map((column) => [column.place, column]));
  /** @param {number} place */
  const used = (place) => !placed.length || columns.get(place)?.channel != null || raw.also.includes(place);
  const table = h(
    "table",
    { class: "raw" },
    h("caption", { class: "unseen" }, "The first rows of the file; above them what each column is"),
    placed.length
      ? h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("td", { class: "row lead" }, raw.head_moves ? "Drag the handle to the header row" : ""),
          ...places.map((place) => headCell(m, columns.get(place), raw.also.includes(place))),
        ),
      )
      : null,
    h(
      "tbody",
      null,
      ...raw.rows.map(({ row, cells }) => {
        const isHead = row === raw.head, isUnits = row === raw.units;
        const kind = isHead
          ? "is-head"
          : isUnits
          ? "is-units"
          : raw.head !== null && row < raw.head
          ? "before"
          : "";
        return h(
          "tr",
          { class: kind, "data-row": row },
          h(
            "td",
            { class: "row" },
            isHead && raw.head_moves
              ? headHandle(m, raw)
              : isHead
              ? `header ${row}`
              : isUnits
              ? `units ${row}`
              : row,
          ),
          // A line of a preamble may be longer than the table is wide.
          cells.length === 1 && width > 1
            ? h("td", { colspan: width, class: "whole-line" }, h("div", null, cells[0]))
            : places.map((place) => h("td", { class: used(place) ? "" : "unused" }, cells[place] ?? "")),
        );
      }),
    ),
  );
  const box = region(table);
  // The head and the first readings are in sight when the table appears.
  requestAnimationFrame(() => {
    const head = /** @type {HTMLElement | null} */ (box.querySelector(".is-head"));
    const over = table.querySelector("thead")?.offsetHeight ?? 0;
    if (head && head.offsetTop + 140 > box.clientHeight) box.scrollTop = head.offsetTop - over - 100;
  });
  return box;
}

/** The handle at the head row: dragged, or moved with arrow keys. @param {Model} m
 * @param {NonNullable<Preview["raw"]>} raw */
function headHandle(m, raw) {
  const rows = raw.rows.filter(({ cells }) => cells.some(Boolean)).map(({ row }) => row);
  const head = raw.head ?? 1;
  const cells = raw.rows.find(({ row }) => row === head)?.cells ?? [];
  const take = (/** @type {number | undefined} */ row) => {
    if (row !== undefined && row !== head) m.change((mapping) => withPlace(mapping, { head: row }));
  };
  /** @param {PointerEvent} e */
  const under = (e) => {
    const row = document.elementFromPoint(e.clientX, e.clientY)?.closest("tr[data-row]");
    return row instanceof HTMLElement && rows.includes(Number(row.dataset.row)) ? row : null;
  };
  const mark = (/** @type {HTMLElement | null} */ row) => {
    handle.closest("table")?.querySelector(".target")?.classList.remove("target");
    row?.classList.add("target");
  };
  const handle = h(
    "button",
    {
      type: "button",
      class: "handle",
      role: "slider",
      "data-key": "head",
      "aria-label": "Row of the column names",
      "aria-orientation": "vertical",
      "aria-valuemin": rows[0],
      "aria-valuemax": rows.at(-1),
      "aria-valuenow": head,
      "aria-valuetext": `row ${head}: ${cells.filter(Boolean).join(", ")}`,
      title: "Drag to another row, or use the arrow keys",
      onkeydown: (/** @type {KeyboardEvent} */ e) => {
        const by = { ArrowUp: -1, ArrowDown: 1 }[e.key];
        if (!by) return;
        e.preventDefault();
        take(rows[rows.indexOf(head) + by]);
      },
      onpointerdown: (/** @type {PointerEvent} */ e) => {
        handle.setPointerCapture(e.pointerId);
        handle.classList.add("held");
      },
      onpointermove: (/** @type {PointerEvent} */ e) => {
        if (handle.hasPointerCapture(e.pointerId)) mark(under(e));
      },
      onpointerup: (/** @type {PointerEvent} */ e) => {
        if (!handle.classList.contains("held")) return;
        handle.classList.remove("held");
        mark(null);
        take(Number(under(e)?.dataset.row ?? head));
      },
      onpointercancel: () => {
        handle.classList.remove("held");
        mark(null);
      },
    },
    icon("grip"),
    `header ${head}`,
  );
  return handle;
}
