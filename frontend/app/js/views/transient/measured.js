// @ts-check
// A measured trace over the plots: a file goes to the server, which says how it understood it.
import { h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { view } from "../../state.js";
import { ApiError, get } from "../../server/client.js";
import { editTransient, transient } from "./model.js";

/** @typedef {import("../../types.js").Measured} Measured */

const MOST_BYTES = 64e6;
const OVERLAID = ["pressure", "displacement", "force", "velocity", "command"];

export const measured = signal(/** @type {Measured | null} */ (null));
const wrong = signal("");
const busy = signal(false);
const chosen = computed(() => transient.value.measurement);

/** @param {File | undefined} file */
async function send(file) {
  if (!file) return;
  wrong.value = "";
  if (file.size > MOST_BYTES) return void (wrong.value = "The file is larger than 64 MB.");
  busy.value = true;
  try {
    const response = await fetch(`/api/measurements?name=${encodeURIComponent(file.name)}`, {
      method: "PUT",
      body: file,
    });
    const answer = await response.json();
    if (!response.ok) {
      const { message, hint, field } = answer.error ?? {};
      throw new ApiError(message ?? `The server answered with status ${response.status}.`, { hint, field });
    }
    editTransient({ measurement: { id: answer.id, name: answer.name } }, `measured trace ${answer.name}`);
  } catch (error) {
    wrong.value = `${file.name}: ${error instanceof ApiError ? error.words : "it could not be sent."}`;
  } finally {
    busy.value = false;
  }
}

/** The columns belong to the id in the document: a link or an undo brings them back. */
function fetchColumns() {
  const wanted = chosen.value;
  if (!wanted || view.value !== "transient") {
    if (!wanted) measured.value = null;
    return;
  }
  if (measured.peek()?.id === wanted.id) return;
  get(`/api/measurements/${wanted.id}`).then((answer) => {
    if (chosen.peek()?.id === answer.id) measured.value = answer;
  }, (error) => {
    measured.value = null;
    const why = error instanceof ApiError && error.status === 404
      ? "This server does not have the file. Choose it once more."
      : error.words ?? String(error);
    wrong.value = `${wanted.name}: ${why}`;
  });
}

/** What is shown of the file, and what the server remarked. */
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
    timed && used.length ? h("p", { class: "muted" }, `Dots in the plots: ${used.join(", ")}.`) : h(
      "p",
      { class: "error" },
      timed ? "None of its columns can be laid over a run." : "It has no column of time.",
    ),
    m.messages.length
      ? h("ul", { class: "plain muted" }, ...m.messages.map((text) => h("li", null, text)))
      : null,
    m.ignored.length ? h("p", { class: "muted" }, `Not used: ${m.ignored.join(", ")}.`) : null,
  ];
}

export function measuredCard() {
  effect(fetchColumns);
  const input = h("input", {
    type: "file",
    hidden: true,
    id: "measured-file",
    accept: ".csv,.txt,.tsv,.xlsx,.mat,.tdms,text/csv",
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
        h("span", null, busy.value ? "Reading…" : "Choose a CSV file, or drop it here"),
        h("small", null, "time, pressure, displacement"),
      ),
    summary,
    h("p", { class: "error", role: "alert" }, () => wrong.value),
  );
}
