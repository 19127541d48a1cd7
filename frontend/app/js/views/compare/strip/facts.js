// @ts-check
// What the experiment was made with, each value with who says it; a click changes it in place.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { muscles } from "../../../store.js";
import { capitalized, readable } from "../../../format.js";
import { answer, chosen, compare } from "../answers.js";
import { infos } from "../measurement/files.js";
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
  const own = answer.value?.specimens ?? [];
  if (own.length > 1) {
    const each = own.flatMap((one) => one.experiment[field] ? [one.experiment[field]] : []);
    if (each.length) {
      return { value: `${each.length} values`, unit: "", origin: each[0].origin, where: "each file its own" };
    }
  }
  return null;
}

/** Whether a file names the muscle that the view has. */
const specimenSaysMuscle = () =>
  chosen.value.some((file) => {
    const { muscle, sample } = infos.value.get(file.id)?.conditions ?? {};
    const named = presetNamed(muscles.value, muscle) ?? presetNamed(muscles.value, sample);
    return named !== null && named.preset.id === compare.value.muscle.preset;
  });

/** @param {string} field */
function fact(field) {
  const title = FIELDS[/** @type {keyof typeof FIELDS} */ (field)] ?? capitalized(readable(field));
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
      onclick: () => openSetup(field),
    },
    h("span", { class: "k" }, title),
    " ",
    h("span", { class: "v" }, value),
    " ",
    h("span", { class: "src" }, ...(words ? [icon(symbol), h("span", null, words)] : [])),
  );
}

const MOST_FACTS = 4;

/** The fields of this kind of test: always the muscle and its length; load and supply where they matter; what was
 * assumed in any case. */
const fields = () => {
  const said = answer.value?.experiment ?? {};
  const isAssumed = (/** @type {string} */ field) => said[field]?.origin === "assumed";
  const usual = ["muscle", "rest_length", ...["load", "supply"].filter((f) => f in said)];
  const more = Object.keys(said).filter((f) => isAssumed(f) && !usual.includes(f));
  const kept = usual.filter((f, i) => isAssumed(f) || i + more.length < MOST_FACTS);
  return [...kept, ...more].slice(0, MOST_FACTS);
};

export const facts = () => h("div", { class: "facts" }, () => fields().map(fact));

/** Whether something was assumed that nobody said. */
export const hasAssumed = () =>
  Object.values(answer.value?.experiment ?? {}).some((one) => one.origin === "assumed");
