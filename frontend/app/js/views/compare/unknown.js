// @ts-check
// What no effect of the catalogue explains: how much, in which variables, and a formula that would.
import { h } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { ApiError, post } from "../../api.js";
import { brief, scaleOf, toShown } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { palette } from "../../plots/theme.js";
import { extent } from "../design/axes.js";
import { plotlyReady } from "../design/charts.js";
import { addModel } from "./history.js";
import { compare, diagnosis } from "./model.js";
import { modelBody } from "./request.js";
import { channelScale, VARIABLES } from "./words.js";

/** @typedef {import("./types.js").ProposedTerm} ProposedTerm */
/** @typedef {import("./types.js").Effects} Effects */

const term = computed(() => diagnosis.value?.verdict.proposed_term ?? null);
const wrong = signal("");
const trying = signal(false);

/** The entry of a model that holds a typed formula: the one with a text in it. @param {Effects} effects */
const holderOf = (effects) =>
  Object.keys(effects).find((id) => Object.values(effects[id]).some((v) => typeof v === "string")) ?? null;

/** @param {ProposedTerm} proposed @param {string} formula */
async function addTerm(proposed, formula) {
  const holder = holderOf(proposed.model.effects);
  if (!holder) return addModel(proposed.model, "own term");
  const typed = formula.trim();
  const known = proposed.model.effects[holder];
  const used = Object.entries(known).filter(([name]) => new RegExp(`\\b${name}\\b`).test(typed));
  const names = [...new Set(typed.match(/\b[A-Za-z_]\w*\b/g) ?? [])].filter((name) => /^c\d+$/.test(name));
  const missing = names.filter((name) => !(name in known)).map((name) => [name, 1]);
  const text = Object.keys(known).find((name) => typeof known[name] === "string") ?? "term";
  const own = { ...Object.fromEntries([...used, ...missing]), [text]: typed };
  const model = { effects: { ...proposed.model.effects, [holder]: own } };
  wrong.value = "";
  trying.value = true;
  try {
    const c = compare.peek();
    // A formula with a mistake must not become a step of the history.
    await post("/api/comparisons", {
      ...modelBody(c, { effects: model.effects, freed: c.freed, values: c.muscle.values }),
      fit: false,
    });
    addModel(model, "own term");
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    wrong.value = error.words;
  } finally {
    trying.value = false;
  }
}

function plot() {
  const host = h("div", { class: "plot", role: "figure", "aria-label": "Residual and proposed term" });
  const chart = new Chart(host, "compare-term");
  effect(() => {
    const curve = term.value?.curve, system = units.value, told = diagnosis.value;
    palette.value;
    if (!curve || !told || !plotlyReady.value) return;
    const v = VARIABLES[curve.x], s = channelScale(told.unit, told.predicted, system);
    const across = v ? scaleOf(v.quantity, system) : null;
    const x = curve.values.map((si) => across && si !== null ? toShown(si, across) : si);
    const y = (/** @type {(number | null)[]} */ values) =>
      values.map((one) => one === null ? null : one / s.factor);
    chart.show((p) => ({
      x: { title: v ? `${v.title} (${across?.unit})` : curve.x, range: extent([x]) },
      y: { title: `Residual (${s.unit})`, range: extent([y(curve.residual), y(curve.term), [0]]) },
      traces: [
        {
          id: "left",
          x,
          y: y(curve.residual),
          marker: { size: 4, symbol: "circle", color: p.soft },
          column: "residual",
        },
        { id: "term", x, y: y(curve.term), line: { color: p.accent, width: 2 }, column: "term" },
      ],
      zones: [],
      revision: `term${system}`,
    }));
  });
  return host;
}

export function unknownCard() {
  const told = computed(() => {
    const verdict = diagnosis.value?.verdict;
    return verdict && (verdict.status === "unknown_effect" || verdict.proposed_term) ? verdict : null;
  });
  return () => {
    const verdict = told.value;
    if (!verdict) return null;
    const proposed = verdict.proposed_term;
    const share = verdict.unexplained_share;
    const where = verdict.unexplained_in.map((name) =>
      VARIABLES[name]?.title.toLowerCase() ?? name.replaceAll("_", " ")
    );
    const formula = h("textarea", {
      rows: 2,
      id: "term-formula",
      spellcheck: "false",
      "aria-describedby": "term-help",
      "aria-invalid": () => wrong.value ? "true" : null,
    });
    formula.value = proposed?.formula ?? "";
    return h(
      "section",
      { class: "card unknown", "aria-label": "Unknown effect" },
      h("div", { class: "card-head" }, h("h2", null, "Not in the catalogue")),
      h(
        "p",
        null,
        share === null ? "" : `${brief(100 * share)} % of the mean square error is left that is not noise`,
        where.length ? `; it follows ${where.join(", ")}.` : ".",
      ),
      proposed
        ? [
          h(
            "label",
            { for: "term-formula", class: "label" },
            `A formula that takes away ${brief(100 * proposed.share)} % of it`,
          ),
          formula,
          h(
            "p",
            { class: "hint", id: "term-help" },
            "Force in N. P (Pa), kappa, v (m/s, positive when lengthening), L (m), t (s); " +
              "abs sign exp sqrt sin cos tanh; c1, c2, … are fitted.",
          ),
          h("p", { class: "error", role: "alert" }, () => wrong.value),
          proposed.curve ? plot() : null,
          h("button", {
            type: "button",
            class: "block",
            disabled: () => trying.value,
            onclick: () => addTerm(proposed, formula.value),
          }, "Add as own term"),
        ].flat()
        : null,
    );
  };
}
