// @ts-check
// Loads into the store what the server knows: effects and presets of every kind.
import { effect } from "../reactive.js";
import { effects, outage, presets, problems } from "../store.js";
import { ApiError, get, UNREACHED } from "./client.js";
import { returned } from "./connection.js";

/** @typedef {import("../types.js").Problem} Problem */

const KINDS = [
  "muscles",
  "valves",
  "tubes",
  "fittings",
  "measurements",
  "curves",
  "designs",
  "drives",
  "tasks",
];

/** @param {string} kind */
export async function loadKind(kind) {
  const answer = await get(`/api/presets/${kind}`);
  presets.value = { ...presets.peek(), [kind]: answer.presets };
  const others = problems.peek().filter((p) => /** @type {any} */ (p).kind !== kind);
  problems.value = [...others, ...answer.problems.map((/** @type {Problem} */ p) => ({ ...p, kind }))];
}

async function loadEffects() {
  const answer = await get("/api/effects");
  effects.value = answer.effects;
  problems.value = [...problems.peek(), ...(answer.problems ?? [])];
}

/** Loads everything at once. A failure shows as a banner instead of being thrown; once the server is back, it is
 * tried again. */
export async function loadAll() {
  const since = returned.peek();
  try {
    outage.value = "";
    problems.value = [];
    await Promise.all([loadEffects(), ...KINDS.map(loadKind)]);
  } catch (error) {
    if (!(error instanceof ApiError)) reportError(error);
    if (!(error instanceof ApiError) || error.status !== UNREACHED) {
      outage.value = error instanceof ApiError
        ? error.words
        : "The catalogue could not be read. Reload the page.";
      return;
    }
    const stop = effect(() => {
      if (returned.value === since) return;
      queueMicrotask(() => {
        stop();
        loadAll();
      });
    });
  }
}
