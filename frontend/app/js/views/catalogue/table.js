// @ts-check
// The table of presets: filtered, sorted, one row selected.
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { doc, look, units } from "../../state.js";
import { presets } from "../../store.js";
import { cellText, columnsOf, KIND_TITLES, sizeOf, sortKey } from "./columns.js";

/** @typedef {import("../../types.js").CatalogueFilter} CatalogueFilter */
/** @typedef {import("../../types.js").Preset} Preset */

export const filter = computed(() => doc.value.catalogue);
/** @param {Partial<CatalogueFilter>} patch */
export const setFilter = (patch) => look((d) => ({ ...d, catalogue: { ...d.catalogue, ...patch } }));

const list = computed(() => presets.value[filter.value.kind] ?? null);
const columns = computed(() => columnsOf(filter.value.kind, list.value ?? []));

/** @param {Preset} p */
function matches(p) {
  const f = filter.value, size = sizeOf(p);
  if (f.maker && p.maker !== f.maker) return false;
  if (f.from !== null && (size === null || size < f.from - 1e-9)) return false;
  if (f.to !== null && (size === null || size > f.to + 1e-9)) return false;
  const text = [p.title, p.id, p.maker, p.series, p.function, p.muscle, p.description].join(" ")
    .toLowerCase();
  return f.search.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

const title = { key: "title", title: "Part", of: (/** @type {Preset} */ p) => p.title };
const natural = new Intl.Collator("en", { numeric: true });

const rows = computed(() => {
  const f = filter.value;
  const by = [title, ...columns.value].find((c) => c.key === f.sort) ?? title;
  const matching = (list.value ?? []).filter(matches).map((p) => ({ p, key: sortKey(by.of(p)) }));
  matching.sort((a, b) => {
    if (a.key === null || b.key === null) return Number(a.key === null) - Number(b.key === null);
    const order = typeof a.key === "number" && typeof b.key === "number"
      ? a.key - b.key
      : natural.compare(String(a.key), String(b.key));
    return f.descending ? -order : order;
  });
  return matching.map(({ p }) => p);
});

/** The selected part, or the first of the list. */
export const selected = computed(() => {
  const all = rows.value;
  return all.find((p) => p.id === filter.value.selected) ?? all[0] ?? null;
});

/** @param {import("./columns.js").Column} c @param {Preset | undefined} sample */
function header(c, sample) {
  const sorted = () => filter.value.sort === c.key;
  const isNumber = typeof (sample && c.of(sample)) === "object";
  return h(
    "th",
    {
      scope: "col",
      class: isNumber ? "" : "text",
      "aria-sort": () => sorted() ? (filter.value.descending ? "descending" : "ascending") : null,
    },
    h(
      "button",
      {
        type: "button",
        onclick: () => setFilter({ sort: c.key, descending: sorted() && !filter.peek().descending }),
      },
      c.title,
      h(
        "span",
        { class: "arrow", "aria-hidden": "true" },
        () => sorted() ? (filter.value.descending ? "↓" : "↑") : "",
      ),
    ),
  );
}

/** @param {Preset} p */
function row(p) {
  return h(
    "tr",
    {
      class: () => selected.value?.id === p.id ? "chosen" : null,
      onclick: () => setFilter({ selected: p.id }),
    },
    h(
      "th",
      { scope: "row", class: "text" },
      h("button", {
        type: "button",
        class: "part",
        "aria-pressed": () => String(selected.value?.id === p.id),
      }, p.title),
      p.verified ? null : h(
        "span",
        { class: "doubt", title: "Has unverified values" },
        icon("warn"),
        h("span", { class: "unseen" }, "unverified values"),
      ),
      p.origin === "user" ? h("small", null, "mine") : null,
    ),
    ...columns.value.map((c) => {
      const cell = c.of(p);
      return h(
        "td",
        { class: typeof cell === "string" ? "text" : "", "data-title": c.title },
        () => cellText(cell, units.value),
      );
    }),
  );
}

export function partsTable() {
  const empty = () => {
    if (list.value === null) return "Loading the catalogue…";
    if (!list.value.length) {
      return `This server has no ${KIND_TITLES[filter.value.kind]?.toLowerCase() ?? "parts"}.`;
    }
    return rows.value.length ? null : "No part matches the filter. Widen the size range or clear the search.";
  };
  return h(
    "section",
    { class: "card parts", "aria-label": "Parts" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, () => KIND_TITLES[filter.value.kind] ?? "Parts"),
      h(
        "span",
        { class: "muted", role: "status" },
        () => `${rows.value.length} of ${list.value?.length ?? 0}`,
      ),
    ),
    h(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Table of parts" },
      h(
        "table",
        { class: "data" },
        h("caption", { class: "unseen" }, "Parts; the buttons in the header sort the table"),
        h(
          "thead",
          null,
          () => h("tr", null, ...[title, ...columns.value].map((c) => header(c, list.value?.[0]))),
        ),
        h("tbody", null, () => rows.value.map(row)),
      ),
    ),
    () => {
      const text = empty();
      return text ? h("p", { class: "muted empty" }, text) : null;
    },
  );
}
