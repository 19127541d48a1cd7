// @ts-check
// A field for a quantity: typed with a unit, stepped with arrow keys, moved with a slider, reset.
import { computed, effect, signal } from "../reactive.js";
import { h, icon } from "../dom.js";
import { niceStep, number, parse, toShown, toSi } from "../format.js";

/** @typedef {import("../format.js").Scale} Scale */
/** @typedef {{
 *   key: string, label: string, symbol?: import("../dom.js").Child,
 *   quantity: import("../format.js").Quantity | null,
 *   scale: () => Scale, get: () => number | null, put: (si: number, done: boolean, typed?: string) => void,
 *   bounds?: () => [number, number], strict?: boolean, log?: boolean, slider?: boolean,
 *   changed?: () => boolean, reset?: () => void, message?: () => string | null, hint?: string,
 *   clear?: () => void, empty?: string, reads?: (text: string) => {value: number} | null, weighs?: boolean, also?: () => string,
 *   counted?: () => import("../quantities.js").Counted}} FieldOptions  `bounds` in SI: the range of the slider,
 *   and with `strict` of accepted values; `clear` allows an empty field, which then shows `empty`; `counted`: what a
 *   typed pressure may be counted from; `reads`: what else
 *   may be typed; `weighs`: a mass is read as its weight; `also`: what stands behind the unit */

/** A symbol with its subscript: "p_s". @param {string} symbol */
export const subscript = (symbol) => {
  const [letter, below] = symbol.split("_");
  return below ? h("span", null, letter, h("sub", null, below)) : symbol;
};

let count = 0;
const STEPS = 200;

/** @param {number} x @param {number} digits */
const significant = (x, digits) => Number(x.toPrecision(digits));

/** The slider's positions 0…n as SI values, in steps that are round in the shown unit.
 * @param {[number, number]} bounds @param {Scale} scale @param {boolean} log */
function track([low, high], scale, log) {
  const lo = toShown(low, scale), hi = toShown(high, scale);
  const clamp = (/** @type {number} */ si) => Math.min(high, Math.max(low, si));
  if (log) {
    const ratio = Math.log(hi / lo) / STEPS;
    return {
      n: STEPS,
      at: (/** @type {number} */ si) => Math.log(Math.max(toShown(si, scale), lo) / lo) / ratio,
      value: (/** @type {number} */ i) => clamp(toSi(significant(lo * Math.exp(i * ratio), 3), scale)),
    };
  }
  const grain = niceStep((hi - lo) / STEPS);
  return {
    n: Math.round((hi - lo) / grain),
    at: (/** @type {number} */ si) => (toShown(si, scale) - lo) / grain,
    value: (/** @type {number} */ i) => clamp(toSi(significant(lo + i * grain, 10), scale)),
  };
}

/** @param {FieldOptions} o */
export function quantityField(o) {
  const id = `f${++count}-${o.key.replace(/\W/g, "-")}`;
  const typed = signal(/** @type {string | null} */ (null));
  const message = computed(() => typed.value ?? o.message?.() ?? null);
  const rail = computed(() => o.bounds ? track(o.bounds(), o.scale(), Boolean(o.log)) : null);
  const shown = () => {
    const si = o.get();
    return si == null ? "" : number(toShown(si, o.scale()), o.scale().digits);
  };

  /** @param {string} text @returns {ReturnType<typeof parse>} */
  const read = (text) => {
    const got = o.reads?.(text) ??
      parse(text, o.scale(), o.quantity, shown(), { ...o.counted?.(), weighs: o.weighs });
    if ("error" in got || !o.strict || !o.bounds) return got;
    const [low, high] = o.bounds(), slack = 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    if (got.value >= low - slack && got.value <= high + slack) return got;
    const asText = (/** @type {number} */ si) => number(toShown(si, o.scale()), 6);
    const wanted = `${asText(low)} to ${asText(high)} ${o.scale().unit}`.trim();
    return { error: `${o.label} must be ${wanted}.` };
  };
  const take = () => {
    if (input.value.trim() === "" && o.clear) {
      typed.value = null;
      return o.clear();
    }
    if (input.value === shown()) return void (typed.value = null);
    const got = read(input.value);
    typed.value = "error" in got ? got.error : null;
    if ("value" in got) {
      o.put(got.value, true, got.kind);
      input.value = shown();
    }
  };
  /** @param {number} by */
  const step = (by) => {
    const si = o.get() ?? o.bounds?.()[0] ?? 0;
    const r = rail.value;
    typed.value = null;
    if (!r) return;
    const next = Math.round(r.at(si)) + by;
    o.put(r.value(Math.min(r.n, Math.max(0, next))), true);
    input.value = shown();
  };

  const input = h("input", {
    id,
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: o.empty,
    "aria-invalid": () => message.value ? "true" : null,
    "aria-describedby": () => message.value ? `${id}-m` : null,
    title: "A number, with or without a unit, or an expression: 20*9.81",
    onchange: take,
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      if (e.key === "Escape") {
        typed.value = null;
        input.value = shown();
      }
      if (e.key === "Enter") take();
      const by = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[e.key];
      if (!by) return;
      e.preventDefault();
      step(by * (e.shiftKey ? 10 : 1));
    },
  });
  let last = "";
  effect(() => {
    const text = shown();
    if (text === last) return;
    last = text;
    if (document.activeElement === input && typed.peek() !== null) return;
    input.value = text;
    typed.value = null;
  });

  const changed = () => Boolean(o.changed?.());
  return h(
    "div",
    {
      class: () => `field${changed() ? " changed" : ""}${message.value ? " wrong" : ""}`,
      "data-field": o.key,
    },
    h(
      "div",
      { class: "field-head" },
      h(
        "label",
        { for: id },
        o.label,
        o.symbol ? h("span", { class: "symbol", "aria-hidden": "true" }, o.symbol) : null,
      ),
      () =>
        changed() && o.reset
          ? h("button", {
            type: "button",
            class: "mini",
            title: "Back to the preset’s value",
            "aria-label": `Reset ${o.label}`,
            onclick: o.reset,
          }, icon("reset"))
          : null,
      h(
        "span",
        { class: "entry" },
        input,
        h("span", { class: "unit" }, () => `${o.scale().unit}${o.also?.() ?? ""}`),
      ),
    ),
    o.slider === false ? null : slider(o, rail, step),
    o.hint ? h("p", { class: "hint" }, o.hint) : null,
    () => message.value ? h("p", { class: "error", id: `${id}-m` }, message.value) : null,
  );
}

/** @param {FieldOptions} o @param {import("../reactive.js").Signal<ReturnType<typeof track> | null>} rail
 * @param {(by: number) => void} step */
function slider(o, rail, step) {
  const place = (/** @type {number} */ i) => rail.peek()?.value(i) ?? 0;
  const range = h("input", {
    type: "range",
    tabindex: -1, // the keys of the number beside it do the same
    min: 0,
    step: "any",
    "aria-label": `${o.label} slider`,
    oninput: () => o.put(place(Math.round(Number(range.value))), false),
    onchange: () => o.put(place(Math.round(Number(range.value))), true),
    ondblclick: () => o.reset?.(),
    onkeydown: (/** @type {KeyboardEvent} */ e) => {
      /** @type {Record<string, number>} */
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 10, PageDown: -10 };
      if (!by[e.key]) return;
      e.preventDefault();
      step(by[e.key] * (e.shiftKey ? 10 : 1));
    },
  });
  effect(() => {
    const r = rail.value, si = o.get(), s = o.scale();
    if (!r) return;
    const at = si == null ? 0 : Math.min(r.n, Math.max(0, r.at(si)));
    range.max = String(r.n);
    range.value = String(at);
    range.style.setProperty("--at", `${(100 * at) / r.n}%`);
    range.setAttribute(
      "aria-valuetext",
      si == null ? "not set" : `${number(toShown(si, s), s.digits)} ${s.unit}`,
    );
  });
  /** @param {-1 | 1} by */
  const button = (by) =>
    h("button", {
      type: "button",
      class: "mini",
      tabindex: -1,
      "aria-label": `${o.label} ${by < 0 ? "less" : "more"}`,
      onclick: () => step(by),
    }, icon(by < 0 ? "minus" : "plus"));
  return h("div", { class: "slide" }, button(-1), range, button(1));
}
