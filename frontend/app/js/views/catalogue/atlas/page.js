// @ts-check
// The atlas: every effect with what it leaves in the residual; one of them in full, with sliders and its twins.
import { each, h, icon } from "../../../dom.js";
import { effect, signal } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { capitalized, plainScale, quantityOf, readable, scaleOf } from "../../../format.js";
import { quantityField } from "../../../ui/field.js";
import { openDesign } from "../../../muscle/document.js";
import { effectNote } from "../../../muscle/effect-note.js";
import { activeEffects, preset } from "../../../muscle/preset.js";
import { seen } from "../../../muscle/seen.js";
import { filter, setFilter } from "../table.js";
import { answer, chosen, fault, followChosen, outdated, shown, sizes, usual } from "./answers.js";
import { picture } from "./picture.js";

/** @typedef {import("./answers.js").Effect} Effect */

/** Effects whose card has come into view. */
const near = signal(/** @type {ReadonlySet<string>} */ (new Set()));

/** @param {Effect} e */
function likeness(e) {
  const share = seen.value?.likeness[e.id];
  return share === undefined
    ? null
    : h("span", { class: "likely" }, `explains ${Math.round(100 * share)}\u00a0%`);
}

/** The picture that is closest to the case, else the first. @param {Effect} e */
function smallPicture(e) {
  const found = near.value.has(e.id) ? usual(e.id)?.pictures : null;
  const one = found?.find((p) => p.kind === seen.value?.kind) ?? found?.[0];
  return one ? picture(one, e.title) : h("i", { class: "bone signature-place", "aria-hidden": "true" });
}

/** @param {Effect} e @param {IntersectionObserver} watch */
function card(e, watch) {
  return h(
    "li",
    {
      class: () => chosen.value?.id === e.id ? "chosen" : null,
      "data-effect-card": e.id,
      ref: (/** @type {HTMLElement} */ el) => watch.observe(el),
    },
    h(
      "button",
      {
        type: "button",
        class: "atlas-title",
        "aria-pressed": () => String(chosen.value?.id === e.id),
        onclick: () => {
          setFilter({ selected: e.id });
          const full = document.querySelector(".atlas-detail");
          const box = full?.getBoundingClientRect();
          if (box && (box.bottom < 0 || box.top < 0)) full?.scrollIntoView({ block: "start" });
        },
      },
      e.title,
    ),
    () => likeness(e),
    () => smallPicture(e),
  );
}

function gallery() {
  const watch = new IntersectionObserver((entries) => {
    const fresh = entries.filter((one) => one.isIntersecting)
      .map((one) => /** @type {HTMLElement} */ (one.target).dataset.effectCard ?? "");
    if (fresh.length) near.value = new Set([...near.peek(), ...fresh]);
  }, { rootMargin: "200px" });
  return h(
    "section",
    { class: "card atlas", "aria-label": "Effects" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Effects"),
      h(
        "span",
        { class: "muted" },
        () =>
          seen.value
            ? "sorted by similarity to the residual of the case (dots)"
            : `what each leaves in the residual of ${preset.value?.title ?? "this muscle"}`,
      ),
    ),
    each("ul", { class: "atlas-grid" }, () => shown.value, ({ id }) => id, (e) => card(e, watch)),
    h(
      "p",
      { class: "muted", role: "status" },
      () => shown.value.length ? "" : "No effect matches the filter.",
    ),
  );
}

/** @param {Effect} e @param {Effect["parameters"][number]} p */
function slider(e, p) {
  const quantity = quantityOf(p.unit, p.name), size = () => sizes.value[e.id]?.[p.name];
  /** @param {number | undefined} si */
  const put = (si) => {
    const { [p.name]: _, ...rest } = sizes.peek()[e.id] ?? {};
    sizes.value = { ...sizes.peek(), [e.id]: si === undefined ? rest : { ...rest, [p.name]: si } };
  };
  return quantityField({
    key: `atlas.${e.id}.${p.name}`,
    label: capitalized(readable(p.name)),
    quantity,
    strict: true,
    scale: () => quantity ? scaleOf(quantity, units.value) : plainScale(p.unit),
    bounds: () => [p.lower, p.upper],
    get: () => size() ?? p.default,
    put,
    changed: () => size() !== undefined,
    reset: () => put(undefined),
  });
}

/** Two effects that look alike, and the test that parts them. @param {Effect} e @param {Effect["confused_with"][number]} twin */
function pair(e, twin) {
  const other = effectsById.value.get(twin.effect);
  if (!other) return null;
  const mine = usual(e.id)?.pictures ?? [], theirs = usual(other.id)?.pictures ?? [];
  // A test in which both change the same reading, else one in which both change any.
  const shared = (/** @type {boolean} */ same) =>
    mine.find((p) => theirs.some((q) => q.kind === p.kind && (!same || q.quantity === p.quantity)))?.kind;
  const kind = shared(true) ?? shared(false);
  const of = (/** @type {typeof mine} */ list) => list.find((p) => p.kind === kind);
  const a = of(mine), b = of(theirs), named = a?.quantity !== b?.quantity;
  return h(
    "li",
    { class: "twin-pair" },
    h(
      "div",
      null,
      h("div", null, h("b", null, e.title), a ? picture(a, e.title, named) : null),
      h(
        "div",
        null,
        h(
          "button",
          { type: "button", class: "link", onclick: () => setFilter({ selected: other.id }) },
          other.title,
        ),
        b ? picture(b, other.title, named) : null,
      ),
    ),
    h("p", null, icon("flask"), h("span", null, capitalized(twin.separated_by))),
  );
}

/** @param {Effect} e */
function detail(e) {
  const [free, fixed] = [true, false].map((fitted) => e.parameters.filter((p) => p.fitted === fitted));
  return [
    h(
      "div",
      { class: "card-head" },
      h("h2", null, e.title),
      h(
        "button",
        {
          type: "button",
          class: "primary",
          onclick: () =>
            openDesign(
              { effects: { ...activeEffects.peek(), [e.id]: { ...sizes.peek()[e.id] } } },
              `${e.title} on`,
            ),
        },
        "Put it into my model",
      ),
    ),
    h("p", null, `${capitalized(e.signature.text)}.`),
    () => fault.value ? h("p", { class: "error", role: "alert" }, fault.value.words) : null,
    h(
      "div",
      { class: () => `pictures${outdated.value ? " stale" : ""}` },
      () =>
        answer.value?.effect === e.id
          ? answer.value.pictures.map((p) => picture(p, e.title, false, true))
          : null,
    ),
    () => {
      const hidden = answer.value?.effect === e.id ? answer.value.hidden : [];
      return hidden.length
        ? h(
          "p",
          { class: "muted" },
          `Also shows in ${hidden.join(", ")} tests, which are not simulated here.`,
        )
        : null;
    },
    ...free.map((p) => slider(e, p)),
    fixed.length
      ? h("details", null, h("summary", null, "Further values"), ...fixed.map((p) => slider(e, p)))
      : null,
    e.confused_with.length ? h("h3", null, "Twins, and the test that separates them") : null,
    h("ul", { class: "plain" }, () => e.confused_with.map((twin) => pair(e, twin))),
    h(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Cause, equation, sources" },
      effectNote(e, true),
    ),
  ];
}

/** @returns {HTMLElement[]} the gallery and the effect in full */
export function atlas() {
  const isShown = () => view.value === "catalogue" && filter.value.kind === "effects";
  followChosen(isShown);
  const box = h("section", { class: "card atlas-detail", "aria-label": "Effect" });
  effect(() => {
    const e = chosen.value;
    if (isShown()) box.replaceChildren(...(e ? within(detail(e)) : []));
  });
  return [gallery(), box];
}

/** @param {import("../../../dom.js").Child[]} kids */
const within = (kids) => [h("div", null, ...kids)];
