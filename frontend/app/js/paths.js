// @ts-check
// Values of nested documents by their path, such as "load.mass". Pure functions.

/** @param {unknown} x @returns {x is Record<string, any>} */
export const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);

/** @param {Record<string, any>} document @param {string} path @returns {any} undefined: there is none */
export const at = (document, path) =>
  path.split(".").reduce(
    (part, key) => (isObject(part) ? part[key] : undefined),
    /** @type {any} */ (document),
  );

/** The document with one value replaced; undefined removes it.
 * @param {Record<string, any>} document @param {string} path @param {unknown} value
 * @returns {Record<string, any>} */
export function put(document, path, value) {
  const [key, ...rest] = path.split(".");
  const next = { ...document };
  if (rest.length) next[key] = put(isObject(document[key]) ? document[key] : {}, rest.join("."), value);
  else if (value === undefined) delete next[key];
  else next[key] = value;
  return next;
}
