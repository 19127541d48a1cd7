// @ts-check
// The experiment behind a file: what it was made with, who says so, and what nobody has said yet.
import { h, icon } from "../dom.js";
import { units } from "../state.js";
import { muscles, presets } from "../store.js";
import { quantityOf, scaleOf } from "../format.js";
import { contradicted, isOpen, saidText, textOf, valueText } from "./fields.js";
import { valueOf } from "./columns.js";

/** @typedef {import("./types.js").Field} Field */
/** @typedef {import("./types.js").Said} Said */
/** @typedef {import("./model.js").Model} Model */

/** Who says a value. @param {Model} m @param {Field} f @param {Said | undefined} said */
function originChip(m, f, said) {
  const way = m.ways.value[f.field];
  if (said !== undefined) {
    const taken = typeof said !== "string";
    return h("span", { class: "origin you" }, taken ? "suggestion accepted" : "you");
  }
  if (way === "later") return h("span", { class: "origin assumed" }, "set in the view");
  if (f.origin === null) {
    return h("span", { class: "origin none" }, f.required ? "not stated" : "not stated");
  }
  if (f.origin === "file") {
    return h("span", { class: "origin from-file" }, `file: ${placeOf(m, f) || "its text"}`);
  }
  if (f.origin === "preset") return h("span", { class: "origin" }, f.where || "preset");
  if (f.origin === "assumed") {
    return h("span", { class: "origin assumed" }, way ? "assumed, check it later" : "assumed");
  }
  return h("span", { class: "origin" }, f.origin);
}

/** Where the file says a value, without the name of the file. @param {Model} m @param {Field} f */
const placeOf = (m, f) =>
  m.files.reduce(
    (where, { name }) => where.startsWith(`${name}, `) ? where.slice(name.length + 2) : where,
    f.where,
  );

/** A field for all files. @param {Model} m @param {Field} f */
function fieldRow(m, f) {
  const said = m.common.value[f.field];
  const open = m.asks && isOpen(f, said, m.ways.value[f.field]) &&
    (m.files.length === 1 || m.missing.value.some((one) => one.field === f.field));
  const id = `experiment-${f.field}`, system = units.value;
  const value = said !== undefined
    ? saidText(f, said, system)
    : f.value === null || (open && f.origin === "assumed")
    ? ""
    : valueText(f, f.value, system);
  const error = m.wrong.value[f.field] ?? "";
  const file = contradicted(f, said, system);
  const kept = m.kept?.said[f.field];
  /** @param {string} text @param {string} key @param {() => void} act */
  const offer = (text, key, act) =>
    h("button", { type: "button", class: "link", "data-key": `${key} ${f.field}`, onclick: act }, text);
  return h(
    "div",
    {
      class: `question${open ? " open" : ""}${error || file ? " wrong" : ""}`,
      "data-field": `experiment.${f.field}`,
    },
    h(
      "label",
      { for: id, title: f.why },
      f.title,
      f.required ? h("span", { class: "must", "aria-hidden": "true" }, " *") : null,
    ),
    h(
      "span",
      { class: "given" },
      entry(m, f, id, value, Boolean(error)),
      originChip(m, f, said),
    ),
    error ? h("p", { class: "error", id: `${id}-m` }, error) : null,
    file
      ? h(
        "p",
        { class: "error" },
        `The file says ${file}${f.where ? ` (${placeOf(m, f)})` : ""}. `,
        offer(`Back to ${file}`, "back", () => m.say(f, "")),
      )
      : null,
    open ? h("p", { class: "hint" }, f.question) : null,
    open && f.proposed !== null
      ? offer(
        `${valueText(f, f.proposed, system)} is suggested by the data: take it`,
        "suggested",
        () => m.say(f, valueText(f, /** @type {number | string} */ (f.proposed), system), null, "suggested"),
      )
      : null,
    open && kept !== undefined
      ? offer(
        `${saidText(f, kept, system)}, as for ${m.kept?.name}`,
        "kept",
        () => m.say(f, textOf(kept)),
      )
      : null,
    open && f.field === "muscle"
      ? offer(
        "Another muscle: set its geometry later",
        "later",
        () => m.goOn([f.field], "later"),
      )
      : null,
    open && f.value !== null && f.field !== "muscle"
      ? offer(
        `I don’t know: assume ${valueText(f, f.value, system)}, check it later`,
        "assume",
        () => m.goOn([f.field], "assumed"),
      )
      : null,
  );
}

/** Fields whose values are presets. @type {Record<string, () => import("../types.js").Preset[]>} */
const PRESETS = { muscle: () => muscles.value, valve: () => presets.value.valves ?? [] };

/** @param {Model} m @param {Field} f @param {string} id @param {string} value @param {boolean} wrong */
function entry(m, f, id, value, wrong) {
  const change = (/** @type {Event} */ e) => m.say(f, valueOf(e));
  const common = {
    id,
    "data-key": `field ${f.field}`,
    "aria-required": f.required ? "true" : null,
    "aria-invalid": wrong ? "true" : null,
    "aria-describedby": wrong ? `${id}-m` : null,
    onchange: change,
  };
  const known = PRESETS[f.field]?.() ?? [];
  if (f.closed || known.length) {
    const choices = f.choices.length ? f.choices : known.map((one) => one.id);
    const list = value && !choices.includes(value) ? [value, ...choices] : choices;
    const titles = new Map(known.map((one) => [one.id, one.title]));
    return h(
      "select",
      common,
      h("option", { value: "", selected: !value }, value ? "not stated" : "choose…"),
      ...list.map((one) => h("option", { value: one, selected: one === value }, titles.get(one) ?? one)),
    );
  }
  const quantity = f.unit ? quantityOf(f.unit) : null;
  const unit = quantity && quantity !== "number" ? scaleOf(quantity, units.value).unit : "";
  const input = h("input", {
    ...common,
    type: "text",
    autocomplete: "off",
    spellcheck: "false",
    value,
    placeholder: f.example,
    title: unit ? `A number in ${unit}, or a number with a unit` : "",
    list: f.choices.length ? `${id}-list` : null,
  });
  if (!f.choices.length) return input;
  const proposals = f.choices.map((one) => h("option", { value: one }));
  return h("span", { class: "listed" }, input, h("datalist", { id: `${id}-list` }, ...proposals));
}

/** @param {Model} m */
export function experimentFields(m) {
  const all = m.fields.value;
  if (!all.length) return h("p", { class: "muted" }, "Nothing more is needed for this kind of test.");
  const isFirst = (/** @type {Field} */ f) => f.required || f.value !== null || f.proposed !== null;
  const more = all.filter((f) => !isFirst(f));
  const open = [...new Set(m.missing.value.map((one) => one.field))];
  return [
    ...all.filter(isFirst).map((f) => fieldRow(m, f)),
    // A run of a valve is simulated with the rig of the view, which takes a drive document.
    open.length && m.preview.value.points.command
      ? h(
        "button",
        { type: "button", class: "link", "data-key": "drive document", onclick: () => m.goOn(open, "later") },
        "A drive document has all of this: open it in the view",
      )
      : null,
    more.length
      ? h(
        "details",
        { open: more.some((f) => m.common.value[f.field] !== undefined) },
        h("summary", { "data-key": "more fields" }, `More about the experiment (${more.length})`),
        ...more.map((f) => fieldRow(m, f)),
      )
      : null,
    all.some((f) => f.required)
      ? h("p", { class: "hint" }, h("span", { class: "must" }, "* "), "This kind of test needs it.")
      : null,
  ];
}

/** The kind of the test, detected or chosen. @param {Model} m */
export function kindField(m) {
  const p = m.preview.value, chosen = m.mapping.value.kind;
  const auto = chosen ? "as detected" : p.kind ?? "to be detected";
  return h(
    "div",
    { class: "question" },
    h("label", { for: "import-kind" }, "Kind of test"),
    h(
      "span",
      { class: "given" },
      h(
        "select",
        {
          id: "import-kind",
          "data-key": "kind",
          onchange: (/** @type {Event} */ e) =>
            m.change(({ kind: _, ...mapping }) => valueOf(e) ? { ...mapping, kind: valueOf(e) } : mapping),
        },
        h("option", { value: "", selected: !chosen }, auto),
        ...p.kind_choices.filter((kind) => chosen || kind !== p.kind)
          .map((kind) => h("option", { value: kind, selected: kind === chosen }, kind)),
      ),
      h(
        "span",
        { class: "origin", title: p.kind_reason },
        chosen ? "you" : p.kind_detected ? "detected" : p.kind ? "file" : "questions first",
      ),
    ),
  );
}

/** Values that differ from file to file. @param {Model} m */
export function severalFiles(m) {
  if (m.files.length < 2) return null;
  const system = units.value;
  const rest = m.fields.value.find((f) => f.field === "rest_length");
  return h(
    "div",
    { class: "scroll several", tabindex: 0, role: "region", "aria-label": "Files" },
    h(
      "table",
      { class: "data" },
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("th", { scope: "col", class: "text" }, "File"),
          h("th", { scope: "col" }, "Rows"),
          rest ? h("th", { scope: "col", class: "text" }, rest.title) : null,
        ),
      ),
      h(
        "tbody",
        null,
        ...m.files.map((file, i) => {
          const problem = m.problemOf(i), p = m.outcomes.value[i].preview;
          return h(
            "tr",
            { class: problem ? "bad" : "", "data-file": file.name },
            h(
              "th",
              { scope: "row", class: "text" },
              h("button", {
                type: "button",
                class: "link",
                "aria-pressed": String(m.at.value === i),
                "data-key": `file ${i}`,
                title: problem || `Show ${file.name}`,
                onclick: () => (m.at.value = i),
              }, file.name),
              problem ? h("span", { class: "unseen" }, `: ${problem}`) : null,
            ),
            h("td", null, problem ? icon("warn") : p.measurement?.usable_rows ?? p.valid_rows),
            rest ? h("td", { class: "text" }, ownEntry(m, i, system)) : null,
          );
        }),
      ),
    ),
  );
}

/** @param {Model} m @param {number} i @param {import("../format.js").System} system */
function ownEntry(m, i, system) {
  const f = m.fieldsOf(i).find((one) => one.field === "rest_length");
  if (!f) return "";
  const said = m.saidOf(i, f.field), error = m.wrong.value[`${f.field} ${i}`];
  const way = m.ways.value[f.field], open = m.asks && isOpen(f, said, way);
  const assumed = f.origin === "assumed" && said === undefined;
  return h(
    "span",
    { class: "given" },
    h("input", {
      type: "text",
      class: open ? "own needed" : "own",
      "data-key": `own ${i}`,
      "aria-label": `${f.title} of ${m.files[i].name}`,
      "aria-invalid": error ? "true" : null,
      title: error ?? "",
      placeholder: assumed && f.value !== null ? valueText(f, f.value, system) : f.example,
      value: said !== undefined
        ? saidText(f, said, system)
        : f.value === null || assumed
        ? ""
        : valueText(f, f.value, system),
      onchange: (/** @type {Event} */ e) => m.say(f, valueOf(e), i),
    }),
    h(
      "small",
      { class: open ? "needed" : "" },
      error ??
        (m.own.value[i][f.field] !== undefined
          ? "you"
          : said !== undefined
          ? "as above"
          : f.origin === "file"
          ? placeOf(m, f) || "file"
          : way
          ? "assumed"
          : f.origin ?? "missing"),
    ),
  );
}
