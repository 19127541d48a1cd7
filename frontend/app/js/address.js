// @ts-check
// The address of the page: its hash holds the whole document. Each view that is visited is an entry of the browser's
// history; Back and Forward change the view and keep the work.
import { fromHash, left, linkOf, PARTLY } from "./link.js";
import { computed, effect } from "./reactive.js";
import { doc, look, past } from "./state.js";
import { status } from "./store.js";
import { atCase } from "./views/compare/cases.js";

const LINK_MS = 250;
/** The last work of this browser. */
const LAST = "mckibben-last";
/** The whole work of this window while its address cannot hold it, for a reload. */
const WHOLE = "mckibben-whole";

/** What an entry of the history shows. @typedef {{view: string, mode: import("./types.js").Sizing["mode"],
 *   kind: string, case: number}} Place */
/** @typedef {{hash: string, view: string, when: number}} Last */

/** @param {import("./types.js").Doc} d @returns {Place} */
const placeOf = (d) => ({
  view: d.view,
  mode: d.sizing.mode,
  kind: d.catalogue.kind,
  case: d.cases.id,
});
/** @param {import("./types.js").Doc} d @param {Place} p */
const at = (d, { view, mode, kind, case: id }) => ({
  ...atCase(d, id),
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
  if (["design", "transient", "compare", "catalogue", "studies"].includes(name)) {
    return { ...now, view: name };
  }
  if (name === "task" || name === "muscle") return { ...now, view: "design", mode: name };
  return name === "effects" ? { ...now, view: "catalogue", kind: name } : null;
}

/** Reads the document of the address. */
export async function readAddress() {
  const short = named(location.hash);
  if (short) return look((d) => at(d, short));
  try {
    const whole = keptWhole(location.hash);
    const linked = whole ? await fromHash(whole, Infinity) : await fromHash(location.hash);
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
      const { hash, whole, left: now } = await linkOf(state);
      if (state !== doc.peek()) return;
      keepWhole(now ? { hash, whole } : null);
      tell(now);
      written = hash;
      history.replaceState(entry(), "", written || location.pathname);
      if (past.peek().length) remember({ hash: whole, view: state.view, when: Date.now() });
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

/** Says it when the address begins to leave out more. @param {import("./link.js").Left} now */
function tell(now) {
  if (now && now !== left.peek()) {
    status.value =
      `The link of this work ${PARTLY[now]}. Nothing is lost here: this window keeps all of it, ` +
      "also after a reload; Project, Save keeps it for good.";
  }
  left.value = now;
}

/** @param {{hash: string, whole: string} | null} work null: the address holds all of it */
function keepWhole(work) {
  try {
    if (work) sessionStorage.setItem(WHOLE, JSON.stringify(work));
    else sessionStorage.removeItem(WHOLE);
  } catch {
    // No storage, or it is full: a reload shows what the address holds.
  }
}

/** The whole work of which the address holds a part, if this window wrote it. @param {string} hash */
function keptWhole(hash) {
  try {
    const kept = JSON.parse(sessionStorage.getItem(WHOLE) ?? "null");
    return kept?.hash === hash && typeof kept.whole === "string" ? kept.whole : null;
  } catch {
    return null;
  }
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
  const linked = await fromHash(last.hash, Infinity).catch(() => null);
  if (linked) doc.value = linked;
  else status.value = "The last work cannot be read any more.";
}
