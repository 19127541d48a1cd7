// @ts-check
// The start: read the link, build the page, then fetch Plotly (4.8 MB), which the page does not wait for.
import { effect } from "./reactive.js";
import { append, h } from "./dom.js";
import { doc } from "./state.js";
import { fromHash, toHash } from "./link.js";
import { get } from "./server/client.js";
import { loadAll, status } from "./store.js";
import { control, listenToKeys, plain, showShortcuts } from "./ui/shortcuts.js";
import { goTo, redoAndTell, shell, undoAndTell } from "./shell.js";
import { designView } from "./views/design/index.js";
import { plotlyReady } from "./views/design/charts.js";
import { TASK_KEYS } from "./views/sizing/index.js";
import { TRANSIENT_KEYS, transientExports, transientView } from "./views/transient/index.js";
import { COMPARE_KEYS, compareExports, compareView, listenToDrops } from "./views/compare/index.js";
import { catalogueView } from "./views/catalogue/index.js";

/** The tabs. A new view is one line here. @type {import("./shell.js").View[]} */
const VIEWS = [
  { id: "design", title: "Design", build: designView },
  { id: "transient", title: "Transient", build: transientView, exports: transientExports },
  { id: "compare", title: "Compare & diagnose", build: compareView, exports: compareExports },
  { id: "catalogue", title: "Catalogue", build: catalogueView },
];

/** @type {import("./ui/shortcuts.js").Shortcut[]} */
const KEYS = [
  { keys: "?", what: "This list", match: plain("?"), run: () => showShortcuts(KEYS) },
  ...VIEWS.map((v, i) => ({
    keys: String(i + 1),
    what: v.title,
    match: plain(String(i + 1)),
    run: () => goTo(v.id),
  })),
  ...TASK_KEYS,
  ...TRANSIENT_KEYS,
  ...COMPARE_KEYS,
  { keys: "Ctrl Z", what: "Undo", match: control("z"), run: undoAndTell },
  { keys: "Ctrl Shift Z", what: "Redo", match: control("z", true), run: redoAndTell },
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
    status.value = `The link cannot be read: ${why}. Here is the example design instead.`;
  }
}

/** The address always holds the newest document; it follows at rest: browsers allow few changes a second. */
function writeLink() {
  let timer = 0, own = location.hash;
  effect(() => {
    const state = doc.value;
    clearTimeout(timer);
    timer = setTimeout(async () => {
      own = await toHash(state);
      if (state === doc.peek()) history.replaceState(null, "", own);
    }, LINK_MS);
  });
  addEventListener("hashchange", () => {
    if (location.hash !== own && location.hash !== "#main") readLink();
  });
}

/** Plotly as a script element put in after the first paint: a deferred one would hold the modules back. */
async function fetchPlotly() {
  const { plotly = "" } = await get("/api/health").catch(() => ({}));
  const script = document.createElement("script");
  script.src = `/vendor/plotly.min.js${plotly ? `?v=${encodeURIComponent(plotly)}` : ""}`;
  script.addEventListener("load", () => (plotlyReady.value = true));
  script.addEventListener("error", () => {
    status.value = "The plotting library did not load; numbers and tables work without it.";
  });
  document.head.append(script);
}

/** A fault of the program itself must not leave a blank page. @param {unknown} error */
function showFault(error) {
  const text = `The page could not be built: ${error instanceof Error ? error.message : error}. `;
  const again = h("a", { href: "/" }, "Start again with the example");
  document.getElementById("app")?.replaceChildren(h("p", { class: "loading", role: "alert" }, text, again));
}

function start() {
  const { bar, main, show, banner, status: line } = shell(VIEWS, () => showShortcuts(KEYS));
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
  showFault(error);
  throw error;
}
