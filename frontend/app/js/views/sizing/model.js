// @ts-check
// From the task to the server's search and its answer. The search goes on while another view is shown.
import { batch, computed, effect, signal } from "../../reactive.js";
import { doc, edit, look } from "../../state.js";
import { ApiError, follow } from "../../server/client.js";
import { status } from "../../store.js";
import { opened, requestOf } from "./document.js";
import { at, put } from "../../paths.js";
import { driveWords } from "./words.js";

/** @typedef {import("../../types.js").S["SizingAnswer"]} Answer */
/** @typedef {import("../../types.js").S["ProposalAnswer"]} Proposal */
/** @typedef {import("../../types.js").Sizing} Sizing */
/** @typedef {import("../../types.js").Doc} Doc */
/** @typedef {"idle" | "running" | "done" | "cancelled" | "failed"} Stage */

export const sizing = computed(() => doc.value.sizing);
export const task = computed(() => sizing.value.task);
export const arrangement = computed(() => sizing.value.arrangement);

/** @param {Partial<Sizing>} patch @returns {(d: Doc) => Doc} */
export const patchSizing = (patch) => (d) => ({ ...d, sizing: { ...d.sizing, ...patch } });
/** @param {Partial<Sizing>} patch @param {string} label */
export const editSizing = (patch, label) => edit(patchSizing(patch), label);
/** What is looked at is no part of the task. @param {Partial<Sizing>} patch */
export const lookSizing = (patch) => look(patchSizing(patch));

/** @param {string} path @param {unknown} value undefined: the default @param {string} label */
export const setTask = (path, value, label) => editSizing({ task: put(task.peek(), path, value) }, label);
/** @param {string} path */
export const valueAt = (path) => at(task.value, path);

/** A task of a file or preset takes the place of the one there is. @param {import("../../types.js").Task} document
 * @param {string} label */
export function openTask(document, label) {
  const part = opened(document);
  edit((d) => ({ ...d, view: "design", sizing: { ...d.sizing, ...part, mode: "task" } }), label);
}

/** @param {import("../../types.js").Preset} preset */
export function openExample({ title, description, document }) {
  openTask(document ?? {}, `example ${title}`);
  status.value = [title, description].filter(Boolean).join(": ");
}

// ---- the search

export const answer = signal(/** @type {Answer | null} */ (null));
export const stage = signal(/** @type {Stage} */ ("idle"));
/** How much of the search is done, 0 to 1. */
export const share = signal(0);
/** What was asked last. */
const key = computed(() => JSON.stringify(requestOf(sizing.value)));
const answered = signal(/** @type {string | null} */ (null));
const refused = signal(/** @type {{error: ApiError, key: string} | null} */ (null));
/** Why there is no answer to the task as it stands. */
export const fault = computed(() => refused.value?.key === key.value ? refused.value.error : null);
/** The drives on screen are not those of the task beside them. */
export const stale = computed(() => answer.value !== null && key.value !== answered.value);
/** The task that the drives on screen belong to. @returns {import("../../types.js").Task} */
export const answeredTask = () => JSON.parse(answered.value ?? "{}");

export const proposals = computed(() => answer.value?.proposals ?? []);
export const chosenIndex = computed(() => Math.min(sizing.value.selected, proposals.value.length - 1));
export const chosen = computed(() => proposals.value[chosenIndex.value] ?? null);

const KEPT = 8;
/** Answers to tasks asked before: undo shows their drives at once. @type {Map<string, Answer>} */
const known = new Map();
/** @param {string} body @param {Answer} got */
function keep(body, got) {
  known.delete(body);
  known.set(body, got);
  if (known.size > KEPT) known.delete([...known.keys()][0]);
}

let control = new AbortController();

/** Searches for drives; a search that still runs is given up. */
export async function propose() {
  control.abort();
  control = new AbortController();
  const mine = control.signal, asked = key.peek();
  batch(() => {
    refused.value = null;
    share.value = 0;
    stage.value = "running";
  });
  try {
    const got = await follow("/api/sizings", JSON.parse(asked), (name, data) => {
      if (name === "progress" && !mine.aborted) share.value = data.share ?? 0;
    }, mine);
    if (mine.aborted) return;
    keep(asked, got);
    batch(() => {
      answer.value = got;
      answered.value = asked;
      stage.value = "done";
      lookSizing({ selected: 0 });
    });
    tell(got);
  } catch (error) {
    if (mine.aborted) return;
    batch(() => {
      refused.value = { error: error instanceof ApiError ? error : new ApiError(String(error)), key: asked };
      stage.value = "failed";
    });
  }
}

/** @param {Answer} got */
function tell({ proposals: [best, ...rest] }) {
  status.value = best
    ? `${rest.length + 1} drive${rest.length ? "s" : ""} found; first ${driveWords(best)}.`
    : "No drive of the catalogue does this task; the list says why.";
}

/** Ends the search on the server too; drives found before stay. */
export function cancel() {
  control.abort();
  stage.value = "cancelled";
}

/** The message for a field, by its path in the task. @param {string} path */
export function messageFor(path) {
  const told = fault.value;
  return told?.field && fieldOf(told.field) === path ? told.words : null;
}

/** The field of the page that a path of the request belongs to: “limits.life”, “catalogue.muscles.0” → the list.
 * @param {string} path */
export const fieldOf = (path) =>
  path.replace(/^body\.?/, "").replace(/^(catalogue\.\w+)\.\d+$/, "$1")
    .replace(/^(load\.force_over_stroke)\..*$/, "$1").replace(/^load\.pair$/, "load.pair.angle")
    .replace(/^load$/, "load.mass");

/** Called once, when the page is built. */
export function startSizing() {
  effect(() => {
    const body = key.value, before = known.get(body);
    if (!before || stage.peek() === "running" || answered.peek() === body) return;
    batch(() => {
      answer.value = before;
      answered.value = body;
    });
  });
  effect(() => {
    document.documentElement.dataset.sizing = stage.value;
  });
  addEventListener("pagehide", () => control.abort());
}
