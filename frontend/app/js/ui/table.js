// @ts-check
// Tables of numbers: on the page and as CSV; saving files.
import { h } from "../dom.js";
import { aligned } from "../format.js";

/** @typedef {{title: string, unit?: string, text?: boolean}} Column */
/** `notes`: lines above the head of a file; null: no value.
 * @typedef {{columns: Column[], rows: (string | number | null)[][], notes?: string[]}} Table */

/** @param {Table} table @param {string} caption */
export function dataTable(table, caption) {
  const columns = table.columns.map((c, i) => {
    const values = table.rows.map((row) => row[i]);
    return c.text ? values.map(String) : aligned(/** @type {(number | null)[]} */ (values));
  });
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    h(
      "table",
      { class: "data" },
      h("caption", { class: "unseen" }, caption),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          table.columns.map((c) =>
            h(
              "th",
              { scope: "col", class: c.text ? "text" : "" },
              c.title,
              c.unit ? h("small", null, c.unit) : null,
            )
          ),
        ),
      ),
      h(
        "tbody",
        null,
        table.rows.map((_, k) =>
          h(
            "tr",
            null,
            columns.map((texts, i) => h("td", { class: table.columns[i].text ? "text" : "" }, texts[k])),
          )
        ),
      ),
    ),
  );
}

/** The head of a column in a file. @param {Column} column */
export const headOf = ({ title, unit }) => unit ? `${title} [${unit}]` : title;

/** Comma-separated, "name [unit]" in the header: the form measurement files are read in.
 * @param {Table} table */
export function toCsv({ columns, rows, notes = [] }) {
  const quote = (/** @type {string} */ text) =>
    /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  const head = columns.map((c) => quote(headOf(c)));
  const write = (/** @type {string | number | null} */ v) =>
    v == null ? "" : typeof v === "number" ? String(Number(v.toPrecision(12))) : quote(v);
  return [...notes.map((note) => `# ${note}`), head.join(","), ...rows.map((row) => row.map(write).join(","))]
    .join("\n") + "\n";
}

/** The name of a saved file with the date of today: "mckibben-run-2024-05-01.csv".
 * @param {string} what "": the whole document @param {string} [ending] */
export function fileName(what, ending) {
  const name = ["mckibben", what, new Date().toISOString().slice(0, 10)].filter(Boolean).join("-");
  return ending ? `${name}.${ending}` : name;
}

/** @param {string} name @param {Blob} blob */
export function download(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
/** @param {string} name @param {string} text @param {string} type */
export const downloadText = (name, text, type) => download(name, new Blob([text], { type }));
