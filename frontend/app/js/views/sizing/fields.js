// @ts-check
// The fields of a task, each with its explanation and the server's message.
import { inSentence } from "../../facts.js";
import { h } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { commit, preview, units } from "../../state.js";
import { number, plainScale, scaleOf, toShown, toSi } from "../../format.js";
import { quantityField } from "../../ui/field.js";
import { at, put } from "../../paths.js";
import { messageFor, patchSizing, setTask, task, valueAt } from "./model.js";
import { fieldOf } from "./specs.js";

/** @param {string} path @param {{needed?: boolean}} [o] needed: it cannot be left at its default */
export function taskField(path, { needed = false } = {}) {
  const { label, quantity, unit, bounds, default: usual, empty, whole, definition } = fieldOf(path);
  const name = inSentence(label);
  const entered = computed(() => valueAt(path));
  const reset = () => setTask(path, undefined, `default ${name}`);
  const scale = () => quantity ? scaleOf(quantity, units.value) : plainScale(unit);
  /** @param {number | null} si */
  const inWords = (si) =>
    si === null
      ? empty ?? "–"
      : `${number(toShown(si, scale()), scale().digits)}\u00a0${scale().unit}`.trim();
  return h(
    "div",
    { class: "task-field" },
    quantityField({
      key: path,
      label,
      quantity,
      slider: false,
      scale,
      bounds: () => bounds,
      get: () => entered.value ?? usual,
      put: (si, done) => {
        preview(patchSizing({ task: put(task.peek(), path, whole ? Math.round(si) : si) }));
        if (done) commit(name, (d) => inWords(/** @type {any} */ (at(d.sizing.task, path)) ?? usual));
      },
      empty,
      clear: usual === null || !needed ? reset : undefined,
      changed: () => !needed && usual !== null && entered.value !== undefined && entered.value !== usual,
      reset,
      message: () => messageFor(path),
    }),
    h("p", { class: "hint" }, definition),
  );
}

/** An error in one of the fields opens the collapsed part they are in. @param {string[]} paths */
export const openOnError = (paths) => (/** @type {HTMLElement} */ el) =>
  void effect(() => {
    if (paths.some((path) => messageFor(path) !== null)) /** @type {HTMLDetailsElement} */ (el).open = true;
  });

/** A force over the stroke as typed or pasted rows. */
export function profileField() {
  const path = "load.force_over_stroke", { label, definition } = fieldOf(path);
  const wrong = signal("");
  const stroke = () => scaleOf("length", units.value), force = () => scaleOf("force", units.value);
  const text = computed(() => {
    const { strokes = [], forces = [] } = valueAt(path) ?? {};
    return strokes.map((/** @type {number} */ s, /** @type {number} */ i) =>
      `${number(toShown(s, stroke()), 4)}  ${number(toShown(forces[i], force()), 4)}`
    ).join("\n");
  });
  const take = () => {
    const rows = area.value.replaceAll("−", "-").split("\n").map((row) => row.trim()).filter(Boolean)
      .map((row) => row.split(/[\s;]+/).map((cell) => Number(cell.replace(",", "."))));
    const bad = rows.findIndex((row) => row.length !== 2 || !row.every(Number.isFinite));
    wrong.value = bad < 0
      ? ""
      : `Row ${bad + 1} must be two numbers, stroke and force, for example “30 120”.`;
    if (wrong.peek()) return;
    const points = {
      strokes: rows.map(([s]) => toSi(s, stroke())),
      forces: rows.map(([, f]) => toSi(f, force())),
    };
    setTask(path, rows.length ? points : undefined, "force over the stroke");
  };
  const message = () => wrong.value || messageFor(path) || "";
  const area = h("textarea", {
    id: "force-over-stroke",
    rows: 3,
    spellcheck: "false",
    "aria-invalid": () => message() ? "true" : null,
    "aria-describedby": "force-over-stroke-m",
    onchange: take,
    value: () => text.value,
  });
  return h(
    "div",
    { class: "task-field", "data-field": path },
    h(
      "label",
      { class: "label", for: "force-over-stroke" },
      () => `${label}: rows of ${stroke().unit} and ${force().unit}`,
    ),
    area,
    h("p", { class: "error", id: "force-over-stroke-m", role: "alert" }, message),
    h(
      "p",
      { class: "hint" },
      definition,
    ),
  );
}
