// @ts-check
// The one document: what undo steps through, what the link carries, what a saved file holds.
import { batch, computed, signal } from "./reactive.js";
import { defaultCompare, readCompare } from "./views/compare/document.js";
import { defaultSizing, readSizing } from "./views/sizing/document.js";
import { defaultTransient, readTransient } from "./views/transient/document.js";

/** @typedef {import("./types.js").Doc} Doc */
/** @typedef {import("./types.js").Design} Design */
/** @typedef {import("./types.js").CatalogueFilter} CatalogueFilter */
/** @typedef {{doc: Doc, label: string, at: number}} Step */

export const BAR = 1e5;

/** @returns {Design} a real muscle with measured points beside it */
export const defaultDesign = () => ({
  muscle: { preset: "DMSP-20", form: "braid", values: { nominal_length: 0.3 } },
  effects: null,
  pressures: [1, 2, 3, 4, 5, 6].map((p) => p * BAR),
  load: 500,
  direction: 0,
  temperature: 293.15,
  dead_volume: 0,
  fixed_length: null,
  range: null,
  clipped: true,
  across: "contraction",
  over: "contraction",
  reference: "auto",
});

/** @returns {Doc} */
export const defaultDoc = () => ({
  schema: 1,
  view: "design",
  units: "bar",
  design: defaultDesign(),
  sizing: defaultSizing(),
  transient: defaultTransient(),
  compare: defaultCompare(),
  catalogue: {
    kind: "muscles",
    search: "",
    maker: "",
    from: null,
    to: null,
    sort: "title",
    descending: false,
    selected: null,
  },
});

export const doc = signal(defaultDoc());
/** @type {import("./reactive.js").Signal<Step[]>} */
export const past = signal(/** @type {Step[]} */ ([]));
/** @type {import("./reactive.js").Signal<Step[]>} */
export const future = signal(/** @type {Step[]} */ ([]));

export const design = computed(() => doc.value.design);
export const units = computed(() => doc.value.units);
export const view = computed(() => doc.value.view);

const MERGE_MS = 800, HISTORY = 200;
/** @type {Doc | null} the document before the gesture that is under way */
let before = null;

/** Shows a change without a history step: a slider that is still moving. @param {(d: Doc) => Doc} change */
export function preview(change) {
  const start = doc.peek();
  before ??= start;
  doc.value = change(start);
}

/** Ends a gesture: one undo step, however many previews it had. Quick repeats of one label merge.
 * @param {string} label */
export function commit(label) {
  const start = before;
  before = null;
  if (!start || start === doc.peek()) return;
  const now = performance.now();
  const last = past.peek().at(-1);
  batch(() => {
    if (last && last.label === label && now - last.at < MERGE_MS) {
      past.value = [...past.peek().slice(0, -1), { ...last, at: now }];
    } else past.value = [...past.peek(), { doc: start, label, at: now }].slice(-HISTORY);
    future.value = [];
  });
}

/** One change, one undo step. @param {(d: Doc) => Doc} change @param {string} label */
export function edit(change, label) {
  batch(() => {
    preview(change);
    commit(label);
  });
}

/** @param {Partial<Design>} patch @returns {(d: Doc) => Doc} */
export const patchDesign = (patch) => (d) => ({ ...d, design: { ...d.design, ...patch } });
/** @param {Partial<CatalogueFilter>} patch @returns {(d: Doc) => Doc} */
export const patchCatalogue = (patch) => (d) => ({ ...d, catalogue: { ...d.catalogue, ...patch } });
/** @param {Partial<Design>} patch @param {string} label */
export const editDesign = (patch, label) => edit(patchDesign(patch), label);

/** What is looked at is not a design decision: it changes without an undo step.
 * @param {(d: Doc) => Doc} change */
export function look(change) {
  doc.value = change(doc.peek());
}

/** @param {typeof past} from @param {typeof past} to @returns {string | null} label of the step */
function travel(from, to) {
  if (before) commit("change");
  const step = from.peek().at(-1);
  if (!step) return null;
  const here = doc.peek();
  batch(() => {
    to.value = [...to.peek(), { doc: here, label: step.label, at: 0 }];
    from.value = from.peek().slice(0, -1);
    doc.value = { ...step.doc, view: here.view };
  });
  return step.label;
}
export const undo = () => travel(past, future);
export const redo = () => travel(future, past);

/** @param {unknown} x @returns {x is Record<string, unknown>} */
const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);
/** @param {unknown} x @returns {x is number} */
const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

/** Checks by the key of the document; a missing key takes its default, a wrong one is refused by name.
 * @type {Record<string, (x: unknown) => boolean>} */
const DESIGN_CHECKS = {
  muscle: (x) =>
    isObject(x) && (x.preset === null || typeof x.preset === "string") &&
    ["braid", "thread", "rhombus"].includes(String(x.form)) && isObject(x.values) &&
    Object.values(x.values).every(isNumber),
  effects: (x) =>
    x === null ||
    (isObject(x) && Object.values(x).every((p) => isObject(p) && Object.values(p).every(isNumber))),
  pressures: (x) => Array.isArray(x) && x.length >= 1 && x.length <= 12 && x.every(isNumber),
  load: isNumber,
  direction: (x) => [-1, 0, 1].includes(/** @type {number} */ (x)),
  temperature: isNumber,
  dead_volume: isNumber,
  fixed_length: (x) => x === null || isNumber(x),
  range: (x) => x === null || (Array.isArray(x) && x.length === 2 && x.every(isNumber)),
  clipped: (x) => typeof x === "boolean",
  across: (x) => ["contraction", "length", "braid_angle"].includes(String(x)),
  over: (x) => ["contraction", "length", "diameter", "outer_diameter", "force"].includes(String(x)),
  reference: (x) => x === null || typeof x === "string",
};

/** Reads the Design part of a link or file. @param {unknown} raw @returns {Design}
 * @throws {Error} names the key */
export function readDesign(raw) {
  if (!isObject(raw)) throw new Error("the design is missing");
  for (const [key, value] of Object.entries(raw)) {
    if (!Object.hasOwn(DESIGN_CHECKS, key)) throw new Error(`“${key}” is not a part of a design`);
    if (!DESIGN_CHECKS[key](value)) throw new Error(`“${key}” has a value that makes no sense`);
  }
  return { ...defaultDesign(), ...raw };
}

/** Reads a whole document. @param {unknown} raw @returns {Doc} @throws {Error} says what is wrong */
export function readDoc(raw) {
  if (!isObject(raw)) throw new Error("it holds no document");
  if (raw.schema !== 1) throw new Error(`it is of version ${raw.schema}; this program reads version 1`);
  const start = defaultDoc();
  const units = ["si", "bar", "us"].includes(String(raw.units))
    ? /** @type {Doc["units"]} */ (raw.units)
    : "bar";
  return {
    ...start,
    view: typeof raw.view === "string" ? raw.view : start.view,
    units,
    design: readDesign(raw.design),
    sizing: readSizing(raw.sizing),
    transient: readTransient(raw.transient),
    compare: readCompare(raw.compare),
    catalogue: readFilter(raw.catalogue),
  };
}

/** Anything unusable in a catalogue filter is dropped: it hides nothing. @param {unknown} raw
 * @returns {CatalogueFilter} */
function readFilter(raw) {
  const start = defaultDoc().catalogue;
  if (!isObject(raw)) return start;
  const sound = Object.entries(raw).filter(([key, value]) => {
    const usual = /** @type {Record<string, unknown>} */ (start)[key];
    if (usual === null) {
      return value === null || (key === "selected" ? typeof value === "string" : isNumber(value));
    }
    return Object.hasOwn(start, key) && typeof usual === typeof value;
  });
  return { ...start, ...Object.fromEntries(sound) };
}
