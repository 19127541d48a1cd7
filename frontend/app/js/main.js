// @ts-check
// The start: read the link, build the page, then load Plotly.
import { designTab } from "./design-tab.js";
import { append, h } from "./dom.js";
import { fromHash, toHash } from "./link.js";
import { fetchPlotly } from "./plots/library.js";
import { effect } from "./reactive.js";
import { loadAll } from "./server/presets.js";
import { shell } from "./shell.js";
import { doc, goTo } from "./state.js";
import { status } from "./store.js";
import { redoAndReport, undoAndReport } from "./ui/history.js";
import { control, listenToKeys, plain, showShortcuts } from "./ui/shortcuts.js";
import { catalogueView } from "./views/catalogue/index.js";
import { COMPARE_KEYS, compareExports, compareView, listenToDrops } from "./views/compare/index.js";
import { designExamples, designExports } from "./views/design/index.js";
import { TASK_KEYS, taskFiles } from "./views/sizing/index.js";
import { driveFiles, TRANSIENT_KEYS, transientExports, transientView } from "./views/transient/index.js";

/** The tabs. A new view is one line here. @type {import("./shell.js").View[]} */
const TABS = [
  { id: "design", title: "Design", build: designTab, exports: designExports, files: [taskFiles] },
  {
    id: "transient",
    title: "Transient",
    build: transientView,
    exports: transientExports,
    files: [driveFiles],
  },
  { id: "compare", title: "Compare & diagnose", build: compareView, exports: compareExports },
  { id: "catalogue", title: "Catalogue", build: catalogueView, exports: designExports },
];

const showKeys = () => showShortcuts(KEYS);

/** @type {import("./ui/shortcuts.js").Shortcut[]} */
const KEYS = [
  { keys: "?", what: "This list", match: plain("?"), run: showKeys },
  ...TABS.map((tab, i) => ({
    keys: String(i + 1),
    what: tab.title,
    match: plain(String(i + 1)),
    run: () => goTo(tab.id),
  })),
  ...TASK_KEYS,
  ...TRANSIENT_KEYS,
  ...COMPARE_KEYS,
  { keys: "Ctrl Z", what: "Undo", match: control("z"), run: undoAndReport },
  { keys: "Ctrl Shift Z", what: "Redo", match: control("z", true), run: redoAndReport },
  {
    keys: "/",
    what: "Search effects, or the catalogue",
    match: plain("/"),
    run: () => {
      const fields = [...document.querySelectorAll("input[type=search]")];
      /** @type {HTMLElement | undefined} */ (fields.find((el) => el.checkVisibility()))?.focus();
    },
  },
];

const LINK_MS = 250;

async function readLink() {
  try {
    const linked = await fromHash(location.hash);
    if (linked) doc.value = linked;
  } catch (error) {
    const why = /** @type {Error} */ (error).message;
    status.value = `The link cannot be read: ${why}. The example design is shown instead.`;
  }
}

/** Keeps the address up to date. Browsers allow few changes of it per second, so it waits for a pause. */
function writeLink() {
  let timer = 0, written = location.hash;
  effect(() => {
    const state = doc.value;
    clearTimeout(timer);
    timer = setTimeout(async () => {
      written = await toHash(state);
      if (state === doc.peek()) history.replaceState(null, "", written);
    }, LINK_MS);
  });
  addEventListener("hashchange", () => {
    if (location.hash !== written && location.hash !== "#main") readLink();
  });
}

/** An error of the program itself must not leave a blank page. @param {unknown} error */
function showError(error) {
  const text = `The page could not be built: ${error instanceof Error ? error.message : error}. `;
  const again = h("a", { href: "/" }, "Start again with the example");
  document.getElementById("app")?.replaceChildren(h("p", { class: "loading", role: "alert" }, text, again));
}

function start() {
  const { bar, main, show, banner, status: line } = shell(TABS, { examples: designExamples, help: showKeys });
  const app = /** @type {HTMLElement} */ (document.getElementById("app"));
  app.replaceChildren(bar);
  append(app, banner);
  app.append(main, line);
  effect(show);
  listenToKeys(KEYS);
  listenToDrops();
  writeLink();
  loadAll();
  requestAnimationFrame(() => setTimeout(fetchPlotly));
  performance.mark("usable");
  document.documentElement.dataset.ready = "1";
}

await readLink();
try {
  start();
} catch (error) {
  showError(error);
  throw error;
}
