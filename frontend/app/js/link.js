// @ts-check
// The document in the address bar: #v1.<deflate-raw, base64url>.
import { readDoc } from "./state.js";

const PREFIX = "#v1.", LONGEST = 60000;

/** @param {Uint8Array<ArrayBuffer>} bytes @param {CompressionStream | DecompressionStream} stream */
async function through(bytes, stream) {
  const answer = new Response(new Blob([bytes]).stream().pipeThrough(stream));
  return new Uint8Array(await answer.arrayBuffer());
}

/** @param {import("./types.js").Doc} doc @returns {Promise<string>} the hash */
export async function toHash(doc) {
  const bytes = new TextEncoder().encode(JSON.stringify(doc));
  const packed = await through(bytes, new CompressionStream("deflate-raw"));
  const text = btoa(String.fromCharCode(...packed));
  return PREFIX + text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** @param {string} hash @returns {Promise<import("./types.js").Doc | null>} null: the address holds no link
 * @throws {Error} says why the link cannot be read */
export async function fromHash(hash) {
  if (hash.length < 2) return null;
  if (!hash.startsWith(PREFIX)) throw new Error("it does not start with “v1.”");
  if (hash.length > LONGEST) throw new Error("it is longer than any link this program writes");
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
