// @ts-check
// The Catalogue view's part of the document: which parts are listed, and which of them is shown in full.
import { addPart } from "../../state.js";

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
