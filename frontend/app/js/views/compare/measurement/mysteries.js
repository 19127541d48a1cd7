// @ts-check
// Measurements with hidden effects for practice: diagnose first, then reveal them.
import { h, icon } from "../../../dom.js";
import { computed, signal } from "../../../reactive.js";
import { edit } from "../../../state.js";
import { ApiError, get, post } from "../../../server/client.js";
import { freeOfOther, IDEAL, PROVIDED, withStartModel } from "../document.js";
import { titleOf } from "../words.js";
import { compare } from "../answers.js";
import { muscleFrom } from "../muscle-values.js";

/** @typedef {import("../types.js").Mystery} Mystery */
/** @typedef {import("../types.js").Revealed} Revealed */

/** Empty if the server has none. */
const mysteries = signal(/** @type {Mystery[]} */ ([]));
const revealed = signal(/** @type {{id: string, answer: Revealed} | null} */ (null));
const wrong = signal("");
const chosen = computed(() => mysteries.value.find((m) => m.id === compare.value.mystery) ?? null);

export async function fetchMysteries() {
  try {
    const answer = await get("/api/mysteries");
    mysteries.value = Array.isArray(answer) ? answer : answer.mysteries ?? [];
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    mysteries.value = [];
  }
}

/** @param {Mystery} m */
function openMystery(m) {
  revealed.value = null;
  edit((d) => ({
    ...d,
    compare: {
      ...withStartModel(d.compare, "ideal"),
      files: [{ id: m.measurement, name: m.title, use: "fit" }],
      muscle: m.muscle ? muscleFrom(m.muscle) : d.compare.muscle,
      effects: m.effects ?? {},
      label: Object.keys(m.effects ?? {}).length ? PROVIDED : IDEAL,
      drive: m.drive
        ? Object.fromEntries(
          Object.entries(m.drive).filter(([k]) => !["muscle", "effects", "schema"].includes(k)),
        )
        : null,
      mystery: m.id,
      free: freeOfOther(d.compare.free),
    },
  }), `mystery ${m.title}`);
}

/** @param {Mystery} m */
async function reveal(m) {
  wrong.value = "";
  try {
    const effects = Object.keys(compare.peek().effects ?? {});
    revealed.value = {
      id: m.id,
      answer: await post(`/api/mysteries/${encodeURIComponent(m.id)}/reveal`, { effects }),
    };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    wrong.value = error.words;
  }
}

/** The mystery that is open: its description, and on request what is hidden in it. */
export function mysteryCard() {
  const m = chosen.value;
  if (!m) return null;
  const hidden = revealed.value?.id === m.id ? revealed.value.answer : null;
  const named = Object.keys(compare.value.effects ?? {}).filter((id) => !(id in (m.effects ?? {})))
    .map(titleOf);
  return h(
    "section",
    { class: "card mystery", "aria-label": "Mystery" },
    h("div", { class: "card-head" }, h("h2", null, m.title)),
    h("p", null, m.story),
    hidden ? null : h(
      "p",
      { class: "muted" },
      named.length
        ? `Your diagnosis so far: ${named.join(", ")}.`
        : "Add the effects you think are missing, then reveal what is hidden.",
    ),
    hidden
      ? [
        h(
          "ul",
          { class: "plain" },
          ...hidden.hidden.map((one, i) =>
            h(
              "li",
              { class: `revealed ${hidden.found[i] ? "good" : "bad"}` },
              icon(hidden.found[i] ? "check" : "close"),
              h(
                "span",
                null,
                h("b", null, one.title),
                ` ${hidden.found[i] ? "found" : "not found"}. `,
                one.what,
              ),
            )
          ),
        ),
        h("p", null, hidden.text),
      ]
      : h("button", { type: "button", onclick: () => reveal(m) }, "Reveal what is hidden"),
    h("p", { class: "error", role: "alert" }, wrong.value),
  );
}

const MOST_LETTERS = 120;

/** The first sentences of a story, as many as a tile holds; at least one. @param {string} story */
function beginning(story) {
  const [first, ...more] = story.split(/(?<=[.?!])\s+/);
  let text = first;
  for (const next of more) {
    if (text.length + next.length >= MOST_LETTERS) break;
    text += ` ${next}`;
  }
  return text;
}

/** Buttons that open a mystery. */
export function mysteryList() {
  if (!mysteries.value.length) return null;
  return h(
    "div",
    { class: "mystery-list" },
    h("h3", null, "Mysteries: find the hidden effect"),
    h(
      "div",
      { class: "tiles" },
      ...mysteries.value.map((m) =>
        h(
          "button",
          { type: "button", class: "tile", onclick: () => openMystery(m) },
          h("b", null, m.title),
          h("small", null, beginning(m.story)),
        )
      ),
    ),
  );
}
