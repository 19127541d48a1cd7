// @ts-check
// The answers of the server: first the comparison of model and measurement, then the diagnosis.
import { batch, computed, effect, signal } from "../../reactive.js";
import { doc, edit, look, view } from "../../state.js";
import { ApiError, fieldMessages, post, postForEvents } from "../../server/client.js";
import { Memory, Question } from "../../server/question.js";
import { caseId } from "./cases.js";
import { seen } from "../../muscle/seen.js";
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
/** Changes what is shown, without an undo step. @param {Partial<Compare>} patch */
export const lookCompare = (patch) => look(patchCompare(patch));

// ---- the comparison

const REMEMBERED = 48, AFTER_MS = 30;

/** How long an entry must be looked at before it is drawn [ms]. */
const GLANCE_MS = 90;

/** Without a fit. @type {Memory<Comparison>} */
const comparisons = new Memory(REMEMBERED);

/** @param {string} text @param {boolean} fit @param {AbortSignal} [signal] @returns {Promise<Comparison>} */
const comparisonOf = (text, fit, signal) =>
  post("/api/comparisons", { ...JSON.parse(text), fit, judge: false }, signal);

/** @param {string} text @param {AbortSignal} [signal] */
export const compareWith = (text, signal) => comparisonOf(text, false, signal);

/** The parameters of a model fitted to the data. @param {string} text @param {AbortSignal} [signal] */
export const fitWith = (text, signal) => comparisonOf(text, true, signal);

const modelText = computed(() => keyOf(compare.value));
const comparison = new Question(compareWith, { memory: comparisons, patience: 0 });
/** The comparison with the model of now, why there is none, and whether it belongs to other data or another
 * model than those chosen. */
export const { answer, error: fault, stale } = comparison;
export const isCompared = computed(() =>
  comparison.answered.value === modelText.value && fault.value === null
);

const previousText = computed(() => {
  const last = steps.value.at(-1);
  return last ? keyOf(compare.value, last) : null;
});
/** The comparison with the model before. Errors are shown for the other one only. */
const comparisonBefore = new Question(compareWith, { memory: comparisons, patience: 0 });
export const previous = computed(() => comparisonBefore.error.value ? null : comparisonBefore.answer.value);

const firstText = computed(() => {
  const [first] = steps.value;
  return first ? keyOf(compare.value, first) : null;
});
const comparisonFirst = new Question(compareWith, { memory: comparisons, patience: 0 });
/** The comparison with the first model: it fixes the scale of colours and residuals. */
export const first = computed(() => {
  if (firstText.value === null) return answer.value;
  return comparisonFirst.error.value ? null : comparisonFirst.answer.value;
});

/** A model that is looked at before it is added: its request and its name.
 * @typedef {{text: string | null, label: string}} Preview */
const previewed = signal(/** @type {Preview | null} */ (null));
const comparisonAhead = new Question(compareWith, { memory: comparisons, patience: 0 });
const isAhead = computed(() =>
  previewed.value !== null && comparisonAhead.answered.value === previewed.value.text &&
  comparisonAhead.error.value === null
);
/** The name of the model that is looked at; "": none. */
export const previewLabel = computed(() => isAhead.value ? previewed.value?.label ?? "" : "");
/** Shows a model in the plots before it is added; null: the current one again.
 * @param {import("./request.js").Asked | null} model @param {string} [label] */
export const preview = (
  model,
  label = "",
) => (previewed.value = model && { text: keyOf(compare.peek(), model), label });

/** Comparisons with several models, one after the other; null where the server refused one.
 * @param {(string | null)[]} texts @param {AbortSignal} signal @returns {Promise<(Comparison | null)[]>} */
export async function comparisonsWith(texts, signal) {
  /** @type {(Comparison | null)[]} */
  const found = [];
  for (const text of texts) {
    const known = text === null ? null : comparisons.get(text);
    if (signal.aborted) break;
    if (known !== undefined || text === null) {
      found.push(known ?? null);
      continue;
    }
    try {
      const got = await compareWith(text, signal);
      comparisons.set(text, got);
      found.push(got);
    } catch (error) {
      if (signal.aborted) break;
      if (!(error instanceof ApiError)) throw error;
      found.push(null);
    }
  }
  return found;
}

/** What is drawn: a model that is looked at, the model of now, or with "before" the one it came from. */
export const shown = computed(() => {
  if (isAhead.value) return comparisonAhead.answer.value;
  return compare.value.before && previous.value ? previous.value : answer.value;
});
/** The request of what is drawn. */
const shownText = computed(() => {
  if (isAhead.value) return comparisonAhead.answered.value;
  return compare.value.before && previous.value ? comparisonBefore.answered.value : comparison.answered.value;
});
const insideQuestion = new Question(compareWith, { memory: new Memory(REMEMBERED), patience: 0 });
/** The rows in the chosen range, by channel; null while they are not known. */
export const inside = computed(() =>
  insideQuestion.stale.value ? null : insideQuestion.answer.value?.inside ?? null
);
export const isBefore = computed(() => compare.value.before && previous.value !== null && !isAhead.value);

// ---- the diagnosis

/** Candidates of the diagnosis of a model while it runs. */
const foundSoFar = signal({ text: "", candidates: /** @type {Candidate[]} */ ([]) });
export const progress = signal(/** @type {Progress} */ ({ share: 0 }));

const NOTABLE = 0.98; // error over the error before, from which a refit is worth a step

/** @type {Memory<Diagnosis>} */
const diagnoses = new Memory(REMEMBERED);
const diagnosisQuestion = new Question((text, signal) => {
  batch(() => {
    foundSoFar.value = { text, candidates: [] };
    progress.value = { share: 0 };
  });
  return /** @type {Promise<Diagnosis>} */ (postForEvents(
    "/api/diagnoses",
    JSON.parse(text),
    (name, data) => {
      if (name === "progress") takeProgress(text, data);
    },
    signal,
  ));
}, { memory: diagnoses, patience: 0, keeps: false });
/** The diagnosis, once it is complete, and why it failed. */
export const { answer: diagnosis, error: diagnosisError } = diagnosisQuestion;
/** The steps of a diagnosis beyond the present model; fitting its own numbers counts only where it helps.
 * @type {import("../../reactive.js").Signal<Diagnosis["path"]>} */
export const ahead = computed(() => {
  const [start, ...steps] = diagnosis.value?.path ?? [];
  return steps.filter((step) => !step.refitted || step.rmse < NOTABLE * start.rmse);
});
/** The candidates of the diagnosis; while it runs, those found so far, the best first. */
export const candidates = computed(() => {
  const { text, candidates: some } = foundSoFar.value;
  return diagnosis.value?.candidates ?? (text === diagnosisQuestion.asked.value ? some : []);
});

/** @param {string} text @param {Progress} data */
function takeProgress(text, data) {
  batch(() => {
    progress.value = data;
    const one = data.found;
    if (!one) return;
    const others = foundSoFar.peek().candidates.filter((c) => c.effect !== one.effect);
    const all = [...others, one].sort((a, b) => b.gain_percent - a.gain_percent);
    foundSoFar.value = { text, candidates: all };
  });
}

/** How far comparison and diagnosis are. @type {import("../../reactive.js").Signal<Stage>} */
export const stage = computed(() => {
  const compared = comparison.stage.value;
  if (compared === "idle" || compared === "failed") return "idle";
  if (compared !== "answered") return compared === "asking" ? "waiting" : "cancelled";
  const diagnosed = diagnosisQuestion.stage.value;
  return diagnosed === "asking" ? "running" : diagnosed === "answered" ? "done" : diagnosed;
});

// ---- asking

/** Ends the diagnosis; what it found stays. */
export function cancel() {
  comparison.cancel();
  diagnosisQuestion.cancel();
}

/** Asks once more for what failed or was cancelled. */
export function again() {
  comparison.again();
  diagnosisQuestion.again();
}

/** The message for a field of the request or for one inside it, by its path. */
export const { field: faultField, within: messageFor } = fieldMessages(() => fault.value, (path) => path);

/** Removes the answers to the case before, unless those of the new one are known: its plots are not those. */
function forgetOtherCase() {
  let last = caseId.peek();
  effect(() => {
    if (caseId.value === last) return;
    last = caseId.value;
    preview(null);
    if (comparisons.get(keyOf(doc.peek().compare) ?? "") !== undefined) return;
    for (const one of [comparison, comparisonBefore, comparisonFirst, comparisonAhead, diagnosisQuestion]) {
      one.clear();
    }
  });
}

/** Starts asking; called once, when the view is built. It rests while another view is shown. */
export function startComparing() {
  forgetOtherCase();
  const isShown = () => view.value === "compare";
  comparison.follow(() => modelText.value, { delay: AFTER_MS, active: isShown });
  comparisonBefore.follow(() => previousText.value, { active: () => isCompared.value });
  comparisonFirst.follow(() => firstText.value, { active: () => isCompared.value });
  comparisonAhead.follow(() => previewed.value?.text ?? null, { delay: GLANCE_MS, active: isShown });
  insideQuestion.follow(
    () =>
      brush.value && shownText.value
        ? JSON.stringify({ ...JSON.parse(shownText.value), within: brush.value })
        : null,
    { delay: AFTER_MS, active: isShown },
  );
  diagnosisQuestion.follow(() => fault.value ? null : modelText.value, { active: () => isCompared.value });
}

/** Tells the atlas what this case sees. */
export function showToAtlas() {
  effect(() => {
    const now = answer.value, found = diagnosis.value;
    const all = now?.series ?? [];
    if (!now || !all.length) return void (seen.value = null);
    const of = (/** @type {(s: import("./types.js").Series) => (number | null)[] | null} */ column) =>
      all.flatMap((s) => column(s) ?? s.residual.map(() => null));
    seen.value = {
      kind: now.kind,
      quantity: now.predicted,
      points: {
        contraction: of((s) => s.contraction),
        pressure: of((s) => s.x_pressure),
        time: of((s) => s.time),
      },
      residual: of((s) => s.residual),
      likeness: Object.fromEntries((found?.candidates ?? []).map((c) => [c.effect, c.gain_percent / 100])),
    };
  });
}

/** The held-out error of the model, one number wherever it stands. */
export const heldOut = () =>
  compare.value.holdout ?? diagnosis.value?.baseline.holdout_rmse ?? answer.value?.holdout_rmse ?? null;
