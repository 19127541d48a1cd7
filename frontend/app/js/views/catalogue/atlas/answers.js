// @ts-check
// The pictures of the atlas, computed by the server on this muscle.
import { post } from "../../../server/client.js";
import { Question } from "../../../server/question.js";
import { computed, signal } from "../../../reactive.js";
import { muscleInput } from "../../../muscle/document.js";
import { muscle } from "../../../muscle/preset.js";
import { seen } from "../../../muscle/seen.js";
import { effects } from "../../../store.js";
import { filter } from "../table.js";

/** @typedef {import("../../../types.js").S["Signatures"]} Signatures */
/** @typedef {import("../../../types.js").S["SignaturePicture"]} Picture */
/** @typedef {import("../../../types.js").Effect} Effect */

const AT_ONCE = 2;

/** @param {string} effect @param {Record<string, number>} [values] */
const bodyOf = (effect, values = {}) => JSON.stringify({ muscle: muscleInput(muscle.value), effect, values });
/** @param {string} text @param {AbortSignal} [signal] @returns {Promise<Signatures>} */
const ask = (text, signal) => post("/api/signatures", JSON.parse(text), signal);

/** The effects that the filter shows, those most like the residual of the case first. */
export const shown = computed(() => {
  const words = filter.value.search.toLowerCase().split(/\s+/), like = seen.value?.likeness ?? {};
  return effects.value
    .filter((e) =>
      words.every((word) => `${e.title} ${e.family} ${e.signature.text}`.toLowerCase().includes(word))
    )
    .sort((a, b) => (like[b.id] ?? -1) - (like[a.id] ?? -1));
});
/** The effect that is shown in full: the chosen one, else the first that the filter shows. */
export const chosen = computed(() =>
  shown.value.find(({ id }) => id === filter.value.selected) ?? shown.value[0] ?? null
);
/** The sizes that the sliders set, by effect. */
export const sizes = signal(/** @type {Record<string, Record<string, number>>} */ ({}));

const full = new Question(ask);
export const { answer, error: fault } = full;
export const outdated = computed(() => full.stale.value);
export const followChosen = (/** @type {() => boolean} */ active) =>
  full.follow(() => chosen.value ? bodyOf(chosen.value.id, sizes.value[chosen.value.id]) : null, { active });

/** Answers at the usual size, by the text of the question. @type {Map<string, import("../../../reactive.js").Signal<Signatures | null>>} */
const kept = new Map();
/** @type {string[]} */
const waiting = [];
let running = 0;

async function next() {
  const text = running < AT_ONCE ? waiting.shift() : undefined;
  if (text === undefined) return;
  running++;
  try {
    const found = await ask(text);
    const place = kept.get(text);
    if (place) place.value = found;
  } catch {
    kept.delete(text); // the page as a whole tells that the server is gone; asked again when it is shown again
  }
  running--;
  next();
}

/** The pictures of an effect at its usual size; null until they are there. @param {string} effect */
export function usual(effect) {
  const text = bodyOf(effect);
  let place = kept.get(text);
  if (!place) {
    place = signal(/** @type {Signatures | null} */ (null));
    kept.set(text, place);
    waiting.push(text);
    queueMicrotask(next);
  }
  return place.value;
}
