// @ts-check
// The Compare view's part of the document: measurements, model, the models before it, and what is shown. The
// server checks what the numbers mean.
import { isObject } from "../../paths.js";
import { addPart } from "../../state.js";

/** @typedef {import("../../types.js").Compare} Compare */
/** @typedef {import("../../types.js").Fit} Fit */
/** @typedef {import("../../types.js").Step} Step */

/** @type {import("../../types.js").Tab[]} */
const TABS = [
  "auto",
  "angle",
  "contraction",
  "pressure",
  "velocity",
  "direction",
  "time",
  "histogram",
  "autocorrelation",
  "cross",
  "loops",
];
export const MOST_FILES = 16, MOST_PINS = 6;
const MOST_STEPS = 40;
/** Labels of start models: the ideal one, and one that comes with a measurement or drive document. */
export const IDEAL = "Ideal muscle", PROVIDED = "Start model";

/** @returns {Compare} */
export const newCompare = () => ({
  files: [],
  muscle: { preset: "DMSP-20", form: "braid", values: { nominal_length: 0.3 } },
  start: "ideal",
  effects: {},
  freed: [],
  free: [],
  fit: {},
  label: IDEAL,
  holdout: null,
  history: [],
  drive: null,
  noise: null,
  decisions: { of: "", use: [], keep: [] },
  mystery: null,
  tab: "auto",
  over: null,
  channel: null,
  brush: null,
  before: false,
  twins: [],
  tells: [],
  pins: [],
  board: false,
  differing: false,
  traces: [],
});

/** @param {unknown} x @returns {x is number} */
const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
/** @param {unknown} x */
const isText = (x) => typeof x === "string";
/** @param {unknown} x */
const isName = (x) => x === null || typeof x === "string";
/** @param {unknown} x */
const isValues = (x) => isObject(x) && Object.values(x).every(isNumber);
/** @param {unknown} x */
const isTexts = (x) => Array.isArray(x) && x.every(isText);
/** @param {unknown} x */
const isEffects = (x) =>
  x === null ||
  (isObject(x) && Object.values(x).every((values) =>
    isObject(values) && Object.values(values).every((v) => isNumber(v) || isText(v))
  ));
/** @param {unknown} x */
const isFit = (x) =>
  isObject(x) &&
  Object.values(x).every((values) =>
    isObject(values) && Object.values(values).every((f) => isObject(f) && typeof f.at_bound === "boolean")
  );
/** @param {unknown} x */
const isRange = (x) => Array.isArray(x) && x.length === 2 && x.every(isNumber);
/** @param {unknown} x */
const isSaid = (x) => isText(x) || (isObject(x) && isText(x.value) && x.origin === "suggested");
/** @param {unknown} x */
const isChosen = (x) =>
  isObject(x) && isText(x.id) && isText(x.name) && ["fit", "validation", "off"].includes(x.use) &&
  (x.experiment === undefined || (isObject(x.experiment) && Object.values(x.experiment).every(isSaid))) &&
  (x.prepare === undefined || isTexts(x.prepare));
/** @param {unknown} x */
const isFiles = (x) => Array.isArray(x) && x.length <= MOST_FILES && x.every(isChosen);
/** @param {unknown} x */
const isDecisions = (x) => isObject(x) && isText(x.of) && isTexts(x.use) && isTexts(x.keep);
/** @param {unknown} x */
const isError = (x) => x === null || isNumber(x);
/** @param {unknown} x */
const isTelling = (x) =>
  isObject(x) && isTexts(x.pair) && isText(x.declared) && isText(x.protocol) && isError(x.separation) &&
  isError(x.minutes);
/** @param {unknown} x */
const areTellings = (x) => Array.isArray(x) && x.every(isTelling);
/** @param {unknown} x */
const isStep = (x) =>
  isObject(x) && isText(x.label) && isEffects(x.effects) && isTexts(x.freed) && isValues(x.values) &&
  isFit(x.fit) && isError(x.rmse) && isError(x.holdout) &&
  (x.context === undefined ||
    (isObject(x.context) && isFiles(x.context.files) && isDecisions(x.context.decisions))) &&
  (x.twins === undefined || isTexts(x.twins)) && (x.tells === undefined || areTellings(x.tells));
/** @param {unknown} x */
const isPinned = (x) => isStep(x) && isObject(x) && isText(x.name) && isText(x.of);
/** @param {unknown} x */
const isBoolean = (x) => typeof x === "boolean";

/** @type {Record<keyof Compare, (x: unknown) => boolean>} */
const CHECKS = {
  files: isFiles,
  muscle: (x) =>
    isObject(x) && isName(x.preset) && ["braid", "thread", "rhombus"].includes(x.form) && isValues(x.values),
  start: (x) => x === "ideal" || x === "preset",
  effects: isEffects,
  freed: isTexts,
  free: isTexts,
  fit: isFit,
  label: isText,
  holdout: isError,
  history: (x) => Array.isArray(x) && x.length <= MOST_STEPS && x.every(isStep),
  drive: (x) => x === null || isObject(x),
  noise: isError,
  decisions: isDecisions,
  mystery: isName,
  tab: (x) => TABS.some((one) => one === x),
  over: isName,
  channel: isName,
  brush: (x) => x === null || (isObject(x) && Object.values(x).every(isRange)),
  before: isBoolean,
  twins: isTexts,
  tells: areTellings,
  pins: (x) => Array.isArray(x) && x.length <= MOST_PINS && x.every(isPinned),
  board: isBoolean,
  differing: isBoolean,
  traces: (x) => Array.isArray(x) && x.every((i) => Number.isInteger(i)),
};

/** Reads the Compare part of a link or file; a missing part takes its default.
 * @param {unknown} raw @returns {Compare} @throws {Error} names the invalid part */
export function readCompare(raw) {
  const start = newCompare();
  if (raw === undefined) return start;
  if (!isObject(raw)) throw new Error("“compare” is not an object");
  const known = Object.entries(raw).filter(([key]) => Object.hasOwn(CHECKS, key));
  for (const [key, value] of known) {
    if (!CHECKS[/** @type {keyof Compare} */ (key)](value)) {
      throw new Error(`“compare.${key}” is invalid`);
    }
  }
  return { ...start, ...Object.fromEntries(known) };
}

addPart("compare", { start: newCompare, read: readCompare });

/** What is fitted beside the effects: geometry by its name, and where and how fast each run begins. */
export const START = "start";
/** What stays freed with other data: starts are those of the runs before. @param {string[]} free */
export const freeOfOther = (free) => free.filter((name) => name !== START);

/** What is said of the data now. @param {Compare} c @returns {import("../../types.js").Context} */
export const contextOf = ({ files, decisions }) => ({ files, decisions });

/** The current model as a step of the history. @param {Compare} c @param {number | null} rmse
 * @param {number | null} holdout @returns {Step} */
export const stepOf = (c, rmse, holdout) => ({
  label: c.label,
  effects: c.effects,
  freed: c.freed,
  values: c.muscle.values,
  fit: c.fit,
  rmse,
  holdout: c.holdout ?? holdout,
  ...(c.twins.length ? { twins: c.twins, tells: c.tells } : {}),
});

/** The files of now with what a step says of their experiments: files brought or removed since stay so.
 * @param {Compare["files"]} files @param {import("../../types.js").Context | undefined} context
 * @returns {Compare["files"]} */
export const filesOf = (files, context) =>
  files.map((file) => {
    const then = context?.files.find((one) => one.id === file.id);
    if (!then) return file;
    const { experiment: _now, ...rest } = file;
    return then.experiment ? { ...rest, experiment: then.experiment } : rest;
  });

/** The document with the model of a step. @param {Compare} c @param {Step} step
 * @param {Step[]} history @returns {Compare} */
export const withStep = (c, step, history) => ({
  ...c,
  label: step.label,
  effects: step.effects,
  freed: step.freed,
  muscle: { ...c.muscle, values: step.values },
  fit: step.fit,
  holdout: step.holdout,
  twins: step.twins ?? [],
  tells: step.tells ?? [],
  files: filesOf(c.files, step.context),
  decisions: step.context?.decisions ?? c.decisions,
  history: history.slice(-MOST_STEPS),
  before: false,
});

/** The document with a new start model: without effects, or with those of the preset.
 * @param {Compare} c @param {"ideal" | "preset"} start @returns {Compare} */
export const withStartModel = (c, start = c.start) => ({
  ...c,
  start,
  effects: start === "ideal" ? {} : null,
  freed: [],
  fit: {},
  label: start === "ideal" ? IDEAL : "Effects of the preset",
  holdout: null,
  history: [],
  twins: [],
  tells: [],
  brush: null,
  before: false,
});

/** What is known of a fitted value: where one fit does not give its standard error, another one.
 * @param {Fit[string][string] | undefined} one @param {Fit[string][string] | undefined} other */
export const surer = (one, other) => one?.stderr != null ? one : other ?? one;

/** Standard errors of fitted values, and which of them are at a bound.
 * @param {Record<string, Record<string, import("./types.js").Fitted>>} parameters @returns {Fit} */
export const fitOf = (parameters) =>
  Object.fromEntries(
    Object.entries(parameters).map(([id, values]) => [
      id,
      Object.fromEntries(
        Object.entries(values).filter(([, p]) => p.fitted)
          .map(([name, { stderr, at_bound }]) => [name, { stderr, at_bound }]),
      ),
    ]),
  );
