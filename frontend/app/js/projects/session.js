// @ts-check
// The project that is open in this window: saved by itself after each change, never over the work of another window.
import { effect, signal } from "../reactive.js";
import { ApiError } from "../server/client.js";
import { returned } from "../server/connection.js";
import * as server from "../server/projects.js";
import { doc, edit, past, readDoc } from "../state.js";
import { status } from "../store.js";

/** @typedef {import("../server/projects.js").Info} Info */

const REST_MS = 2000, AGAIN_MS = 30_000, KEPT = "mckibben-project";

/** The open project; `version`: that of its last save here.
 * @type {import("../reactive.js").Signal<{id: string, title: string, version: number} | null>} */
export const open = signal(/** @type {{id: string, title: string, version: number} | null} */ (null));
/** "saved", "changed" (it will be saved), "saving", "elsewhere" (saved in another window), "failed". */
export const state = signal(/** @type {"saved" | "changed" | "saving" | "elsewhere" | "failed"} */ ("saved"));

/** What is saved: all but the view that is shown. @param {import("../types.js").Doc} d */
const workOf = (d) => JSON.stringify({ ...d, view: "" });
let saved = "", timer = 0;
/** Called when another window has saved the project. */
let ask = () => {};
/** The study on the page, as the server takes it; null until its view was shown.
 * @type {() => Record<string, any> | null} */
let studyOf = () => null;
/** The study whose table was finished and is not in the project yet.
 * @type {Record<string, any> | null} */
let owed = null;

/** Called by the view of studies. @param {() => Record<string, any>} request gives the study on the page */
export function carryStudy(request) {
  studyOf = request;
}

/** Keeps the table of a study that has just been finished with the open project.
 * @param {Record<string, any>} request the study, as the server was asked for it */
export function keepTable(request) {
  if (!open.peek()) return;
  owed = request;
  if (state.peek() !== "elsewhere") saveNow(true);
}

/** What the server has to say about study tables, instead of a plain success.
 * @param {string} plain @param {string[]} remarks */
const withRemarks = (plain, remarks) => [plain, ...remarks].join(" ");

/** @param {Info} info */
function hold({ id, title, version }) {
  open.value = { id, title, version };
  remember();
}

/** For a reload. @param {{work: unknown}} [unsaved] */
function remember(unsaved) {
  try {
    if (open.peek()) sessionStorage.setItem(KEPT, JSON.stringify({ ...open.peek(), ...unsaved }));
    else sessionStorage.removeItem(KEPT);
  } catch {
    // No storage: after a reload the project has to be opened again.
  }
}

/** Keeps the work in this window as a new project. @param {string} title */
export async function saveAs(title) {
  const work = doc.peek();
  const made = await server.create(title, work, studyOf());
  saved = workOf(work);
  owed = null;
  hold(made.project);
  state.value = "saved";
  status.value = withRemarks(`Saved as project “${made.project.title}”.`, made.remarks);
}

/** Opens a project, or an earlier version of it, in one undo step. @param {string} id @param {number} [version] */
export async function openProject(id, version) {
  const found = await server.project(id, version);
  const document = readDoc(found.document);
  const what = version ? `version ${version} of ${found.project.title}` : found.project.title;
  edit((d) => ({ ...document, view: version ? d.view : document.view }), `open ${what}`);
  saved = version ? "" : workOf(doc.peek());
  owed = null;
  hold(found.project);
  state.value = version ? "changed" : "saved";
  status.value = withRemarks(`Opened ${what}.`, found.remarks);
}

/** Saves now. @param {boolean} automatic */
export async function saveNow(automatic) {
  const project = open.peek();
  clearTimeout(timer);
  if (!project || state.peek() === "saving") return;
  const work = doc.peek(), text = workOf(work);
  if (text === saved && automatic && !owed) return;
  state.value = "saving";
  const owing = owed;
  owed = null;
  try {
    const label = owing && text === saved ? "study finished" : past.peek().at(-1)?.label || "saved";
    const answer = await server.save(project.id, {
      document: /** @type {any} */ (work),
      base_version: project.version,
      study: owing ?? (automatic ? null : studyOf()),
      label,
      automatic,
    });
    if (open.peek()?.id !== project.id) return;
    take(answer.project, text);
    if (!automatic) status.value = withRemarks(`Saved version ${answer.project.version}.`, answer.remarks);
    else if (answer.remarks.length) status.value = answer.remarks.join(" ");
  } catch (error) {
    if (open.peek()?.id !== project.id) return;
    owed ??= owing;
    const { field, status: code } = /** @type {ApiError} */ (error);
    if (code === 409 && field === "base_version") {
      if (await isThere(project.id, text)) return;
      state.value = "elsewhere";
      ask();
    } else {
      state.value = "failed";
      const why = error instanceof ApiError ? error.words : String(error);
      status.value = automatic ? `“${project.title}” could not be saved. ${why}` : why;
      // Deleted: it comes back only by hand. All else may pass by itself: a full disk, a database that restarts.
      if (code !== 404) schedule(AGAIN_MS);
    }
  }
}

/** Whether what was to be saved is the last version already, and is taken as such: a page that is left saves
 * while it goes and never hears the new version; two windows may have made the same change.
 * @param {string} id @param {string} text */
async function isThere(id, text) {
  const there = await server.project(id).catch(() => null);
  if (open.peek()?.id !== id) return true;
  if (!there || workOf(readDoc(there.document)) !== text) return false;
  take(there.project, text);
  return true;
}

/** The last version there is the work of this window. @param {Info} info @param {string} text */
function take(info, text) {
  saved = text;
  hold(info);
  state.value = workOf(doc.peek()) === saved && !owed ? "saved" : "changed";
  if (state.peek() === "changed") schedule();
}

/** Replaces what another window has saved by the work of this one. */
export async function replaceOther() {
  const project = open.peek();
  if (!project) return;
  const { project: there } = await server.project(project.id);
  open.value = { ...project, version: there.version };
  state.value = "changed";
  await saveNow(false);
}

/** Another title and other notes. @param {string} title @param {string} notes */
export async function rename(title, notes) {
  const project = open.peek();
  if (project) hold(await server.describe(project.id, { base_version: project.version, title, notes }));
}

export function close() {
  clearTimeout(timer);
  open.value = null;
  state.value = "saved";
  remember();
}

/** @param {number} [rest] until it is saved [ms] */
function schedule(rest = REST_MS) {
  clearTimeout(timer);
  timer = setTimeout(() => saveNow(true), rest);
}

/** Follows the document, and finds the project of this window again after a reload.
 * @param {() => void} onElsewhere what asks the user when another window has saved */
export function followProject(onElsewhere) {
  ask = onElsewhere;
  effect(() => {
    const now = doc.value;
    if (!open.peek() || state.peek() === "elsewhere" || workOf(now) === saved) return;
    if (state.peek() !== "saving") state.value = "changed";
    schedule();
  });
  effect(() => {
    if (returned.value && state.peek() === "failed") schedule();
  });
  addEventListener("pagehide", () => {
    if (open.peek() && workOf(doc.peek()) !== saved) remember({ work: doc.peek() });
    saveNow(true);
  });
  /** @type {{id: string, title: string, version: number, work?: unknown} | null} */
  let last = null;
  try {
    last = JSON.parse(sessionStorage.getItem(KEPT) ?? "null");
  } catch {
    return;
  }
  if (typeof last?.id !== "string" || typeof last.version !== "number") return;
  open.value = { id: last.id, title: last.title, version: last.version };
  remember();
  // The address is written after a pause: what was changed just before the page was left is not in it. (An
  // address that was typed or followed is of other work.)
  const [how] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType("navigation"));
  if (last.work && how?.type !== "navigate") doc.value = readDoc(last.work);
  server.project(last.id).then((there) => {
    const text = workOf(readDoc(there.document));
    if (there.project.version === last.version || text === workOf(doc.peek())) take(there.project, text);
    else schedule();
  }, (error) => error.status === 404 && close());
}

/** Runs what the server may refuse. @param {() => Promise<unknown>} work */
export async function attempt(work) {
  try {
    await work();
  } catch (error) {
    status.value = /** @type {any} */ (error).words ?? String(error);
  }
}
