// @ts-check
// The steps that prepare the data of a file: a range, a drift, a low pass, another time step. Each says what it did,
// and a small picture shows the readings before, pale, and after.
import { h, icon } from "../../../dom.js";
import { signal } from "../../../reactive.js";
import { ApiError } from "../../../server/client.js";
import { measurement } from "../../../server/measurements.js";
import { untilLoaded } from "../../../server/patience.js";
import { units } from "../../../state.js";
import { answer } from "../answers.js";
import { setPreparation } from "./files.js";

/** @typedef {import("../../../types.js").Chosen} Chosen */
/** @typedef {import("../../../types.js").S["MeasurementDetails"]} Details */

const SHA256 = /^[0-9a-f]{64}$/;
const EXAMPLES = [
  "range time 2 s to 10 s",
  "range rows 20 to 400",
  "detrend force",
  "low pass 20 Hz",
  "resample 100 Hz",
];
const MOST_POINTS = 400;

/** A few hundred of the readings, evenly spread. @param {Details} m
 * @returns {import("../../../measurement/picture.js").Drawn} */
function drawn(m) {
  const step = Math.max(1, Math.ceil(m.rows / MOST_POINTS));
  const points = m.channels.map(({ name }) => {
    const values = /** @type {(number | null)[]} */ (m.columns[name] ?? []);
    return [name, values.filter((_, i) => i % step === 0)];
  });
  const choices = m.channels.map(({ name, si_unit }) => ({ name, si_unit, units: [] }));
  return { kind: m.kind, points: Object.fromEntries(points), channel_choices: choices };
}

/** What the steps of a file did: of a file of the user as the server reads it, else as the comparison says.
 * @param {Chosen} file @param {Details | null} after */
const doneOf = (file, after) =>
  after?.prepared ?? answer.value?.specimens.find((one) => one.file === file.name)?.prepared ?? [];

/** @param {Chosen} file */
export function preparation(file) {
  const steps = file.prepare ?? [], isStored = SHA256.test(file.id);
  const problem = signal(""), after = signal(/** @type {Details | null} */ (null));
  const draw = signal(/** @type {(() => Node) | null} */ (null));

  const input = h("input", {
    type: "text",
    id: `prepare-${file.id}`,
    autocomplete: "off",
    spellcheck: "false",
    maxlength: "120",
    list: `prepare-${file.id}-list`,
    placeholder: "low pass 20 Hz",
    "aria-label": `A step that prepares ${file.name}`,
    "aria-invalid": () => problem.value ? "true" : null,
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      if (e.key === "Enter") add();
    },
  });

  /** The server says what is wrong with a step before it is taken. */
  async function add() {
    const text = input.value.trim();
    if (!text) return;
    problem.value = "";
    try {
      if (isStored) await measurement(file.id, undefined, [...steps, text]);
      setPreparation(file.id, [...steps, text]);
      document.getElementById(input.id)?.focus(); // of the row as it is drawn now
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      problem.value = error.words;
    }
  }

  async function look() {
    try {
      const [whole, prepared, { picture }] = await Promise.all([
        measurement(file.id),
        measurement(file.id, undefined, steps),
        untilLoaded(() => import("../../../measurement/picture.js")),
      ]);
      after.value = prepared;
      draw.value = () => picture(drawn(prepared), units.value, drawn(whole).points);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      problem.value = error.words;
    }
  }
  if (steps.length && isStored) look();

  return h(
    "details",
    { class: "prepare", open: steps.length > 0 },
    h(
      "summary",
      null,
      steps.length ? `Prepared in ${steps.length} step${steps.length > 1 ? "s" : ""}` : "Prepare",
    ),
    h("ol", { class: "plain muted" }, () =>
      steps.map((step, i) => {
        const done = doneOf(file, after.value)[i];
        return h(
          "li",
          null,
          h(
            "div",
            { class: "file-head" },
            h("b", null, step),
            h("button", {
              type: "button",
              class: "mini",
              "aria-label": `Remove the step ${step}`,
              onclick: () => setPreparation(file.id, steps.filter((_, k) => k !== i)),
            }, icon("close")),
          ),
          done ? h("span", null, `${done.done}.`) : null,
        );
      })),
    () =>
      draw.value
        ? h(
          "figure",
          null,
          draw.value(),
          h("figcaption", { class: "muted" }, "Pale: as it was read. Strong: prepared."),
        )
        : null,
    h(
      "div",
      { class: "file-head" },
      input,
      h("button", { type: "button", class: "small", onclick: add }, "Add"),
      h("datalist", { id: `prepare-${file.id}-list` }, ...EXAMPLES.map((value) => h("option", { value }))),
    ),
    h("p", { class: "error", role: "alert" }, () => problem.value),
  );
}
