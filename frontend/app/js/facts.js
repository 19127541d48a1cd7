// @ts-check
// What the server declares: figures, and units. Loaded before the modules that use it.

/** A figure with how it is shown. @typedef {Omit<import("./types.js").S["DeclaredFigure"], "quantity"> &
 *   {quantity: import("./format.js").Quantity}} DeclaredFigure */
/** @typedef {import("./types.js").S["Units"]} Units */

/** @param {string} path */
async function declared(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`The server answers ${answer.status} to ${path}; reload the page.`);
  return answer.json();
}

const [figures, units] = await Promise.all([declared("/api/figures"), declared("/api/units")]);

/** How values are shown, and which units are read. @type {Units} */
export const UNITS = units;

/** @type {Map<string, DeclaredFigure>} */
const FIGURES = new Map(figures.map((/** @type {DeclaredFigure} */ figure) => [figure.key, figure]));

/** A figure by its key, "timing.rise_time". @param {string} key @returns {DeclaredFigure} */
export function figure(key) {
  const found = FIGURES.get(key);
  if (!found) throw new Error(`There is no figure ${key}.`);
  return found;
}

/** The figures of a group, in the order of tables. @param {string} group */
export const figuresOf = (group) => [...FIGURES.values()].filter((each) => each.group === group);
