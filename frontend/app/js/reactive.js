// @ts-check
// Signals: values that effects follow.

/** `deaf`: it follows no signal, it only holds the effects made inside.
 * @typedef {{fn: () => void, deps: Set<Set<Effect>>, kids: Effect[], live: boolean, deaf?: boolean}} Effect */
let running = /** @type {Effect | null} */ (null);
const queue = /** @type {Set<Effect>} */ (new Set());
let depth = 0;

/** A value that effects follow: read `s.value`, write `s.value = x`, look without following with `s.peek()`.
 * @template T */
export class Signal {
  /** @param {T} start */
  constructor(start) {
    this.v = start;
    this.subs = /** @type {Set<Effect>} */ (new Set());
  }
  get value() {
    if (running && !running.deaf) {
      this.subs.add(running);
      running.deps.add(this.subs);
    }
    return this.v;
  }
  set value(next) {
    if (Object.is(next, this.v)) return;
    this.v = next;
    batch(() => this.subs.forEach((e) => queue.add(e)));
  }
  peek() {
    return this.v;
  }
}

/** @template T @param {T} start @returns {Signal<T>} */
export const signal = (start) => new Signal(start);

/** Unsubscribes an effect from the signals it read and stops the effects made inside it.
 * @param {Effect} e @param {boolean} [live] it will run again */
function clear(e, live = false) {
  e.live = live;
  e.deps.forEach((subs) => subs.delete(e));
  e.deps.clear();
  e.kids.forEach((kid) => clear(kid));
  e.kids = [];
  queue.delete(e);
}

/** @template T @param {Effect | null} e @param {() => T} fn */
function within(e, fn) {
  const outer = running;
  running = e;
  try {
    return fn();
  } finally {
    running = outer;
  }
}

/** @param {Effect} e */
function run(e) {
  clear(e, true);
  within(e, e.fn);
}

/** Runs fn now and whenever a signal it read changes; effects made inside stop before each re-run.
 * @param {() => void} fn @returns {() => void} stops it */
export function effect(fn) {
  /** @type {Effect} */
  const e = { fn, deps: new Set(), kids: [], live: true };
  running?.kids.push(e);
  run(e);
  return () => clear(e);
}

/** Runs fn; the effects made inside live until they are stopped together. @template T @param {() => T} fn
 * @returns {[T, () => void]} */
export function scope(fn) {
  /** @type {Effect} */
  const e = { fn: () => {}, deps: new Set(), kids: [], live: true, deaf: true };
  return [within(e, fn), () => clear(e)];
}

/** Effects made inside fn are not stopped with the effect that is running. @template T @param {() => T} fn */
export const apart = (fn) => within(null, fn);

/** A signal that follows others. @template T @param {() => T} fn @returns {Signal<T>} */
export function computed(fn) {
  const s = /** @type {Signal<T>} */ (signal(/** @type {unknown} */ (undefined)));
  effect(() => {
    s.value = fn();
  });
  return s;
}

/** Runs fn, then once each effect it touched. @param {() => void} fn */
export function batch(fn) {
  depth++;
  try {
    fn();
    if (depth === 1) {
      for (const e of queue) {
        queue.delete(e);
        if (e.live) run(e);
      }
    }
  } finally {
    depth--;
  }
}
