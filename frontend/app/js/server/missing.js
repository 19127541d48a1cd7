// @ts-check
// Measurements that the document names and the server does not have: deleted there, or kept in another data folder. One
// banner says so; the page looks by itself whether they are back.
import { computed, effect, signal } from "../reactive.js";
import { doc } from "../state.js";
import { presets } from "../store.js";
import { ApiError, get, send } from "./client.js";
import { returned } from "./connection.js";

/** `view`: where it is needed. @typedef {{id: string, name: string, view: "compare" | "transient"}} Missing */

const FIRST_MS = 5000, LONGEST_MS = 60_000;

const known = signal(/** @type {Missing[]} */ ([]));
/** Ids of deleted files that the server could restore. */
const bin = signal(/** @type {string[]} */ ([]));
/** How often a file has come back: whoever needs it asks again. */
export const cameBack = signal(0);

/** Whether the document uses a measurement. @param {import("../types.js").Doc} d @param {Missing} one */
const needs = ({ compare, transient }, { id, view }) =>
  view === "compare"
    ? compare.files.some((file) => file.id === id && file.use !== "off")
    : transient.measurement?.id === id;

/** The files that are missing now. @type {import("../reactive.js").Signal<Missing[]>} */
export const missing = computed(() => known.value.filter((one) => needs(doc.value, one)));
/** Those of them that can be restored. */
export const deleted = computed(() => missing.value.filter(({ id }) => bin.value.includes(id)));

/** Presets that Transient shows and the server, whose lists are read, does not have: its kind and its id. */
export const lostPresets = computed(() => {
  const { view, design, transient } = doc.value, drive = transient?.drive; // not yet while the modules load
  const idOf = (/** @type {unknown} */ part) => /** @type {{preset?: unknown} | undefined} */ (part)?.preset;
  const used = view === "transient" && drive
    ? [["muscle", design.muscle.preset], ["valve", idOf(drive.valve)], ["tube", idOf(drive.tube)]]
    : [];
  return used.flatMap(([kind, id]) => {
    const known = presets.value[`${kind}s`];
    return !known?.length || typeof id !== "string" || known.some((one) => one.id === id)
      ? []
      : [{ kind, id }];
  });
});

let timer = 0, pause = FIRST_MS;

/** The server does not have a file. @param {Missing} one */
export function lacks(one) {
  if (known.peek().some(({ id, view }) => id === one.id && view === one.view)) return;
  known.value = [...known.peek(), one];
  pause = FIRST_MS;
  lookForMissing();
}

/** The server has these files. @param {string[]} ids */
export function has(ids) {
  const left = known.peek().filter(({ id }) => !ids.includes(id));
  if (left.length === known.peek().length) return;
  known.value = left;
  cameBack.value++;
}

/** Looks whether the files are back, less and less often. */
export async function lookForMissing() {
  clearTimeout(timer);
  if (!known.peek().length) return;
  timer = setTimeout(lookForMissing, pause);
  pause = Math.min(2 * pause, LONGEST_MS);
  if (document.hidden || !known.peek().some((one) => needs(doc.peek(), one))) return;
  try {
    const kept = await get("/api/kept");
    const files = (/** @type {{kind: string, id: string}[]} */ list) =>
      list.filter(({ kind }) => kind === "files").map(({ id }) => id);
    bin.value = files(kept.deleted);
    has(files(kept.items));
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
  }
}

/** Restores the deleted ones. @returns {Promise<void>} */
export async function restoreDeleted() {
  for (const { id } of deleted.peek()) {
    await send("POST", `/api/kept/files/${id}/restore`);
    has([id]);
  }
}

effect(() => void (returned.value, lookForMissing()));
