// @ts-check
// A question to the server that is asked again whenever its text changes. Only one request is under way at a
// time, the newest text wins, and requests that are out of date are aborted. All views ask through this.
import { batch, computed, effect, signal } from "../reactive.js";
import { ApiError, UNREACHED } from "./client.js";
import { returned } from "./connection.js";

/** `idle`: nothing is asked; `asking`: there is no answer to the newest text yet.
 * @typedef {"idle" | "asking" | "answered" | "failed" | "cancelled"} Stage */
/** The request as text, by which it is recognized. @typedef {string | null} Text */

/** How long a short request that was sent before the server went may take once it is back [ms]; then it is lost. */
const GRACE_MS = 2000;
/** How long an out-of-date request may still take [ms]: while a slider moves, answers keep coming. */
const PATIENCE_MS = 400;
const FAULT = "The page could not process this answer. Reload it; what you entered is kept in the address.";

/** Answers by the text of their question; those not used for longest are forgotten. @template A */
export class Memory {
  /** @param {number} most how many answers are kept */
  constructor(most) {
    this.most = most;
    /** @type {Map<string, A>} */
    this.answers = new Map();
  }
  /** @param {string} text @returns {A | undefined} */
  get(text) {
    const answer = this.answers.get(text);
    if (answer !== undefined) this.set(text, answer);
    return answer;
  }
  /** @param {string} text @param {A} answer */
  set(text, answer) {
    this.answers.delete(text);
    this.answers.set(text, answer);
    if (this.answers.size > this.most) this.answers.delete([...this.answers.keys()][0]);
  }
  /** @param {string} text */
  forget(text) {
    this.answers.delete(text);
  }
}

/** Calls when the server has been gone and back for a while. @param {() => void} then
 * @returns {() => void} ends the wait */
function awaitComeback(then) {
  const since = returned.peek();
  let timer = 0;
  const stop = effect(() => {
    if (returned.value !== since && !timer) timer = setTimeout(then, GRACE_MS);
  });
  return () => {
    clearTimeout(timer);
    stop();
  };
}

/** `memory`: a text asked before is answered from it, so that undo needs no request. `patience` [ms]: see above;
 * 0 for long work. `keeps`: the last answer stays until the next one arrives (the default), else it is removed
 * when the next request is sent. `arrived` is called with every answer of the server.
 * @template A @typedef {{memory?: Memory<A>, patience?: number, keeps?: boolean,
 *   arrived?: (answer: A) => void}} Options */

/** @template A */
export class Question {
  /** Ends the wait for a server that is gone. */
  stopWaiting = () => {};

  /** @param {(text: string, signal: AbortSignal) => Promise<A>} send @param {Options<A>} [options] */
  constructor(send, { memory, patience = PATIENCE_MS, keeps = true, arrived } = {}) {
    this.send = send;
    this.memory = memory;
    this.patience = patience;
    this.keeps = keeps;
    this.arrived = arrived;

    this.answer = signal(/** @type {A | null} */ (null));
    /** Why the newest request failed; it stays until an answer arrives. */
    this.error = signal(/** @type {ApiError | null} */ (null));
    /** The newest text. */
    this.asked = signal(/** @type {Text} */ (null));
    /** The text that the answer belongs to. */
    this.answered = signal(/** @type {Text} */ (null));
    /** From the last request to its answer [ms]. */
    this.took = signal(0);
    /** The last text that came to an end, and how. */
    this.ended = signal({ text: /** @type {Text} */ (null), stage: /** @type {Stage} */ ("idle") });
    this.stage = computed(() => {
      const text = this.asked.value, { text: last, stage } = this.ended.value;
      return text === null ? "idle" : text === last ? stage : "asking";
    });
    /** The answer is not the one to the newest text. */
    this.stale = computed(() => this.asked.value !== this.answered.value || this.error.value !== null);

    /** @type {Text} the next to be sent */
    this.waiting = null;
    /** @type {{text: string, control: AbortController, since: number} | null} */
    this.running = null;
    this.abortTimer = 0;
    this.followers = 0;
    /** How often the user wanted another try. */
    this.tries = signal(0);
  }

  /** Asks; null removes answer and error.
   * @param {Text} text @param {boolean} [anew] even if the answer is known */
  ask(text, anew = false) {
    if (text === null) return this.clear();
    const known = anew ? undefined : this.memory?.get(text);
    const isShown = !anew && this.answered.peek() === text;
    batch(() => {
      this.asked.value = text;
      this.ended.value = { text: null, stage: "idle" };
      if (known !== undefined) this.settle(text, known);
      else if (isShown) this.settle(text, /** @type {A} */ (this.answer.peek()));
    });
    const isDone = known !== undefined || isShown;
    this.outdate(text, isDone);
    const isUnderWay = this.running?.text === text && !this.running.control.signal.aborted;
    this.waiting = isDone || isUnderWay ? null : text;
    this.next();
  }

  /** Asks the newest text once more, after an error, a cancellation or an answer that its limit of time ended. */
  again() {
    const text = this.asked.peek();
    if (!this.followers) return this.ask(text, true);
    batch(() => {
      if (text !== null) this.memory?.forget(text);
      if (this.answered.peek() === text) this.answered.value = null;
      this.ended.value = { text: null, stage: "idle" };
      this.tries.value++;
    });
  }

  /** Ends the request, on the server too; the last answer stays. */
  cancel() {
    this.waiting = null;
    this.running?.control.abort();
    if (this.stage.peek() === "asking") this.ended.value = { text: this.asked.peek(), stage: "cancelled" };
  }

  clear() {
    this.waiting = null;
    this.running?.control.abort();
    batch(() => {
      this.answer.value =
        this.error.value =
        this.asked.value =
        this.answered.value =
          null;
    });
  }

  /** Asks what `text` gives, again whenever the signals it reads change; null: nothing to ask.
   * @param {() => Text} text
   * @param {{delay?: number, active?: () => boolean}} [o]  `delay`: how long the text must have stayed the same
   *   [ms]; `active`: false holds the question back, for example while its view is hidden
   * @returns {() => void} stops it */
  follow(text, { delay = 0, active = () => true } = {}) {
    let timer = 0;
    this.followers++;
    const newest = computed(text);
    const stop = effect(() => {
      const wanted = newest.value, isActive = active();
      this.tries.value;
      clearTimeout(timer);
      if (wanted === null) return this.clear();
      if (this.asked.peek() === wanted && this.stage.peek() === "cancelled") return;
      this.asked.value = wanted;
      this.outdate(wanted);
      if (!isActive) return;
      if (delay) timer = setTimeout(() => this.ask(wanted), delay);
      else this.ask(wanted);
    });
    return () => {
      clearTimeout(timer);
      this.followers--;
      stop();
      this.cancel();
    };
  }

  /** Aborts the running request if it is for another text: after the time it may still take, or at once.
   * @param {Text} text @param {boolean} [now] */
  outdate(text, now = false) {
    clearTimeout(this.abortTimer);
    if (!this.running || this.running.text === text) return;
    const { control, since } = this.running, left = now ? 0 : since + this.patience - performance.now();
    if (left <= 0) control.abort();
    else this.abortTimer = setTimeout(() => control.abort(), left);
  }

  /** Sends what waits, if nothing is under way. */
  async next() {
    if (this.waiting === null || this.running) return;
    const text = this.waiting, control = new AbortController(), since = performance.now();
    this.waiting = null;
    this.running = { text, control, since };
    if (!this.keeps) batch(() => (this.answer.value = this.answered.value = null));
    const stopAwaiting = this.patience ? awaitComeback(() => this.lose(control)) : () => {};
    /** @type {{answer: A} | {thrown: unknown}} */
    let outcome;
    try {
      outcome = { answer: await this.send(text, control.signal) };
    } catch (thrown) {
      outcome = { thrown };
    }
    stopAwaiting();
    this.running = null;
    clearTimeout(this.abortTimer);
    this.next();
    if (control.signal.aborted) return;
    if ("thrown" in outcome) return this.fail(text, outcome.thrown);
    const { answer } = outcome;
    this.memory?.set(text, answer);
    batch(() => {
      this.took.value = performance.now() - since;
      this.settle(text, answer);
      this.arrived?.(answer);
    });
  }

  /** A request that no answer comes to is sent once more, if it is still wanted. @param {AbortController} control */
  lose(control) {
    if (this.running?.control !== control || control.signal.aborted) return;
    const { text } = this.running;
    if (this.waiting === null && this.asked.peek() === text) this.waiting = text;
    control.abort();
  }

  /** Asks once more when the server is back; until then the banner of the page tells that it is gone.
   * @param {string} text */
  wait(text) {
    this.stopWaiting();
    const since = returned.peek();
    this.stopWaiting = effect(() => {
      if (returned.value === since) return;
      queueMicrotask(() => {
        this.stopWaiting();
        if (this.asked.peek() === text && this.stage.peek() === "asking" && !this.running) {
          this.waiting = text;
          this.next();
        }
      });
    });
  }

  /** @param {string} text @param {A} answer */
  settle(text, answer) {
    batch(() => {
      this.error.value = null;
      this.answer.value = answer;
      this.answered.value = text;
      this.ended.value = { text, stage: "answered" };
    });
  }

  /** @param {string} text @param {unknown} thrown */
  fail(text, thrown) {
    if (!(thrown instanceof ApiError)) reportError(thrown); // a fault of this program, not an answer
    if (thrown instanceof ApiError && thrown.status === UNREACHED) return this.wait(text);
    batch(() => {
      this.error.value = thrown instanceof ApiError ? thrown : new ApiError(FAULT);
      this.ended.value = { text, stage: "failed" };
    });
  }
}
