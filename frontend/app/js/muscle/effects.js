// @ts-check
// The effects of a model in one sentence: a chip for each that is on, with its values; all others are a search away.
import { each, h, icon, mathml } from "../dom.js";
import { computed } from "../reactive.js";
import { commit, preview, units, view } from "../state.js";
import { design, editDesign, patchDesign } from "./document.js";
import { effects, effectsById } from "../store.js";
import { capitalized, number, plainScale, quantityOf, readable, scaleOf, toShown } from "../format.js";
import { quantityField } from "../ui/field.js";
import { openPopover } from "../ui/dialog.js";
import { openPalette } from "../ui/palette.js";

/** @typedef {import("../types.js").Effect} Effect */
/** @typedef {import("../types.js").Parameter} Parameter */
/** @typedef {Record<string, Record<string, number>>} Chosen */
/** The effects of one view. `preset`: those that come with muscle, valve and tube; `active`: those that are on;
 * `defaults`: values that depend on the size of the muscle, as the server answered them; `idle`: why an effect changes
 * nothing that the view shows.
 * @typedef {{preset: Signal<Chosen>, active: Signal<Chosen>, defaults: () => Chosen | undefined,
 *   message: (key: string) => string | null, idle?: (e: Effect) => string | null}} Panel */
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

/** @param {Parameter} p @param {number} si */
function valueText(p, si) {
  const quantity = quantityOf(p.unit, p.name);
  const s = quantity ? scaleOf(quantity, units.value) : plainScale(p.unit);
  return `${number(toShown(si, s), s.digits)} ${s.unit}`.trimEnd();
}

/** The rows of effects, by view. @type {Map<string, Panel>} */
const panels = new Map();

/** What the search adds in this view: the effects that are not on. @returns {import("../ui/palette.js").Command[]} */
export function effectsToAdd() {
  const panel = panels.get(view.peek());
  return panel
    ? effects.peek().filter((e) => !(e.id in panel.active.peek())).map((e) => ({
      label: e.title,
      kind: `add effect · ${e.family}`,
      also: e.cause,
      run: () => turn(panel, e, true),
    }))
    : [];
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
function details(c, e) {
  const idle = c.idle?.(e);
  return [
    h("div", { class: "card-head" }, h("h3", null, e.title), aboutButton(e)),
    h("p", { class: "muted" }, e.cause),
    idle ? h("p", { class: "hint" }, idle) : null,
    ...e.parameters.map((p) => parameterField(c, e, p)),
  ];
}

/** An effect that is on: its name and first value open what is set, the cross switches it off.
 * @param {Panel} c @param {Effect} e */
function chip(c, e) {
  const wrong = () =>
    c.message(e.id) ?? e.parameters.map((p) => c.message(`${e.id}.${p.name}`)).find(Boolean) ?? null;
  const first = e.parameters[0], name = e.title.replace(/ \(.*\)$/, "");
  const value = () => first ? ` ${valueText(first, valueOf(c, e, first))}` : "";
  const open = h(
    "button",
    {
      type: "button",
      class: "link",
      title: () => wrong() ?? `${e.cause} ${c.idle?.(e) ?? ""}`.trim(),
      "aria-expanded": "false",
      onclick: () => openPopover(open, e.title, () => details(c, e), { kind: "effect-values" }),
    },
    h("span", null, name),
    h("small", null, value),
  );
  return h(
    "li",
    {
      class: () => `chip effect on${wrong() ? " over" : ""}${c.idle?.(e) ? " idle" : ""}`,
      "data-effect": e.id,
    },
    open,
    h(
      "button",
      { type: "button", "aria-label": `Remove ${e.title}`, onclick: () => turn(c, e, false) },
      icon("close"),
    ),
  );
}

/** Whether the effect changes static curves. @param {Effect} e */
export const isStatic = (e) => e.kinds.some((kind) => kind === "static" || kind === "diameter");

/** @param {string} of view @param {Panel} c */
export function effectsRow(of, c) {
  panels.set(of, c);
  const hasPreset = () => Object.keys(c.preset.value).length > 0;
  const on = computed(() =>
    Object.keys(c.active.value).map((id) => effectsById.value.get(id)).filter((e) => e !== undefined)
  );
  return h(
    "section",
    { class: "card effects-row", "aria-label": "Effects" },
    h("h2", null, () => on.value.length ? "The model holds" : "The model is the ideal braid"),
    each(
      "ul",
      { class: "chips", "aria-label": "Effects that are on" },
      () => on.value,
      ({ id }) => id,
      (e) => chip(c, e),
    ),
    h(
      "button",
      {
        type: "button",
        class: "add-effect",
        title: "Add an effect, by its name or its cause",
        disabled: () => !effects.value.length,
        onclick: () => openPalette(effectsToAdd(), "Add an effect"),
      },
      icon("plus"),
      "Add ",
      h("kbd", null, "Ctrl K"),
    ),
    h("button", {
      type: "button",
      class: "link",
      title: "Switch all effects off: the ideal braid",
      disabled: () => !on.value.length,
      onclick: () => choose({}, "ideal model"),
    }, "Ideal"),
    h("button", {
      type: "button",
      class: "link",
      title: "The effects that come with the preset",
      hidden: () => !hasPreset() || design.value.effects === null,
      onclick: () => editDesign({ effects: null }, "the preset’s effects"),
    }, "Preset’s effects"),
    () => {
      const said = on.value.flatMap((e) => c.message(e.id) ?? []);
      return said.length ? h("p", { class: "error" }, said.join(" ")) : null;
    },
  );
}
