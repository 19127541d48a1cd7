// @ts-check
// The method of a study: how its runs are chosen, how many, and the seed.
import { h } from "../../dom.js";
import { countField } from "./fields.js";
import { editMethod, messageWithin, plannedText, study } from "./model.js";

/** @typedef {import("../../types.js").Study} Study */

/** @type {[Study["method"]["type"], string, string][]} */
const METHODS = [
  [
    "monte_carlo",
    "Monte Carlo",
    "Independent random values. Gives distributions, and probabilities with intervals.",
  ],
  [
    "latin_hypercube",
    "Latin hypercube",
    "Random values, spread evenly over each quantity. Covers much with few runs.",
  ],
  ["grid", "Grid", "All combinations of the points of each range and the values of each list."],
  ["list", "List", "One run for the first value of each list, one for the second values, and so on."],
  [
    "sobol",
    "Sobol indices",
    "The share of the variance of each figure that each quantity causes, alone and with its interactions.",
  ],
  ["morris", "Morris screening", "Which quantities matter at all, with few runs."],
  [
    "optimisation",
    "Optimisation",
    "The best values for one or several goals within the limits. Needs a figure with a goal.",
  ],
  [
    "robust",
    "Robust design",
    "Probability that built specimens keep the limits, for each combination of the ranges and lists. Needs a limit, a range or list, and a distribution.",
  ],
];

/** @type {Record<string, [keyof Study["method"], string, number, number][]>} */
const COUNTS = {
  monte_carlo: [["runs", "Runs", 1, 20000]],
  latin_hypercube: [["runs", "Runs", 1, 20000]],
  robust: [["runs", "Specimens of each design", 1, 20000]],
  morris: [["trajectories", "Trajectories", 2, 5000]],
  optimisation: [["population", "Runs of a generation", 8, 1000], ["generations", "Generations", 1, 1000]],
};
const POWERS = [16, 32, 64, 128, 256, 512, 1024, 2048];

function samplesField() {
  return h(
    "div",
    { class: "field-head" },
    h("label", { for: "study-samples" }, "Base samples"),
    h(
      "select",
      {
        id: "study-samples",
        class: "small",
        onchange: (/** @type {Event} */ e) =>
          editMethod({ samples: Number(/** @type {HTMLSelectElement} */ (e.target).value) }, "base samples"),
      },
      ...POWERS.map((n) =>
        h("option", { value: n, selected: () => study.value.method.samples === n }, String(n))
      ),
    ),
  );
}

export const methodCard = (/** @type {import("../../reactive.js").Signal<string>} */ type) =>
  h(
    "section",
    { class: "card", "aria-label": "Method", "data-field": "method" },
    h("div", { class: "card-head" }, h("h2", null, "Method")),
    h("select", {
      id: "study-method",
      "aria-label": "Method",
      onchange: (/** @type {Event} */ e) =>
        editMethod(
          {
            type: /** @type {Study["method"]["type"]} */ (/** @type {HTMLSelectElement} */ (e.target).value),
          },
          "method of the study",
        ),
    }, () => METHODS.map(([id, name]) => h("option", { value: id, selected: type.value === id }, name))),
    h("p", { class: "hint" }, () => METHODS.find(([id]) => id === type.value)?.[2] ?? ""),
    () => type.value === "sobol" ? samplesField() : null,
    () =>
      (COUNTS[type.value] ?? []).map(([key, label, least, most]) =>
        countField({
          key,
          label,
          least,
          most,
          get: () => /** @type {number} */ (study.value.method[key]),
          put: (n) => editMethod({ [key]: n }, label.toLowerCase()),
        })
      ),
    () =>
      type.value === "grid" || type.value === "list" ? null : countField({
        key: "seed",
        label: "Seed",
        least: 0,
        most: 2 ** 32 - 1,
        get: () => study.value.method.seed,
        put: (seed) => editMethod({ seed }, "seed"),
      }),
    h(
      "p",
      { class: "hint" },
      () => `${plannedText.value ? `${plannedText.value}; the` : "The"} page makes at most 20,000.`,
    ),
    h("p", { class: "error" }, () => messageWithin("method") ?? ""),
  );
