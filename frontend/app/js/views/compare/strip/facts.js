// @ts-check
// What the experiment was made with, each value with who says it; a click changes it in place.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { muscles } from "../../../store.js";
import { capitalized, readable } from "../../../format.js";
import { answer, chosen, compare } from "../answers.js";
import { hasSource, importOnceMore, infos } from "../measurement/files.js";
import { presetNamed } from "../muscle-values.js";
import { openSetup } from "../setup-panel.js";
import { statedText } from "../words.js";

/** @typedef {import("../words.js").Stated & {origin: string, where: string}} Stated */

/** Field -> title; shown in this order. */
const FIELDS = { muscle: "Muscle", rest_length: "Rest length", load: "Load", supply: "Supply" };
/** @type {Record<string, [Parameters<typeof icon>[0], string]>} */
const ORIGINS = {
  file: ["file", "from the file"],
  you: ["person", "you said"],
  suggested: ["person", "you agreed"],
  preset: ["table", "catalogue"],
  assumed: ["warn", "assumed!"],
};

/** @type {[Parameters<typeof icon>[0], string]} */
const NOBODY = ["file", ""];

/** What the answer says of a field; before it, what the view takes. @param {string} field @returns {Stated | null} */
function stated(field) {
  const found = answer.value?.experiment[field];
  if (found) {
    const chosenHere = field === "muscle" && compare.value.files.every((file) => !file.experiment?.muscle);
    const fromFile = chosenHere && specimenSaysMuscle();
    return { ...found, origin: fromFile ? "file" : found.origin };
  }
  const unit = assumedUnits().find((one) => one.key === field);
  if (unit) return { ...unit, value: String(unit.value), unit: "" };
  const own = answer.value?.specimens ?? [];
  if (own.length > 1) {
    const each = own.flatMap((one) => one.experiment[field] ? [one.experiment[field]] : []);
    if (each.length) {
      return { value: `${each.length} values`, unit: "", origin: each[0].origin, where: "each file its own" };
    }
  }
  return null;
}

/** Units of columns that were assumed when the files were read. */
const assumedUnits = () =>
  chosen.value.flatMap((file) =>
    (infos.value.get(file.id)?.stated ?? []).filter((one) => one.origin === "assumed")
  );

/** Whether a file names the muscle that the view has. */
const specimenSaysMuscle = () =>
  chosen.value.some((file) => {
    const { muscle, sample } = infos.value.get(file.id)?.conditions ?? {};
    const named = presetNamed(muscles.value, muscle) ?? presetNamed(muscles.value, sample);
    return named !== null && named.preset.id === compare.value.muscle.preset;
  });

/** @param {string} field */
const titleOf = (field) => FIELDS[/** @type {keyof typeof FIELDS} */ (field)] ?? capitalized(readable(field));

/** @param {string} field */
function fact(field) {
  const title = titleOf(field);
  const one = stated(field), value = one ? statedText(one, units.value) : "–";
  const [symbol, words] = one ? ORIGINS[one.origin] ?? ORIGINS.you : NOBODY;
  return h(
    "button",
    {
      type: "button",
      class: `fact${one?.origin === "assumed" ? " assumed" : ""}`,
      "data-fact": field,
      title: `${title}: ${value}${one?.where ? ` · ${one.where}` : ""}`,
      "aria-label": `${title}: ${value}${words ? `, ${words}` : ""}: change`,
      onclick: () => change(field),
    },
    h("span", { class: "k" }, title),
    " ",
    h("span", { class: "v" }, value),
    " ",
    h("span", { class: "src" }, ...(words ? [icon(symbol), h("span", null, words)] : [])),
  );
}

/** Opens what says a field: the panel, or how the file is read. @param {string} field */
function change(field) {
  const file = chosen.peek().find(({ id }) =>
    infos.peek().get(id)?.stated.some((one) => one.key === field && one.origin === "assumed")
  );
  if (file && hasSource(file.id)) importOnceMore(file.id);
  else openSetup(file ? "files" : field);
}

/** The fields of this kind of test: always the muscle and its length; load and supply where they matter; then what
 * was assumed beside them. */
function fields() {
  const said = answer.value?.experiment ?? {};
  const usual = ["muscle", "rest_length", ...["load", "supply"].filter((f) => f in said)];
  const assumed = [
    ...assumedUnits().map((one) => one.key),
    ...Object.keys(said).filter((f) => said[f].origin === "assumed" && !usual.includes(f)),
  ];
  return { usual, assumed };
}

const MOST_FACTS = 4;

/** What was assumed and has no room of its own, in one fact. @param {string[]} list */
function assumedFact(list) {
  const texts = list.map((field) => {
    const one = stated(field);
    return `${titleOf(field)} ${one ? statedText(one, units.value) : ""}`.trim();
  });
  return h(
    "button",
    {
      type: "button",
      class: "fact assumed",
      "data-fact": "assumed",
      title: texts.join(" · "),
      "aria-label": `Also ${list.length === 1 ? "" : `${list.length} values, `}assumed: ${
        texts.join(", ")
      }: change`,
      onclick: () => change(list[0]),
    },
    h("span", { class: "k" }, "Also"),
    " ",
    h("span", { class: "v" }, list.length === 1 ? texts[0] : `${list.length} values`),
    " ",
    h("span", { class: "src" }, icon("warn"), h("span", null, "assumed!")),
  );
}

/** In one line: what has no room is said together. */
export const facts = () =>
  h("div", { class: "facts" }, () => {
    const { usual, assumed } = fields(), all = [...usual, ...assumed];
    if (all.length <= MOST_FACTS || !assumed.length) return all.slice(0, MOST_FACTS).map(fact);
    const alone = usual.slice(0, MOST_FACTS - 1);
    const rest = [...usual.slice(alone.length).filter((f) => stated(f)?.origin === "assumed"), ...assumed];
    return [...alone.map(fact), assumedFact(rest)];
  });

/** One below the other. */
export const allFacts = () =>
  h("div", { class: "facts" }, () => {
    const { usual, assumed } = fields();
    return [...usual, ...assumed].map(fact);
  });

/** Whether something was assumed that nobody said. */
export const hasAssumed = () =>
  assumedUnits().length > 0 ||
  Object.values(answer.value?.experiment ?? {}).some((one) => one.origin === "assumed");
