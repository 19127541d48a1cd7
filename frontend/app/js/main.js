// @ts-check
// The start: read the address, build the page, then load Plotly.
import { continueWith, lastWork, readAddress, writeAddress } from "./address.js";
import { designTab } from "./design-tab.js";
import { append, h } from "./dom.js";
import { fetchPlotly } from "./plots/library.js";
import { projectCommands } from "./projects/menu.js";
import { followProject } from "./projects/session.js";
import { effect } from "./reactive.js";
import { look } from "./server/connection.js";
import { loadAll } from "./server/presets.js";
import { share, shell } from "./shell.js";
import { goTo } from "./state.js";
import { setTheme } from "./plots/theme.js";
import { redoAndReport, undoAndReport } from "./ui/history.js";
import { control, listenToKeys, plain, showShortcuts } from "./ui/shortcuts.js";
import { catalogueView } from "./views/catalogue/index.js";
import {
  caseCommands,
  chooseAgain,
  COMPARE_KEYS,
  compareExports,
  compareView,
  listenToDrops,
} from "./views/compare/index.js";
import { designExamples, designExports } from "./views/design/index.js";
import { TASK_KEYS, taskFiles } from "./views/sizing/index.js";
import { studiesView, studyExports } from "./views/studies/index.js";
import {
  chooseTrace,
  driveFiles,
  TRANSIENT_KEYS,
  transientExports,
  transientView,
} from "./views/transient/index.js";

/** The tabs. A new view is one line here. @type {import("./shell.js").View[]} */
const TABS = [
  { id: "design", title: "Design", build: designTab, exports: designExports, files: [taskFiles] },
  {
    id: "transient",
    title: "Transient",
    build: transientView,
    exports: transientExports,
    files: [driveFiles],
    choose: chooseTrace,
  },
  {
    id: "compare",
    title: "Compare & diagnose",
    build: compareView,
    exports: compareExports,
    choose: chooseAgain,
  },
  { id: "catalogue", title: "Catalogue", build: catalogueView, exports: designExports },
  { id: "studies", title: "Studies", build: studiesView, exports: studyExports },
];

/** The command palette. */
async function palette() {
  const { showCommands } = await import("./commands.js");
  const themes = /** @type {const} */ (["light", "dark", "system"]);
  const actions = [
    ...themes.map((theme) => ({ label: `Theme: ${theme}`, kind: "action", run: () => setTheme(theme) })),
    ...projectCommands(),
    ...await caseCommands(),
    { label: "Copy a link to this state", kind: "action", run: share },
    { label: "Keyboard shortcuts and reference", kind: "action", run: showKeys },
  ];
  showCommands(TABS, KEYS.filter(({ run }) => run !== palette), actions);
}

/** Offers the work of last time, beside the content: nothing moves. @param {import("./address.js").Last} last */
function offerToContinue(last) {
  const title = TABS.find(({ id }) => id === last.view)?.title ?? "";
  const when = new Date(last.when).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
  const close = () => box.remove();
  const box = h(
    "aside",
    { class: "continue", "aria-label": "Last time" },
    h("span", null, h("b", null, "Continue where you stopped?"), ` ${title}, ${when}`),
    h("button", {
      type: "button",
      class: "primary",
      onclick: () => {
        close();
        continueWith(last);
      },
    }, "Continue"),
    h("button", { type: "button", onclick: close }, "Start fresh"),
  );
  document.body.append(box);
}

const AT_REST_MS = 3000;
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
  {
    keys: "Ctrl K",
    what: "Go to any view, preset, effect or action",
    match: control("k"),
    run: palette,
    typing: true,
  },
  { keys: "Ctrl Z", what: "Undo", match: control("z"), run: undoAndReport },
  { keys: "Ctrl Shift Z", what: "Redo", match: control("z", true), run: redoAndReport },
  {
    keys: "/",
    what: "Ask in Design, search the catalogue",
    match: plain("/"),
    run: () => {
      const fields = [...document.querySelectorAll("#ask, input[type=search]")];
      const field = /** @type {HTMLInputElement | undefined} */ (fields.find((el) => el.checkVisibility()));
      field?.select();
    },
  },
];

/** Where a letter after G goes. @type {import("./ui/shortcuts.js").Places} */
const PLACES = {
  d: () => goTo("design"),
  t: () => goTo("transient"),
  c: () => goTo("compare"),
  p: () => goTo("catalogue"),
  s: () => goTo("studies"),
};

/** An error of the program itself must not leave a blank page. */
function showError() {
  const text = "The page could not be built. The console of the browser has the details. ";
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
  listenToKeys(KEYS, PLACES);
  listenToDrops();
  const last = lastWork();
  writeAddress();
  if (last) offerToContinue(last);
  // A part that is fetched when it is needed: without a server the banner says why nothing happens.
  addEventListener("unhandledrejection", (e) => {
    if (!(e.reason instanceof TypeError && /module/i.test(e.reason.message))) return;
    e.preventDefault();
    look();
  });
  followProject(async () => (await import("./projects/dialogs.js")).askElsewhere());
  loadAll();
  requestAnimationFrame(() => setTimeout(fetchPlotly));
  setTimeout(() => import("./commands.js"), AT_REST_MS); // so that the palette opens before the next key
  performance.mark("usable");
  document.documentElement.dataset.ready = "1";
}

await readAddress();
try {
  start();
} catch (error) {
  showError();
  throw error;
}
