// @ts-check
// The Catalogue view as the program sees it: its part of the document, and its page, which is fetched when it is
// first shown.
import { addPart } from "../../state.js";
import { later } from "../../ui/later.js";

/** @typedef {import("../../types.js").CatalogueFilter} CatalogueFilter */

/** @returns {CatalogueFilter} */
const defaultFilter = () => ({
  kind: "muscles",
  search: "",
  maker: "",
  from: null,
  to: null,
  sort: "title",
  descending: false,
  selected: null,
});

/** Anything unusable in a catalogue filter takes its default: a filter decides nothing about a design.
 * @param {unknown} raw @returns {CatalogueFilter} */
function readFilter(raw) {
  const start = defaultFilter();
  if (typeof raw !== "object" || raw === null || Array.isArray(raw)) return start;
  const sound = Object.entries(raw).filter(([key, value]) => {
    const usual = /** @type {Record<string, unknown>} */ (start)[key];
    if (usual === null) {
      return value === null || (key === "selected" ? typeof value === "string" : Number.isFinite(value));
    }
    return Object.hasOwn(start, key) && typeof usual === typeof value;
  });
  return { ...start, ...Object.fromEntries(sound) };
}

addPart("catalogue", { start: defaultFilter, read: readFilter });

export const catalogueView = later(async () => (await import("./page.js")).cataloguePage);
