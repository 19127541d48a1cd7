// @ts-check
// From the task to the server's search and its answer. The search goes on while another view is shown.
import { waitingWords } from "../../server/waiting.js";
import { computed, effect, signal } from "../../reactive.js";
import { doc, edit, look } from "../../state.js";
import { fieldMessages, postForEvents } from "../../server/client.js";
import { Memory, Question } from "../../server/question.js";
import { status } from "../../store.js";
import { requestOf } from "../../drive/task.js";
import { opened } from "./document.js";
import { at, put } from "../../paths.js";
import { driveWords } from "./words.js";

/** @typedef {import("../../types.js").S["SizingResult"]} Answer */
/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */
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
/** Changes what is shown, without an undo step. @param {Partial<Sizing>} patch */
export const lookSizing = (patch) => look(patchSizing(patch));

/** @param {string} path @param {unknown} value undefined: its default @param {string} label */
export const setTask = (path, value, label) => editSizing({ task: put(task.peek(), path, value) }, label);
/** @param {string} path */
export const valueAt = (path) => at(task.value, path);

/** Replaces the task by that of a file or preset. @param {import("../../types.js").Task} document
 * @param {string} label */
export function openTask(document, label) {
  const part = opened(document);
  edit((d) => ({ ...d, view: "design", sizing: { ...d.sizing, ...part, mode: "task" } }), label);
}

/** A title describes the figures of its preset; as the name of a task it would outlive them.
 * @param {import("../../types.js").Preset} preset */
export function openExample({ title, description, document }) {
  openTask({ ...document, title: "" }, `example ${title}`);
  status.value = [title, description].filter(Boolean).join(": ");
}

// ---- the search

const REMEMBERED = 8;
const searchMemory = /** @type {Memory<Answer>} */ (new Memory(REMEMBERED));
const KEPT = "mckibben-proposals";

/** The last drives found outlive a reload of the page. */
function recall() {
  try {
    const { version, text, answer } = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}");
    if (version === 2 && typeof text === "string" && Array.isArray(answer?.proposals)) {
      searchMemory.set(text, answer);
    }
  } catch {
    // No storage, or a damaged entry: the drives are proposed again on request.
  }
}

/** @param {string | null} text @param {Answer} answer */
function keep(text, answer) {
  try {
    sessionStorage.setItem(KEPT, JSON.stringify({ version: 2, text, answer }));
  } catch {
    // No storage or no room in it: then the drives last until the page is left.
  }
}

/** How much of the search is done, 0 to 1. */
export const share = signal(0);
/** The place in the server's queue, in words; empty once the search runs. */
export const waiting = signal("");

const search = new Question((text, signal) => {
  share.value = 0;
  waiting.value = "";
  return /** @type {Promise<Answer>} */ (postForEvents("/api/sizings", JSON.parse(text), (name, data) => {
    if (name !== "progress") return;
    share.value = data.share ?? 0;
    waiting.value = data.waiting ? waitingWords(data.waiting) : "";
  }, signal));
}, { memory: searchMemory, patience: 0, arrived: showFound });
/** The newest drives found; other ones stay until new ones arrive. */
export const { answer } = search;

/** @type {import("../../reactive.js").Signal<Stage>} */
export const stage = computed(() => {
  const now = search.stage.value;
  return now === "asking" ? "running" : now === "answered" ? "done" : now;
});
const taskText = computed(() => JSON.stringify(requestOf(sizing.value)));
/** Why there are no drives for the task as it is now. */
export const fault = computed(() =>
  stage.value === "failed" && search.asked.value === taskText.value ? search.error.value : null
);
/** The drives on screen are not those of the task beside them. */
export const stale = computed(() => answer.value !== null && taskText.value !== search.answered.value);
/** The task that the drives on screen belong to. @returns {import("../../types.js").Task} */
export const answeredTask = () => JSON.parse(search.answered.value ?? "{}");

/** The task of an answer in its figures, beside the name that the user gave it, as reports are headed.
 * @param {Answer} found */
export const headingOf = ({ about }) => [answeredTask().title, about].filter(Boolean).join(": ");

/** Whether the search ended before everything was tried. @param {Answer} found */
export const isPartial = ({ outcome }) => outcome !== "completed";
/** What an answer without a drive says: only a complete search speaks of the whole catalogue.
 * @param {Answer} found */
export const nothingWords = (found) =>
  isPartial(found)
    ? "None of the drives that were tried can do this"
    : "No drive in the catalogue can do this";

export const proposals = computed(() => answer.value?.proposals ?? []);
export const chosenIndex = computed(() => Math.min(sizing.value.selected, proposals.value.length - 1));
export const chosen = computed(() => proposals.value[chosenIndex.value] ?? null);

/** Searches for drives; a search for another task is ended. */
export const propose = () => search.ask(taskText.peek(), true);

/** @param {Answer} found */
function showFound(found) {
  const [best, ...rest] = found.proposals;
  keep(search.answered.peek(), found);
  lookSizing({ selected: 0 });
  status.value = best
    ? `${rest.length + 1} drive${rest.length ? "s" : ""} found${isPartial(found) ? " so far" : ""}; first ${
      driveWords(best)
    }.`
    : `${nothingWords(found)}. The list below gives the reasons.`;
}

/** Ends the search on the server too; drives found before stay. */
export const cancel = () => search.cancel();

/** The field of the page for a path of the request: "catalogue.muscles.0" belongs to the list.
 * @param {string} path */
const fieldOf = (path) =>
  path.replace(/^(catalogue\.\w+)\.\d+$/, "$1").replace(/^(load\.force_over_stroke)\..*$/, "$1")
    .replace(/^load\.pair$/, "load.pair.angle").replace(/^load$/, "load.mass");
/** The message for a field, by its path in the task. */
export const { field: faultField, at: messageFor } = fieldMessages(() => fault.value, fieldOf);

/** Called once, when the page is built. */
export function startSizing() {
  recall();
  effect(() => {
    // Undo shows the drives of a task that was answered before.
    const text = taskText.value;
    if (stage.peek() !== "running" && searchMemory.get(text)) search.ask(text);
  });
  effect(() => {
    document.documentElement.dataset.sizing = stage.value;
  });
  addEventListener("pagehide", cancel);
}
