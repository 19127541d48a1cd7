// @ts-check
// The candidates: a card for each effect, the best first, with its reason and the effects it is indistinguishable from.
import { h, icon, mathml } from "../../../dom.js";
import { signal } from "../../../reactive.js";
import { units } from "../../../state.js";
import { effectsById } from "../../../store.js";
import { brief, capitalized, plainScale, quantityOf, readable, scaleOf, toShown } from "../../../format.js";
import { aboutButton } from "../../../muscle/effects.js";
import { equationBox } from "./equation.js";
import { add } from "../model/history.js";
import { answer, candidates, diagnosis, stage, stale } from "../answers.js";
import { errorText, figures, titleOf } from "../words.js";

/** @typedef {import("../types.js").Candidate} Candidate */
/** @typedef {import("../types.js").Fitted} Fitted */

const USEFUL = 1, SHOWN = 5;
const more = signal(false);

/** @param {number | null | undefined} si */
const asText = (si) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value);
};

/** "24.1 ± 0.3 N", with a mark at a bound.
 * @param {string} name @param {{value: number, stderr: number | null, unit: string, at_bound: boolean}} p */
function valueText(name, p) {
  const quantity = quantityOf(p.unit, name);
  const s = quantity ? scaleOf(quantity, units.value) : plainScale(p.unit);
  const error = p.stderr === null ? "" : ` ± ${figures(p.stderr / s.factor, 2)}`;
  return [
    `${figures(toShown(p.value, s), 4)}${error} ${s.unit}`.trim(),
    p.at_bound
      ? h(
        "span",
        { class: "at-bound", title: "The fit stopped at the end of the allowed range" },
        " at its bound",
      )
      : null,
  ];
}

/** @param {string} id @param {Record<string, Fitted>} parameters */
function parameterList(id, parameters) {
  const known = effectsById.value.get(id)?.parameters ?? [];
  const entries = Object.entries(parameters).filter(([, p]) => p.fitted);
  if (!entries.length) return null;
  return h(
    "ul",
    { class: "found-values" },
    ...entries.map(([name, p]) => {
      const symbol = known.find((one) => one.name === name)?.symbol_mathml;
      return h(
        "li",
        { title: readable(name) },
        symbol ? mathml(symbol) : readable(name),
        " = ",
        ...valueText(name, p),
      );
    }),
  );
}

const NAMED = 3;
/** @param {string[]} names */
const listed = (names) =>
  names.length > NAMED + 1
    ? `${names.slice(0, NAMED).join(", ")} and ${names.length - NAMED} others`
    : names.join(", ");

/** @param {Candidate} c @param {boolean} best @param {boolean} wanted the verdict names it missing */
function card(c, best, wanted) {
  const effect = effectsById.value.get(c.effect);
  const helps = c.gain_percent >= USEFUL;
  return h(
    "li",
    { class: `candidate${helps ? "" : " useless"}`, "data-candidate": c.effect },
    h(
      "div",
      { class: "candidate-head" },
      h("h3", null, c.title),
      effect ? aboutButton(effect) : null,
      h("button", {
        type: "button",
        class: best && wanted ? "primary" : "",
        "aria-label": `Add ${c.title}`,
        disabled: () => stale.value,
        onclick: () => add(c),
      }, "Add"),
    ),
    h(
      "p",
      { class: "gain" },
      h(
        "span",
        { class: "bar", "aria-hidden": "true" },
        h("i", { style: `width:${Math.max(0, c.gain_percent)}%` }),
      ),
      h("b", null, `−${brief(Math.max(0, c.gain_percent))} %`),
      ` to ${asText(c.rmse)}`,
      h("small", null, ` hold-out ${asText(c.holdout_rmse)}`),
    ),
    c.twins.length
      ? h(
        "p",
        { class: "twins", title: c.twins.map(titleOf).join(", ") },
        icon("info"),
        h("span", null, `Indistinguishable from ${listed(c.twins.map(titleOf))} with these data.`),
      )
      : null,
    h(
      "details",
      { open: best && wanted },
      h("summary", null, "Why, values, equation"),
      c.why ? h("p", { class: "why" }, c.why) : null,
      parameterList(c.effect, c.parameters),
      c.freed.length
        ? h(
          "p",
          { class: "muted" },
          `Fitted with it: ${c.freed.map((name) => readable(name.replace(".", ": "))).join(", ")}.`,
        )
        : null,
      equationBox(c.title, effect?.equation_mathml, c.equation),
      c.next_measurement
        ? h("p", { class: "next" }, h("b", null, "Measure next: "), c.next_measurement)
        : null,
    ),
  );
}

const skeletons = () => [1, 2].map(() => h("li", { class: "candidate skeleton block-tall" }));

/** Effects that were no candidates, by the reason. */
function notTried() {
  const left = diagnosis.value?.not_tried ?? [];
  if (stage.value !== "done" || !left.length) return null;
  /** @type {Map<string, string[]>} */
  const reasons = new Map();
  for (const { effect, why } of left) reasons.set(why, [...(reasons.get(why) ?? []), titleOf(effect)]);
  return h(
    "details",
    { class: "not-tried" },
    h(
      "summary",
      null,
      left.length === 1 ? "1 effect was not tried" : `${left.length} effects were not tried`,
    ),
    h(
      "ul",
      { class: "plain" },
      [...reasons].map(([why, names]) =>
        h("li", null, h("b", null, `${capitalized(why)}: `), names.join(", "))
      ),
    ),
  );
}

export function candidatesCard() {
  const list = () => {
    const all = candidates.value;
    if (!all.length && stage.value === "done") {
      return h("li", { class: "muted" }, "No other effect of the catalogue is visible in these data.");
    }
    if (!all.length) return ["running", "waiting"].includes(stage.value) ? skeletons() : null;
    const useful = all.filter((c) => c.gain_percent >= USEFUL);
    const shown = more.value ? all : useful.slice(0, SHOWN);
    const status = diagnosis.value?.verdict.status;
    const wanted = status !== "adequate" &&
      (status !== "unknown_effect" || diagnosis.value?.verdict.effects.length !== 0);
    return [
      status === "adequate" && useful.length
        ? h("li", { class: "muted" }, "The error is as small as the noise: none of these effects is needed.")
        : null,
      ...shown.map((c, i) => card(c, i === 0 && c.gain_percent >= USEFUL, wanted)),
      shown.length
        ? null
        : h("li", { class: "muted" }, "No effect of the catalogue lowers the error by 1 % or more."),
    ];
  };
  const rest = () => {
    const all = candidates.value, useful = all.filter((c) => c.gain_percent >= USEFUL).length;
    const hidden = all.length - Math.min(useful, SHOWN);
    if (hidden <= 0) return null;
    return h(
      "button",
      { type: "button", class: "link", onclick: () => (more.value = !more.peek()) },
      () => more.value ? "Show the best only" : `Show ${hidden} more that were tried`,
    );
  };
  return h(
    "section",
    { class: () => `card candidates${stale.value ? " stale" : ""}`, "aria-label": "Which effect" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Which effect is missing?"),
      h("span", { class: "muted" }, () => candidates.value.length ? `${candidates.value.length} tried` : ""),
    ),
    h("ol", { class: "plain", "aria-live": "off" }, list),
    rest,
    notTried,
  );
}
