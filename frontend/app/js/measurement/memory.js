// @ts-check
// The mapping of each kind of file, kept in this browser and used for the next file of its kind.

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Mapping} Mapping */
/** What was answered for a kind of file, and for which file.
 * @typedef {{signature: string, name: string, mapping: Mapping,
 *   said: import("./types.js").Experiment}} Kept */

const KEY = "mckibben-mappings", MOST = 40;

/** What files of one laboratory have in common: format, sheet, heads and units; none of the numbers.
 * @param {Preview} p as the file is read without any mapping */
export function signatureOf(p) {
  const read = p.tables.filter((table) => table.is_read).map((table) => table.name);
  const units = p.raw?.rows.find(({ row }) => row === p.raw?.units)?.cells ?? [];
  return JSON.stringify([p.format, read.length === 1 ? read[0] : "", p.columns.map((c) => c.header), units]);
}

/** Private windows may refuse storage; then nothing is remembered. @returns {Kept[]} the newest first */
function stored() {
  try {
    const all = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return Array.isArray(all) ? all.filter((one) => typeof one?.signature === "string" && one.mapping) : [];
  } catch {
    return [];
  }
}

/** @param {Kept[]} all */
function store(all) {
  try {
    localStorage.setItem(KEY, JSON.stringify(all.slice(0, MOST)));
  } catch {
    // then it lasts until the panel is closed
  }
}

/** @param {string} signature @returns {Kept | null} */
export const recall = (signature) => stored().find((one) => one.signature === signature) ?? null;

/** @param {Kept} kept */
export const remember = (kept) =>
  store([kept, ...stored().filter((one) => one.signature !== kept.signature)]);

/** @param {string} signature */
export const forget = (signature) => store(stored().filter((one) => one.signature !== signature));
