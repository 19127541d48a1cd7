// @ts-check
// The ranked list: one row per proposal, with its reasons and margins below it on request.
import { capitalized } from "../../format.js";
import { h, icon } from "../../dom.js";
import { effect, signal } from "../../reactive.js";
import { menuButton } from "../../ui/menu.js";
import { saveCsv, saveTask } from "./actions.js";
import { marginBars } from "./margins.js";
import { answer, answeredTask, chosenIndex, headingOf, isPartial, lookSizing, proposals } from "./model.js";
import { asText, driveWords, limitName, partsOf, percent, spare } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */

/** Proposals whose reasons are shown, by index. */
const unfolded = signal(/** @type {ReadonlySet<number>} */ (new Set()));
/** @param {number} i */
function fold(i) {
  const next = new Set(unfolded.peek());
  if (!next.delete(i)) next.add(i);
  unfolded.value = next;
}

/** @type {[string, string][]} */
const HEAD = [
  ["", "No."],
  ["text", "Drive"],
  ["", "Time"],
  ["", "Probability"],
  ["wide", "Air per cycle"],
  ["wide roomy", "Impact"],
  ["wide roomy", "Force reserve"],
  ["wide", "Margin"],
  ["", ""],
];

const DOUBTFUL = 0.5;

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
      h("td", { class: "rank" }, String(i + 1)),
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
            title: "Not on the Pareto front: another drive is as good in every aim and better in one",
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
        h("small", { class: "whole" }, limitName(p.binding)),
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
    () => (open() ? h("tr", { class: "more" }, h("td", { colspan: HEAD.length }, details(p))) : null),
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
        ...figures(p).flatMap(([name, text]) => [h("dt", null, name), h("dd", null, text)]),
      ),
      p.notes.length
        ? h("ul", { class: "plain muted" }, ...p.notes.map((note) => h("li", null, note)))
        : null,
    ),
    h("div", null, h("h3", null, "Margins"), marginBars(p)),
  );
}

/** @param {Proposal} p @returns {[string, string][]} */
const figures = (p) => [
  ["Pressure at the start", asText(p.pressure_start, "pressure")],
  ["Pressure at the end", asText(p.pressure_end, "pressure")],
  ["Stiffness, valve open", asText(p.stiffness, "stiffness")],
  ["Stiffness, valve closed", asText(p.stiffness_closed, "stiffness")],
  ["Air cost per 1000 cycles", money(1e3 * p.air_cost)],
  ["Air cost per year", money(p.air_cost_year)],
];

/** In the currency of the task; a price that nobody stated is an assumption.
 * @param {number} amount */
function money(amount) {
  const stated = /** @type {{ currency?: string, air_price?: unknown }} */ (answeredTask().operation ?? {});
  const assumed = stated.air_price === undefined ? " at an assumed price of air" : "";
  return `${amount.toPrecision(3)} ${stated.currency ?? "EUR"}${assumed}`;
}

/** Whether the proposals are on the Pareto front; those that are not bear a mark. */
const frontWords = () =>
  proposals.value.length > 1 && proposals.value.every((p) => p.front)
    ? "; all on the Pareto front: none beats another in every aim"
    : "";

export function proposalsCard() {
  effect(() => {
    answer.value;
    unfolded.value = new Set();
  });
  return h(
    "section",
    { class: "card proposals", "aria-label": "Proposals" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Proposals"),
      h(
        "span",
        { class: "muted" },
        () => `${answer.value && isPartial(answer.value) ? "found so far, " : ""}best first${frontWords()}`,
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
      h(
        "table",
        { class: "data" },
        h("caption", { class: "unseen" }, "Drives that fulfil the task, best first"),
        h(
          "thead",
          null,
          h(
            "tr",
            null,
            ...HEAD.map(([kind, title]) =>
              title
                ? h(
                  "th",
                  { scope: "col", class: kind },
                  title,
                  title === "Air per cycle" ? h("small", null, "ANR") : null,
                  title === "Margin" ? h("small", null, "nearest limit") : null,
                )
                : h("td", null)
            ),
          ),
        ),
        () => proposals.value.map(row),
      ),
    ),
  );
}
