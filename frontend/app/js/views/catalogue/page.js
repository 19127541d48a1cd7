// @ts-check
// The page of the Catalogue view: filter, table, detail, and preset files that could not be read.
import { h, icon } from "../../dom.js";
import { apart, computed, effect } from "../../reactive.js";
import { units } from "../../state.js";
import { effects, presets, problems } from "../../store.js";
import { scaleOf } from "../../format.js";
import { quantityField } from "../../ui/field.js";
import { atlas } from "./atlas/page.js";
import { KIND_TITLES } from "./columns.js";
import { detailPanel } from "./detail.js";
import { keptCard } from "./kept.js";
import { filter, partsTable, setFilter } from "./table.js";
import { segments } from "../../ui/segments.js";

const kind = computed(() => filter.value.kind);
const makers = computed(() =>
  [...new Set((presets.value[kind.value] ?? []).map((p) => p.maker ?? "").filter(Boolean))].sort()
);

const EFFECTS = "effects";
const isAtlas = computed(() => kind.value === EFFECTS);

/** @param {"from" | "to"} key @param {string} label */
const sizeField = (key, label) =>
  quantityField({
    key: `size.${key}`,
    label,
    quantity: "length",
    slider: false,
    empty: "any",
    scale: () => scaleOf("length", units.value),
    bounds: () => [0, 0.1],
    get: () => filter.value[key],
    put: (si) => setFilter({ [key]: si }),
    clear: () => setFilter({ [key]: null }),
  });

function filterCard() {
  const search = h("input", {
    type: "search",
    placeholder: "Search  ( / )",
    "aria-label": "Search the catalogue",
    oninput: () => setFilter({ search: search.value }),
  });
  effect(() => {
    if (document.activeElement !== search) search.value = filter.value.search;
  });
  return h(
    "section",
    { class: "card", "aria-label": "Filter" },
    h("div", { class: "card-head" }, h("h2", null, "Filter")),
    h("label", { class: "search" }, icon("search"), search),
    segments(
      "Kind of part",
      [...Object.entries(KIND_TITLES), [EFFECTS, "Effects"]].map(([id, title]) => [
        id,
        [
          title,
          h("small", null, () => String((id === EFFECTS ? effects.value : presets.value[id])?.length ?? "")),
        ],
      ]),
      () => kind.value,
      (id) => setFilter({ kind: id, selected: null, maker: "", sort: "title", descending: false }),
      "kinds",
    ),
    h("label", { class: "label", for: "maker", hidden: () => isAtlas.value }, "Maker"),
    h(
      "select",
      {
        id: "maker",
        hidden: () => isAtlas.value,
        onchange: (/** @type {Event} */ e) =>
          setFilter({ maker: /** @type {HTMLSelectElement} */ (e.target).value }),
      },
      () => [
        h("option", { value: "" }, "All makers"),
        ...makers.value.map((m) => h("option", { value: m, selected: m === filter.value.maker }, m)),
      ],
    ),
    h(
      "div",
      { hidden: () => isAtlas.value },
      h("p", { class: "label" }, "Inside diameter"),
      sizeField("from", "from"),
      sizeField("to", "to"),
    ),
    h("button", {
      type: "button",
      class: "link",
      onclick: () => {
        search.value = "";
        setFilter({ search: "", maker: "", from: null, to: null });
      },
    }, "Clear the filter"),
  );
}

function problemCard() {
  const all = problems.value;
  if (!all.length) return null;
  return h(
    "section",
    { class: "card", "aria-label": "Refused files" },
    h("div", { class: "card-head" }, h("h2", null, `${all.length} file${all.length > 1 ? "s" : ""} refused`)),
    h(
      "ul",
      { class: "plain" },
      ...all.map((p) =>
        h(
          "li",
          null,
          h("b", null, p.file),
          p.field ? `, ${p.field}` : "",
          `: ${p.message}. `,
          p.hint ? h("small", null, p.hint) : null,
        )
      ),
    ),
  );
}

export function cataloguePage() {
  const [list, full] = [h("div"), h("div")];
  let built = false;
  effect(() => {
    list.hidden = full.hidden = !isAtlas.value;
    if (built || !isAtlas.value) return;
    built = true;
    const [gallery, detail] = apart(atlas);
    list.append(gallery);
    full.append(detail);
  });
  return h(
    "div",
    { class: () => `catalogue${isAtlas.value ? " with-atlas" : ""}` },
    h("div", { class: "column" }, filterCard(), keptCard(), problemCard),
    h("div", { class: "column" }, h("div", { hidden: () => isAtlas.value }, partsTable()), list),
    h("div", { class: "column" }, h("div", { hidden: () => isAtlas.value }, detailPanel()), full),
  );
}
