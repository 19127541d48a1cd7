// @ts-check
// Entries that may be wrong: the question before the physics, with an answer in one click.
import { h, icon } from "../../../dom.js";
import { capitalized, number } from "../../../format.js";
import { chosen, compare, editCompare, stale } from "../answers.js";
import { decided } from "../request.js";

/** @typedef {import("../types.js").Diagnosis} Diagnosis */
/** @typedef {Diagnosis["context"][number]} Entry */
/** @typedef {import("../../../types.js").Chosen} Chosen */

/** Field of an entry -> field of the experiment that says it per file. */
const PER_FILE = { "muscle.nominal_length": "rest_length", load: "load" };

/** A value as requests take it. @param {number} value @param {string} unit */
const asRequest = (value, unit) => (unit === "m" ? `${number(1e3 * value, 3)} mm` : `${value} ${unit}`);

/** A value for people. @param {number} value @param {string} unit */
const asText = (value, unit) =>
  unit === "m"
    ? `${number(1e3 * value, 1)} mm`
    : unit === "rad"
    ? `${number((180 * value) / Math.PI, 1)}°`
    : `${number(value, 1)} ${unit}`;

/** The decisions about the present files with one more. @param {"use" | "keep"} kind @param {string} hypothesis */
function withDecision(kind, hypothesis) {
  const c = compare.peek(), now = decided(c);
  return { ...now, of: chosen.peek().map((f) => f.id).join(), [kind]: [...now[kind], hypothesis] };
}

/** Takes what fits the data: a value becomes that of the muscle and its files, a channel is read the other way.
 * @param {Entry} entry */
function use(entry) {
  const label = `use ${entry.sentence.split(" explains")[0]}`;
  if (typeof entry.value !== "number") {
    editCompare({ decisions: withDecision("use", entry.hypothesis) }, label);
    return;
  }
  const value = entry.value, c = compare.peek();
  const field = PER_FILE[/** @type {keyof typeof PER_FILE} */ (entry.field)];
  const said = { value: asRequest(value, entry.unit), origin: /** @type {const} */ ("suggested") };
  const withValue = (/** @type {Chosen} */ file) =>
    file.use === "off" || !field ? file : { ...file, experiment: { ...file.experiment, [field]: said } };
  const name = entry.field.startsWith("muscle.") ? entry.field.slice("muscle.".length) : null;
  const values = name ? { ...c.muscle.values, [name]: value } : c.muscle.values;
  editCompare({ files: c.files.map(withValue), muscle: { ...c.muscle, values } }, label);
}

/** @param {Entry} entry */
const keep = (entry) =>
  editCompare({ decisions: withDecision("keep", entry.hypothesis) }, `keep ${entry.hypothesis}`);

/** @param {Entry} entry @param {boolean} first */
function question(entry, first) {
  const value = typeof entry.value === "number" ? asText(entry.value, entry.unit) : entry.value ?? "";
  const stated = entry.stated === null ? "" : ` ${asText(entry.stated, entry.unit)}`;
  return h(
    "li",
    { class: "entry-doubt", "data-hypothesis": entry.hypothesis },
    h("p", null, `${capitalized(entry.sentence)}.`),
    h(
      "div",
      { class: "row" },
      h(
        "button",
        {
          type: "button",
          class: first ? "primary" : "",
          disabled: () => stale.value,
          onclick: () => use(entry),
        },
        `Use ${value}`,
      ),
      h(
        "button",
        { type: "button", disabled: () => stale.value, onclick: () => keep(entry) },
        stated ? `Keep${stated}` : "Keep as stated",
      ),
    ),
  );
}

/** Whether an entry has to be answered before the effects count. @param {Diagnosis} result */
export const isDoubted = ({ context }) => context.some((entry) => entry.asked);

/** The questions about entries, before anything else; null without one. @param {Diagnosis} result */
export function entryQuestions({ context }) {
  const asked = context.filter((entry) => entry.asked);
  if (!asked.length) return null;
  const [first, ...others] = asked;
  return h(
    "section",
    { class: "entries", id: "entry-questions", "aria-label": "Entries to check", "aria-live": "polite" },
    h("p", null, icon("info"), h("b", null, " Is an entry wrong?")),
    h("ul", { class: "plain" }, question(first, true)),
    others.length
      ? h(
        "details",
        null,
        h("summary", null, `Or ${others.length === 1 ? "another entry" : `${others.length} other entries`}`),
        h("ul", { class: "plain" }, ...others.map((entry) => question(entry, false))),
      )
      : null,
  );
}
