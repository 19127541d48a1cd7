// @ts-check
// What is shown without a measurement: what this view does and ways to start.
import { h } from "../../../dom.js";
import { otherCases } from "../case-menu.js";
import { openBuiltIn } from "./files.js";
import { builtIn, chooseFiles } from "./card.js";
import { mysteryList } from "./mysteries.js";

export function emptyCard() {
  const first = () => builtIn()[0];
  return h(
    "section",
    { class: "card empty-state", "aria-label": "Start" },
    otherCases,
    h("h2", null, "Which physical effect is your model missing?"),
    h(
      "p",
      null,
      "Bring a measurement: it becomes a case. The page shows where and by how much the model is wrong, finds the effects " +
        "of the catalogue that explain it, and the error falls as you add them.",
    ),
    h(
      "div",
      { class: "starts" },
      h("button", { type: "button", onclick: chooseFiles }, "Choose a measurement file"),
      () =>
        first()
          ? h(
            "button",
            { type: "button", onclick: () => openBuiltIn(first()?.id ?? "") },
            "Example measurement",
          )
          : null,
    ),
    h(
      "p",
      { class: "muted" },
      "A CSV, JSON, .xlsx, .mat, .h5 or .tdms file with columns for pressure, length or contraction, force, time. You can also drop it on the page.",
    ),
    h("h3", null, "Built-in measurements"),
    h("div", { class: "tiles" }, () =>
      builtIn().map((m) =>
        h(
          "button",
          { type: "button", class: "tile", onclick: () => openBuiltIn(m.id) },
          h("b", null, m.title),
          h("small", null, m.description ?? ""),
        )
      )),
    mysteryList,
  );
}
