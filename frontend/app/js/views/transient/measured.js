// @ts-check
// A measured trace shown in the plots: the file is read by the server.
import { h, icon } from "../../dom.js";
import { apart, computed, effect, signal } from "../../reactive.js";
import { figure, inSentence } from "../../facts.js";
import { view } from "../../state.js";
import { aboutFile, ApiError } from "../../server/client.js";
import { keep, measurement } from "../../server/measurements.js";
import { cameBack, has, lacks } from "../../server/missing.js";
import { untilLoaded } from "../../server/patience.js";
import { Question } from "../../server/question.js";
import { editTransient, transient } from "./model.js";

const OVERLAID = ["pressure", "displacement", "length", "force", "velocity", "command"];

const chosen = computed(() => transient.value.measurement);
const columns = new Question(measurement);
/** The measured trace. The document holds its id only, so that links and undo bring it back. */
export const measured = computed(() => columns.error.value ? null : columns.answer.value);
/** Why a file could not be sent. */
const refused = signal("");
const isSending = signal(false);

/** Imports a trace; the experiment need not be answered, because nothing is fitted to it.
 * @param {File | undefined} file */
async function send(file) {
  if (!file) return;
  refused.value = "";
  const { importFiles } = await untilLoaded(() => import("../../measurement/import.js"));
  try {
    const [read] = await importFiles([file], {
      asks: false,
      complain: (name, words) => (refused.value = `${name}: ${aboutFile(name, words)}`),
      reading: (name) => (isSending.value = Boolean(name)),
    });
    if (!read) return;
    isSending.value = true;
    const answer = await keep(file, read.mapping);
    has([answer.id]);
    editTransient({ measurement: { id: answer.id, name: answer.name } }, `measured trace ${answer.name}`);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    refused.value = `${file.name}: ${aboutFile(file.name, error.words)}`;
  } finally {
    isSending.value = false;
  }
}

/** What is wrong with the file that was sent, or with the one the document names. */
function complaint() {
  const error = columns.error.value;
  const isMissing = error?.status === 404; // the banner says so
  const { name } = chosen.value ?? { name: "" };
  return refused.value || (error && name && !isMissing ? `${name}: ${aboutFile(name, error.words)}` : "");
}

/** What is shown of the file, and the messages of the server. */
function summary() {
  const m = measured.value;
  if (!m) return null;
  const timed = m.channels.some((c) => c.name === "time");
  const used = OVERLAID.filter((name) => m.columns[name]);
  return [
    h(
      "p",
      { class: "file" },
      h("b", null, m.name),
      h("small", null, ` ${m.rows} rows`),
      h("button", {
        type: "button",
        class: "mini",
        "aria-label": `Remove ${m.name}`,
        onclick: () => editTransient({ measurement: null }, "remove measured trace"),
      }, icon("close")),
    ),
    timed && used.length
      ? h(
        "p",
        { class: "muted" },
        `Dots in the plots: ${used.map((name) => inSentence(figure(`channel.${name}`).label)).join(", ")}.`,
      )
      : h(
        "p",
        { class: "error" },
        timed ? "None of its columns can be shown in the plots." : "It has no time column.",
      ),
    m.messages.length
      ? h("ul", { class: "plain muted" }, ...m.messages.map((text) => h("li", null, text)))
      : null,
    m.ignored.length ? h("p", { class: "muted" }, `Not used: ${m.ignored.join(", ")}.`) : null,
  ];
}

export function measuredCard() {
  columns.follow(() => chosen.value?.id ?? null, { active: () => view.value === "transient" });
  effect(() => {
    const error = columns.error.value, file = chosen.peek();
    if (error?.status === 404 && file) lacks({ ...file, view: "transient" });
  });
  effect(() => {
    if (cameBack.value && columns.error.peek()?.status === 404) apart(() => columns.again());
  });
  const input = h("input", {
    type: "file",
    hidden: true,
    id: "measured-file",
    accept: ".csv,.txt,.tsv,.dat,.asc,.log,.lvm,.md,.json,.jsonl,.xlsx,.mat,.h5,.hdf5,.tdms,text/csv",
    onchange: () => {
      send(input.files?.[0]);
      input.value = "";
    },
  });
  const over = signal(false);
  return h(
    "section",
    {
      class: () => `card measured${over.value ? " over" : ""}`,
      "aria-label": "Measured trace",
      ondragover: (/** @type {DragEvent} */ e) => {
        e.preventDefault();
        over.value = true;
      },
      ondragleave: () => (over.value = false),
      ondrop: (/** @type {DragEvent} */ e) => {
        e.preventDefault();
        over.value = false;
        send(e.dataTransfer?.files[0]);
      },
    },
    h("div", { class: "card-head" }, h("h2", null, "Measured trace")),
    input,
    () =>
      measured.value ? null : h(
        "button",
        { type: "button", class: "drop", onclick: () => input.click() },
        h("span", null, isSending.value ? "Reading…" : "Choose a CSV file, or drop it here"),
        h("small", null, "time, pressure, stroke"),
      ),
    summary,
    h("p", { class: "error", role: "alert" }, complaint),
  );
}
