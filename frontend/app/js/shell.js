// @ts-check
// The bar above every view: tabs, undo, units, export, link, theme, help; and the status line.
import { h, icon } from "./dom.js";
import { left, linkOf, PARTLY } from "./link.js";
import { setTheme, themeChoice } from "./plots/theme.js";
import { projectButton } from "./projects/menu.js";
import { apart } from "./reactive.js";
import { compiling, connection, look } from "./server/connection.js";
import { deleted, lookForMissing, lostPresets, missing, restoreDeleted } from "./server/missing.js";
import { loadAll } from "./server/presets.js";
import { doc, edit, future, goTo, past, units, view } from "./state.js";
import { outage, status } from "./store.js";
import { openDialog } from "./ui/dialog.js";
import { redoAndReport, undoAndReport } from "./ui/history.js";
import { menuButton } from "./ui/menu.js";

/** A tab. `exports`: what the Export menu offers besides the document; `files`: other JSON files that are opened
 * here; `choose`: asks for a measurement that the server has no more.
 * @typedef {{id: string, title: string, build: () => HTMLElement, exports: () => import("./ui/menu.js").Item[],
 *   files?: import("./ui/files.js").Opener[], choose?: () => unknown}} View */

/** @type {Record<import("./format.js").System, string>} */
const SYSTEMS = { si: "SI", bar: "bar · mm", us: "US" };

/** What the banner says. */
const WORDS = {
  gone:
    "The server does not answer. Is “mckibben serve” still running? The page tries again by itself; what you " +
    "entered stays. Dimmed plots show the state before.",
  locked:
    "The server was started with another token. Open the link that “mckibben serve” has printed: this page then " +
    "goes on by itself, and what you entered stays.",
  slow: "The server takes long to answer. Dimmed plots show the state before.",
  compiling:
    "The server compiles the simulation for this machine. That takes about half a minute, once after an " +
    "installation; what needs it waits.",
};

export async function share() {
  const url = new URL(location.href), { hash, left: less } = await linkOf(doc.peek());
  if (less === "all") {
    status.value =
      "This work is too long for a link. Export, Save JSON writes it to a file that opens here again.";
    return;
  }
  url.hash = hash;
  try {
    await navigator.clipboard.writeText(url.href);
    status.value = less
      ? `Link copied: it ${PARTLY[less]}. To hand on everything: Export, Save JSON.`
      : "Link copied: it holds the whole state of this page.";
  } catch {
    // Without permission for the clipboard the link is shown, so that the user can copy it.
    const field = h("input", { type: "text", readonly: true, value: url.href, "aria-label": "Link" });
    openDialog({ title: "Link to this state" }, field);
    field.select();
  }
}

/** @param {View[]} views */
const exportItems = (views) => () => [
  ...views.find((v) => v.id === view.peek())?.exports() ?? [],
  { heading: "Document" },
  {
    label: "Save JSON",
    note: "opens here again",
    run: async () => (await import("./ui/files.js")).saveDocument(),
  },
  {
    label: "Open JSON…",
    run: async () => (await import("./ui/files.js")).chooseDocument(views.flatMap((v) => v.files ?? [])),
  },
];

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

/** @param {View[]} views
 * @param {{examples: () => import("./ui/menu.js").Item[], help: () => void}} o */
export function shell(views, { examples, help }) {
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
    { "data-view": () => view.value },
    h("h1", { class: "brand" }, mark(), "mckibben"),
    h(
      "nav",
      { "aria-label": "Views" },
      ...views.map((v) =>
        h("button", {
          type: "button",
          "data-title": v.title,
          "data-short": v.title.split(" ")[0],
          "aria-current": () => view.value === v.id ? "page" : null,
          onclick: () => goTo(v.id),
        }, named(v.title))
      ),
    ),
    projectButton(),
    menuButton({ label: ["Examples", icon("down")], name: "Examples", class: "quiet", items: examples }),
    h("span", { class: "space" }),
    h(
      "span",
      { class: "history" },
      historyButton(() => past.value.at(-1)?.label, "undo", undoAndReport, "Ctrl+Z"),
      historyButton(() => future.value.at(-1)?.label, "redo", redoAndReport, "Ctrl+Shift+Z"),
    ),
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
      {
        type: "button",
        onclick: share,
        title: () => `Copy a link that ${left.value ? PARTLY[left.value] : "restores everything"}`,
      },
      icon("share"),
      h("span", { class: "wide" }, "Share"),
    ),
    menuButton({ label: icon("system"), name: "Theme", class: "quiet", items: themeItems }),
    h("button", {
      type: "button",
      class: "quiet",
      "aria-label": "Keyboard shortcuts and reference",
      title: "Keyboard and reference  (?)",
      onclick: help,
    }, icon("help")),
  );
  const banner = () => {
    const now = connection.value;
    if (now === "up" && !outage.value && missing.value.length) return missingBanner(views);
    if (now === "up" && !outage.value && lostPresets.value.length) return lostBanner();
    const text = now === "up" ? outage.value : WORDS[now === "slow" && compiling.value ? "compiling" : now];
    return text
      ? h(
        "div",
        { class: `banner ${now}`, role: now === "slow" ? "status" : "alert" },
        icon("warn"),
        h("span", null, text),
        now === "slow"
          ? null
          : h("button", { type: "button", onclick: now === "up" ? loadAll : look }, "Try again"),
      )
      : null;
  };
  return { bar, main, show, banner, status: h("p", { role: "status", class: "status" }, () => status.value) };
}

/** A title; where there is little room its first word stands alone. @param {string} title */
function named(title) {
  const [first, ...rest] = title.split(" ");
  return h("span", null, first, rest.length ? h("span", { class: "rest" }, ` ${rest.join(" ")}`) : null);
}

function lostBanner() {
  const names = lostPresets.value.map(({ kind, id }) => `the ${kind} “${id}”`).join(" and ");
  return h(
    "div",
    { class: "banner missing", role: "alert" },
    icon("warn"),
    h(
      "span",
      null,
      `The server does not have ${names}: deleted, or it runs with another data folder. Choose another one in the `,
      "inputs, or restore it in the Catalogue under Kept; the rest of your work stays.",
    ),
    h("button", { type: "button", onclick: loadAll }, "Look again"),
  );
}

/** @param {View[]} views */
function missingBanner(views) {
  const names = [...new Set(missing.value.map(({ name }) => `“${name}”`))], one = names.length === 1;
  const first = views.find(({ id }) => id === missing.value[0].view);
  const run = (/** @type {() => Promise<unknown>} */ work) => () =>
    work().catch((error) => (status.value = error.words ?? String(error)));
  return h(
    "div",
    { class: "banner missing", role: "alert" },
    icon("warn"),
    h(
      "span",
      null,
      `The server does not have ${names.join(", ")}: ${
        one ? "it was" : "they were"
      } deleted, or it runs with another `,
      `data folder. Choose the file${
        one ? "" : "s"
      } again; the model and what you said of the experiment stay.`,
    ),
    h("button", { type: "button", onclick: () => first?.choose?.() }, `Choose the file${one ? "" : "s"}…`),
    deleted.value.length
      ? h("button", { type: "button", onclick: run(restoreDeleted) }, "Restore")
      : h("button", { type: "button", onclick: run(lookForMissing) }, "Look again"),
  );
}

function mark() {
  return h("img", { src: "/icon.svg", alt: "", width: 22, height: 22 });
}
