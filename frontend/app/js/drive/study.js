// @ts-check
// The study in the document: what is varied in a drive, task or model, how, and which figures are watched; SI. Other
// views open a study of their drive or model here.
import { siOf } from "../format.js";
import { muscleInput } from "../muscle/document.js";
import { isObject } from "../paths.js";
import { siNumber } from "../quantities.js";
import { addPart, doc, edit } from "../state.js";
import { musclesById } from "../store.js";
import { driveDocument } from "./document.js";
import { requestOf } from "./task.js";

/** @typedef {import("../types.js").Doc} Doc */
/** @typedef {import("../types.js").Study} Study */
/** @typedef {import("../types.js").Varied} Varied */
/** @typedef {import("../types.js").Watched} Watched */
/** @typedef {import("../types.js").Drive} Drive */

/** @type {Study["method"]["type"][]} */
const METHODS = [
  "grid",
  "list",
  "monte_carlo",
  "latin_hypercube",
  "sobol",
  "morris",
  "optimisation",
  "robust",
];
const SUBJECTS = ["drive", "task", "model"];
const FORMS = ["range", "logarithmic", "values", "uniform", "triangular", "normal", "lognormal"];
/** Half the width of the assumed spread of a quantity, as a share of it. */
export const SPREAD = 0.05;
const MOST = 100, MOST_VALUES = 1000;

/** @param {string} path @returns {Watched} */
export const watched = (path) => ({ path, goal: null, at_least: null, at_most: null });

/** @param {string} path @param {number | null} value @param {Varied["form"]} [form] @returns {Varied} */
export function varied(path, value, form = "range") {
  const half = value === null ? null : SPREAD * (Math.abs(value) || 1);
  /** @param {number} sign */
  const end = (sign) =>
    value === null ? null : Number((value + sign * /** @type {number} */ (half)).toPrecision(9));
  return {
    path,
    form,
    from: end(-1),
    to: end(1),
    points: 5,
    values: [],
    mean: value,
    deviation: half && half / 2,
    log_deviation: SPREAD / 2,
    least: null,
    most: null,
  };
}

/** Figures that one usually wants. @type {Record<Study["subject"], string[]>} */
export const USUAL = {
  drive: ["positioning_time", "rise_time", "max_speed", "impact_energy", "supplied_volume_anr"].map((name) =>
    `timing.extend.${name}`
  ),
  model: ["positioning_time", "rise_time", "max_speed", "impact_energy", "supplied_volume_anr"].map((name) =>
    `timing.extend.${name}`
  ),
  task: ["best.time", "best.air_volume_anr", "best.probability"],
};

/** @returns {Study} */
const defaultStudy = () => ({
  subject: "drive",
  quantities: [],
  figures: USUAL.drive.map(watched),
  assumed: false,
  method: {
    type: "monte_carlo",
    runs: 200,
    samples: 64,
    trajectories: 20,
    population: 40,
    generations: 10,
    seed: 1,
  },
});

/** @param {unknown} x @returns {number | null} */
const numberOr = (x) => typeof x === "number" && Number.isFinite(x) ? x : null;
/** @param {unknown} x */
const isCount = (x) => Number.isInteger(x) && Number(x) >= 0;

/** Reads the study of a link or file; missing values take their defaults.
 * @param {unknown} raw @returns {Study} @throws {Error} says which part is invalid */
function readStudy(raw) {
  const start = defaultStudy();
  if (raw === undefined) return start;
  if (!isObject(raw)) throw new Error("“study” is not an object");
  const { subject, quantities = [], figures = start.figures, method = {}, assumed } = raw;
  const isList = (/** @type {unknown} */ x) =>
    Array.isArray(x) && x.length <= MOST && x.every((one) => isObject(one) && typeof one.path === "string");
  if (!isList(quantities)) throw new Error("“study.quantities” is invalid");
  if (!isList(figures)) throw new Error("“study.figures” is invalid");
  if (!isObject(method)) throw new Error("“study.method” is invalid");
  const counts = Object.entries(start.method).map(([key, value]) =>
    key === "type"
      ? [key, METHODS.includes(method.type) ? method.type : value]
      : [key, isCount(method[key]) ? method[key] : value]
  );
  return {
    subject: SUBJECTS.includes(subject) ? subject : start.subject,
    quantities: quantities.map((/** @type {Record<string, any>} */ q) => ({
      path: q.path,
      form: FORMS.includes(q.form) ? q.form : "range",
      from: numberOr(q.from),
      to: numberOr(q.to),
      points: isCount(q.points) ? q.points : 5,
      mean: numberOr(q.mean),
      deviation: numberOr(q.deviation),
      log_deviation: numberOr(q.log_deviation) ?? SPREAD / 2,
      least: numberOr(q.least),
      most: numberOr(q.most),
      values: Array.isArray(q.values)
        ? q.values.filter((x) => numberOr(x) !== null).slice(0, MOST_VALUES)
        : [],
    })),
    figures: figures.map((/** @type {Record<string, any>} */ f) => ({
      path: f.path,
      goal: f.goal === "minimise" || f.goal === "maximise" ? f.goal : null,
      at_least: numberOr(f.at_least),
      at_most: numberOr(f.at_most),
    })),
    assumed: assumed === true,
    method: /** @type {Study["method"]} */ (Object.fromEntries(counts)),
  };
}

addPart("study", { start: defaultStudy, read: readStudy });

/** The parts of the drive that is studied: that of the Transient view, or the model of the open case in it.
 * @param {Doc} d */
export function partsOf(d) {
  if (d.study.subject !== "model") {
    return { muscle: d.design.muscle, effects: d.design.effects, transient: d.transient };
  }
  const drive = { ...d.transient.drive, ...(d.compare.drive ?? {}) };
  return { muscle: d.compare.muscle, effects: d.compare.effects, transient: { ...d.transient, drive } };
}

/** What is studied, as requests take it. @param {Doc} d */
export function subjectOf(d) {
  if (d.study.subject === "task") return { task: requestOf(d.sizing) };
  const { muscle, effects, transient } = partsOf(d);
  return { drive: driveDocument(transient, muscleInput(muscle), effects) };
}

/** Opens a Monte Carlo study of what matters in most drives: load, supply pressure, length. Nobody has stated their
 * spread, so it is assumed. @param {"drive" | "model"} subject */
export function studyTolerance(subject) {
  const d = doc.peek(), parts = partsOf({ ...d, study: { ...d.study, subject } });
  const { load, supply } = parts.transient.drive;
  const ofPreset = musclesById.peek().get(parts.muscle.preset ?? "")?.geometry?.nominal_length;
  const values = {
    "load.mass": siNumber(load?.mass, { unit: "kg" }),
    "supply.pressure": siNumber(supply?.pressure, { unit: "Pa" }),
    "muscle.nominal_length": parts.muscle.values.nominal_length ?? (ofPreset ? siOf(ofPreset) : null),
  };
  const quantities = Object.entries(values).flatMap(([path, value]) =>
    value ? [varied(path, value, "uniform")] : []
  );
  edit((now) => ({
    ...now,
    view: "studies",
    study: {
      ...now.study,
      subject,
      quantities,
      figures: USUAL[subject].map(watched),
      assumed: true,
      method: { ...now.study.method, type: "monte_carlo" },
    },
  }), "study of the tolerance");
}
