// @ts-check
// What is shown without a measurement: what this view does and ways to start; and the guide of the example.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { openBuiltIn } from "./files.js";
import { builtIn, chooseFiles } from "./card.js";
import { answer, compare, diagnosis, lookCompare, stage, stale, steps } from "../answers.js";
import { mysteryList } from "./mysteries.js";
import { errorText } from "../words.js";

export function emptyCard() {
  const first = () => builtIn()[0];
  return h(
    "section",
    { class: "card empty-state", "aria-label": "Start" },
    h("h2", null, "Which physical effect is your model missing?"),
    h(
      "p",
      null,
      "Open a measurement. The page plots it with the model, shows where and by how much the model is wrong, finds the " +
        "effects of the catalogue that explain the error, and shows how the error falls as you add them.",
    ),
    h(
      "div",
      { class: "starts" },
      h("button", { type: "button", class: "primary", onclick: chooseFiles }, "Choose a measurement file"),
      () =>
        first()
          ? h(
            "button",
            { type: "button", onclick: () => openBuiltIn(first()?.id ?? "", true) },
            "Guided example",
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

/** What to do next. */
function advice() {
  const a = answer.value, result = diagnosis.value, added = steps.value.length;
  if (!a || stale.value) return "The measured points are being compared with the ideal muscle…";
  const error = errorText(a.rmse, a.unit, a.predicted, units.value);
  if (stage.value === "running") {
    return `The ${
      added ? "model" : "ideal muscle"
    } is wrong by ${error}. The map “Where it fails” shows at which pressure and contraction. ` +
      "Now every effect of the catalogue is tried.";
  }
  if (result?.verdict.status === "adequate") {
    return `The error is ${error}: only noise is left. Undo (Ctrl Z) takes the steps back, Report saves them.`;
  }
  if (!added) {
    return "Each card on the right is an effect, and by how much it reduces the error. Press Add on the first one.";
  }
  if (added === 1) {
    return "The error fell. Press B to compare with the model before, then add the next effect.";
  }
  return "Continue while a card still reduces the error, including the hold-out error.";
}

/** The guide through the example. */
export function guide() {
  if (!compare.value.guided) return null;
  return h(
    "div",
    { class: "notice guide", role: "status" },
    icon("info"),
    h("span", null, advice()),
    h("button", { type: "button", onclick: () => lookCompare({ guided: false }) }, "Skip the guide"),
  );
}
