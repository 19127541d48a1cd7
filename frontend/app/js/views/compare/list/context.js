// @ts-check
// Entries that may be wrong: the question before the physics, with an answer in one click.
import { h, icon } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { capitalized, number, plainScale, quantityOf, readable, scaleOf } from "../../../format.js";
import { edit, units } from "../../../state.js";
import { answer, chosen, compare, diagnosis, editCompare, stale } from "../answers.js";
import { withStep } from "../document.js";
import { effectsNow, fittedStep, here, stamped, whileFitting } from "../model/history.js";
import { decided } from "../request.js";
import { channelWords, errorText, measuredText, statedText } from "../words.js";

/** @typedef {import("../types.js").Diagnosis} Diagnosis */
/** @typedef {Diagnosis["context"][number]} Entry */
/** @typedef {import("../../../types.js").Chosen} Chosen */
/** @typedef {import("../../../types.js").Compare} Compare */

/** Field of an entry -> field of the experiment that says it per file. */
const PER_FILE = { "muscle.nominal_length": "rest_length", load: "load" };

/** A value as requests take it. @param {number} value @param {string} unit */
const asRequest = (value, unit) => (unit === "m" ? `${number(1e3 * value, 3)} mm` : `${value} ${unit}`);

/** @param {string} unit of SI */
const scaleOfUnit = (unit) => {
  const quantity = quantityOf(unit);
  return quantity ? scaleOf(quantity, units.value) : plainScale(unit);
};

/** A value for people. @param {number} value @param {string} unit */
const asText = (value, unit) =>
  unit === "m"
    ? `${number(1e3 * value, 1)} mm`
    : unit === "rad"
    ? `${number((180 * value) / Math.PI, 1)}°`
    : `${number(value, 1)} ${unit}`;

/** The entries to be answered before the effects count. @param {Diagnosis} result */
export const asked = ({ context }) => context.filter((entry) => entry.asked);

/** @param {Entry} entry */
const valueOf = (entry) =>
  typeof entry.value === "number" ? asText(entry.value, entry.unit) : entry.value ?? "";

/** Whether an entry is a way of reading a column, and not a value. @param {Entry} entry */
const isReading = (entry) => typeof entry.value === "string" && entry.stated === null;

/** What is said wrong, in few words: "rest length", "unit of the force". @param {Entry} entry */
export function subject(entry) {
  if (!isReading(entry)) return entry.hypothesis.replaceAll("_", " ");
  const words = String(entry.value), column = channelWords(entry.field);
  if (/^(absolute|gauge)$/.test(words)) return "reference of the pressure";
  return `${/^(not )?in /.test(words) ? "unit" : "sign"} of the ${column}`;
}

/** What the button of an entry says, the same in the strip and in the list: "Use 300 mm", "Read force in lbf".
 * @param {Entry} entry */
export function useLabel(entry) {
  if (!isReading(entry)) return `Use ${valueOf(entry)}`;
  const [words] = String(entry.value).split(/:| and not /), column = channelWords(entry.field);
  return `Read ${column} ${/^(absolute|gauge)$/.test(words) ? `as ${words}` : words}`;
}

/** The decisions about the present files with one more. @param {"use" | "keep"} kind @param {string} hypothesis */
function withDecision(kind, hypothesis) {
  const c = compare.peek(), now = decided(c);
  return { ...now, of: chosen.peek().map((f) => f.id).join(), [kind]: [...now[kind], hypothesis] };
}

/** What the document becomes when an entry is taken over. @param {Entry} entry @returns {Partial<Compare>} */
function changeOf(entry) {
  if (typeof entry.value !== "number") return { decisions: withDecision("use", entry.hypothesis) };
  const value = entry.value, c = compare.peek();
  const field = PER_FILE[/** @type {keyof typeof PER_FILE} */ (entry.field)];
  const said = { value: asRequest(value, entry.unit), origin: /** @type {const} */ ("suggested") };
  const withValue = (/** @type {Chosen} */ file) =>
    file.use === "off" || !field ? file : { ...file, experiment: { ...file.experiment, [field]: said } };
  const name = entry.field.startsWith("muscle.") ? entry.field.slice("muscle.".length) : null;
  const values = name ? { ...c.muscle.values, [name]: value } : c.muscle.values;
  return { files: c.files.map(withValue), muscle: { ...c.muscle, values } };
}

/** Takes what fits the data: a value becomes that of the muscle and its files, a channel is read the other way.
 * It is a step of the case; effects in the model are fitted again. @param {Entry} entry */
export const use = (entry) =>
  whileFitting(async () => {
    const change = changeOf(entry), history = stamped();
    const label = isReading(entry) ? useLabel(entry) : capitalized(`${subject(entry)} ${valueOf(entry)}`);
    const values = change.muscle?.values ?? compare.peek().muscle.values;
    const context = {
      files: change.files ?? compare.peek().files,
      decisions: change.decisions ?? compare.peek().decisions,
    };
    const plain = { ...here(), label, values, context, rmse: null, holdout: null, twins: [], tells: [] };
    const step = Object.keys(effectsNow()).length ? await fittedStep(plain) : plain;
    if (step) edit((d) => ({ ...d, compare: withStep(d.compare, step, history) }), `use ${label}`);
  });

/** @param {Entry} entry */
const keep = (entry) =>
  editCompare({ decisions: withDecision("keep", entry.hypothesis) }, `keep ${entry.hypothesis}`);

/** @param {number | null | undefined} si @param {Diagnosis} result */
const inUnits = (si, result) => errorText(si, result.unit, result.predicted, units.value);

/** The evidence for an entry. @param {Entry} entry @param {Diagnosis} result */
function proof(entry, result) {
  const end = result.path.at(-1)?.rmse ?? null;
  const stated = entry.stated === null ? "As stated" : `With ${asText(entry.stated, entry.unit)}`;
  const other = isReading(entry) ? String(entry.value).replace(/^/, "Read ") : `With ${valueOf(entry)}`;
  const estimate = typeof entry.value === "number" && entry.stderr !== null
    ? ` The data say ${
      measuredText(entry.value, entry.stderr, scaleOfUnit(entry.unit)).replaceAll(" ", "\u00a0")
    } (${inSentence(figure("diagnosis.stderr").label)}).`
    : "";
  return h(
    "p",
    { class: "proof" },
    `${stated} the best set of effects stops at `,
    h("b", null, inUnits(end, result)),
    `. ${other} it reaches `,
    h("b", null, inUnits(entry.rmse_after, result)),
    `.${estimate}`,
  );
}

/** @param {Entry} entry @param {Diagnosis} result @param {boolean} first */
function question(entry, result, first) {
  const stated = entry.stated === null ? "" : asText(entry.stated, entry.unit);
  return h(
    "li",
    { class: "entry-doubt", "data-hypothesis": entry.hypothesis },
    h("h3", null, `${capitalized(entry.sentence).replace(/(\d) %/g, "$1\u00a0%")}.`),
    first ? proof(entry, result) : null,
    h(
      "div",
      { class: "row" },
      h("button", {
        type: "button",
        class: first ? "primary" : "",
        disabled: () => stale.value,
        onclick: () => use(entry),
      }, useLabel(entry)),
      h("button", {
        type: "button",
        class: "link",
        disabled: () => stale.value,
        onclick: () => keep(entry),
      }, stated ? `${stated} is right` : "It is right as stated"),
    ),
  );
}

/** The questions about entries, before anything else. @param {Diagnosis} result */
export function contextBlock(result) {
  const [first, ...others] = asked(result);
  return h(
    "section",
    { class: "context-block", id: "entry-questions", "aria-label": "Entries to check" },
    h("p", { class: "cap" }, icon("warn"), "An entry may be wrong: it explains more than any effect"),
    h("ul", { class: "plain" }, question(first, result, true)),
    others.length
      ? h(
        "details",
        null,
        h("summary", null, `Or ${others.length === 1 ? "another entry" : `${others.length} other entries`}`),
        h("ul", { class: "plain" }, ...others.map((entry) => question(entry, result, false))),
      )
      : null,
    h(
      "p",
      { class: "muted" },
      `Effects are ranked once this is settled. Ranked now, wrong ones could take the blame for the fall from ${
        inUnits(answer.value?.rmse_beyond_accuracy, result)
      } to ${inUnits(first.rmse_after, result)}.`,
    ),
  );
}

/** One line about entries that are not in doubt, or that the user keeps. */
export function contextLine() {
  const result = diagnosis.value;
  const kept = result?.context.filter((entry) => entry.kept) ?? [];
  const alike = result?.context.filter((entry) => !entry.kept && !entry.asked) ?? [];
  const told = result?.assumptions ?? answer.value?.assumptions ?? [];
  const assumed = told.length ? told : Object.entries(answer.value?.experiment ?? {})
    .flatMap(([field, one]) =>
      one.origin === "assumed" ? [`${readable(field)} ${statedText(one, units.value)}`] : []
    );
  return h(
    "p",
    { class: "context-line", title: assumed.join("\n") },
    icon(kept.length || assumed.length || alike.length ? "info" : "check"),
    h(
      "span",
      null,
      alike.length
        ? `Or an entry is wrong: ${alike.map((entry) => capitalized(entry.sentence)).join("; or: ")}. `
        : "",
      kept.length
        ? `Kept as you said: ${kept.map(subject).join(", ")}.`
        : assumed.length
        ? `Assumed: ${
          assumed.map((text) => text.replace(/^assuming /, "").replace(/: --.*$/, "")).join("; ")
        }`
        : alike.length
        ? ""
        : result
        ? "No entry is in doubt: muscle, lengths, units, signs."
        : "Entries are checked with the effects.",
    ),
  );
}
