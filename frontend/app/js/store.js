// @ts-check
// What the server knows and does not change while the page is open: effects, presets, version.
import { computed, effect, signal } from "./reactive.js";
import { ApiError, get } from "./server/client.js";

/** @typedef {import("./types.js").Effect} Effect */
/** @typedef {import("./types.js").Preset} Preset */
/** @typedef {import("./types.js").Problem} Problem */

export const effects = signal(/** @type {Effect[]} */ ([]));
/** @type {import("./reactive.js").Signal<Record<string, Preset[]>>} */
export const presets = signal(/** @type {Record<string, Preset[]>} */ ({}));
export const problems = signal(/** @type {Problem[]} */ ([]));
/** Why the page cannot work at all; shown as a banner with “Try again”. */
export const outage = signal("");
/** The one sentence in the status line; it leaves by itself. */
export const status = signal("");
const STATUS_MS = 8000;
let clearing = 0;
effect(() => {
  clearTimeout(clearing);
  if (status.value) clearing = setTimeout(() => (status.value = ""), STATUS_MS);
});

export const KINDS = [
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

export const muscles = computed(() => presets.value.muscles ?? []);
export const musclesById = computed(() => new Map(muscles.value.map((m) => [m.id, m])));
export const effectsById = computed(() => new Map(effects.value.map((e) => [e.id, e])));
/** Curves of the maker and measurements: everything that can be laid over the model. */
export const references = computed(() => [
  ...(presets.value.measurements ?? []),
  ...(presets.value.curves ?? []),
]);

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

/** Everything at once; a failure is told in the banner instead of thrown. */
export async function loadAll() {
  try {
    outage.value = "";
    await Promise.all([loadEffects(), ...KINDS.map(loadKind)]);
  } catch (error) {
    outage.value = error instanceof ApiError ? error.words : String(error);
  }
}
