// @ts-check
// Loads into the store what the server knows: effects and presets of every kind.
import { effects, outage, presets, problems } from "../store.js";
import { ApiError, get } from "./client.js";

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

/** Loads everything at once. A failure shows as a banner instead of being thrown. */
export async function loadAll() {
  try {
    outage.value = "";
    await Promise.all([loadEffects(), ...KINDS.map(loadKind)]);
  } catch (error) {
    outage.value = error instanceof ApiError ? error.words : String(error);
  }
}
