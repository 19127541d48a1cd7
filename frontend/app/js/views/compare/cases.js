// @ts-check
// The cases of the document: each is files, experiment and model under a name. The one at hand is the part "compare";
// the others rest here until they are shown.
import { isObject } from "../../paths.js";
import { computed } from "../../reactive.js";
import { addPart, doc } from "../../state.js";
import { newCompare, readCompare } from "./document.js";

/** @typedef {import("../../types.js").Doc} Doc */
/** @typedef {import("../../types.js").Cases} Cases */
/** @typedef {import("../../types.js").Case} Case */

export const MOST_CASES = 12, LONGEST_NAME = 60;

/** @returns {Cases} */
const start = () => ({ id: 1, name: "Case 1", at: 0, rest: [] });

/** @param {unknown} x @returns {x is number} */
const isCount = (x) => typeof x === "number" && Number.isInteger(x) && x >= 0;

/** Reads the cases of a link or file; without them there is one. @param {unknown} raw @returns {Cases}
 * @throws {Error} names the invalid part */
function read(raw) {
  if (raw === undefined) return start();
  if (!isObject(raw) || !isCount(raw.id) || !isCount(raw.at) || typeof raw.name !== "string") {
    throw new Error("“cases” is invalid");
  }
  if (!Array.isArray(raw.rest) || raw.rest.length >= MOST_CASES) throw new Error("“cases.rest” is invalid");
  const rest = raw.rest.map((one) => {
    if (!isObject(one) || !isCount(one.id) || typeof one.name !== "string") {
      throw new Error("“cases.rest” is invalid");
    }
    return { id: one.id, name: one.name, compare: readCompare(one.compare) };
  });
  if (new Set([raw.id, ...rest.map(({ id }) => id)]).size <= rest.length) {
    throw new Error("“cases” has two of one number");
  }
  return { id: raw.id, name: raw.name, at: Math.min(raw.at, rest.length), rest };
}

addPart("cases", { start, read });

/** The number of the case at hand. */
export const caseId = computed(() => doc.value.cases.id);

/** Every case in order, the one at hand among them. @param {Doc} d @returns {Case[]} */
export function casesOf({ cases: { id, name, at, rest }, compare }) {
  return [...rest.slice(0, at), { id, name, compare }, ...rest.slice(at)];
}

/** The document with one of these cases at hand. @param {Doc} d @param {Case[]} all @param {number} at
 * @returns {Doc} */
function withCases(d, all, at) {
  const { id, name, compare } = all[at];
  return { ...d, compare, cases: { id, name, at, rest: all.filter((_one, i) => i !== at) } };
}

/** The document with another case at hand; the same where there is no such case. @param {Doc} d @param {number} id
 * @returns {Doc} */
export function atCase(d, id) {
  const all = casesOf(d), at = all.findIndex((one) => one.id === id);
  return at < 0 || id === d.cases.id ? d : withCases(d, all, at);
}

/** A name that no other case has. @param {Case[]} all @param {string} wanted */
function free(all, wanted) {
  const taken = new Set(all.map(({ name }) => name));
  let name = wanted;
  for (let k = 2; taken.has(name); k++) name = `${wanted} (${k})`;
  return name;
}

/** The document with one more case, at hand. @param {Doc} d @param {Pick<Case, "name" | "compare">} one
 * @returns {Doc} */
function withOneMore(d, { name, compare }) {
  const all = casesOf(d), id = 1 + Math.max(...all.map((one) => one.id));
  return withCases(d, [...all, { id, name: free(all, name), compare }], all.length);
}

/** The name that nobody chose. @param {Doc} d */
const numbered = (d) => `Case ${casesOf(d).length + 1}`;

/** With an empty case at hand. @param {Doc} d */
export const withNewCase = (d) => withOneMore(d, { name: numbered(d), compare: newCompare() });

/** With a copy of the case at hand. @param {Doc} d */
export const withCopy = (d) =>
  withOneMore(d, {
    name: /^Case \d+$/.test(d.cases.name) ? numbered(d) : d.cases.name,
    compare: d.compare,
  });

/** With another name of the case at hand. @param {Doc} d @param {string} name @returns {Doc} */
export const withName = (d, name) => ({
  ...d,
  cases: { ...d.cases, name: free(d.cases.rest, name.trim().slice(0, LONGEST_NAME) || d.cases.name) },
});

/** Without the case at hand; the one after it, else the one before it, is at hand. The last case stays.
 * @param {Doc} d @returns {Doc} */
export function withoutCase(d) {
  const all = casesOf(d).filter(({ id }) => id !== d.cases.id);
  return all.length ? withCases(d, all, Math.min(d.cases.at, all.length - 1)) : d;
}
