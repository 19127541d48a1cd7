// @ts-check
// One field of a task: typed with a unit, its reason beside it, the server's message under it.
import { h } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { commit, preview, units } from "../../state.js";
import { number, plainScale, scaleOf, toShown, toSi } from "../../format.js";
import { quantityField } from "../../ui/field.js";
import { put } from "../../paths.js";
import { messageFor, patchSizing, setTask, task, valueAt } from "./model.js";
import { FIELDS } from "./specs.js";

/** @param {string} path @param {{needed?: boolean}} [o] needed: its default alone makes no task */
export function taskField(path, { needed = false } = {}) {
  const { label, quantity, unit = "1", bounds, usual, empty, whole, why } = FIELDS[path];
  const name = label.toLowerCase();
  const own = computed(() => valueAt(path));
  const reset = () => setTask(path, undefined, `${name} as usual`);
  return h(
    "div",
    { class: "task-field" },
    quantityField({
      key: path,
      label,
      quantity,
      slider: false,
      scale: () => quantity ? scaleOf(quantity, units.value) : plainScale(unit),
      bounds: () => bounds,
      get: () => own.value ?? usual,
      put: (si, done) => {
        preview(patchSizing({ task: put(task.peek(), path, whole ? Math.round(si) : si) }));
        if (done) commit(name);
      },
      empty,
      clear: usual === null || !needed ? reset : undefined,
      changed: () => !needed && usual !== null && own.value !== undefined && own.value !== usual,
      reset,
      message: () => messageFor(path),
    }),
    h("p", { class: "hint" }, why),
  );
}

/** An error inside opens what is folded; it stays as the user leaves it. @param {string[]} paths */
export const openOnError = (paths) => (/** @type {HTMLElement} */ el) =>
  void effect(() => {
    if (paths.some((path) => messageFor(path) !== null)) /** @type {HTMLDetailsElement} */ (el).open = true;
  });

/** Points of a force over the stroke, a row each, as one types or pastes them. */
export function profileField() {
  const path = "load.force_over_stroke";
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
    wrong.value = bad < 0 ? "" : `Row ${bad + 1} is not two numbers: stroke and force, for example “30 120”.`;
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
      () => `Force over stroke: ${stroke().unit} and ${force().unit}, a row each`,
    ),
    area,
    h("p", { class: "error", id: "force-over-stroke-m", role: "alert" }, message),
    h(
      "p",
      { class: "hint" },
      "Further force by the stroke, straight between the rows; empty: the external force alone. A run takes the " +
        "lowest straight line above it that does not fall.",
    ),
  );
}
