// @ts-check
// From the study in the document to its runs by the server, which go on while another view is shown.
import { SPREAD, subjectOf, varied } from "../../drive/study.js";
import { carryStudy, keepTable } from "../../projects/session.js";
import { computed, effect, signal } from "../../reactive.js";
import { fieldMessages, post, postForEvents } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { waitingWords } from "../../server/waiting.js";
import { doc, edit, view } from "../../state.js";
import { status } from "../../store.js";
import { forMethod, isSpread, quantityRequest } from "./forms.js";

/** @typedef {import("../../types.js").Doc} Doc */
/** @typedef {import("../../types.js").Study} Study */
/** @typedef {import("../../types.js").Varied} Varied */
/** @typedef {import("../../types.js").Watched} Watched */
/** @typedef {import("../../types.js").S["StudyResult"]} Answer */
/** @typedef {import("../../types.js").S["StudyOptions"]} Options */
/** @typedef {import("../../types.js").S["StudyColumn"]} Column */
/** @typedef {Record<string, (number | string | null)[]>} Columns */
/** The rows on screen. @typedef {{columns: Column[], table: Columns, planned: number}} Shown */

export const study = computed(() => doc.value.study);

/** @param {Partial<Study>} patch @param {string} label */
export const editStudy = (patch, label) => edit((d) => ({ ...d, study: { ...d.study, ...patch } }), label);

/** @param {number} place @param {Partial<Varied>} patch @param {string} label */
export const editQuantity = (place, patch, label) =>
  editStudy({
    quantities: study.peek().quantities.map((q, i) => i === place ? { ...q, ...patch } : q),
    assumed: false,
  }, label);

/** @param {number} place @param {Partial<Watched>} patch @param {string} label */
export const editFigure = (place, patch, label) =>
  editStudy({ figures: study.peek().figures.map((f, i) => i === place ? { ...f, ...patch } : f) }, label);

/** @param {Partial<Study["method"]>} patch @param {string} label */
export function editMethod(patch, label) {
  const now = study.peek();
  const method = { ...now.method, ...patch };
  const quantities = now.quantities.map((q) => forMethod(q, method.type));
  editStudy({ method, quantities }, label);
}

// ---- what the subject has

const optionsQuestion = new Question((
  text,
  signal,
) => /** @type {Promise<Options>} */ (post("/api/studies/options", JSON.parse(text), signal)));
/** What can be varied and watched, and why that is not known. */
export const { answer: options, error: optionsFault } = optionsQuestion;
const subjectText = computed(() => JSON.stringify({ subject: subjectOf(doc.value) }));

export const quantityOptions = computed(() =>
  new Map((options.value?.quantities ?? []).map((q) => [q.path, q]))
);
export const figureOptions = computed(() => new Map((options.value?.figures ?? []).map((f) => [f.path, f])));

/** Whether the server can write Parquet. */
export const hasParquet = computed(() => options.value?.parquet === true);

/** @param {string} path */
export const addQuantity = (path) => {
  const now = study.peek(), value = quantityOptions.peek().get(path)?.value ?? null;
  const one = forMethod(varied(path, value, "uniform"), now.method.type);
  editStudy({ quantities: [...now.quantities, one], assumed: true }, `vary ${path}`);
};
export const spreadText = `±${Math.round(100 * SPREAD)}\u00a0%`;

// ---- the request

/** @param {Study["method"]} m */
export function methodRequest({ type, runs, samples, trajectories, population, generations, seed }) {
  if (type === "grid" || type === "list") return { type };
  if (type === "sobol") return { type, samples, seed };
  if (type === "morris") return { type, trajectories, seed };
  if (type === "optimisation") return { type, population, generations, seed };
  return { type, runs, seed };
}

/** The study document, as the server and the command line take it. @param {Doc} d */
export function studyRequest(d) {
  const { quantities, figures, method } = d.study;
  const designed = new Set(quantities.filter((q) => !isSpread(q)).map((q) => q.path));
  const wanted = figures.filter((f) => f.goal !== null);
  const limited = figures.filter((f) => f.at_least !== null || f.at_most !== null);
  return {
    schema: 1,
    subject: subjectOf(d),
    quantities: quantities.map((q) => quantityRequest(q, isSpread(q) && designed.has(q.path))),
    figures: figures.map((f) => f.path),
    goals: wanted.map((f) => ({ figure: f.path, direction: f.goal })),
    limits: limited.map((f) => ({
      figure: f.path,
      ...(f.at_least === null ? {} : { at_least: f.at_least }),
      ...(f.at_most === null ? {} : { at_most: f.at_most }),
    })),
    method: methodRequest(method),
  };
}

// ---- the runs

const REDRAW_MS = 300;
/** Rows of the study under way, or of one that was cancelled. */
export const live = signal(/** @type {Shown | null} */ (null));
/** The place in the server's queue, in words; empty once the study runs. */
export const waiting = signal("");
/** When the study was asked [ms], how many rows there are, and how many of them are from before. */
export const pace = signal({ began: 0, made: 0, planned: 0, now: 0, kept: 0 });
/** The document whose runs are on screen. */
export const ranOf = signal(/** @type {Doc | null} */ (null));

/** @param {Record<string, any>} request @returns {Column[]} */
function columnsOf(request) {
  return [
    ...request.quantities.map((/** @type {any} */ q) => ({
      name: q.relative ? `${q.path} (factor)` : q.path,
      kind: "quantity",
      unit: q.relative ? "1" : quantityOptions.peek().get(q.path)?.unit ?? null,
    })),
    ...request.figures.map((/** @type {string} */ path) => ({
      name: path,
      kind: "figure",
      unit: figureOptions.peek().get(path)?.unit ?? null,
    })),
  ];
}

const question = new Question((text, signal) => {
  const request = JSON.parse(text), columns = columnsOf(request), began = performance.now();
  /** @type {Columns} */
  const table = {};
  let drawn = 0;
  live.value = null;
  waiting.value = "";
  pace.value = { began, made: 0, planned: 0, now: began, kept: 0 };
  return /** @type {Promise<Answer>} */ (postForEvents("/api/studies", request, (name, data) => {
    if (name !== "progress") return;
    waiting.value = data.waiting ? waitingWords(data.waiting) : "";
    if (!data.found?.table) return;
    for (const [key, values] of Object.entries(data.found.table)) (table[key] ??= []).push(...values);
    const now = performance.now();
    const { planned, kept } = data.found;
    pace.value = { began, made: table.run.length, planned, now, kept };
    if (now - drawn < REDRAW_MS && table.run.length < data.found.planned) return;
    drawn = now;
    live.value = { columns, table: { ...table }, planned: data.found.planned };
  }, signal));
}, { patience: 0, keeps: false, arrived: (answer) => showEnd(answer) });

export const { answer, asked: askedText } = question;
export const stage = computed(() => {
  const now = question.stage.value;
  return now === "asking" ? "running" : now === "answered" ? "done" : now;
});
const studyText = computed(() => JSON.stringify(studyRequest(doc.value)));
/** Why the study as it is now was refused. */
export const fault = computed(() =>
  stage.value === "failed" && question.asked.value === studyText.value ? question.error.value : null
);
/** The runs on screen: all of a finished study, else those made so far. @type {import("../../reactive.js").Signal<Shown | null>} */
export const shown = computed(() => {
  const a = answer.value;
  return a ? { columns: a.columns, table: a.table, planned: a.planned } : live.value;
});

/** The runs on screen are not those of the study beside them. */
export const stale = computed(() => shown.value !== null && question.asked.value !== studyText.value);

/** Seconds until the study is done, as far as the runs made so far say; null: not known yet. */
export const remaining = computed(() => {
  const { began, made, planned: all, now, kept } = pace.value;
  return made > kept ? ((now - began) / 1e3) * (all - made) / (made - kept) : null;
});

/** The request that was under way when the page was left; it goes on when the page comes back. */
const UNDER_WAY = "mckibben-study";
/** @param {string | null} text */
function remember(text) {
  try {
    if (text === null) sessionStorage.removeItem(UNDER_WAY);
    else sessionStorage.setItem(UNDER_WAY, text);
  } catch {
    // storage is disabled or full: the runs are kept by the server all the same
  }
}
function wasUnderWay() {
  try {
    return sessionStorage.getItem(UNDER_WAY);
  } catch {
    return null;
  }
}

/** @param {Answer} a */
function showEnd(a) {
  remember(null);
  const isKept = a.kept === a.runs;
  status.value = a.message ??
    (isKept
      ? `${a.runs} runs, kept from before.`
      : `${a.runs} runs made in ${(a.wall_ms / 1e3).toFixed(1)} s.`);
  if (!isKept) keepTable(JSON.parse(question.asked.peek() ?? "null"));
}

export function run() {
  ranOf.value = doc.peek();
  remember(studyText.peek());
  question.ask(studyText.peek(), true);
}
/** Ends the study on the server too; the runs made so far stay, there as well. */
export function cancel() {
  remember(null);
  question.cancel();
}

// ---- what the server plans and kept

const keptQuestion = new Question((
  text,
  signal,
) => /** @type {Promise<import("../../types.js").S["StudyKeptAnswer"]>} */ (
  post("/api/studies/kept", JSON.parse(text), signal)
));
const keptAnswer = computed(() =>
  keptQuestion.answered.value === studyText.value ? keptQuestion.answer.value : null
);
/** How many runs of the study as it is now are kept from before; 0 as long as that is not known. */
export const keptRuns = computed(() => keptAnswer.value?.runs ?? 0);
/** How many runs the study as it is now has; null as long as that is not known. */
export const planned = computed(() =>
  keptAnswer.value?.planned ??
    (question.asked.value === studyText.value ? shown.value?.planned ?? null : null)
);
/** How many runs that is, in words; "" as long as that is not known. */
export const plannedText = computed(() =>
  planned.value === null ? "" : `${planned.value.toLocaleString("en")} runs`
);

/** A study that was finished before, or left while it ran, is shown without being asked for. */
function followKept() {
  keptQuestion.follow(() => studyText.value, {
    delay: 300,
    active: () =>
      view.value === "studies" && stage.value !== "running" && question.asked.value !== studyText.value &&
      study.value.quantities.length > 0,
  });
  effect(() => {
    const kept = keptRuns.value, all = planned.value;
    if (!kept || all === null || stage.peek() === "running" || question.asked.peek() === studyText.peek()) {
      return;
    }
    if (kept >= all || wasUnderWay() === studyText.peek()) run();
  });
}

/** @param {string} path */
const fieldOf = (path) => path.replace(/^(quantities\.\d+)\..*$/, "$1");
export const { field: faultField, within: messageWithin } = fieldMessages(() => fault.value, fieldOf);

/** Called once, when the page is built. */
export function startStudies() {
  carryStudy(() => studyRequest(doc.peek()));
  optionsQuestion.follow(() => subjectText.value, { delay: 150, active: () => view.value === "studies" });
  effect(() => {
    document.documentElement.dataset.study = stage.value;
  });
  followKept();
  addEventListener("pagehide", () => question.cancel());
}
