// @ts-check
// What the runs show: figures with their spread, probabilities of the limits, influences, designs.
import { h } from "../../dom.js";
import { figure, inSentence } from "../../facts.js";
import { toShown } from "../../format.js";
import { computed, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { answer } from "./model.js";
import { columnText, outcomeText, percentText, scaleFor, titleOf, valueText } from "./words.js";

/** @typedef {import("./model.js").Answer} Answer */
/** @typedef {import("../../types.js").S["Probability"]} Probability */

/** @param {string} caption @param {string[]} heads @param {(Node | string)[][]} rows */
const table = (caption, heads, rows) =>
  h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    h(
      "table",
      { class: "data figures" },
      h("caption", { class: "unseen" }, caption),
      h(
        "thead",
        null,
        h("tr", null, ...heads.map((head, i) => h("th", { scope: "col", class: i ? null : "text" }, head))),
      ),
      h(
        "tbody",
        null,
        ...rows.map(([first, ...rest]) =>
          h(
            "tr",
            null,
            h("th", { scope: "row", class: "text" }, first),
            ...rest.map((cell, i) => h("td", { "data-title": heads[i + 1] }, cell)),
          )
        ),
      ),
    ),
  );

/** What rounding leaves of a figure that is 0, in any shown unit. */
const NOTHING = 1e-6;

/** A mean to the digits that half its interval allows: "432.2 ± 2.7". @param {number} mean @param {number} half */
function withHalf(mean, half) {
  if (Math.abs(mean) + half < NOTHING) return "0";
  const places = half > 0 ? Math.min(8, Math.max(0, 1 - Math.floor(Math.log10(half)))) : 0;
  return `${mean.toFixed(places).replace("-", "−")} ± ${half.toFixed(places)}`;
}

const SHARES = ["5", "50", "95"];
/** @param {string} name */
const named = (name) => figure(`summary.${name}`).label;
/** @param {Answer} a */
const hasIntervals = (a) => a.summary.some((s) => s.mean?.high != null);

/** @param {Answer} a */
function spread(a) {
  return table(
    "Figures of all runs",
    [
      "Figure",
      `${named("mean")}${hasIntervals(a) ? `, ± at ${percentText(a.confidence)}` : ""}`,
      named("deviation"),
      ...SHARES.map((q) => `${q} %`),
      named("least"),
      named("most"),
      named("count"),
    ],
    a.summary.map((s) => {
      const scale = scaleFor(s.figure, s.unit, units.value), wide = { ...scale, offset: 0 };
      const shares = SHARES.map((q) => s.percentiles[q]?.value);
      const text = columnText([...shares, s.least, s.most].map((v) => v ?? null), scale);
      const half = s.mean?.high == null || s.mean.value === null ? null : s.mean.high - s.mean.value;
      return [
        h("span", null, titleOf(s.figure), h("small", null, ` ${scale.unit}`)),
        half === null
          ? text(s.mean?.value)
          : withHalf(toShown(s.mean?.value ?? 0, scale), toShown(half, wide)),
        columnText([s.deviation?.value ?? null], wide)(s.deviation?.value),
        ...shares.map(text),
        text(s.least),
        text(s.most),
        String(s.count),
      ];
    }),
  );
}

/** @param {Probability} p */
function probabilityText(p) {
  const { value, low, high } = p.probability;
  const ends = low === null || high === null ? "" : ` (${percentText(low)} to ${percentText(high)})`;
  return `${value === null ? "–" : percentText(value)}${ends}`;
}

/** @param {Answer} a */
const chances = (a) =>
  h(
    "div",
    { class: "bars", role: "list", "aria-label": figure("studied.probability").label },
    ...a.probabilities.map((p) =>
      bar({
        name: p.what === "all" ? "All limits" : titleOf(p.what),
        text: probabilityText(p),
        value: p.probability.value ?? 0,
        low: p.probability.low,
        high: p.probability.high,
        most: 1,
      })
    ),
  );

/** A bar from 0 with its interval; negative values grow to the left of the middle.
 * @param {{name: string, text: string, value: number, low: number | null, high: number | null, most: number,
 *   signed?: boolean, second?: number | null}} o */
function bar({ name, text, value, low, high, most, signed = false, second = null }) {
  const at = (/** @type {number} */ v) => {
    const share = Math.max(signed ? -1 : 0, Math.min(1, v / (most || 1)));
    return 100 * (signed ? (share + 1) / 2 : share);
  };
  const zero = at(0), from = Math.min(zero, at(value));
  const size = (/** @type {number} */ v) => Math.abs(at(v) - zero);
  return h(
    "div",
    { class: "bar-row", role: "listitem" },
    h("span", { class: "bar-name" }, name),
    h(
      "span",
      { class: "track", "aria-hidden": "true" },
      second === null ? null : h("i", { class: "second", style: `left:${zero}%;width:${size(second)}%` }),
      h("i", { style: `left:${from}%;width:${size(value)}%` }),
      low === null || high === null
        ? null
        : h("em", { style: `left:${at(low)}%;width:${Math.max(0.4, at(high) - at(low))}%` }),
      signed ? h("u", { style: `left:${zero}%` }) : null,
    ),
    h("span", { class: "num" }, text),
  );
}

const wanted = signal("");
/** Figures with influences, and what their bars are. */
const influenced = computed(() => {
  const a = answer.value;
  if (!a) return [];
  const of = a.sensitivity.length ? a.sensitivity : a.correlations;
  return [...new Set(of.map((one) => one.figure))];
});
const influencedNow = computed(() =>
  influenced.value.includes(wanted.value) ? wanted.value : influenced.value[0] ?? ""
);

/** @param {number | null} v */
const digits = (v) => v === null ? "–" : v.toFixed(2).replace("-", "−");

/** @param {Answer} a @param {string} path */
function influences(a, path) {
  const found = a.sensitivity.find((s) => s.figure === path);
  if (!found) {
    const list = a.correlations.filter((c) => c.figure === path)
      .sort((x, y) => Math.abs(y.rank_correlation ?? 0) - Math.abs(x.rank_correlation ?? 0));
    return list.map((c) =>
      bar({
        name: titleOf(c.quantity),
        text: digits(c.rank_correlation),
        value: c.rank_correlation ?? 0,
        low: null,
        high: null,
        most: 1,
        signed: true,
      })
    );
  }
  const isSobol = found.influences.some((i) => i.total !== null);
  const size = (/** @type {typeof found.influences[0]} */ i) => (isSobol ? i.total : i.mean_size) ?? 0;
  const unit = a.columns.find((c) => c.name === path)?.unit ?? null;
  const scale = { ...scaleFor(path, unit, units.value), offset: 0 };
  const most = isSobol ? 1 : Math.max(...found.influences.map((i) => size(i) + (i.mean_size_error ?? 0)), 0);
  return [...found.influences].sort((x, y) => size(y) - size(x)).map((i) => {
    const error = isSobol ? i.total_error : i.mean_size_error, value = size(i);
    const text = (/** @type {number | null} */ v) => isSobol ? digits(v) : valueText(v, scale);
    const alone = isSobol
      ? `, ${inSentence(figure("influence.first").label)} ${text(i.first)} ± ${text(i.first_error)}`
      : "";
    return bar({
      name: titleOf(i.quantity),
      text: `${text(value)} ± ${text(error)}${alone}${isSobol ? "" : ` ${scale.unit}`}`,
      value,
      low: error === null ? null : value - error,
      high: error === null ? null : value + error,
      most,
      second: null,
    });
  });
}

/** @param {Answer} a */
const influenceWords = (a) =>
  !a.sensitivity.length
    ? `${figure("influence.rank_correlation").label}. ${figure("influence.rank_correlation").definition}`
    : `${figure(`influence.${a.method === "sobol" ? "total" : "mean_size"}`).definition} ± at ${
      percentText(a.confidence)
    } confidence.`;

export const influenceCard = () =>
  h(
    "section",
    { class: "card", "aria-label": "What matters", hidden: () => !influenced.value.length },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "What matters"),
      h("select", {
        class: "small",
        "aria-label": "Figure that is influenced",
        onchange: (
          /** @type {Event} */ e,
        ) => (wanted.value = /** @type {HTMLSelectElement} */ (e.target).value),
      }, () =>
        influenced.value.map((f) =>
          h("option", { value: f, selected: f === influencedNow.value }, titleOf(f))
        )),
    ),
    () => {
      const a = answer.value;
      if (!a || !influencedNow.value) {
        return null;
      }
      const bars = influences(a, influencedNow.value);
      return [
        bars.length
          ? h("div", { class: "bars", role: "list", "aria-label": "Influences" }, ...bars)
          : h("p", null, "This figure does not vary, or too few runs have it."),
        h("p", { class: "hint" }, influenceWords(a)),
      ];
    },
  );

/** @param {Answer} a */
function designs(a) {
  const names = Object.keys(a.designs[0].values);
  const unitOf = (/** @type {string} */ name) => a.columns.find((c) => c.name === name)?.unit ?? null;
  return table(
    "Designs, those most likely to keep all limits first",
    [
      "Design",
      ...names.map((n) => `${titleOf(n)} (${scaleFor(n, unitOf(n), units.value).unit})`),
      "Keeps all limits",
    ],
    a.designs.slice(0, 50).map((d) => [
      String(d.design + 1),
      ...names.map((n) => {
        const v = d.values[n];
        return typeof v === "string" ? v : valueText(v, scaleFor(n, unitOf(n), units.value));
      }),
      d.probabilities.length ? probabilityText(d.probabilities[d.probabilities.length - 1]) : "–",
    ]),
  );
}

/** @param {Answer} a */
const outcomes = (a) =>
  Object.entries(a.outcomes).map(([name, count]) => `${count} ${outcomeText(name)}`).join(", ");

/** @param {Answer} a */
function certainty(a) {
  const has = hasIntervals(a) || a.sensitivity.length > 0 || a.designs.length > 0;
  const intervals = has ? `${figure("studied.confidence").label}: ${percentText(a.confidence)}.` : "";
  return [intervals, a.seed === null ? "" : `Seed ${a.seed}.`].filter(Boolean).join(" ");
}

export const summaryCard = () =>
  h(
    "section",
    { class: "card", "aria-label": "Result", hidden: () => !answer.value },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Result"),
      h("span", { class: "muted" }, () => answer.value ? outcomes(answer.value) : ""),
    ),
    () => {
      const a = answer.value;
      if (!a) return null;
      return [
        a.probabilities.length
          ? [
            h("h3", { title: figure("studied.probability").definition }, figure("studied.probability").label),
            chances(a),
          ]
          : [],
        a.designs.length ? [h("h3", null, "Designs"), designs(a)] : [],
        [a.probabilities.length || a.designs.length ? h("h3", null, "Figures") : null, spread(a)],
        a.remarks.length
          ? [h("ul", { class: "plain muted" }, ...a.remarks.map((r) => h("li", null, r)))]
          : [],
        [h("p", { class: "hint" }, certainty(a))],
      ].flat();
    },
  );
