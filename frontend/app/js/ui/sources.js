// @ts-check
// How reliable a value is: grades in words, and the values of a preset that nobody has verified.
import { h, icon } from "../dom.js";
import { readable, tidyUnit } from "../format.js";
import { effectTitle } from "../store.js";
import { openPopover } from "./dialog.js";

/** @type {Record<string, string>} */
const GRADES = {
  S: "read in the source",
  S2: "second-hand: from a public transcript of the source",
  C: "computed from sourced data",
  D: "derived or fitted for this program",
  M: "general knowledge, not verified",
  E: "estimate, not verified",
  user: "entered by you",
};

/** @param {string} grade */
const isUnverified = (grade) => grade === "M" || grade === "E";

/** @param {string} grade */
export const gradeTag = (grade) =>
  h("abbr", { class: `grade${isUnverified(grade) ? " warn" : ""}`, title: GRADES[grade] ?? grade }, grade);

/** @param {import("../types.js").Preset} preset */
function unverifiedNote(preset) {
  /** @type {[string, import("../types.js").PresetValue][]} */
  const doubtful = [
    ...[preset.geometry, preset.limits, preset.data].flatMap((part) =>
      Object.entries(part ?? {}).map(([key, q]) => /** @type {[string, typeof q]} */ ([readable(key), q]))
    ),
    // Several effects have a force, so the effect is named too.
    ...Object.entries(preset.effects ?? {}).flatMap(([effect, values]) =>
      Object.entries(values).map((
        [key, q],
      ) => /** @type {[string, typeof q]} */ ([`${effectTitle(effect)}: ${readable(key)}`, q]))
    ),
  ].filter(([, q]) => isUnverified(q.grade));
  return h(
    "div",
    null,
    h("h3", null, "Unverified values"),
    h(
      "p",
      null,
      "These values are general knowledge or estimates, not read from a data sheet. ",
      "Check them before you rely on them.",
    ),
    h(
      "ul",
      { class: "plain" },
      ...doubtful.map(([name, q]) =>
        h(
          "li",
          null,
          h("b", null, name),
          ` ${q.value} ${tidyUnit(q.unit)} `,
          h("small", null, q.source),
        )
      ),
    ),
  );
}

/** A badge that opens the unverified values of a preset; null if there are none.
 * @param {import("../types.js").Preset | null} preset @param {string} [text] */
export function unverifiedBadge(preset, text = "unverified values") {
  if (!preset || preset.verified) return null;
  const badge = h(
    "button",
    {
      type: "button",
      class: "badge warn",
      "aria-expanded": "false",
      onclick: () => openPopover(badge, "Unverified values", () => unverifiedNote(preset)),
    },
    icon("warn"),
    text,
  );
  return badge;
}
