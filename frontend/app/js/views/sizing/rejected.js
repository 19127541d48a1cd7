// @ts-check
// Rejected candidates: the reason for each, and what would make it work.
import { capitalized } from "../../format.js";
import { h } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { answer } from "./model.js";
import { limitName } from "./words.js";

/** @typedef {import("../../types.js").S["RejectedParts"]} Rejected */

const SHOWN = 8;
const all = signal(false);

/** Merges candidates that differ only in the tube and fail for the same reason.
 * @param {Rejected[]} list @returns {(Rejected & {tubes: string[]})[]} */
function together(list) {
  /** @type {Map<string, Rejected & {tubes: string[]}>} */
  const merged = new Map();
  for (const one of list) {
    // The reason names its tube; with several tubes they stand in the heading instead.
    const { tube, combinations, ...rest } = one, why = rest.why.replace(` and ${tube ?? "no tube"}:`, ":");
    const name = JSON.stringify({ ...rest, why });
    const same = merged.get(name);
    const tubes = [...same?.tubes ?? [], ...(tube ? [tube] : [])];
    merged.set(name, {
      ...one,
      why: same ? why : one.why,
      combinations: combinations + (same?.combinations ?? 0),
      tubes,
    });
  }
  return [...merged.values()];
}

const groups = computed(() => together(answer.value?.rejected ?? []));

/** @param {Rejected & {tubes: string[]}} r */
function item(r) {
  const who = [`${r.parallel > 1 ? `${r.parallel} × ` : ""}${r.muscle}`, r.valve].filter(Boolean);
  // Each name is kept whole; a line may break between them.
  const names = [
    ...who.map((name, i) => `${name}${i < who.length - 1 || r.tubes.length ? ", " : ""}`),
    ...r.tubes.map((name, i) => `${name}${i < r.tubes.length - 1 ? " or " : ""}`),
  ];
  return h(
    "li",
    null,
    h("b", null, names.map((name) => h("span", { class: "whole" }, name))),
    h("span", { class: "limit" }, limitName(r.binding)),
    h("p", null, `${capitalized(r.why)}.`),
    h("p", { class: "remedy" }, h("span", null, "Would work with "), `${r.would_work_if}.`),
  );
}

export function rejectedCard() {
  effect(() => {
    answer.value;
    all.value = false;
  });
  const hidden = () => groups.value.length - SHOWN;
  return h(
    "section",
    { class: "card rejected", "aria-label": "Rejected", hidden: () => !groups.value.length },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Rejected candidates"),
      h("span", { class: "muted" }, "closest first"),
    ),
    h("ul", null, () => (all.value ? groups.value : groups.value.slice(0, SHOWN)).map(item)),
    () =>
      hidden() > 0
        ? h(
          "button",
          { type: "button", class: "link", onclick: () => (all.value = !all.peek()) },
          all.value ? "Show fewer" : `Show ${hidden()} more`,
        )
        : null,
  );
}
