// @ts-check
// What a file leaves open: questions with their answers, columns that are not read, rows that cannot be.
import { h, icon } from "../dom.js";
import { capitalized, readable } from "../format.js";
import { answersOf, heldIn, typedAbout, withColumns, withHeld } from "./choices.js";

/** @typedef {import("./types.js").OpenQuestion} OpenQuestion */
/** @typedef {import("./model.js").Model} Model */

/** Questions that fields of the experiment ask. */
const OF_EXPERIMENT = new Set(["rest length", "load", "supply"]);

/** @param {Model} m */
export function questionsOf(m) {
  const fields = new Set(m.fields.value.map((field) => field.field));
  return m.preview.value.questions.filter((q) =>
    !OF_EXPERIMENT.has(q.about) || !fields.has(q.about.replace(" ", "_"))
  );
}

/** A question of the command line as a sentence: it asks in its last clause, or says what would be right.
 * @param {string} text */
const asSentence = (text) =>
  `${capitalized(text).replace(/[.?]$/, "")}${
    /(?:^|; |: |\. )(?:what|which|is|are|does|do|was)\b[^;]*$/i.test(text) ? "?" : "."
  }`;

/** The questions of the file that is shown, each with its answers; first those whose proposal is assumed.
 * @param {Model} m */
export const questionList = (m) =>
  [...m.assumed.value, ...questionsOf(m)].map((q) => {
    const answers = answersOf(q, m.preview.value).filter((one) => !(one.ignores && one.label === "ignore"));
    const isAssumed = m.assumed.value.includes(q);
    return h(
      "fieldset",
      { class: `ask${isAssumed ? " assumed" : q.stops ? "" : " may-wait"}`, "data-about": q.about },
      h(
        "legend",
        null,
        icon(q.stops ? "warn" : "info"),
        h("span", null, asSentence(q.text)),
      ),
      typedAbout(q) ? typedAnswer(m, q) : q.stops || answers.length
        ? h(
          "div",
          { class: "answers" },
          ...answers.map((one) =>
            h(
              "button",
              {
                type: "button",
                "data-key": `answer ${q.about} ${one.label}`,
                onclick: () => m.change(one.apply),
              },
              readable(one.label),
              one.proposed ? h("small", null, isAssumed ? "assumed" : "proposed") : null,
            )
          ),
          ignoresColumn(q) ? h("small", null, "or tick “ignore” below") : null,
        )
        : null,
    );
  });

/** @param {string} label @param {string} name @param {string} placeholder @param {string} [value] */
const typedField = (label, name, placeholder, value = "") =>
  h(
    "label",
    { class: "typed" },
    h("span", null, label),
    h("input", {
      type: "text",
      name,
      value,
      placeholder,
      required: true,
      maxlength: 40,
      autocomplete: "off",
      "data-key": `typed ${name}`,
    }),
  ); // deno-fmt-ignore

/** Fields for what no column holds as numbers. @param {Model} m @param {OpenQuestion} q */
function typedAnswer(m, q) {
  const { column, choices } = q, [{ channel, column: example }] = q.answers;
  const levels = q.about.startsWith("levels of ") && column !== null;
  const said = (/** @type {HTMLFormElement} */ form, /** @type {string} */ name) =>
    String(new FormData(form).get(name) ?? "").trim();
  /** @param {SubmitEvent} e */
  const submit = (e) => {
    e.preventDefault();
    const form = /** @type {HTMLFormElement} */ (e.target);
    const scale = choices.map((word) => `${word} = ${said(form, word)}`).join(", ");
    m.change((mapping) =>
      levels
        ? withColumns(mapping, { [column]: { channel: channel ?? "", scale } })
        : withHeld(mapping, m.preview.value, channel ?? "", said(form, "held"))
    );
  };
  return h(
    "form",
    { class: "answers typed-answer", onsubmit: submit },
    ...levels
      ? choices.map((word, i) => typedField(word, word, `${i + 1} bar`))
      : [typedField(capitalized(channel ?? ""), "held", example)],
    h("button", { type: "submit" }, "Use"),
  );
}

/** What the user said was held, with the way back. @param {Model} m */
export const heldList = (m) =>
  heldIn(m.mapping.value, m.preview.value).map(({ text, channel }) =>
    h(
      "p",
      { class: "held", "data-held": channel },
      `${capitalized(channel)} was held at ${text}, as you say.`,
      h("button", {
        type: "button",
        "data-key": `held ${channel}`,
        onclick: () => m.change((mapping) => withHeld(mapping, m.preview.value, channel, "")),
      }, "Take back"),
    )
  );

/** @param {OpenQuestion} q */
const ignoresColumn = (q) => q.choices.includes("ignore");

/** Every column that nothing is read from, with the reason; a tick where a column has to be answered for.
 * @param {Model} m */
export function unreadList(m) {
  const p = m.preview.value;
  const headers = new Set(p.columns.map((column) => column.header));
  const asked = new Set(p.questions.filter(ignoresColumn).map((q) => q.column));
  const given = m.mapping.value.columns ?? {};
  const listed = p.unread.map((one) => one.column);
  const rows = [
    ...p.unread,
    ...[...asked].flatMap((column) =>
      column && !listed.includes(column) ? [{ column, why: "it needs an answer" }] : []
    ),
  ];
  if (!rows.length) {
    return h("p", { class: "muted" }, icon("check"), "Every column of the file is read.");
  }
  return [
    h("h4", null, `Not read: ${rows.length} column${rows.length === 1 ? "" : "s"}`),
    h(
      "ul",
      { class: "plain unread" },
      ...rows.map(({ column, why }) => {
        const ignored = given[column] === null;
        const tick = headers.has(column) && (asked.has(column) || ignored);
        return h(
          "li",
          { class: asked.has(column) && !ignored ? "open" : "", "data-unread": column },
          h("b", null, column),
          h("span", { class: "why" }, why),
          tick
            ? h(
              "label",
              { class: "check" },
              h("input", {
                type: "checkbox",
                "data-key": `ignore ${column}`,
                "aria-label": `Ignore ${column}`,
                checked: ignored,
                onchange: (/** @type {Event} */ e) =>
                  m.change((mapping) => {
                    const { [column]: _, ...others } = mapping.columns ?? {};
                    return /** @type {HTMLInputElement} */ (e.target).checked
                      ? withColumns(mapping, { [column]: null })
                      : { ...mapping, columns: others };
                  }),
              }),
              "ignore",
            )
            : null,
        );
      }),
    ),
  ];
}

/** How many rows are read, and the rows that cannot be. @param {Model} m */
export function rowCounts(m) {
  const p = m.preview.value, taken = p.measurement;
  const total = p.skipped.reduce((sum, s) => sum + s.rows, 0);
  const out = Object.entries(taken?.excluded ?? {}).map(([why, n]) => `${n} ${why}`);
  const reasons = p.skipped.map((s) => `${s.rows} × ${s.reason}, first in ${s.first}`).join("; ");
  return [
    h(
      "p",
      { class: "muted", role: "status" },
      h("b", null, p.valid_rows),
      ` of ${p.rows} rows can be read${taken ? `, ${taken.usable_rows} can be compared` : ""}`,
      out.length ? `; left out: ${out.join(", ")}` : "",
      ".",
    ),
    total || m.mapping.value.bad_rows === "skip"
      ? h(
        "div",
        { class: "bad-rows" },
        h(
          "label",
          { class: "check" },
          h("input", {
            type: "checkbox",
            "data-key": "bad rows",
            checked: m.mapping.value.bad_rows === "skip",
            onchange: (/** @type {Event} */ e) => {
              const skip = /** @type {HTMLInputElement} */ (e.target).checked;
              m.change(({ bad_rows: _, ...mapping }) => skip ? { ...mapping, bad_rows: "skip" } : mapping);
            },
          }),
          h("span", null, `Leave out ${total} row${total === 1 ? "" : "s"} that cannot be read`),
        ),
        reasons ? h("p", { class: "hint" }, `${reasons}.`) : null,
      )
      : null,
  ];
}
