// @ts-check
// The measurements card: drop zone, built-in examples, the files and their use.
import { h, icon } from "../../../dom.js";
import { aboutFile } from "../../../server/client.js";
import { references } from "../../../store.js";
import { menuButton } from "../../../ui/menu.js";
import {
  addFiles,
  complaints,
  hasSource,
  importOnceMore,
  infos,
  keptFor,
  openBuiltIn,
  reading,
  removeFile,
  setUse,
} from "./files.js";
import { answer, chosen, fault, files, messageFor } from "../answers.js";
import { preparation } from "./prepare.js";
import { segments } from "../../../ui/segments.js";

/** @typedef {import("../../../types.js").Chosen} Chosen */
/** @typedef {import("../../../types.js").Use} Use */

/** @type {[Use, string, string][]} */
const USES = [
  ["fit", "Fit", "The parameters are fitted to this file"],
  ["validation", "Check", "Validation: only the error on this file is computed"],
  ["off", "Off", "Not used"],
];

/** Opens the browser's file dialog. */
export function chooseFiles() {
  document.getElementById("measurement-files")?.click();
}

export const builtIn = () => references.value.filter((r) => r.kind === "measurement");

/** @param {string} name */
const examplesMenu = (name) =>
  menuButton({
    label: [name, icon("down")],
    name: "Built-in measurements",
    class: "small",
    items: () => {
      const all = builtIn();
      if (!all.length) return [{ heading: "No measurements on this server" }];
      return all.map((m) => ({ label: m.title, note: m.description, run: () => openBuiltIn(m.id) }));
    },
  });

/** The number of rows used, and why others are left out. @param {Chosen} file */
function rowsText(file) {
  const info = infos.value.get(file.id);
  if (!info) {
    const preset = references.value.find((r) => r.id === file.id);
    return preset?.description ?? "";
  }
  const out = Object.entries({ ...info.skipped, ...info.excluded });
  const left = out.length ? `; left out: ${out.map(([why, n]) => `${n} ${why}`).join(", ")}` : "";
  const unread = Object.values(info.skipped).reduce((sum, n) => sum + n, 0);
  return `${info.usable_rows} of ${info.rows + unread} rows${left}`;
}

/** @param {Chosen} file */
function kindText(file) {
  const info = infos.value.get(file.id);
  if (info) return `${info.kind}${info.kind_detected ? ", detected" : ""}`;
  const preset = /** @type {any} */ (references.value.find((r) => r.id === file.id));
  return preset?.measurement_kind ?? "";
}

/** @param {Chosen} file @param {number} index */
function fileRow(file, index) {
  const messages = () => infos.value.get(file.id)?.messages ?? [];
  return h(
    "li",
    { class: `file${file.use === "off" ? " off" : ""}`, "data-file": file.id },
    h(
      "div",
      { class: "file-head" },
      h("b", { title: file.name }, file.name),
      () =>
        hasSource(file.id)
          ? h("button", { type: "button", class: "link", onclick: () => importOnceMore(file.id) }, "Import…")
          : null,
      h("button", {
        type: "button",
        class: "mini",
        "aria-label": `Remove ${file.name}`,
        onclick: () => removeFile(file.id),
      }, icon("close")),
    ),
    segments(`Use of ${file.name}`, USES, () => file.use, (id) => setUse(file.id, id)),
    h("p", { class: "muted" }, () => [kindText(file), rowsText(file)].filter(Boolean).join(" · ")),
    () => {
      const kept = keptFor(file.id);
      if (!kept) return null;
      return h(
        "p",
        { class: "muted kept" },
        `Mapping of ${kept.name} used. `,
        h("button", { type: "button", class: "link", onclick: () => importOnceMore(file.id, true) }, "Undo"),
      );
    },
    preparation(file),
    h("p", { class: "error" }, () => messageFor(`measurements.${index}`) ?? ""),
    () =>
      messages().length
        ? h(
          "details",
          null,
          h("summary", null, "Assumptions"),
          h("ul", { class: "plain muted" }, ...messages().map((text) => h("li", null, text))),
        )
        : null,
  );
}

/** What the comparison left out of all files together, unless a single file shows it already. */
function leftOut() {
  const a = answer.value, all = chosen.value;
  if (!a || fault.value || !all.length) return null;
  const out = Object.entries(a.excluded);
  const info = all.length === 1 ? infos.value.get(all[0].id) : undefined;
  if (info && out.every(([why]) => why in info.skipped || why in info.excluded)) return null;
  const why = out.length ? `; left out: ${out.map(([text, n]) => `${n} ${text}`).join(", ")}` : "";
  return h("p", { class: "muted" }, `Compared: ${a.rows_used} of ${a.rows} rows${why}.`);
}

/** What is wrong with files that were brought. */
export const complaintNotices = () =>
  complaints.value.map(({ name, words }) =>
    h(
      "p",
      { class: "flag bad", role: "alert" },
      icon("warn"),
      h("span", null, h("b", null, name), `: ${aboutFile(name, words)}`),
    )
  );

export function measurementsCard() {
  const input = h("input", {
    type: "file",
    hidden: true,
    multiple: true,
    id: "measurement-files",
    "aria-label": "Measurement files",
    accept: ".csv,.txt,.tsv,.dat,.asc,.log,.lvm,.md,.json,.jsonl,.xlsx,.mat,.h5,.hdf5,.tdms,text/csv",
    onchange: () => {
      const list = [...input.files ?? []];
      input.value = "";
      addFiles(list);
    },
  });
  return h(
    "section",
    { class: "card measurements", "aria-label": "Measurements" },
    h("div", { class: "card-head" }, h("h2", null, "Measurements"), examplesMenu("Built-in")),
    input,
    h(
      "button",
      { type: "button", class: "drop", onclick: chooseFiles },
      h(
        "span",
        null,
        () => reading.value ? `Reading ${reading.value}…` : "Choose files, or drop them on the page",
      ),
      h("small", null, "CSV, JSON, .xlsx, .mat, .h5, .tdms"),
    ),
    () => files.value.length ? h("ul", { class: "files" }, ...files.value.map(fileRow)) : null,
    leftOut,
  );
}
