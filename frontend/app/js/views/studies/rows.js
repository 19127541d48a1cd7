// @ts-check
// The rows on screen: sorted, filtered, pinned. Row numbers are places in the table; pins are numbers of runs.
import { computed, effect, signal } from "../../reactive.js";
import { answer, shown, stage } from "./model.js";

/** @typedef {import("./model.js").Column} Column */

export const sorting = signal({ name: "run", descending: false });
/** Ends of what is shown of a column, in SI. */
export const filter = signal({
  name: "",
  least: /** @type {number | null} */ (null),
  most: /** @type {number | null} */ (null),
});
/** Ranges drawn on the axes of the parallel coordinates: column -> both ends in SI; a run must lie in all of them. */
export const ranges = signal(/** @type {Record<string, [number, number]>} */ ({}));
/** @param {string} name @param {[number, number] | null} range null: all runs again */
export function keepRange(name, range) {
  const { [name]: _old, ...others } = ranges.peek();
  ranges.value = range ? { ...others, [name]: range } : others;
}
/** Numbers of runs that are compared, the first of them with the others. */
export const pins = signal(/** @type {number[]} */ ([]));
export const MOST_PINS = 5;

/** @param {string} name @param {number} place */
export const valueAt = (name, place) => shown.value?.table[name]?.[place] ?? null;

/** @param {string} name @returns {(number | null)[]} of a column, null for texts and missing values */
export const numbersOf = (name) =>
  (shown.value?.table[name] ?? []).map((v) => typeof v === "number" ? v : null);

/** Places of the rows that pass the filter, sorted. */
export const places = computed(() => {
  const now = shown.value;
  if (!now) return [];
  const { name, least, most } = filter.value, { name: by, descending } = sorting.value;
  const tested = now.table[name], drawn = Object.entries(ranges.value);
  const passes = (/** @type {number} */ i) => {
    const v = tested?.[i];
    const isOut = drawn.some(([column, [from, to]]) => {
      const value = now.table[column]?.[i];
      return typeof value !== "number" || value < from || value > to;
    });
    if (isOut) return false;
    if (!tested || (least === null && most === null)) return true;
    return typeof v === "number" && (least === null || v >= least) && (most === null || v <= most);
  };
  const found = now.table.run.map((_, i) => i).filter(passes), column = now.table[by] ?? now.table.run;
  const sign = descending ? -1 : 1;
  return found.sort((a, b) => {
    const x = column[a], y = column[b];
    if (x === null || y === null) return x === y ? 0 : x === null ? 1 : -1; // what is missing comes last
    return sign * (x < y ? -1 : x > y ? 1 : 0);
  });
});

/** @param {string} name */
export function sortBy(name) {
  const now = sorting.peek();
  sorting.value = { name, descending: now.name === name && !now.descending };
}

/** @param {number} run */
export function pin(run) {
  const now = pins.peek();
  pins.value = now.includes(run) ? now.filter((r) => r !== run) : [...now, run].slice(-MOST_PINS);
}

export const front = computed(() => new Set(answer.value?.front ?? []));

/** Figures that the runs on screen have. */
export const figures = computed(() => (shown.value?.columns ?? []).filter((c) => c.kind === "figure"));
export const quantities = computed(() => (shown.value?.columns ?? []).filter((c) => c.kind === "quantity"));

/** Runs of another study have other numbers. */
export const startRows = () =>
  effect(() => {
    if (stage.value !== "running") return;
    pins.value = [];
    filter.value = { name: "", least: null, most: null };
    ranges.value = {};
    sorting.value = { name: "run", descending: false };
  });
