// @ts-check
// How a quantity can vary: the forms that each method takes, from one form to another, and the request of each.

/** @typedef {import("../../types.js").Study} Study */
/** @typedef {import("../../types.js").Varied} Varied */
/** @typedef {Varied["form"]} Form */
/** @typedef {Study["method"]["type"]} Method */

/** @type {Record<Form, string>} */
export const FORM_NAMES = {
  range: "Range",
  logarithmic: "Logarithmic range",
  values: "List of values",
  uniform: "Uniform distribution",
  triangular: "Triangular distribution",
  normal: "Normal distribution",
  lognormal: "Lognormal distribution",
};
/** @type {Form[]} */
const DISTRIBUTIONS = ["uniform", "triangular", "normal", "lognormal"];
/** @type {Form[]} */
const RANGES = ["range", "logarithmic"];

/** The forms that a method takes. @param {Method} method @returns {Form[]} */
export function formsOf(method) {
  if (method === "list") return ["values"];
  if (method === "grid") return [...RANGES, "values"];
  if (method === "optimisation") return RANGES;
  if (method === "robust") return [...RANGES, "values", ...DISTRIBUTIONS];
  return [...RANGES, ...DISTRIBUTIONS];
}

/** Whether a quantity differs between specimens, that is, has a distribution. @param {Varied} q */
export const isSpread = (q) => DISTRIBUTIONS.includes(q.form);

/** The ends that stand for a quantity of any form. @param {Varied} q @returns {[number | null, number | null]} */
function endsOf({ form, from, to, mean, deviation, log_deviation, values }) {
  if (form === "values") return values.length ? [Math.min(...values), Math.max(...values)] : [from, to];
  if (form === "normal" && mean !== null && deviation !== null) {
    return [mean - 2 * deviation, mean + 2 * deviation];
  }
  if (form === "lognormal" && mean !== null && log_deviation !== null) {
    return [mean * Math.exp(-2 * log_deviation), mean * Math.exp(2 * log_deviation)];
  }
  return [from, to];
}

/** @param {number} x */
const short = (x) => Number(x.toPrecision(9));

/** The same quantity in another form: about the same spread, as far as that has one. @param {Varied} q @param {Form} form
 * @returns {Varied} */
export function inForm(q, form) {
  if (q.form === form) return q;
  const [from, to] = endsOf(q);
  if (from === null || to === null) return { ...q, form };
  const middle = short((from + to) / 2), quarter = short(Math.abs(to - from) / 4);
  const next = { ...q, form, from: short(from), to: short(to) };
  if (form === "values") {
    const last = Math.max(2, q.points) - 1;
    const step = (/** @type {number} */ i) =>
      q.form === "logarithmic" && from > 0
        ? from * (to / from) ** (i / last)
        : from + ((to - from) * i) / last;
    next.values = Array.from({ length: last + 1 }, (_, i) => short(step(i)));
  } else if (isSpread(next) && form !== "uniform") {
    next.mean = isSpread(q) && q.form !== "uniform" && q.mean !== null ? q.mean : middle;
    next.deviation = quarter;
    next.log_deviation = next.mean > 0 ? short(quarter / next.mean) : q.log_deviation;
  }
  return next;
}

/** @param {Varied} q @param {Method} method @returns {Varied} the quantity in a form that the method takes */
export function forMethod(q, method) {
  const forms = formsOf(method);
  return forms.includes(q.form) ? q : inForm(q, forms[0]);
}

/** The quantity as requests take it. With `isFactor` the distribution is that of a factor on the value of the
 * design; its middle stands for 1. @param {Varied} q @param {boolean} isFactor
 * @returns {Record<string, unknown>} */
export function quantityRequest(q, isFactor) {
  const { path, form, from, to, points, mean, deviation, log_deviation, least, most, values } = q;
  if (form === "values") return { path, values };
  if (form === "range") return { path, from: from ?? undefined, to: to ?? undefined, points };
  if (form === "logarithmic") {
    return { path, from: from ?? undefined, to: to ?? undefined, points, scale: "logarithmic" };
  }
  const middle = form === "uniform" ? (from === null || to === null ? null : (from + to) / 2) : mean;
  const unit = isFactor && middle ? middle : 1;
  const by = (/** @type {number | null} */ x) => x === null ? undefined : x / unit;
  const bounds = { least: by(least), most: by(most) }, ends = { least: by(from), most: by(to) };
  const laws = {
    uniform: ends,
    triangular: { ...ends, mode: by(mean) },
    normal: { mean: by(mean), deviation: by(deviation), ...bounds },
    lognormal: { median: by(mean), log_deviation: log_deviation ?? undefined, ...bounds },
  };
  return {
    path,
    distribution: { type: form, ...laws[form] },
    ...(isFactor && middle ? { relative: true } : {}),
  };
}
