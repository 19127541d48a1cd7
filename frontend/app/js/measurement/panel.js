// @ts-check
// The panel of an import: how the files are read (1), and the experiment behind them (2).
import { h, icon } from "../dom.js";
import { apart, computed, effect } from "../reactive.js";
import { units } from "../state.js";
import { connection } from "../server/connection.js";
import { openDialog } from "../ui/dialog.js";
import { heldList, questionList, questionsOf, rowCounts, unreadList } from "./asks.js";
import { withPlace } from "./choices.js";
import { countingRows } from "./columns.js";
import { experimentFields, kindField, severalFiles } from "./experiment.js";
import { importModel } from "./model.js";
import { axesOf, picture, plausibility, titleOf } from "./picture.js";
import { rawTable } from "./raw.js";

/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./model.js").Start} Start */
/** @typedef {import("./types.js").Imported} Imported */

/** Shows how files are read and what is known of their experiment; null: cancelled.
 * @param {Start} start @returns {Promise<Imported[] | null>} */
export function openImport(start) {
  return new Promise((resolve) => {
    /** @type {Imported[] | null} */
    let result = null;
    const model = apart(() => importModel(start));
    const { files } = start, many = files.length > 1;
    const use = () => {
      if (!model.ready.peek()) return;
      result = model.result();
      dialog.close();
    };
    const accept = h("button", {
      type: "button",
      class: "primary",
      disabled: () => !model.ready.value,
      onclick: use,
    }, many ? `Use these ${files.length} files` : "Use this file");
    const [body, foot] = apart(() => [
      h("div", { class: "import-body" }, tablePart(model), experimentPart(model)),
      h(
        "div",
        { class: "foot" },
        h("small", null, "Kept in this browser for the next file of this kind."),
        h("p", { class: "state-now", role: "status" }, () => stateNow(model)),
        h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
        accept,
      ),
    ]);
    const title = many ? `How ${files.length} files are read` : `How ${files[0].name} is read`;
    const dialog = openDialog({ title, wide: true, outside: false }, body);
    dialog.classList.add("import");
    dialog.append(foot);
    const forget = apart(() => keepFocus(dialog, model));
    begin(dialog, model, accept);
    dialog.addEventListener("close", () => {
      forget();
      model.stop();
      resolve(result);
    });
  });
}

/** Where the user begins: at the first thing to answer, else at the button. @param {HTMLElement} dialog
 * @param {Model} model @param {HTMLElement} accept */
function begin(dialog, model, accept) {
  const open = model.ready.peek() ? null : dialog.querySelector(
    ".ask:not(.may-wait, .assumed) button, .unread .open input, .question.open input, .question.open select",
  );
  const first = open ?? (model.ready.peek() ? accept : dialog.querySelector(".import-body select"));
  if (first instanceof HTMLElement) first.focus({ preventScroll: first === accept });
}

/** Elements are built anew with every answer: the one with the same key takes the focus of the old one.
 * @param {HTMLElement} dialog @param {Model} model @returns {() => void} */
function keepFocus(dialog, model) {
  let last = "";
  dialog.addEventListener("focusin", (e) => {
    last = e.target instanceof HTMLElement ? e.target.dataset.key ?? "" : "";
  });
  dialog.addEventListener("keydown", (e) => {
    const isField = e.target instanceof HTMLInputElement && e.target.type === "text";
    if (e.key === "Enter" && isField && !e.isComposing) setTimeout(() => moveOn(dialog));
  });
  return effect(() => {
    [model.preview, model.mapping, model.common, model.own, model.ways, model.wrong, model.at, units]
      .forEach((one) => one.value);
    queueMicrotask(() => {
      if (!last || dialog.contains(document.activeElement) && document.activeElement !== dialog) return;
      const same = dialog.querySelector(`[data-key="${CSS.escape(last)}"]`);
      if (same instanceof HTMLElement) same.focus({ preventScroll: true });
      else moveOn(dialog); // what was answered is gone
    });
  });
}

/** To the next question, or to the button. @param {HTMLElement} dialog */
function moveOn(dialog) {
  const next =
    dialog.querySelector(".ask:not(.may-wait, .assumed) button, .question.open :is(input, select)") ??
      dialog.querySelector(".foot .primary:not(:disabled)") ?? dialog.querySelector(".dialog-body");
  if (next instanceof HTMLElement) next.focus();
}

/** What is still open, in a sentence. @param {Model} m */
function stateNow(m) {
  if (m.failure()) return h("span", { class: "error" }, m.failure());
  if (m.isReading()) return connection.value === "up" ? "Reading…" : "Waiting for the server…";
  const bad = m.files.filter((_, i) => m.problemOf(i));
  const asked = questionsOf(m).filter((q) => q.stops).length;
  const titles = [...new Set(m.missing.value.map((one) => one.title.toLowerCase()))];
  const parts = [
    asked ? `${asked} question${asked === 1 ? "" : "s"} open` : "",
    bad.length && !asked
      ? (m.files.length > 1 ? `${bad.length} of ${m.files.length} files cannot be read` : "")
      : "",
    titles.length ? `missing: ${titles.join(", ")}` : "",
    Object.keys(m.wrong.value).length ? "an entry cannot be used" : "",
  ].filter(Boolean);
  return parts.length ? h("b", null, parts.join("; ")) : "";
}

/** @param {Model} m */
const tablePart = (m) =>
  h(
    "section",
    { class: "import-table", "aria-label": "Table" },
    h("h3", null, h("span", { class: "step-number" }, 1), "Table"),
    () => keptNote(m),
    () => fileChoice(m),
    () => tableTabs(m),
    h("div", { class: "asks", "aria-live": "polite" }, () =>
      problemNote(m), () =>
      heldList(m), () =>
      questionList(m)),
    () =>
      rawTable(m),
    () =>
      rowCounts(m),
    h("div", { class: "countings" }, () => countingRows(m)),
    h("div", { class: "unread-part" }, () => unreadList(m)),
    () => remarks(m),
  );

/** @param {Model} m */
function experimentPart(m) {
  const drawn = computed(() => axesOf(m.preview.value));
  return h(
    "section",
    { class: "import-experiment", "aria-label": "Experiment" },
    h("h3", { class: "looks" }, () => drawn.value ? titleOf(drawn.value) : "What it looks like"),
    () => picture(m.preview.value, units.value),
    () => {
      const seen = plausibility(m.preview.value);
      if (!seen) return null;
      return h(
        "p",
        { class: `plausible ${seen.good ? "good" : "doubt"}` },
        icon(seen.good ? "check" : "warn"),
        seen.text,
      );
    },
    h("h3", null, h("span", { class: "step-number" }, 2), "The experiment"),
    () => severalFiles(m),
    () => kindField(m),
    () => experimentFields(m),
  );
}

/** @param {Model} m */
function keptNote(m) {
  if (!m.kept) return null;
  return h(
    "p",
    { class: "kept" },
    icon("info"),
    m.usesKept.value
      ? h("span", null, `Read as ${m.kept.name}, a file of the same kind.`)
      : h("span", null, "Read without the mapping of the file before."),
    m.usesKept.value
      ? h("button", { type: "button", class: "link", "data-key": "undo kept", onclick: m.undoKept }, "Undo")
      : null,
  );
}

/** Which of several files is shown. @param {Model} m */
function fileChoice(m) {
  if (m.files.length < 2) return null;
  return h(
    "p",
    { class: "file-choice" },
    h("label", { for: "import-file" }, `${m.files.length} files of one kind; shown is`),
    h(
      "select",
      {
        id: "import-file",
        "data-key": "file",
        onchange: (/** @type {Event} */ e) =>
          m.at.value = Number(/** @type {HTMLSelectElement} */ (e.target).value),
      },
      ...m.files.map((file, i) => h("option", { value: i, selected: i === m.at.value }, file.name)),
    ),
  );
}

/** The sheets, groups or structs of the file. @param {Model} m */
function tableTabs(m) {
  const { tables } = m.preview.value;
  if (tables.length < 2) return null;
  return h(
    "div",
    { class: "segments tables", role: "group", "aria-label": "Tables of the file" },
    ...tables.map((table) =>
      h("button", {
        type: "button",
        "aria-pressed": String(table.is_read),
        "data-key": `table ${table.name}`,
        title: table.is_read ? "It is read" : "Read this one",
        onclick: () => m.change((mapping) => withPlace(mapping, { sheet: table.name })),
      }, table.name)
    ),
  );
}

/** @param {Model} m */
function problemNote(m) {
  const problem = m.problemOf(m.at.value);
  const answered = questionsOf(m).some((q) => q.stops) && !m.outcomes.value[m.at.value].wrong;
  // The questions below say the same, with their answers.
  if (!problem || answered) return null;
  return h("p", { class: "flag bad", role: "alert" }, icon("warn"), h("span", null, `${problem}.`));
}

/** What a remark says at its end to users of the command line. */
const OPTION = / \(--[^()]*\)$/;

/** @param {Model} m */
function remarks(m) {
  const { messages } = m.preview.value;
  if (!messages.length) return null;
  return h(
    "details",
    null,
    h("summary", { "data-key": "remarks" }, `Remarks on the reading (${messages.length})`),
    h("ul", { class: "plain muted" }, ...messages.map((text) => h("li", null, text.replace(OPTION, "")))),
  );
}
