// @ts-check
// Requests to the server: one JSON error shape, one request in flight per question, the latest wins.

export class ApiError extends Error {
  /** @param {string} message @param {{field?: string | null, hint?: string | null, status?: number}} [more]
   */
  constructor(message, { field = null, hint = null, status = 0 } = {}) {
    super(message);
    this.field = field;
    this.hint = hint;
    this.status = status;
  }
  /** Message and hint as one text. */
  get words() {
    return [this.message, this.hint].filter((text) => text != null && text !== "").map(sentence).join(" ");
  }
}

/** @param {string | null} text */
const sentence = (text) =>
  String(text).replace(/^[a-z]/, (c) => c.toUpperCase()).replace(/([^.!?:])$/, "$1.");

/** @param {string} path @param {RequestInit} [init] */
async function request(path, init) {
  let response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (init?.signal?.aborted) throw error;
    throw new ApiError("The server does not answer. Is “mckibben serve” still running?");
  }
  const body = await response.json().catch(() => null);
  if (response.ok && body) return body;
  const told = body?.error;
  const message = told?.message ?? `The server answered with status ${response.status}.`;
  throw new ApiError(message, { field: told?.field, hint: told?.hint, status: response.status });
}

/** @param {string} path */
export const get = (path) => request(path);

/** @param {string} path @param {unknown} body @param {AbortSignal} [signal] */
export const post = (path, body, signal) =>
  request(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });

const PATIENCE_MS = 400;

/** Asks with the newest body only: while one request is under way the next waits; a newer one replaces it.
 * A request that takes long is aborted as soon as it is out of date.
 * @template B, A
 * @param {(body: B, signal: AbortSignal) => Promise<A>} ask
 * @param {(answer: A, body: B) => void} done @param {(error: ApiError, body: B) => void} failed
 * @returns {(body: B) => void} */
export function latest(ask, done, failed) {
  /** @type {{body: B} | null} */
  let waiting = null;
  /** @type {{control: AbortController, since: number} | null} */
  let running = null;
  const next = async () => {
    if (!waiting || running) return;
    const { body } = waiting;
    waiting = null;
    const control = new AbortController();
    running = { control, since: performance.now() };
    try {
      const answer = await ask(body, control.signal);
      if (!control.signal.aborted) done(answer, body);
    } catch (error) {
      if (error instanceof ApiError) failed(error, body);
      else if (!control.signal.aborted) throw error;
    } finally {
      running = null;
      next();
    }
  };
  return (body) => {
    waiting = { body };
    if (running && performance.now() - running.since > PATIENCE_MS) running.control.abort();
    next();
  };
}
