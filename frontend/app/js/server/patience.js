// @ts-check
// What waits for a server that is gone, instead of failing: the banner of the page says what is going on.
import { effect } from "../reactive.js";
import { ApiError, UNREACHED } from "./client.js";
import { connection, look, returned } from "./connection.js";

/** When the server has come back, or the work is no longer wanted.
 * @param {number} since how often it had come back before @param {AbortSignal} [signal] @returns {Promise<void>} */
const comeback = (since, signal) =>
  new Promise((resolve) => {
    const stop = effect(() => {
      if (returned.value !== since) done();
    });
    function done() {
      signal?.removeEventListener("abort", done);
      queueMicrotask(() => stop());
      resolve();
    }
    signal?.addEventListener("abort", done);
  });

/** Asks again each time the server comes back, until it answers. Only for requests that may be repeated.
 * @template A @param {() => Promise<A>} ask @param {AbortSignal} [signal] @returns {Promise<A>} */
export async function untilAnswered(ask, signal) {
  for (;;) {
    const since = returned.peek();
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== UNREACHED || signal?.aborted) throw error;
    }
    await comeback(since, signal);
    signal?.throwIfAborted();
  }
}

/** Modules that are fetched when they are needed, once there is a server for them.
 * @template A @param {() => Promise<A>} load @param {() => void} [onWait] @returns {Promise<A>}
 * @throws what is wrong with the modules, when it is not the server */
export async function untilLoaded(load, onWait) {
  for (;;) {
    const since = returned.peek();
    try {
      return await load();
    } catch (error) {
      await look();
      if (connection.peek() !== "gone" && returned.peek() === since) throw error;
    }
    onWait?.();
    await comeback(since);
  }
}
