// @ts-check
// How the evidence of the data is divided among the models of the board. Pure functions.

/** A model as it is weighed. `error`: its RMS; `fitted`: the number of its fitted values; `autocorrelation` of its
 * residual at the lags 1, 2, …
 * @typedef {{error: number, fitted: number, rows: number, autocorrelation: number[]}} Weighed */

/** Correlation from which on readings count as independent. */
const INDEPENDENT = 0.05;
/** Smallest error that counts, as a share of the noise; less is chance. */
const BELOW_NOISE = 0.5;

/** Number of independent rows: n / (1 + 2 Σ ρ), summed up to the first small correlation; at least two.
 * @param {Weighed} model */
export function independentRows({ rows, autocorrelation }) {
  const end = autocorrelation.findIndex((rho) => !(rho > INDEPENDENT));
  const sum = (end < 0 ? autocorrelation : autocorrelation.slice(0, end)).reduce((all, rho) => all + rho, 0);
  return Math.max(rows / (1 + 2 * sum), 2);
}

/** Scores n ln e² + penalty(n) k of models with the error e, the number k of fitted values and the number n of
 * independent rows of the best model, the same for all, less the lowest of them; null: not comparable.
 * @param {(Weighed | null)[]} models fitted to the same rows @param {number | null} noise
 * @param {(n: number) => number} penalty @returns {(number | null)[]} */
function scores(models, noise, penalty) {
  const known = models.filter((m) => m !== null);
  const [best] = [...known].sort((a, b) => a.error - b.error);
  if (known.length < 2 || known.some((m) => m.rows !== best.rows)) return models.map(() => null);
  const n = independentRows(best), least = Math.max(BELOW_NOISE * (noise ?? 0), Number.MIN_VALUE);
  const score = (/** @type {Weighed} */ m) =>
    2 * n * Math.log(Math.max(m.error, least)) + m.fitted * penalty(n);
  const lowest = Math.min(...known.map(score));
  return models.map((m) => m && score(m) - lowest);
}

/** Akaike's criterion (1974) n ln e² + 2 k of each model, above the lowest.
 * @param {(Weighed | null)[]} models @param {number | null} noise */
export const aicOf = (models, noise) => scores(models, noise, () => 2);

/** Weights exp(−S/2) of models over their sum, S = n ln e² + k ln n (Schwarz 1978). They say which model these data
 * favour among those shown, not that one of them is right.
 * @param {(Weighed | null)[]} models @param {number | null} noise @returns {(number | null)[]} */
export function weightsOf(models, noise) {
  const raw = scores(models, noise, Math.log).map((s) => s === null ? null : Math.exp(-s / 2));
  const sum = raw.reduce((/** @type {number} */ all, w) => all + (w ?? 0), 0);
  return raw.map((w) => w === null ? null : w / sum);
}
