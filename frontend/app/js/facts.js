// @ts-check
// What the server declares: figures, and units. Loaded before the modules that use it.

/** A figure with how it is shown. @typedef {Omit<import("./types.js").S["DeclaredFigure"], "quantity"> &
 *   {quantity: import("./format.js").Quantity}} DeclaredFigure */
/** @typedef {import("./types.js").S["Units"]} Units */

const FIRST_MS = 500, LONGEST_MS = 8000;

/** @param {string} path */
async function declared(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer.json();
}

/** Says that there is nothing to begin with, and waits for the time, or a click. @param {number} pause [ms] */
function wait(pause) {
  const banner = document.createElement("div"), again = document.createElement("button");
  banner.className = "banner gone";
  banner.setAttribute("role", "alert");
  again.textContent = "Try again";
  banner.append("The server does not answer. The page tries again by itself.", again);
  document.getElementById("app")?.replaceChildren(banner);
  return new Promise((go) => {
    const timer = setTimeout(go, pause);
    again.addEventListener("click", () => {
      clearTimeout(timer);
      go(undefined);
    });
  });
}

/** Both declarations, however long the server takes to come back. @returns {Promise<any[]>} */
async function all() {
  for (let pause = FIRST_MS;; pause = Math.min(2 * pause, LONGEST_MS)) {
    try {
      return await Promise.all([declared("/api/figures"), declared("/api/units")]);
    } catch {
      await wait(pause);
    }
  }
}

const [figures, units] = await all();

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

/** Whether a figure is declared. @param {string} key */
export const hasFigure = (key) => FIGURES.has(key);

/** A label inside a sentence. @param {string} label */
export const inSentence = (label) => label.replace(/^./, (letter) => letter.toLowerCase());

/** The figures of a group, in the order of tables. @param {string} group */
export const figuresOf = (group) => [...FIGURES.values()].filter((each) => each.group === group);
