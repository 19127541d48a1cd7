// @ts-check
// The project that is open in this window: saved by itself after each change, never over the work of another window.
import { effect, signal } from "../reactive.js";
import { ApiError } from "../server/client.js";
import * as server from "../server/projects.js";
import { doc, edit, past, readDoc } from "../state.js";
import { status } from "../store.js";

/** @typedef {import("../server/projects.js").Info} Info */

const REST_MS = 2000, KEPT = "mckibben-project";

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

function remember() {
  try {
    if (open.peek()) sessionStorage.setItem(KEPT, JSON.stringify(open.peek()));
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
    saved = text;
    hold(answer.project);
    state.value = workOf(doc.peek()) === saved && !owed ? "saved" : "changed";
    if (!automatic) status.value = withRemarks(`Saved version ${answer.project.version}.`, answer.remarks);
    else if (answer.remarks.length) status.value = answer.remarks.join(" ");
    if (state.peek() === "changed") schedule();
  } catch (error) {
    if (open.peek()?.id !== project.id) return;
    owed ??= owing;
    const { field, status: code } = /** @type {ApiError} */ (error);
    if (code === 409 && field === "base_version") {
      state.value = "elsewhere";
      ask();
    } else {
      state.value = "failed";
      if (!automatic) status.value = error instanceof ApiError ? error.words : String(error);
    }
  }
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

function schedule() {
  clearTimeout(timer);
  timer = setTimeout(() => saveNow(true), REST_MS);
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
  addEventListener("pagehide", () => saveNow(true));
  /** @type {{id: string, title: string, version: number} | null} */
  let last = null;
  try {
    last = JSON.parse(sessionStorage.getItem(KEPT) ?? "null");
  } catch {
    return;
  }
  if (typeof last?.id !== "string" || typeof last.version !== "number") return;
  open.value = last;
  server.project(last.id).then((there) => {
    if (there.project.version === last.version) saved = workOf(readDoc(there.document));
    if (workOf(doc.peek()) === saved) state.value = "saved";
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
