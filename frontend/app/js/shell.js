// @ts-check
// The bar over every view: tabs, history, units, export, share, theme, help, status.
import { h, icon } from "./dom.js";
import { apart } from "./reactive.js";
import { doc, edit, future, look, past, readDoc, redo, undo, units, view } from "./state.js";
import { toHash } from "./link.js";
import { loadAll, outage, presets, status } from "./store.js";
import { setTheme, themeChoice } from "./plots/theme.js";
import { menuButton } from "./ui/menu.js";
import { openDialog } from "./ui/dialog.js";
import { downloadText, toCsv } from "./ui/table.js";
import { saveSheet } from "./plots/export.js";
import { charts } from "./views/design/charts.js";
import { curvesTable } from "./views/design/curves-table.js";
import { openExample } from "./views/design/examples.js";
import { isTaskDocument } from "./views/sizing/document.js";
import { isDriveDocument } from "./views/transient/document.js";

/** `exports`: what the Export menu offers besides the document; without, that of the Design view.
 * @typedef {{id: string, title: string, build: () => HTMLElement,
 *   exports?: () => import("./ui/menu.js").Item[]}} View */

/** @type {Record<import("./format.js").System, string>} */
const SYSTEMS = { si: "SI", bar: "bar · mm", us: "US" };

export const undoAndTell = () => tell(undo(), "Undone");
export const redoAndTell = () => tell(redo(), "Redone");
/** @param {string | null} label @param {string} verb */
function tell(label, verb) {
  if (label) status.value = `${verb}: ${label}`;
}

export async function share() {
  const url = new URL(location.href);
  url.hash = await toHash(doc.peek());
  history.replaceState(null, "", url);
  try {
    await navigator.clipboard.writeText(url.href);
    status.value = "Link copied: it holds the whole state of this page.";
  } catch {
    // Without permission for the clipboard the link is shown, to be copied by hand.
    const field = h("input", { type: "text", readonly: true, value: url.href, "aria-label": "Link" });
    openDialog({ title: "Link to this state" }, field);
    field.select();
  }
}

const stamp = () => new Date().toISOString().slice(0, 10);

function saveJson() {
  downloadText(`mckibben-${stamp()}.json`, JSON.stringify(doc.peek(), null, 2) + "\n", "application/json");
}

/** @param {File | undefined} file */
async function openJson(file) {
  if (!file) return;
  try {
    if (file.size > 1e6) throw new Error("it is larger than any document of this program");
    const raw = JSON.parse(await file.text());
    if (isDriveDocument(raw)) {
      const { openDrive } = await import("./views/transient/model.js");
      openDrive(raw, null, `open ${file.name}`);
    } else if (isTaskDocument(raw)) {
      const { openTask } = await import("./views/sizing/model.js");
      openTask(raw, `open ${file.name}`);
    } else {
      const opened = readDoc(raw);
      edit(() => opened, `open ${file.name}`);
    }
    status.value = `Opened ${file.name}.`;
  } catch (error) {
    const why = error instanceof SyntaxError ? "it is not JSON" : /** @type {Error} */ (error).message;
    status.value = `${file.name} cannot be opened: ${why}.`;
  }
}

function chooseFile() {
  const input = h("input", { type: "file", accept: ".json,application/json" });
  input.addEventListener("change", () => openJson(input.files?.[0]));
  input.click();
}

/** @param {"png" | "svg"} format */
async function savePlots(format) {
  try {
    await saveSheet(charts, format, `mckibben-plots-${stamp()}`);
  } catch (error) {
    status.value = `The plots could not be saved: ${/** @type {Error} */ (error).message}`;
  }
}

const designExports = () => [
  {
    label: "Curves as CSV",
    note: "all values, shown units",
    run: () => downloadText(`mckibben-curves-${stamp()}.csv`, toCsv(curvesTable()), "text/csv"),
  },
  { label: "Plots as PNG", note: "one sheet", run: () => savePlots("png") },
  { label: "Plots as SVG", note: "one sheet", run: () => savePlots("svg") },
];

/** @param {View[]} views */
const exportItems = (views) => () => [
  ...(views.find((v) => v.id === view.peek())?.exports ?? designExports)(),
  { heading: "Document" },
  { label: "Save JSON", note: "opens here again", run: saveJson },
  { label: "Open JSON…", run: chooseFile },
];

const exampleItems = () => {
  const designs = presets.peek().designs ?? [];
  if (!designs.length) return [{ heading: "No example documents on this server" }];
  return designs.map((d) => ({ label: d.title, note: d.description, run: () => openExample(d) }));
};

/** @param {() => string | undefined} label @param {"undo" | "redo"} name @param {() => void} run
 * @param {string} keys */
function historyButton(label, name, run, keys) {
  const text = () => {
    const step = label();
    const verb = name === "undo" ? "Undo" : "Redo";
    return step ? `${verb}: ${step}  (${keys})` : `Nothing to ${name}`;
  };
  return h("button", {
    type: "button",
    class: "quiet",
    "aria-label": text,
    title: text,
    disabled: () => !label(),
    onclick: run,
  }, icon(name));
}

const themeItems = () =>
  /** @type {const} */ ([["system", "As the system"], ["light", "Light"], ["dark", "Dark"]]).map((
    [id, label],
  ) => ({
    label,
    checked: themeChoice.peek() === id,
    run: () => setTheme(id),
  }));

/** @param {View[]} views @param {() => void} help */
export function shell(views, help) {
  /** @type {Map<string, HTMLElement>} */
  const built = new Map();
  const main = h("main", { id: "main", tabindex: -1 });
  const show = () => {
    const chosen = views.find((v) => v.id === view.value) ?? views[0];
    if (!built.has(chosen.id)) {
      const el = apart(chosen.build);
      built.set(chosen.id, el);
      main.append(el);
    }
    built.forEach((el, id) => (el.hidden = id !== chosen.id));
    document.title = `${chosen.title} · mckibben`;
  };
  const bar = h(
    "header",
    null,
    h("h1", { class: "brand" }, mark(), "mckibben"),
    h(
      "nav",
      { "aria-label": "Views" },
      ...views.map((v) =>
        h("button", {
          type: "button",
          "aria-current": () => view.value === v.id ? "page" : null,
          onclick: () => goTo(v.id),
        }, v.title)
      ),
    ),
    menuButton({ label: ["Examples", icon("down")], name: "Examples", class: "quiet", items: exampleItems }),
    h("span", { class: "space" }),
    historyButton(() => past.value.at(-1)?.label, "undo", undoAndTell, "Ctrl+Z"),
    historyButton(() => future.value.at(-1)?.label, "redo", redoAndTell, "Ctrl+Shift+Z"),
    h(
      "select",
      {
        "aria-label": "Units",
        title: "Units",
        onchange: (/** @type {Event} */ e) => {
          const system = /** @type {import("./format.js").System} */ (/** @type {any} */ (e.target).value);
          edit((d) => ({ ...d, units: system }), `units ${SYSTEMS[system]}`);
        },
      },
      () =>
        Object.entries(SYSTEMS).map(([id, name]) =>
          h("option", { value: id, selected: units.value === id }, name)
        ),
    ),
    menuButton({
      label: [icon("export"), h("span", { class: "wide" }, "Export")],
      name: "Export",
      items: exportItems(views),
    }),
    h(
      "button",
      { type: "button", onclick: share, title: "Copy a link that restores everything" },
      icon("share"),
      h("span", { class: "wide" }, "Share"),
    ),
    menuButton({ label: icon("system"), name: "Theme", class: "quiet", items: themeItems }),
    h("button", {
      type: "button",
      class: "quiet",
      "aria-label": "Keyboard shortcuts",
      title: "Keyboard  (?)",
      onclick: help,
    }, icon("help")),
  );
  const banner = () =>
    outage.value
      ? h(
        "div",
        { class: "banner", role: "alert" },
        icon("warn"),
        h("span", null, outage.value),
        h("button", { type: "button", onclick: loadAll }, "Try again"),
      )
      : null;
  return { bar, main, show, banner, status: h("p", { role: "status", class: "status" }, () => status.value) };
}

/** @param {string} id */
export const goTo = (id) => look((d) => ({ ...d, view: id }));

function mark() {
  return h("img", { src: "/icon.svg", alt: "", width: 22, height: 22 });
}
