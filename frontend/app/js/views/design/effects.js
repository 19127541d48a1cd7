// @ts-check
// The effects card: everything the server's catalogue holds, by family, each with a switch and its parameters.
import { h, icon, mathml } from "../../dom.js";
import { computed, signal } from "../../reactive.js";
import { commit, design, editDesign, patchDesign, preview, units } from "../../state.js";
import { effects } from "../../store.js";
import { number, plainScale, quantityOf, scaleOf, toShown } from "../../format.js";
import { quantityField } from "../../ui/field.js";
import { openPopover } from "../../ui/dialog.js";
import { effectNote } from "./effect-note.js";
import { activeEffects, curves, messageFor, preset, presetEffects } from "./model.js";

/** @typedef {import("../../types.js").Effect} Effect */
/** @typedef {import("../../types.js").Parameter} Parameter */
/** @typedef {Record<string, Record<string, number>>} Chosen */

const wanted = signal("");
const chosen = computed(activeEffects);

/** @param {Effect} e @param {Parameter} p what the preset gives, else the effect's default */
const usual = (e, p) => presetEffects.value[e.id]?.[p.name] ?? p.default;
/** @param {Effect} e @param {Parameter} p */
const valueOf = (e, p) => chosen.value[e.id]?.[p.name] ?? usual(e, p);

/** @param {Chosen} next @param {string} label */
const choose = (next, label) => editDesign({ effects: next }, label);

/** @param {Effect} e @param {boolean} on */
function turn(e, on) {
  const next = { ...chosen.peek() };
  if (on) next[e.id] = { ...presetEffects.peek()[e.id] };
  else delete next[e.id];
  choose(next, `${e.title} ${on ? "on" : "off"}`);
}

/** @param {Effect} e @param {Parameter} p */
function parameterField(e, p) {
  const quantity = quantityOf(p.unit, p.name);
  /** @param {number | null} si */
  const set = (si) => {
    const own = { ...chosen.peek()[e.id] };
    if (si === null) delete own[p.name];
    else own[p.name] = si;
    if (si === null && presetEffects.peek()[e.id]?.[p.name] !== undefined) own[p.name] = usual(e, p);
    return { effects: { ...chosen.peek(), [e.id]: own } };
  };
  return quantityField({
    key: `${e.id}.${p.name}`,
    label: p.name.replaceAll("_", " ").replace(/^./, (c) => c.toUpperCase()),
    symbol: mathml(p.symbol_mathml),
    quantity,
    strict: true,
    scale: () => quantity ? scaleOf(quantity, units.value) : plainScale(p.unit),
    bounds: () => [p.lower, p.upper],
    get: () => valueOf(e, p),
    put: (si, done) => {
      preview(patchDesign(set(si)));
      if (done) commit(`${e.title}: ${p.name.replaceAll("_", " ")}`);
    },
    changed: () =>
      Math.abs(valueOf(e, p) - usual(e, p)) > 1e-9 * Math.max(Math.abs(p.lower), Math.abs(p.upper)),
    reset: () => editDesign(set(null), `reset ${p.name.replaceAll("_", " ")}`),
    message: () => messageFor(`${e.id}.${p.name}`),
  });
}

/** The parameters in one line, for an effect that is folded. @param {Effect} e */
function summary(e) {
  return e.parameters.slice(0, 3).map((p, i) => {
    const quantity = quantityOf(p.unit, p.name);
    const s = quantity ? scaleOf(quantity, units.value) : plainScale(p.unit);
    return h(
      "span",
      { class: "pair" },
      i ? ", " : "",
      mathml(p.symbol_mathml),
      ` = ${number(toShown(valueOf(e, p), s), s.digits)} ${s.unit}`,
    );
  });
}

/** @param {Effect} e */
function row(e) {
  const on = computed(() => e.id in chosen.value);
  const open = signal(false);
  const info = h("button", {
    type: "button",
    class: "mini",
    "aria-label": `About ${e.title}`,
    "aria-expanded": "false",
    onclick: () => openPopover(info, e.title, () => effectNote(e), { kind: "about" }),
  }, icon("info"));
  const matches = () => {
    const words = wanted.value.trim().toLowerCase();
    return !words || [e.title, e.family, e.cause, e.id].some((text) => text.toLowerCase().includes(words));
  };
  const body = () => {
    if (!on.value || !e.parameters.length) return null;
    if (open.value) {
      return h(
        "div",
        { class: "parameters" },
        ...e.parameters.map((p) => parameterField(e, p)),
      );
    }
    return h("button", {
      type: "button",
      class: "summary",
      title: "Change the parameters",
      onclick: () => (open.value = true),
    }, () => summary(e));
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
            turn(e, want);
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
      info,
    ),
    body,
    () => {
      const text = messageFor(e.id);
      return text && !e.parameters.some((p) => messageFor(`${e.id}.${p.name}`))
        ? h("p", { class: "error" }, text)
        : null;
    },
  );
}

/** A family is open while one of its effects is on, until the user folds or unfolds it.
 * @param {string} family @param {Effect[]} list */
function group(family, list) {
  const count = computed(() => list.filter((e) => e.id in chosen.value).length);
  const folded = signal(/** @type {boolean | null} */ (null));
  const open = () => wanted.value.trim() !== "" || !(folded.value ?? count.value === 0);
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
    h("ul", null, ...list.map(row)),
  );
  return box;
}

/** @param {Effect[]} all */
function byFamily(all) {
  /** @type {Map<string, Effect[]>} */
  const families = new Map();
  for (const e of all) families.set(e.family, [...families.get(e.family) ?? [], e]);
  return [...families].map(([family, list]) => group(family, list));
}

export function effectsCard() {
  const own = () => preset.value && Object.keys(presetEffects.value).length > 0;
  return h(
    "section",
    { class: "card", "aria-label": "Effects" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Effects"),
      h("span", { class: "muted" }, () => {
        const n = Object.keys(curves.value?.model.effects ?? chosen.value).length;
        return n ? `${n} on` : "";
      }),
      h(
        "span",
        { class: "group" },
        h("button", {
          type: "button",
          title: "Switch all effects off: the ideal braid",
          "aria-pressed": () => String(Object.keys(chosen.value).length === 0),
          onclick: () => choose({}, "ideal model"),
        }, "Ideal"),
        h("button", {
          type: "button",
          title: "The effects that come with the preset",
          disabled: () => !own(),
          "aria-pressed": () => String(design.value.effects === null && Boolean(own())),
          onclick: () => editDesign({ effects: null }, "the preset’s own effects"),
        }, "Preset’s own"),
      ),
    ),
    h(
      "label",
      { class: "search" },
      icon("search"),
      h("input", {
        type: "search",
        id: "effect-search",
        placeholder: "Search effects  ( / )",
        "aria-label": "Search effects",
        oninput: (
          /** @type {Event} */ e,
        ) => (wanted.value = /** @type {HTMLInputElement} */ (e.target).value),
      }),
    ),
    () =>
      effects.value.length
        ? byFamily(effects.value)
        : h("p", { class: "muted" }, "Loading the catalogue of effects…"),
  );
}
