// @ts-check
// Requests to the server, and the one shape of its errors.
import { attend, found, locked, lost, watch } from "./connection.js";

export class ApiError extends Error {
  /** @param {string} message @param {{field?: string | null, hint?: string | null, status?: number}} [more]
   */
  constructor(message, { field = null, hint = null, status = 0 } = {}) {
    super(message);
    this.field = field;
    this.hint = hint;
    this.status = status;
  }
  /** Message and hint as sentences, without hints for programs. */
  get words() {
    const hint = /(^|\s)("\w+": |(GET|PUT|POST|PATCH|DELETE) \/)/.test(this.hint ?? "") ? null : this.hint;
    return [this.message, hint].filter((text) => text != null && text !== "").map(sentence).join(" ");
  }
}

/** @param {string | null} text */
const sentence = (text) =>
  String(text).replace(/^[a-z]/, (c) => c.toUpperCase()).replace(/([^.!?:])$/, "$1.");

/** What is wrong with a file, without its name where the words begin with it. @param {string} name @param {string} words */
export const aboutFile = (name, words) =>
  words.toLowerCase().startsWith(name.toLowerCase())
    ? words.slice(name.length).replace(/^[:,]\s*/, "")
    : words;

/** The status of an error that is no answer: the server could not be reached. */
export const UNREACHED = -1;

/** @param {string} path @param {RequestInit} [init] @param {boolean} [long] whether it may take its time */
async function reach(path, init, long = true) {
  const end = long ? () => {} : watch();
  try {
    const response = await fetch(path, init);
    (response.status === 401 ? locked : found)();
    return response;
  } catch (error) {
    if (init?.signal?.aborted) throw error;
    lost();
    throw new ApiError("The server does not answer. Is “mckibben serve” still running?", {
      status: UNREACHED,
    });
  } finally {
    end();
  }
}

/** @param {Response} response */
async function answerOf(response) {
  const body = await response.json().catch(() => null);
  if (response.ok && body) return body;
  throw errorOf(body, response.status);
}

/** @param {any} body @param {number} status */
const errorOf = (body, status) =>
  new ApiError(body?.error?.message ?? `The server answered with status ${status}.`, {
    field: body?.error?.field,
    hint: body?.error?.hint,
    status,
  });

/** @param {string} path @param {RequestInit} [init] */
export const request = async (path, init) => answerOf(await reach(path, init, false));

/** @param {string} path @param {AbortSignal} [signal] */
export const get = (path, signal) => request(path, { signal });

/** @param {string} path @param {unknown} body @param {AbortSignal} [signal] */
export const post = (path, body, signal) =>
  request(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });

/** Changes something that is kept. @param {"POST" | "PATCH" | "DELETE"} method @param {string} path
 * @param {unknown} [body] */
export const send = (method, path, body) =>
  request(
    path,
    body === undefined
      ? { method }
      : { method, headers: { "content-type": "application/json" }, body: JSON.stringify(body) },
  );

/** Sends a file as it is. @param {"PUT" | "POST"} method @param {string} path @param {Blob} file
 * @param {AbortSignal} [signal] */
export const sendFile = (method, path, file, signal) => request(path, { method, body: file, signal });

/** An answer that is text instead of JSON. @param {string} path @param {unknown} body */
export async function postForText(path, body) {
  const response = await reach(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  });
  return response.ok ? response.text() : answerOf(response);
}

/** An answer that is a file, with the name that the server gives it. @param {string} path @param {unknown} body
 * @returns {Promise<{name: string, blob: Blob}>} */
export async function postForFile(path, body) {
  const response = await reach(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  });
  if (!response.ok) return answerOf(response);
  const [, name = "file"] = /filename="([\w.-]+)"/.exec(response.headers.get("content-disposition") ?? "") ??
    [];
  return { name, blob: await response.blob() };
}

/** One event of a stream: its name and its data. @param {string} text
 * @returns {{event: string, data: any} | null} */
function readEvent(text) {
  /** @type {Record<string, string>} */
  const parts = {};
  for (const line of text.split(/\r?\n/)) {
    const [, key, value] = /^(\w+): ?(.*)$/.exec(line) ?? [];
    if (key) parts[key] = key in parts ? `${parts[key]}\n${value}` : value;
  }
  return parts.data === undefined ? null : { event: parts.event ?? "message", data: JSON.parse(parts.data) };
}

/** Long work whose answer comes as events, the last of which is "done".
 * @param {string} path @param {unknown} body @param {(event: string, data: any) => void} onEvent for every event
 * before
 * @param {AbortSignal} signal ends the work on the server too
 * @returns {Promise<any>} the data of "done" */
export async function postForEvents(path, body, onEvent, signal) {
  const { heard, end } = attend();
  try {
    return await eventsOf(path, body, (event, data) => {
      heard();
      onEvent(event, data);
    }, signal);
  } finally {
    end();
  }
}

/** @param {string} path @param {unknown} body @param {(event: string, data: any) => void} onEvent
 * @param {AbortSignal} signal @returns {Promise<any>} */
async function eventsOf(path, body, onEvent, signal) {
  const response = await reach(path, {
    method: "POST",
    headers: { "content-type": "application/json", accept: "text/event-stream" },
    body: JSON.stringify(body),
    signal,
  });
  if (!response.headers.get("content-type")?.startsWith("text/event-stream")) return answerOf(response);
  const reader = /** @type {ReadableStream<Uint8Array<ArrayBuffer>>} */ (response.body)
    .pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read().catch((error) => {
      if (signal.aborted) throw error;
      lost();
      throw new ApiError("The connection to the server was lost.", { status: UNREACHED });
    });
    const blocks = (rest + (value ?? "")).split(/\r?\n\r?\n/);
    rest = blocks.pop() ?? "";
    for (const block of blocks) {
      const { event, data } = readEvent(block) ?? {};
      if (event === "done") return data;
      if (event === "error") throw errorOf(data.error ? data : { error: data }, 422);
      if (event && !signal.aborted) onEvent(event, data);
    }
    if (done) throw new ApiError("The connection ended before the work was done.");
  }
}

/** Which field of the page the message of a refused request belongs to.
 * @param {() => ApiError | null} error the error to show, if there is one
 * @param {(path: string) => string} keyOf the field of the page for a path of the request */
export function fieldMessages(error, keyOf) {
  const keyOfError = () => {
    const path = error()?.field;
    return path ? keyOf(path.replace(/^body\.?/, "")) : null;
  };
  return {
    /** The field of the page the error belongs to. */
    field: keyOfError,
    /** The message for a field. @param {string} key */
    at: (key) => keyOfError() === key ? error()?.words ?? null : null,
    /** The message for a field or for one inside it. @param {string} key */
    within: (key) => {
      const field = keyOfError();
      return field === key || field?.startsWith(`${key}.`) ? error()?.words ?? null : null;
    },
  };
}
