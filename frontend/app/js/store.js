// @ts-check
// Effects and presets of the server, which server/presets.js loads; and the status line.
import { readable } from "./format.js";
import { computed, effect, signal } from "./reactive.js";

/** @typedef {import("./types.js").Effect} Effect */
/** @typedef {import("./types.js").Preset} Preset */
/** @typedef {import("./types.js").Problem} Problem */

export const effects = signal(/** @type {Effect[]} */ ([]));
/** @type {import("./reactive.js").Signal<Record<string, Preset[]>>} */
export const presets = signal(/** @type {Record<string, Preset[]>} */ ({}));
export const problems = signal(/** @type {Problem[]} */ ([]));
/** Why the page cannot work at all, shown as a banner. */
export const outage = signal("");
/** The sentence in the status line; it disappears after a few seconds. */
export const status = signal("");
const STATUS_MS = 8000;
let clearing = 0;
effect(() => {
  clearTimeout(clearing);
  if (status.value) clearing = setTimeout(() => (status.value = ""), STATUS_MS);
});

export const muscles = computed(() => presets.value.muscles ?? []);
export const musclesById = computed(() => new Map(muscles.value.map((m) => [m.id, m])));
export const effectsById = computed(() => new Map(effects.value.map((e) => [e.id, e])));
/** Title of an effect; the words of its id while the catalogue is not loaded. @param {string} id */
export const effectTitle = (id) => effectsById.value.get(id)?.title ?? readable(id);
/** Measurements and curves of the maker: everything the model can be compared with. */
export const references = computed(() => [
  ...(presets.value.measurements ?? []),
  ...(presets.value.curves ?? []),
]);
