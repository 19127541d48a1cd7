// @ts-check
// The dialog about how a file is read, where the user can correct channels, units, kind and conditions.
import { h, icon } from "../../../dom.js";
import { apart, computed, effect, signal } from "../../../reactive.js";
import { ApiError } from "../../../server/client.js";
import { brief, capitalized, readable } from "../../../format.js";
import { openDialog } from "../../../ui/dialog.js";
import { columnTable, valueOf } from "./mapping-columns.js";
import { previewOf } from "../../../server/measurements.js";
import { Question } from "../../../server/question.js";

/** @typedef {import("../types.js").Preview} Preview */
/** @typedef {import("../types.js").Mapping} Mapping */
/** @typedef {import("./mapping-columns.js").Context} Context */

const AFTER_MS = 200;

/** Shows how a file is read; resolves to the corrections of the user, null if the dialog is cancelled.
 * @param {File} file @param {Preview} first @param {Mapping} start @returns {Promise<Mapping | null>} */
export function openMapping(file, first, start) {
  const mapping = signal(start);
  const reading = new Question((text, signal) => previewOf(file, JSON.parse(text), signal), { patience: 0 });
  const stopReading = reading.follow(
    () => mapping.value === start ? null : JSON.stringify(mapping.value),
    { delay: AFTER_MS },
  );
  const preview = computed(() => reading.answer.value ?? first);
  /** @type {Context} */
  const context = {
    preview,
    mapping,
    change: (patch) => (mapping.value = { ...mapping.peek(), ...patch }),
  };
  const usable = () =>
    preview.value.measurement !== null && !preview.value.problem && !reading.error.value &&
    reading.stage.value !== "asking";

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
      () => problem(preview.value, reading.error.value?.words ?? ""),
      notes(preview),
      h(
        "div",
        { class: "foot" },
        h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
        h("button", {
          type: "button",
          class: "primary",
          disabled: () => !usable(),
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
      stopReading();
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
        const p = preview.value, chosen = mapping.value.kind;
        const auto = p.kind && p.kind_detected ? `detected: ${p.kind}` : "as the file says";
        return [
          h("option", { value: "", selected: !chosen }, auto),
          ...p.kind_choices.map((kind) => h("option", { value: kind, selected: kind === chosen }, kind)),
        ];
      }),
    ),
    h("p", { class: "hint" }, () => preview.value.kind_reason),
  );

/** Missing conditions, which are asked for, and those the file gives. @param {Context} c */
function conditionFields({ preview, mapping, change }) {
  // A field that was asked for stays after the user has filled it in.
  const asked = signal(/** @type {import("../types.js").Missing[]} */ ([]));
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
            h("label", { for: `map-${m.key}` }, capitalized(readable(m.key))),
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
      const texts = known.map(([key, v]) => `${readable(key)} ${typeof v === "number" ? brief(v) : v}`);
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
  const { message = "", hint = null } = p.problem ?? {};
  // The message starts with the file name, which must not be capitalized.
  const text = wrong ||
    (message && [`${message}.`, hint && new ApiError(hint).words].filter(Boolean).join(" "));
  return text ? h("p", { class: "flag bad", role: "alert" }, icon("warn"), h("span", null, text)) : null;
}

/** @param {import("../../../reactive.js").Signal<Preview>} preview */
const notes = (preview) =>
  h("ul", { class: "plain muted" }, () => preview.value.messages.map((text) => h("li", null, text)));
