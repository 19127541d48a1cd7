// @ts-check
// The ranked list: one row per proposal, with its reasons and margins below it on request.
import { inSentence } from "../../facts.js";
import { capitalized, scaleOf, toShown } from "../../format.js";
import { each, h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { menuButton } from "../../ui/menu.js";
import { saveCsv, saveTask } from "./actions.js";
import { tick, ticked } from "./differences.js";
import { marginBars } from "./margins.js";
import { answer, answeredTask, chosenIndex, headingOf, isPartial, lookSizing, proposals } from "./model.js";
import { asText, driveWords, limitName, partsOf, percent, sizingFigure, spare, terms } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */
/** @typedef {import("../../format.js").Quantity} Quantity */

/** Proposals whose reasons are shown, by index. */
const unfolded = signal(/** @type {ReadonlySet<number>} */ (new Set()));
/** @param {number} i */
function fold(i) {
  const next = new Set(unfolded.peek());
  if (!next.delete(i)) next.add(i);
  unfolded.value = next;
}

/** Classes of a column, and its figure. @type {[string, string][]} */
const COLUMNS = [
  ["", "time"],
  ["", "probability"],
  ["wide", "air_volume_anr"],
  ["wide roomy", "impact_energy"],
  ["wide roomy", "force_reserve"],
  ["wide", "margins"],
];
const WIDTH = COLUMNS.length + 3; // with number, drive, and the button for reasons

const DOUBTFUL = 0.5;

/** What the list is sorted by: a figure, "length", or the server's rank. Not part of the task, so not of the document. */
const sorting = signal(/** @type {{by: string, down: boolean}} */ ({ by: "rank", down: false }));
/** @param {string} by */
const sortBy = (by) => (sorting.value = { by, down: sorting.peek().by === by && !sorting.peek().down });
/** @param {Proposal} p @param {string} by */
const sortValue = (p, by) =>
  by === "margins"
    ? p.margins[p.binding]
    : by === "length"
    ? p.nominal_length
    : /** @type {number | null} */ (/** @type {any} */ (p)[by]) ?? Infinity;
const sorted = computed(() => {
  const { by, down } = sorting.value, all = proposals.value.map((p, i) => ({ p, i }));
  if (by !== "rank") all.sort((a, b) => sortValue(a.p, by) - sortValue(b.p, by));
  return down ? all.reverse() : all;
});

/** A head that sorts; a second press turns the order round. @param {string} by @param {string} kind CSS class
 * @param {string} definition @param {import("../../dom.js").Child[]} text */
const sortHead = (by, kind, definition, ...text) =>
  h(
    "th",
    {
      scope: "col",
      class: kind,
      title: definition,
      "aria-sort": () => sorting.value.by !== by ? null : sorting.value.down ? "descending" : "ascending",
    },
    h(
      "button",
      { type: "button", class: "sort", onclick: () => sortBy(by) },
      ...text,
      h("span", { class: "arrow", "aria-hidden": "true" }, () =>
        sorting.value.by !== by ? "" : sorting.value.down ? "↓" : "↑"),
    ),
  );

/** @param {Proposal} p */
const doubt = (p) =>
  p.unverified.length
    ? h(
      "span",
      { class: "doubt", title: `Unverified: ${p.unverified.join("; ")}` },
      icon("warn"),
      h("span", { class: "unseen" }, "unverified values"),
    )
    : null;

/** @param {Proposal} p @param {number} i */
function row(p, i) {
  const open = () => unfolded.value.has(i);
  return h(
    "tbody",
    null,
    h(
      "tr",
      {
        class: () => `proposal${chosenIndex.value === i ? " chosen" : ""}`,
        onclick: () => lookSizing({ selected: i }),
      },
      h(
        "td",
        { class: "rank" },
        h(
          "label",
          { onclick: (/** @type {Event} */ e) => e.stopPropagation() },
          h("input", {
            type: "checkbox",
            "aria-label": `Compare proposal ${i + 1}`,
            title: "Tick two to see how they differ",
            checked: () => ticked.value.includes(i),
            onchange: () => tick(i),
          }),
          String(i + 1),
        ),
      ),
      h(
        "th",
        { scope: "row", class: "text" },
        h(
          "button",
          { type: "button", class: "drive", "aria-pressed": () => String(chosenIndex.value === i) },
          () => driveWords(p),
        ),
        p.front ? null : h(
          "span",
          {
            class: "front-mark",
            title: `Not on the ${sizingFigure("front").label}. ${sizingFigure("front").definition}`,
          },
          "dominated",
        ),
        doubt(p),
        h(
          "small",
          null,
          () =>
            partsOf(p).map((text, i, all) =>
              h("span", { class: "whole" }, text, i < all.length - 1 ? ", " : "")
            ),
        ),
      ),
      h("td", null, () => asText(p.time, "time")),
      h(
        "td",
        { class: (p.probability ?? 1) < DOUBTFUL ? "doubtful" : "" },
        p.probability === null ? "–" : percent(p.probability),
      ),
      h("td", { class: "wide" }, () => asText(p.air_volume_anr, "normal").replace(/\s*\(ANR\)/, "")),
      h("td", { class: "wide roomy" }, () => asText(p.impact_energy, "energy")),
      h("td", { class: "wide roomy" }, percent(p.force_reserve)),
      h(
        "td",
        { class: p.reservations.length ? "wide doubtful" : "wide", title: p.reservations.join("; ") || null },
        spare(p.margins[p.binding]),
        h("small", null, limitName(p.binding)),
      ),
      h(
        "td",
        null,
        h("button", {
          type: "button",
          class: () => `mini fold${open() ? " up" : ""}`,
          "aria-expanded": () => String(open()),
          "aria-label": `Reasons for proposal ${i + 1}`,
          onclick: (/** @type {Event} */ e) => {
            e.stopPropagation();
            fold(i);
          },
        }, icon("down")),
      ),
    ),
    () => (open() ? h("tr", { class: "more" }, h("td", { colspan: WIDTH }, details(p))) : null),
  );
}

/** @param {Proposal} p */
function details(p) {
  return h(
    "div",
    { class: "reasons" },
    h(
      "div",
      null,
      h("p", null, `${capitalized(p.reason)}.`),
      h(
        "dl",
        null,
        ...terms(p, FIGURES),
        ...costs(p),
      ),
      p.notes.length
        ? h("ul", { class: "plain muted" }, ...p.notes.map((note) => h("li", null, note)))
        : null,
    ),
    h("div", null, marginBars(p)),
  );
}

/** @type {import("./words.js").Name[]} */
const FIGURES = ["pressure_start", "pressure_end", "stiffness", "stiffness_closed"];

/** The cost of the air in the currency of the task; a price that nobody stated is an assumption.
 * @param {Proposal} p */
function costs(p) {
  const stated = /** @type {{ currency?: string, air_price?: unknown }} */ (answeredTask().operation ?? {});
  const assumed = stated.air_price === undefined ? " at an assumed price of air" : "";
  return /** @type {const} */ (["air_cost", "air_cost_year"]).flatMap((name) => {
    const { label, definition, quantity } = sizingFigure(name);
    const scale = scaleOf(/** @type {Quantity} */ (quantity), units.value);
    const amount = toShown(p[name], scale).toPrecision(3);
    return [
      h("dt", { title: definition }, `${label} ${scale.unit}`.trim()),
      h("dd", null, `${amount} ${stated.currency ?? "EUR"}${assumed}`),
    ];
  });
}

export function proposalsCard() {
  effect(() => {
    answer.value;
    unfolded.value = new Set();
    ticked.value = [];
    sorting.value = { by: "rank", down: false };
  });
  return h(
    "section",
    { class: "card proposals", "aria-label": "Proposals" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, () => `${proposals.value.length} drive${proposals.value.length === 1 ? "" : "s"}`),
      h(
        "span",
        { class: "muted" },
        () =>
          [
            answer.value && isPartial(answer.value) ? "found so far" : "",
            ticked.value.length ? `${ticked.value.length} of 2 ticked` : "",
          ].filter(Boolean).join(", "),
      ),
      menuButton({
        label: icon("more"),
        name: "Proposals: save",
        class: "mini",
        items: () => [
          { label: "Proposals as CSV", note: "shown units", run: saveCsv },
          { label: "Task as JSON", note: "for mckibben size", run: saveTask },
        ],
      }),
    ),
    () => h("p", { class: "of-task" }, answer.value ? headingOf(answer.value) : ""),
    () => answer.value?.ranking ? h("p", { class: "hint ranking" }, answer.value.ranking) : null,
    h(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Ranked drives" },
      each(
        "table",
        { class: "data" },
        () => sorted.value,
        ({ p }) => p,
        ({ p, i }) => row(p, i),
        h("caption", { class: "unseen" }, "Drives that fulfil the task, best first"),
        h(
          "thead",
          null,
          h(
            "tr",
            null,
            sortHead("rank", "text", "The order of the search: best first", "No."),
            sortHead("length", "text", sizingFigure("nominal_length").definition, "Drive"),
            ...COLUMNS.map(([kind, name]) => {
              const { label, definition } = sizingFigure(name), [title, note] = label.split(" (ANR)");
              const small = name === "margins" ? inSentence(sizingFigure("binding").label) : "ANR";
              return sortHead(
                name,
                kind,
                definition,
                title,
                name === "margins" || note !== undefined ? h("small", null, small) : null,
              );
            }),
            h("td", null),
          ),
        ),
      ),
    ),
  );
}
