// @ts-check
// The address of the page: its hash holds the whole document. Each view that is visited is an entry of the browser's
// history; Back and Forward change the view and keep the work.
import { fromHash, toHash } from "./link.js";
import { computed, effect } from "./reactive.js";
import { doc, look, past } from "./state.js";
import { status } from "./store.js";

const LINK_MS = 250;
/** The last work of this browser. */
const LAST = "mckibben-last";

/** What an entry of the history shows. @typedef {{view: string, mode: import("./types.js").Sizing["mode"],
 *   kind: string}} Place */
/** @typedef {{hash: string, view: string, when: number}} Last */

/** @param {import("./types.js").Doc} d @returns {Place} */
const placeOf = (d) => ({ view: d.view, mode: d.sizing.mode, kind: d.catalogue.kind });
/** @param {import("./types.js").Doc} d @param {Place} p */
const at = (d, { view, mode, kind }) => ({
  ...d,
  view,
  sizing: { ...d.sizing, mode },
  catalogue: { ...d.catalogue, kind },
});

/** Entries that this page wrote, also before a reload. */
const session = (() => {
  try {
    const known = sessionStorage.getItem("mckibben-session");
    const id = known ?? Math.random().toString(36).slice(2);
    sessionStorage.setItem("mckibben-session", id);
    return id;
  } catch {
    return "";
  }
})();

/** Short addresses to be typed: `#catalogue`. @param {string} hash @returns {Place | null} */
function named(hash) {
  const name = hash.slice(1), now = placeOf(doc.peek());
  if (["design", "transient", "compare", "catalogue"].includes(name)) return { ...now, view: name };
  if (name === "task" || name === "muscle") return { ...now, view: "design", mode: name };
  return name === "effects" ? { ...now, view: "catalogue", kind: name } : null;
}

/** Reads the document of the address. */
export async function readAddress() {
  const short = named(location.hash);
  if (short) return look((d) => at(d, short));
  try {
    const linked = await fromHash(location.hash);
    if (linked) doc.value = linked;
  } catch (error) {
    const why = /** @type {Error} */ (error).message;
    status.value = `The link cannot be read: ${why}. The example design is shown instead.`;
  }
}

/** Keeps the address up to date. Browsers allow few changes of it per second, so it waits for a pause. */
export function writeAddress() {
  const place = computed(() => JSON.stringify(placeOf(doc.value)));
  const entry = () => ({ session, place: place.peek() });
  let timer = 0, written = location.hash, shown = place.peek();
  effect(() => {
    if (place.value === shown) return;
    shown = place.value;
    history.pushState(entry(), "", location.hash || location.pathname);
  });
  effect(() => {
    const state = doc.value;
    clearTimeout(timer);
    timer = setTimeout(async () => {
      const hash = await toHash(state);
      if (state !== doc.peek()) return;
      written = hash;
      history.replaceState(entry(), "", written);
      if (past.peek().length) remember({ hash, view: state.view, when: Date.now() });
    }, LINK_MS);
  });
  addEventListener("popstate", ({ state }) => {
    if (state?.session !== session) return;
    shown = state.place;
    look((d) => at(d, JSON.parse(state.place)));
  });
  addEventListener("hashchange", () => {
    if (history.state?.session === session || location.hash === "#main") return;
    if (location.hash !== written) readAddress();
  });
}

/** @param {Last} last */
function remember(last) {
  try {
    localStorage.setItem(LAST, JSON.stringify(last));
  } catch {
    // No storage: nothing to continue from next time.
  }
}

/** The work to continue, if the page was opened without an address of its own. @returns {Last | null} */
export function lastWork() {
  if (location.hash.length > 1) return null;
  try {
    const last = JSON.parse(localStorage.getItem(LAST) ?? "null");
    return typeof last?.hash === "string" && typeof last.view === "string" ? last : null;
  } catch {
    return null;
  }
}

/** @param {Last} last */
export async function continueWith(last) {
  const linked = await fromHash(last.hash).catch(() => null);
  if (linked) doc.value = linked;
  else status.value = "The last work cannot be read any more.";
}
