// @ts-check
// The document in the address bar: #v1.<deflate-raw, base64url>.
import { signal } from "./reactive.js";
import { readDoc } from "./state.js";

/** What a link leaves out to stay short enough: nothing, the other cases, those and the earlier steps and pinned
 * models of the open one, or all. @typedef {"" | "cases" | "steps" | "all"} Left */

const PREFIX = "#v1.";
/** Browsers, mail programs and chats cut longer links. */
const LONGEST = 60000;
/** What the address leaves out now. */
export const left = signal(/** @type {Left} */ (""));

/** What a link holds that leaves something out. */
export const PARTLY = {
  cases: "holds only the open case",
  steps: "holds only the open case without its earlier steps and pinned models",
  all: "would be too long",
};

/** So many bytes at a time are arguments of a call, which may have few. */
const CHUNK = 0x8000;

/** @param {Uint8Array<ArrayBuffer>} bytes @param {CompressionStream | DecompressionStream} stream */
async function through(bytes, stream) {
  const answer = new Response(new Blob([bytes]).stream().pipeThrough(stream));
  return new Uint8Array(await answer.arrayBuffer());
}

/** @param {import("./types.js").Doc} doc @returns {Promise<string>} the hash of the whole document, however long */
export async function toHash(doc) {
  const bytes = new TextEncoder().encode(JSON.stringify(doc));
  const packed = await through(bytes, new CompressionStream("deflate-raw"));
  let letters = "";
  for (let i = 0; i < packed.length; i += CHUNK) {
    letters += String.fromCharCode(...packed.subarray(i, i + CHUNK));
  }
  return PREFIX + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** @type {[Left, (d: import("./types.js").Doc) => import("./types.js").Doc][]} */
const SHORTER = [
  ["cases", (d) => ({ ...d, cases: { ...d.cases, at: 0, rest: [] } })],
  ["steps", (d) => ({ ...d, compare: { ...d.compare, history: [], pins: [], traces: [] } })],
];

/** A link that is not too long, and what it leaves out; `whole`: the hash that leaves out nothing.
 * @param {import("./types.js").Doc} doc @returns {Promise<{hash: string, whole: string, left: Left}>} */
export async function linkOf(doc) {
  const whole = await toHash(doc);
  if (whole.length <= LONGEST) return { hash: whole, whole, left: "" };
  let less = doc;
  for (const [left, shorten] of SHORTER) {
    less = shorten(less);
    const hash = await toHash(less);
    if (hash.length <= LONGEST) return { hash, whole, left };
  }
  return { hash: "", whole, left: "all" };
}

/** @param {string} hash @param {number} [longest] a link of anywhere has a limit, what this browser kept has none
 * @returns {Promise<import("./types.js").Doc | null>} null: the address holds no link
 * @throws {Error} says why the link cannot be read */
export async function fromHash(hash, longest = LONGEST) {
  if (hash.length < 2) return null;
  if (!hash.startsWith(PREFIX)) throw new Error("it does not start with “v1.”");
  if (hash.length > longest) throw new Error("it is longer than any link this program writes");
  let raw;
  try {
    const text = hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/");
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const bytes = await through(packed, new DecompressionStream("deflate-raw"));
    raw = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new Error("it is incomplete or damaged");
  }
  return readDoc(raw);
}
