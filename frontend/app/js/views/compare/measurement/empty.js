// @ts-check
// Before there are data: what this view does, and ways to start; the guide over a first example.
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
      "Give a measurement. It is laid over the model, you see where and by how much the model fails, which effects of the " +
        "catalogue explain it, and the error falls as you add them.",
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
      "CSV, .xlsx, .mat or .tdms with columns for pressure, length or contraction, force, time. Or drop it anywhere.",
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

/** What to look at next; it follows what the user does. */
function advice() {
  const a = answer.value, told = diagnosis.value, done = steps.value.length;
  if (!a || stale.value) return "The measured points are being laid over the ideal muscle…";
  const error = errorText(a.rmse, a.unit, a.predicted, units.value);
  if (stage.value === "running") {
    return `The ${
      done ? "model" : "ideal muscle"
    } misses the points by ${error}. The map “Where it fails” shows at which pressure and ` +
      "contraction; now every effect of the catalogue is tried.";
  }
  if (told?.verdict.status === "adequate") {
    return `The error is ${error}: what is left looks like noise. Undo (Ctrl Z) takes the steps back, Report writes them down.`;
  }
  if (!done) {
    return "Each card on the right is an effect with what it would take from the error. Press Add on the first.";
  }
  if (done === 1) return "The error fell. Hold it against the model before with B, then add the next effect.";
  return "Go on while a card still lowers the error, also on the points held out.";
}

/** The guide over the first example. */
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
