// @ts-check
// From the document to the server's answers: the comparison at once, then the diagnosis as it finds things.
import { batch, computed, effect, signal } from "../../reactive.js";
import { doc, edit, look, view } from "../../state.js";
import { ApiError, follow, post } from "../../server/client.js";
import { musclesById } from "../../store.js";
import { keyOf, used } from "./request.js";

/** @typedef {import("../../types.js").Compare} Compare */
/** @typedef {import("./types.js").Comparison} Comparison */
/** @typedef {import("./types.js").Candidate} Candidate */
/** @typedef {import("./types.js").Diagnosis} Diagnosis */
/** @typedef {import("./types.js").Progress} Progress */
/** @typedef {"idle" | "waiting" | "running" | "done" | "cancelled" | "failed"} Stage */

export const compare = computed(() => doc.value.compare);
export const files = computed(() => compare.value.files);
export const chosen = computed(() => used(compare.value));
export const preset = computed(() => musclesById.value.get(compare.value.muscle.preset ?? "") ?? null);
export const brush = computed(() => compare.value.brush);
export const tab = computed(() => compare.value.tab);
export const steps = computed(() => compare.value.history);

/** @typedef {import("../../types.js").Doc} Doc */
/** @param {Partial<Compare>} patch @returns {(d: Doc) => Doc} */
export const patchCompare = (patch) => (d) => ({ ...d, compare: { ...d.compare, ...patch } });
/** @param {Partial<Compare>} patch @param {string} label */
export const editCompare = (patch, label) => edit(patchCompare(patch), label);
/** What is looked at is no step of the work. @param {Partial<Compare>} patch */
export const lookCompare = (patch) => look(patchCompare(patch));

/** The comparison with the model of now, and with the one before it. */
export const answer = signal(/** @type {Comparison | null} */ (null));
export const previous = signal(/** @type {Comparison | null} */ (null));
/** Why there is no comparison. */
export const fault = signal(/** @type {ApiError | null} */ (null));

/** The diagnosis; while it runs, what it found so far. */
export const diagnosis = signal(/** @type {Diagnosis | null} */ (null));
export const found = signal(/** @type {Candidate[]} */ ([]));
export const progress = signal(/** @type {Progress} */ ({ share: 0 }));
export const stage = signal(/** @type {Stage} */ ("idle"));
export const trouble = signal(/** @type {ApiError | null} */ (null));

const key = computed(() => keyOf(compare.value));
const keyBefore = computed(() => {
  const last = steps.value.at(-1);
  return last ? keyOf(compare.value, last) : null;
});
/** The body that the answers on screen belong to. */
const answered = signal(/** @type {string | null} */ (null));
/** The numbers on screen are not those of the model and data chosen. */
export const stale = computed(() => key.value !== answered.value || fault.value !== null);

/** What is drawn: the model of now, or with “before” the one it came from. */
export const shown = computed(() => compare.value.before && previous.value ? previous.value : answer.value);
export const isBefore = computed(() => compare.value.before && previous.value !== null);

const KEPT = 16;
/** Answers of bodies asked before: undo shows its numbers at once. @template T */
class Memory {
  constructor() {
    /** @type {Map<string, T>} */
    this.known = new Map();
  }
  /** @param {string} name */
  get(name) {
    return this.known.get(name) ?? null;
  }
  /** @param {string} name @param {T} value */
  keep(name, value) {
    this.known.delete(name);
    this.known.set(name, value);
    if (this.known.size > KEPT) this.known.delete([...this.known.keys()][0]);
  }
}
/** @type {Memory<Comparison>} */
const comparisons = new Memory();
/** @type {Memory<Diagnosis>} */
const diagnoses = new Memory();

/** @param {string} body @param {AbortSignal} [control] @returns {Promise<Comparison>} */
async function compareWith(body, control) {
  const known = comparisons.get(body);
  if (known) return known;
  const got = await post("/api/comparisons", { ...JSON.parse(body), fit: false }, control);
  comparisons.keep(body, got);
  return got;
}

/** The parameters of a model fitted to the data. @param {string} body @param {AbortSignal} [control]
 * @returns {Promise<Comparison>} */
export const fitWith = (body, control) =>
  post("/api/comparisons", { ...JSON.parse(body), fit: true }, control);

let control = new AbortController();

/** @param {unknown} error @returns {ApiError} */
const asApiError = (error) => error instanceof ApiError ? error : new ApiError(String(error));

/** @param {string | null} body */
async function start(body) {
  control.abort();
  control = new AbortController();
  const mine = control.signal;
  if (!body) return clear();
  trouble.value = null;
  stage.value = "waiting";
  try {
    const got = await compareWith(body, mine);
    if (mine.aborted) return;
    batch(() => {
      fault.value = null;
      answer.value = got;
      answered.value = body;
      if (!keyBefore.peek()) previous.value = null;
    });
    fetchPrevious(mine);
  } catch (error) {
    if (mine.aborted) return;
    batch(() => {
      fault.value = asApiError(error);
      stage.value = "idle";
      found.value = [];
      diagnosis.value = null;
    });
    return;
  }
  await diagnose(body, mine);
}

function clear() {
  batch(() => {
    answer.value = previous.value = diagnosis.value = null;
    answered.value = null;
    fault.value = trouble.value = null;
    found.value = [];
    stage.value = "idle";
  });
}

/** @param {AbortSignal} mine */
async function fetchPrevious(mine) {
  const body = keyBefore.peek();
  if (!body) return;
  try {
    const got = await compareWith(body, mine);
    if (!mine.aborted) previous.value = got;
  } catch {
    // without it there is no “before” to show; what is wrong with the data is said by the comparison
    if (!mine.aborted) previous.value = null;
  }
}

/** @param {string} body @param {AbortSignal} mine */
async function diagnose(body, mine) {
  const known = diagnoses.get(body);
  if (known) {
    return batch(() => {
      diagnosis.value = known;
      found.value = known.candidates;
      stage.value = "done";
    });
  }
  batch(() => {
    diagnosis.value = null;
    found.value = [];
    progress.value = { share: 0 };
    stage.value = "running";
    trouble.value = null;
  });
  try {
    const got = await follow("/api/diagnoses", JSON.parse(body), (name, data) => {
      if (name === "progress" && !mine.aborted) heed(data);
    }, mine);
    if (mine.aborted) return;
    diagnoses.keep(body, got);
    batch(() => {
      diagnosis.value = got;
      found.value = got.candidates;
      stage.value = "done";
    });
  } catch (error) {
    if (mine.aborted) return;
    trouble.value = asApiError(error);
    stage.value = "failed";
  }
}

/** @param {Progress} data */
function heed(data) {
  batch(() => {
    progress.value = data;
    const one = data.found;
    if (!one) return;
    const others = found.peek().filter((c) => c.effect !== one.effect);
    found.value = [...others, one].sort((a, b) => b.gain_percent - a.gain_percent);
  });
}

/** Ends the diagnosis; what it found stays. */
export function cancel() {
  control.abort();
  stage.value = "cancelled";
}

/** Asks for all of it again. */
export const again = () => void start(key.peek());

/** The message for a field of the request, by its path. @param {string} name */
export function messageFor(name) {
  const told = fault.value;
  if (!told?.field) return null;
  const path = told.field.replace(/^body\./, "");
  return path === name || path.startsWith(`${name}.`) ? told.words : null;
}

const shownNow = computed(() => view.value === "compare");
const AFTER_MS = 30;
let asked = /** @type {string | null} */ (null);

/** Starts asking; called once, when the view is built. It rests while another view is shown. */
export function startComparing() {
  let timer = 0;
  effect(() => {
    const body = key.value;
    clearTimeout(timer);
    if (!shownNow.value || body === asked) return;
    timer = setTimeout(() => {
      asked = body;
      start(body);
    }, AFTER_MS);
  });
}
