// @ts-check
// The line to type a question into. The server reads it; what it states goes into the fields, what it does not
// know is marked and named. The line and the fields are one document: it says what they hold.
import { h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { design } from "../../muscle/document.js";
import { preset } from "../../muscle/preset.js";
import { number, withUnit } from "../../format.js";
import { ApiError, post } from "../../server/client.js";
import { geometryValue, loadText, pressureNow } from "./model.js";

/** @typedef {import("../../types.js").S["AskedLine"]} AskedLine */

/** What the fields of the muscle hold, as a question. */
export const muscleWords = computed(() => {
  const length = geometryValue("nominal_length"), system = units.value, { contraction } = design.value;
  return [
    [preset.value?.id, length === null ? null : withUnit(length, "length", system)].filter(Boolean).join(" "),
    withUnit(pressureNow.value, "pressure", system),
    loadText.value,
    contraction === null ? null : `${number(100 * contraction, 2)} %`,
  ].filter(Boolean).join(", ").replaceAll("\u00a0", " ");
});

/** The line that was read last, and what the fields held then: as long as they do, the user's words stay. */
const last = signal(/** @type {{text: string, line: AskedLine, held: string} | null} */ (null));
const wrong = signal("");

/** The line with what was read underlined, and what was not. @param {AskedLine} line @param {string} words */
function marked({ parts }, words) {
  let at = 0;
  const texts = parts.flatMap(({ text: part, start, meaning, problem }) => {
    const before = words.slice(at, start);
    at = start + part.length;
    return [before, h(meaning ? "u" : "s", { title: meaning ?? problem }, part)];
  });
  return [...texts, words.slice(at)];
}

/** @param {AskedLine | null} line */
function said(line) {
  if (wrong.value) return h("p", { class: "error" }, wrong.value);
  const unread = line?.parts.filter(({ problem }) => problem) ?? [];
  if (!unread.length) return null;
  const named = unread.map(({ text: part, problem }) =>
    `“${part}”${problem === "not read" ? "" : ` (${problem})`}`
  );
  return h("p", { class: "error" }, `Not read: ${named.join(", ")}.`);
}

/** @param {() => string} held what the fields hold, in words @param {(line: AskedLine) => unknown} take puts what the
 * line states into the document */
export function askLine(held, take) {
  const text = computed(() => last.value && last.value.held === held() ? last.value.text : held());
  const reading = computed(() => last.value && last.value.text === text.value ? last.value.line : null);
  /** @param {string} line */
  async function ask(line) {
    wrong.value = "";
    try {
      const read = /** @type {AskedLine} */ (await post("/api/asked", { text: line }));
      take(read);
      last.value = { text: line, line: read, held: held() };
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      wrong.value = error.words;
    }
  }
  const follow = () => (words.style.transform = `translateX(${-input.scrollLeft}px)`);
  const input = h("input", {
    id: "ask",
    type: "text",
    autocomplete: "off",
    spellcheck: "false",
    maxlength: 300,
    placeholder: "DMSP-20 of 300 mm at 6 bar, 20 kg; which pressure for 15 %?",
    "aria-label": "Ask: muscle, length, pressure, load; or a task",
    "aria-describedby": "ask-said",
    onscroll: follow,
    oninput: () => (marks.hidden = true),
    onblur: () => {
      if (input.value.trim() === "") input.value = text.peek();
    },
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      if (e.key === "Escape") input.value = text.peek();
      if (e.key === "Enter" && input.value.trim()) ask(input.value);
    },
  });
  const words = h("span", null, () => {
    const line = reading.value;
    return line ? marked(line, text.value) : null;
  });
  const marks = h("div", { class: "ask-marks", "aria-hidden": "true" }, words);
  effect(() => {
    input.value = text.value;
    marks.hidden = !reading.value;
    follow();
  });
  return h(
    "div",
    { class: "ask", role: "search" },
    h("div", { class: "ask-line" }, icon("search"), marks, input, h("kbd", { "aria-hidden": "true" }, "/")),
    h("div", { id: "ask-said", role: "status" }, () => said(reading.value)),
  );
}
