// @ts-check
// The one document: what undo steps through, what the link carries, what a saved file holds. Its parts are
// defined elsewhere and registered here by name.
import { batch, computed, signal } from "./reactive.js";

/** @typedef {import("./types.js").Doc} Doc */
/** @typedef {Omit<Doc, "schema" | "view" | "units">} Parts */
/** `key`: changes of one thing shortly after each other are one step. @typedef {{doc: Doc, key: string, label: string, at: number}} Step */
/** A part of the document: its value in a new document, and how it is read from a link or file, where undefined
 * means that it is missing; `read` throws an Error that says what is wrong.
 * @template T @typedef {{start: () => T, read: (raw: unknown) => T}} Part */

/** @type {Map<string, Part<unknown>>} */
const parts = new Map();

/** @returns {Doc} a new document, with the parts registered so far */
export const defaultDoc = () => /** @type {Doc} */ ({
  schema: 1,
  view: "design",
  units: "bar",
  ...Object.fromEntries([...parts].map(([name, part]) => [name, part.start()])),
});

export const doc = signal(defaultDoc());

/** Registers a part of the document. Called once for each part, while the modules load.
 * @template {keyof Parts} K @param {K} name @param {Part<Parts[K]>} part */
export function addPart(name, part) {
  parts.set(name, part);
  doc.value = { ...doc.peek(), [name]: part.start() };
}

/** @type {import("./reactive.js").Signal<Step[]>} */
export const past = signal(/** @type {Step[]} */ ([]));
/** @type {import("./reactive.js").Signal<Step[]>} */
export const future = signal(/** @type {Step[]} */ ([]));

export const units = computed(() => doc.value.units);
export const view = computed(() => doc.value.view);

const MERGE_MS = 800, HISTORY = 200;
/** @type {Doc | null} the document before the change that is under way */
let before = null;

/** Changes the document without an undo step yet, while a slider moves; commit() ends the change. @param {(d: Doc) => Doc} change */
export function preview(change) {
  const start = doc.peek();
  before ??= start;
  doc.value = change(start);
}

/** "300 N", "700 N" → "300 → 700 N". @param {string} from @param {string} to */
function fromTo(from, to) {
  const [number, unit] = from.split("\u00a0");
  return `${unit && to.endsWith(`\u00a0${unit}`) ? number : from} → ${to}`;
}

/** Ends a change: one undo step for all its previews. Changes of the same thing shortly after each other are one
 * step too.
 * @param {string} what @param {(d: Doc) => string} [value] what was changed, in words */
export function commit(what, value) {
  const start = before;
  before = null;
  if (!start || start === doc.peek()) return;
  const now = performance.now();
  const last = past.peek().at(-1), merged = last && last.key === what && now - last.at < MERGE_MS;
  const from = merged ? last.doc : start;
  const label = value ? `${what} ${fromTo(value(from), value(doc.peek()))}` : what;
  batch(() => {
    past.value = [...past.peek().slice(0, merged ? -1 : undefined), { doc: from, key: what, label, at: now }]
      .slice(-HISTORY);
    future.value = [];
  });
}

/** Changes the document in one undo step. @param {(d: Doc) => Doc} change @param {string} what
 * @param {(d: Doc) => string} [value] */
export function edit(change, what, value) {
  batch(() => {
    preview(change);
    commit(what, value);
  });
}

/** Changes without an undo step what is shown, as opposed to what is designed.
 * @param {(d: Doc) => Doc} change */
export function look(change) {
  doc.value = change(doc.peek());
}
/** Shows another view. @param {string} id */
export const goTo = (id) => look((d) => ({ ...d, view: id }));

/** @param {typeof past} from @param {typeof past} to @returns {string | null} label of the step */
function travel(from, to) {
  if (before) commit("change");
  const step = from.peek().at(-1);
  if (!step) return null;
  const here = doc.peek();
  batch(() => {
    to.value = [...to.peek(), { ...step, doc: here, at: 0 }];
    from.value = from.peek().slice(0, -1);
    doc.value = { ...step.doc, view: here.view };
  });
  return step.label;
}
export const undo = () => travel(past, future);
export const redo = () => travel(future, past);

/** Reads a whole document. @param {unknown} raw @returns {Doc} @throws {Error} says what is wrong */
export function readDoc(raw) {
  if (typeof raw !== "object" || raw === null || Array.isArray(raw)) {
    throw new Error("it is not a document of this program");
  }
  const document = /** @type {Record<string, unknown>} */ (raw);
  if (document.schema !== 1) {
    throw new Error(`it is a document of version ${document.schema}; this program reads version 1`);
  }
  const start = defaultDoc();
  return {
    ...start,
    view: typeof document.view === "string" ? document.view : start.view,
    units: ["si", "bar", "us"].includes(String(document.units))
      ? /** @type {Doc["units"]} */ (document.units)
      : start.units,
    ...Object.fromEntries([...parts].map(([name, part]) => [name, part.read(document[name])])),
  };
}
