// @ts-check
// Whether the server answers. While it does not, one banner says so in every view, and the page tries again by itself.
import { batch, signal } from "../reactive.js";

/** `slow`: a short request waits for long; `locked`: the server asks for its token.
 * @typedef {"up" | "slow" | "gone" | "locked"} Connection */

const SLOW_MS = 5000, FIRST_MS = 1000, LONGEST_MS = 10_000;
/** How long the server may take to say that it is there [ms]. */
const HEALTH_MS = 10_000;

export const connection = signal(/** @type {Connection} */ ("up"));
/** How often the server has come back, or may have: whoever waits for it asks again. */
export const returned = signal(0);

let timer = 0, pause = FIRST_MS, waiting = 0;

/** A request got no answer. */
export function lost() {
  connection.value = "gone";
  if (!timer) timer = setTimeout(look, pause);
}

/** The server has another token than this page. */
export function locked() {
  connection.value = "locked";
  if (!timer) timer = setTimeout(look, pause);
}

/** A request was answered. */
export function found() {
  clearTimeout(timer);
  timer = 0;
  pause = FIRST_MS;
  if (connection.peek() === "gone" || connection.peek() === "locked") {
    batch(() => {
      connection.value = waiting ? "slow" : "up";
      returned.value++;
    });
  }
}

/** Whether the server compiles its integrators, once after an installation: what needs them waits. */
export const compiling = signal(false);

/** Asks whether the server is there. A question that gets lost, in a sleeping network for example, would wait for
 * ever. @returns {Promise<() => void>} what follows from the answer */
const asked = async () => {
  try {
    const answer = await fetch("/api/health", { cache: "no-store", signal: AbortSignal.timeout(HEALTH_MS) });
    if (answer.ok) compiling.value = (await answer.json()).compiling;
    return answer.ok ? found : answer.status === 401 ? locked : lost;
  } catch {
    return lost;
  }
};

/** Looks whether the server is there, less and less often. */
export async function look() {
  clearTimeout(timer);
  timer = 0;
  pause = Math.min(2 * pause, LONGEST_MS);
  (await asked())();
}

/** Says that something is slow when it takes for long. @param {() => void} [then] what else happens then
 * @returns {() => void} to be called when it has ended */
function time(then) {
  let late = false;
  const bell = setTimeout(() => {
    late = true;
    waiting++;
    if (connection.peek() === "up") connection.value = "slow";
    then?.();
  }, SLOW_MS);
  return () => {
    clearTimeout(bell);
    if (!late) return;
    late = false;
    waiting--;
    if (!waiting && connection.peek() === "slow") connection.value = "up";
  };
}

/** Asks whether the server is still there; where it is known to be gone, `look` does. */
async function check() {
  if (connection.peek() === "gone") return;
  (await asked())();
}

/** Watches a short request: when it takes for long, the server is asked whether it is still there.
 * @returns {() => void} to be called when it has ended */
export function watch() {
  let beat = 0;
  const end = time(() => {
    check();
    beat = setInterval(check, SLOW_MS);
  });
  return () => {
    clearInterval(beat);
    end();
  };
}

const BEAT_MS = 1000;

/** Watches long work: when it has been silent for a while, the server is asked whether it is still there.
 * @returns {{heard: () => void, end: () => void}} `heard`: for each sign of life; `end`: when the work has ended */
export function attend() {
  let last = performance.now(), isAsking = false;
  const heard = () => (last = performance.now());
  const beat = setInterval(async () => {
    if (isAsking || performance.now() - last < SLOW_MS) return;
    isAsking = true;
    const end = time();
    await check();
    end();
    heard();
    isAsking = false;
  }, BEAT_MS);
  return { heard, end: () => clearInterval(beat) };
}
