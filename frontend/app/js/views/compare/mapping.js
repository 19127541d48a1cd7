// @ts-check
// How a file is read, as a table the user can correct: channel and unit of each column, kind, conditions.
import { h, icon } from "../../dom.js";
import { apart, effect, signal } from "../../reactive.js";
import { ApiError } from "../../api.js";
import { brief } from "../../format.js";
import { openDialog } from "../../ui/dialog.js";
import { spoken } from "../../ui/sources.js";
import { previewOf } from "./upload.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").PreviewColumn} PreviewColumn */
/** @typedef {import("./types.js").Mapping} Mapping */
/** @typedef {{preview: import("../../reactive.js").Signal<Preview>,
 *   mapping: import("../../reactive.js").Signal<Mapping>,
 *   change: (patch: Mapping) => void}} Context */

const SAMPLE_ROWS = 5, AFTER_MS = 200;

/** @param {Event} event */
const valueOf = (event) => /** @type {HTMLSelectElement | HTMLInputElement} */ (event.target).value;

/** Shows how a file is read; the answer is what the user said, null when the file is not wanted.
 * @param {File} file @param {Preview} first @param {Mapping} start @returns {Promise<Mapping | null>} */
export function openMapping(file, first, start) {
  const preview = signal(first), mapping = signal(start);
  const wrong = signal(""), waiting = signal(false);
  let control = new AbortController(), timer = 0;

  async function ask() {
    control.abort();
    control = new AbortController();
    const mine = control.signal;
    try {
      const got = await previewOf(file, mapping.peek(), mine);
      preview.value = got;
      wrong.value = "";
      waiting.value = false;
    } catch (error) {
      if (mine.aborted) return;
      if (!(error instanceof ApiError)) throw error;
      wrong.value = error.words;
      waiting.value = false;
    }
  }
  /** @param {Mapping} patch */
  const change = (patch) => {
    mapping.value = { ...mapping.peek(), ...patch };
    waiting.value = true;
    clearTimeout(timer);
    timer = setTimeout(ask, AFTER_MS);
  };
  /** @type {Context} */
  const context = { preview, mapping, change };
  const usable = () => preview.value.measurement !== null && !preview.value.problem && !wrong.value;

  return new Promise((resolve) => {
    /** @type {Mapping | null} */
    let result = null;
    const body = apart(() => [
      h("p", { class: "muted", role: "status" }, () => counts(preview.value)),
      h("div", {
        class: "scroll map-table",
        tabindex: 0,
        role: "region",
        "aria-label": "Columns of the file",
      }, () => columnTable(context)),
      h("div", { class: "map-more" }, kindField(context), conditionFields(context)),
      () => badRows(context),
      () => problem(preview.value, wrong.value),
      notes(preview),
      h(
        "div",
        { class: "foot" },
        h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
        h("button", {
          type: "button",
          class: "primary",
          disabled: () => waiting.value || !usable(),
          onclick: () => {
            result = mapping.peek();
            dialog.close();
          },
        }, "Use these columns"),
      ),
    ]);
    const dialog = openDialog({ title: `How ${file.name} is read`, wide: true }, ...body);
    dialog.classList.add("mapping");
    dialog.addEventListener("close", () => {
      control.abort();
      clearTimeout(timer);
      resolve(result);
    });
  });
}

/** @param {Preview} p */
function counts(p) {
  const skipped = p.rows - p.valid_rows;
  const kind = p.kind ? `, kind ${p.kind}${p.kind_detected ? " (detected)" : ""}` : "";
  return `${p.format.toUpperCase()} · ${p.rows} rows: ${p.valid_rows} can be used, ${skipped} skipped${kind}.`;
}

/** @param {Context} c */
function columnTable({ preview, mapping, change }) {
  const p = preview.value;
  const row = (/** @type {number} */ k) => p.sample[k] ?? [];
  /** @param {PreviewColumn} column @param {any} choice */
  const set = (column, choice) => change({ columns: { ...mapping.peek().columns, [column.header]: choice } });
  const names = p.channel_choices.map((one) => one.name);
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
    ...all.map((name) => h("option", { value: name, selected: name === column.channel }, spoken(name))),
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
        h("small", null, "above vacuum"),
      )
      : null,
  ];
}

/** @param {Context} c */
const kindField = ({ preview, mapping, change }) =>
  h(
    "div",
    { class: "field choice" },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: "map-kind" }, "Kind of test"),
      h("select", {
        id: "map-kind",
        onchange: (/** @type {Event} */ e) => change({ kind: valueOf(e) || undefined }),
      }, () => {
        const p = preview.value, said = mapping.value.kind;
        const auto = p.kind && p.kind_detected ? `detected: ${p.kind}` : "as the file says";
        return [
          h("option", { value: "", selected: !said }, auto),
          ...p.kind_choices.map((kind) => h("option", { value: kind, selected: kind === said }, kind)),
        ];
      }),
    ),
    h("p", { class: "hint" }, () => preview.value.kind_reason),
  );

/** Conditions that are asked for, and those that were found. @param {Context} c */
function conditionFields({ preview, mapping, change }) {
  // A field stays once it was asked for and answered: the answer must not take it away.
  const asked = signal(/** @type {import("./types.js").Missing[]} */ ([]));
  effect(() => {
    const seen = asked.peek();
    const added = preview.value.missing.filter((m) => !seen.some((one) => one.key === m.key));
    if (added.length) asked.value = [...seen, ...added];
  });
  const open = (/** @type {string} */ key) => preview.value.missing.some((m) => m.key === key);
  return h(
    "div",
    null,
    () =>
      asked.value.map((m) =>
        h(
          "div",
          {
            class: () => `field${open(m.key) ? " wanted" : ""}`,
            hidden: () => !open(m.key) && !mapping.value.conditions?.[m.key],
            "data-field": `conditions.${m.key}`,
          },
          h(
            "div",
            { class: "field-head" },
            h("label", { for: `map-${m.key}` }, spoken(m.key).replace(/^./, (c) => c.toUpperCase())),
            h(
              "span",
              { class: "entry" },
              h("input", {
                id: `map-${m.key}`,
                type: "text",
                placeholder: m.example,
                value: mapping.peek().conditions?.[m.key] ?? "",
                onchange: (/** @type {Event} */ e) =>
                  change({
                    conditions: { ...mapping.peek().conditions, [m.key]: valueOf(e).trim() || null },
                  }),
              }),
            ),
          ),
          h("p", { class: "hint" }, `Not in the file: ${m.why}.`),
        )
      ),
    () => {
      const known = Object.entries(preview.value.conditions).filter(([, v]) => v !== null);
      if (!known.length) return null;
      const texts = known.map(([key, v]) => `${spoken(key)} ${typeof v === "number" ? brief(v) : v}`);
      return h("p", { class: "muted" }, `Conditions in SI: ${texts.join(", ")}.`);
    },
  );
}

/** @param {Context} c */
function badRows({ preview, mapping, change }) {
  const p = preview.value;
  if (!p.skipped.length && mapping.value.bad_rows !== "skip") return null;
  const total = p.skipped.reduce((sum, s) => sum + s.rows, 0);
  const reasons = p.skipped.map((s) => `${s.rows} × ${s.reason}, first in ${s.first}`).join("; ");
  return h(
    "div",
    { class: "bad-rows" },
    h(
      "label",
      { class: "check" },
      h("input", {
        type: "checkbox",
        checked: mapping.value.bad_rows === "skip",
        onchange: (/** @type {Event} */ e) =>
          change({ bad_rows: /** @type {HTMLInputElement} */ (e.target).checked ? "skip" : undefined }),
      }),
      h("span", null, `Leave out ${total} row${total === 1 ? "" : "s"} that cannot be read`),
    ),
    reasons ? h("p", { class: "hint" }, `${reasons}.`) : null,
  );
}

/** @param {Preview} p @param {string} wrong */
function problem(p, wrong) {
  const told = wrong || (p.problem ? new ApiError(p.problem.message, p.problem).words : "");
  return told ? h("p", { class: "flag bad", role: "alert" }, icon("warn"), h("span", null, told)) : null;
}

/** @param {import("../../reactive.js").Signal<Preview>} preview */
const notes = (preview) =>
  h("ul", { class: "plain muted" }, () => preview.value.messages.map((text) => h("li", null, text)));
