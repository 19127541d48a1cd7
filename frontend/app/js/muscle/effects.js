// @ts-check
// The effects card: every effect of the server's catalogue by family, each with a switch and its parameters.
import { h, icon, mathml } from "../dom.js";
import { computed, signal } from "../reactive.js";
import { commit, preview, units } from "../state.js";
import { design, editDesign, patchDesign } from "./document.js";
import { effects } from "../store.js";
import { capitalized, number, plainScale, quantityOf, readable, scaleOf, toShown } from "../format.js";
import { quantityField } from "../ui/field.js";
import { openPopover } from "../ui/dialog.js";

/** @typedef {import("../types.js").Effect} Effect */
/** @typedef {import("../types.js").Parameter} Parameter */
/** @typedef {Record<string, Record<string, number>>} Chosen */
/** The card of one view. `preset`: the effects that come with muscle, valve and tube; `active`: those that are on;
 * `search`: what is typed into the search field; `count`: how many are on; `families`: the effects by heading;
 * `defaults`: those that depend on the size of the muscle, as the server answered them.
 * @typedef {{preset: Signal<Chosen>, active: Signal<Chosen>, search: Signal<string>, count: () => number,
 *   defaults: () => Chosen | undefined,
 *   message: (key: string) => string | null, families: (all: Effect[]) => Map<string, Effect[]>,
 *   hints?: Record<string, string>}} Panel */
/** @template T @typedef {import("../reactive.js").Signal<T>} Signal */

/** The value of the preset, else the default of the effect for this muscle.
 * @param {Panel} c @param {Effect} e @param {Parameter} p */
const usual = (c, e, p) => c.preset.value[e.id]?.[p.name] ?? c.defaults()?.[e.id]?.[p.name] ?? p.default;
/** @param {Panel} c @param {Effect} e @param {Parameter} p */
const valueOf = (c, e, p) => c.active.value[e.id]?.[p.name] ?? usual(c, e, p);

/** @param {Chosen} next @param {string} label */
const choose = (next, label) => editDesign({ effects: next }, label);

/** @param {Panel} c @param {Effect} e @param {boolean} on */
function turn(c, e, on) {
  const next = { ...c.active.peek() };
  if (on) next[e.id] = { ...c.preset.peek()[e.id] };
  else delete next[e.id];
  choose(next, `${e.title} ${on ? "on" : "off"}`);
}

/** @param {Panel} c @param {Effect} e @param {Parameter} p */
function parameterField(c, e, p) {
  const quantity = quantityOf(p.unit, p.name);
  /** @param {number | null} si */
  const set = (si) => {
    const values = { ...c.active.peek()[e.id] };
    if (si === null) delete values[p.name];
    else values[p.name] = si;
    if (si === null && c.preset.peek()[e.id]?.[p.name] !== undefined) values[p.name] = usual(c, e, p);
    return { effects: { ...c.active.peek(), [e.id]: values } };
  };
  return quantityField({
    key: `${e.id}.${p.name}`,
    label: capitalized(readable(p.name)),
    symbol: mathml(p.symbol_mathml),
    quantity,
    strict: !p.grows, // the server knows the bounds of this muscle
    scale: () => quantity ? scaleOf(quantity, units.value) : plainScale(p.unit),
    bounds: () => [p.lower, p.upper],
    get: () => valueOf(c, e, p),
    put: (si, done) => {
      preview(patchDesign(set(si)));
      if (done) commit(`${e.title}: ${readable(p.name)}`);
    },
    changed: () =>
      Math.abs(valueOf(c, e, p) - usual(c, e, p)) > 1e-9 * Math.max(Math.abs(p.lower), Math.abs(p.upper)),
    reset: () => editDesign(set(null), `reset ${readable(p.name)}`),
    message: () => c.message(`${e.id}.${p.name}`),
  });
}

/** The first parameters in one line, for an effect that is collapsed. @param {Panel} c @param {Effect} e */
function summary(c, e) {
  return e.parameters.slice(0, 3).flatMap((p, i) => {
    const quantity = quantityOf(p.unit, p.name);
    const s = quantity ? scaleOf(quantity, units.value) : plainScale(p.unit);
    const value = ` = ${number(toShown(valueOf(c, e, p), s), s.digits)} ${s.unit}`.trimEnd();
    return [i ? ", " : "", h("span", { class: "pair" }, mathml(p.symbol_mathml), value)];
  });
}

/** A button that opens the description of an effect. @param {Effect} e */
export function aboutButton(e) {
  const button = h("button", {
    type: "button",
    class: "mini",
    "aria-label": `About ${e.title}`,
    "aria-expanded": "false",
    onclick: async () => {
      const { effectNote } = await import("./effect-note.js");
      openPopover(button, e.title, () => effectNote(e), { kind: "about" });
    },
  }, icon("info"));
  return button;
}

/** @param {Panel} c @param {Effect} e */
function row(c, e) {
  const on = computed(() => e.id in c.active.value);
  const open = signal(false);
  const matches = () => {
    const words = c.search.value.trim().toLowerCase();
    return !words || [e.title, e.family, e.cause, e.id].some((text) => text.toLowerCase().includes(words));
  };
  const body = () => {
    if (!on.value || !e.parameters.length) return null;
    if (open.value) {
      return h(
        "div",
        { class: "parameters" },
        ...e.parameters.map((p) => parameterField(c, e, p)),
      );
    }
    return h("button", {
      type: "button",
      class: "summary",
      title: "Change the parameters",
      onclick: () => (open.value = true),
    }, () => summary(c, e));
  };
  return h(
    "li",
    { class: () => `effect${on.value ? " on" : ""}`, hidden: () => !matches(), "data-effect": e.id },
    h(
      "div",
      { class: "effect-head" },
      h(
        "label",
        { class: "switch" },
        h("input", {
          type: "checkbox",
          role: "switch",
          checked: () => on.value,
          onchange: (/** @type {Event} */ event) => {
            const want = /** @type {HTMLInputElement} */ (event.target).checked;
            open.value = want;
            turn(c, e, want);
          },
        }),
        h("span", null, e.title),
      ),
      () =>
        on.value && e.parameters.length
          ? h("button", {
            type: "button",
            class: `mini fold${open.value ? " up" : ""}`,
            "aria-label": `Parameters of ${e.title}`,
            "aria-expanded": String(open.value),
            onclick: () => (open.value = !open.peek()),
          }, icon("down"))
          : null,
      aboutButton(e),
    ),
    body,
    () => {
      const text = c.message(e.id);
      return text && !e.parameters.some((p) => c.message(`${e.id}.${p.name}`))
        ? h("p", { class: "error" }, text)
        : null;
    },
  );
}

/** A family is open while one of its effects is on, unless the user opens or closes it.
 * @param {Panel} c @param {string} family @param {Effect[]} list */
function group(c, family, list) {
  const count = computed(() => list.filter((e) => e.id in c.active.value).length);
  const folded = signal(/** @type {boolean | null} */ (null));
  const open = () => c.search.value.trim() !== "" || !(folded.value ?? count.value === 0);
  const box = h(
    "details",
    { class: "family", open, onchange: () => (folded.value = false) },
    h(
      "summary",
      {
        onclick: (/** @type {Event} */ event) => {
          event.preventDefault();
          folded.value = box.open;
        },
      },
      h("span", null, family),
      h("small", null, () => `${count.value} of ${list.length}`),
    ),
    c.hints?.[family] ? h("p", { class: "hint" }, c.hints[family]) : null,
    h("ul", null, ...list.map((e) => row(c, e))),
  );
  return box;
}

/** Whether the effect changes static curves. @param {Effect} e */
export const isStatic = (e) => e.kinds.some((kind) => kind === "static" || kind === "diameter");

/** @param {Omit<Panel, "search">} panel */
export function effectsCard(panel) {
  /** @type {Panel} */
  const c = { ...panel, search: signal("") };
  const hasPreset = () => Object.keys(c.preset.value).length > 0;
  return h(
    "section",
    { class: "card", "aria-label": "Effects" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Effects"),
      h("span", { class: "muted whole" }, () => {
        const n = c.count();
        return n ? `${n} on` : "";
      }),
      h(
        "span",
        { class: "group" },
        h("button", {
          type: "button",
          title: "Switch all effects off: the ideal braid",
          "aria-pressed": () => String(Object.keys(c.active.value).length === 0),
          onclick: () => choose({}, "ideal model"),
        }, "Ideal"),
        h("button", {
          type: "button",
          title: "The effects that come with the preset",
          disabled: () => !hasPreset(),
          "aria-pressed": () => String(design.value.effects === null && hasPreset()),
          onclick: () => editDesign({ effects: null }, "the preset’s effects"),
        }, "Preset’s effects"),
      ),
    ),
    h(
      "label",
      { class: "search" },
      icon("search"),
      h("input", {
        type: "search",
        placeholder: "Search effects  ( / )",
        "aria-label": "Search effects",
        oninput: (
          /** @type {Event} */ e,
        ) => (c.search.value = /** @type {HTMLInputElement} */ (e.target).value),
      }),
    ),
    () =>
      effects.value.length
        ? [...c.families(effects.value)].map(([family, list]) => group(c, family, list))
        : h("p", { class: "muted" }, "Loading the catalogue of effects…"),
  );
}
