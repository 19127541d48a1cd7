// @ts-check
// What is asked about, load and pressure; and the card of conditions: pressures of the curves, direction of motion,
// temperature, dead volume, fixed length.
import { each, h, icon } from "../../dom.js";
import { figure } from "../../facts.js";
import { computed, signal } from "../../reactive.js";
import { commit, preview, units } from "../../state.js";
import { design, editDesign, patchDesign } from "../../muscle/document.js";
import { BAR, GRAVITY, number, parse, scaleOf, siOf, toShown, withUnit } from "../../format.js";
import { quantityField } from "../../ui/field.js";
import { openPopover } from "../../ui/dialog.js";
import { segments } from "../../ui/segments.js";
import { curves, loadOf, messageFor, pressureNow } from "./model.js";
import { preset } from "../../muscle/preset.js";

/** @typedef {import("../../types.js").Design} Design */
/** @typedef {import("../../format.js").Quantity} Quantity */

const MOST = 12;
const pressures = computed(() => design.value.pressures);
const direction = computed(() => design.value.direction);
/** @type {import("../../quantities.js").Counted} */
const GAUGE = { reference: "gauge" };
const pressureScale = () => scaleOf("pressure", units.value);

/** @param {number[]} list @param {string} label */
const setPressures = (list, label) => {
  const sorted = [...new Set(list.map((p) => Number(p.toPrecision(9))))].sort((a, b) => a - b);
  editDesign({ pressures: sorted.slice(0, MOST) }, label);
};

/** @param {number} p */
const shownPressure = (p) => number(toShown(p, pressureScale()), 2);

/** @param {number} p */
function chip(p) {
  const over = () => {
    const limit = curves.value?.limits.max_pressure;
    return limit != null && p > limit * (1 + 1e-9);
  };
  return h(
    "li",
    {
      class: () => `chip${over() ? " over" : ""}`,
      title: () => over() ? "Above the permitted pressure" : null,
    },
    () => shownPressure(p),
    h("button", {
      type: "button",
      "aria-label": () => `Remove ${shownPressure(p)} ${pressureScale().unit}`,
      disabled: () => pressures.value.length < 2,
      onclick: () => setPressures(pressures.peek().filter((q) => q !== p), "remove pressure"),
    }, icon("close")),
  );
}

function pressureEditor() {
  const wrong = signal("");
  const add = () => {
    if (!input.value.trim()) return;
    const parts = input.value.trim().split(/\s*[;\s]\s*(?=[-+\d.])/);
    const read = parts.map((part) => parse(part, pressureScale(), "pressure", undefined, GAUGE));
    const bad = read.find((r) => "error" in r);
    const values = read.flatMap((r) => ("value" in r ? [r.value] : []));
    if (bad && "error" in bad) return void (wrong.value = bad.error);
    if (values.some((p) => p < 0)) {
      return void (wrong.value = "The gauge pressure must be zero or more.");
    }
    if (pressures.peek().length + values.length > MOST) {
      return void (wrong.value = `At most ${MOST} pressures; remove one first.`);
    }
    wrong.value = "";
    input.value = "";
    setPressures([...pressures.peek(), ...values], "add pressure");
  };
  const input = h("input", {
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    "aria-label": "Pressure to add",
    "aria-invalid": () => wrong.value ? "true" : null,
    placeholder: "add",
    onkeydown: (/** @type {KeyboardEvent} */ e) => e.key === "Enter" && add(),
    onchange: add,
  });
  return h(
    "div",
    { class: "field", "data-field": "pressures" },
    h(
      "div",
      { class: "field-head" },
      h("span", { class: "label" }, "Pressures", h("span", { class: "symbol" }, "P")),
      spaced(),
      h("span", { class: "unit" }, () => pressureScale().unit),
    ),
    h(
      "div",
      { class: "chips" },
      each("ul", { "aria-label": "Pressures of the curves" }, () => pressures.value, (p) => p, chip),
      h("span", { class: "chip add" }, input),
    ),
    () => {
      const text = wrong.value || messageFor("pressures");
      return text ? h("p", { class: "error" }, text) : null;
    },
  );
}

/** A popover for evenly spaced pressures: from, to, how many. */
function spaced() {
  const from = signal(BAR), to = signal(6 * BAR), count = signal(6);
  /** @param {string} label @param {typeof from} value @param {Quantity} quantity
   * @param {[number, number]} bounds */
  const field = (label, value, quantity, bounds) =>
    quantityField({
      key: `spaced ${label}`,
      label,
      quantity,
      slider: false,
      strict: true,
      counted: () => quantity === "pressure" ? GAUGE : {},
      bounds: () => bounds,
      scale: () => scaleOf(quantity, units.value),
      get: () => value.value,
      put: (si) => (value.value = si),
    });
  const button = h("button", {
    type: "button",
    class: "link",
    "aria-expanded": "false",
    onclick: () => {
      const highest = preset.peek()?.limits?.max_pressure;
      to.value = highest ? siOf(highest) : pressures.peek().at(-1) ?? 6 * BAR;
      openPopover(button, "Evenly spaced pressures", (close) => [
        h("h3", null, "Evenly spaced pressures"),
        field("From", from, "pressure", [0, 1e8]),
        field("To", to, "pressure", [0, 1e8]),
        field("How many", count, "number", [1, MOST]),
        h("button", {
          type: "button",
          class: "primary",
          onclick: () => {
            const n = Math.round(count.peek());
            const step = n > 1 ? (to.peek() - from.peek()) / (n - 1) : 0;
            setPressures(
              Array.from({ length: n }, (_, i) => from.peek() + i * step),
              "evenly spaced pressures",
            );
            close();
          },
        }, "Use these"),
      ]);
    },
  }, "space evenly");
  return button;
}

/** @param {keyof Design & string} key
 * @param {Partial<import("../../ui/field.js").FieldOptions> & {label: string,
 *   quantity: Quantity, bounds: () => [number, number]}} o */
const designField = (key, o) =>
  quantityField({
    key,
    scale: () => scaleOf(/** @type {Quantity} */ (o.quantity), units.value),
    get: () => /** @type {number | null} */ (design.value[key]),
    put: (si, done) => {
      preview(patchDesign({ [key]: si }));
      const text = (/** @type {any} */ d) =>
        withUnit(d.design[key], /** @type {Quantity} */ (o.quantity), units.peek());
      if (done) commit(o.label.toLowerCase(), text);
    },
    message: () => messageFor(key),
    ...o,
  });

/** @type {[-1 | 0 | 1, string, string][]} */
const DIRECTIONS = [
  [-1, "Filling", "The muscle shortens: friction reduces the force"],
  [0, "Static", "No motion, no friction"],
  [1, "Venting", "The muscle lengthens: friction adds to the force"],
];

export const operationCard = () =>
  h(
    "section",
    { class: "card", "aria-label": "Operation" },
    h("div", { class: "card-head" }, h("h2", null, "Curves and conditions")),
    pressureEditor(),
    h(
      "div",
      { class: "field" },
      h("span", { class: "label", "aria-hidden": "true" }, "Direction of motion"),
      segments(
        "Direction of motion",
        DIRECTIONS,
        () => direction.value,
        (value) => editDesign({ direction: value }, `direction ${value}`),
      ),
    ),
    designField("temperature", {
      label: figure("channel.temperature").label,
      symbol: "T",
      quantity: "temperature",
      bounds: () => [253.15, 353.15],
      changed: () => design.value.temperature !== 293.15,
      reset: () => editDesign({ temperature: 293.15 }, "reset temperature"),
    }),
    designField("dead_volume", {
      label: "Dead volume",
      symbol: "V",
      quantity: "volume",
      bounds: () => [0, 2e-4],
      hint: "Air volume of tube and fittings. It makes the muscle softer when the valve is closed.",
    }),
    designField("fixed_length", {
      label: "Fixed length",
      symbol: "L",
      quantity: "length",
      empty: "off",
      clear: () => editDesign({ fixed_length: null }, "no fixed length"),
      bounds: () => {
        const all = curves.value?.length ?? [0.1, 0.3];
        return [Math.min(...all), Math.max(...all)];
      },
      hint: "Both ends fixed, for force over pressure. Leave empty to switch off.",
    }),
    h(
      "label",
      { class: "check" },
      h("input", {
        type: "checkbox",
        checked: () => !design.value.clipped,
        onchange: (/** @type {Event} */ e) =>
          editDesign({ clipped: !(/** @type {HTMLInputElement} */ (e.target).checked) }, "negative forces"),
      }),
      "Show negative forces (a real muscle goes slack)",
    ),
  );

/** What is asked about, in the row of fields. */
export const askedFields = () => [
  designField("load", {
    label: "Load",
    quantity: "force",
    slider: false,
    weighs: true,
    // A mass stays a mass, with its weight beside it.
    scale: () => isMass() ? massScale() : scaleOf("force", units.value),
    also: () => isMass() ? ` = ${withUnit(design.value.load, "force", units.value)}` : "",
    put: (si, done, typed) => {
      const as = typed === "mass" || typed === "force" ? typed : design.peek().load_as;
      preview(patchDesign({ load: si, load_as: as }));
      if (done) commit("load", loadOf);
    },
    bounds: () => [0, preset.value?.limits?.max_force ? siOf(preset.value.limits.max_force) : 1000],
  }),
  designField("pressure", {
    label: "Pressure",
    quantity: "pressure",
    slider: false,
    counted: () => GAUGE,
    get: () => pressureNow.value,
    bounds: () => [0, preset.value?.limits?.max_pressure ? siOf(preset.value.limits.max_pressure) : 1e6],
  }),
];

const isMass = () => design.value.load_as === "mass";
const massScale = () => {
  const s = scaleOf("mass", units.value);
  return { ...s, factor: s.factor * GRAVITY };
};
