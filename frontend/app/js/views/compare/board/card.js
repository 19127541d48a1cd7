// @ts-check
// The board: up to six pinned models beside the case, what differs between them, and their lines in the overlay.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { answer, compare, lookCompare, steps } from "../answers.js";
import { MOST_PINS } from "../document.js";
import { errorText } from "../words.js";
import { canPin, columns, pin, pinStart } from "./columns.js";
import { hidden, saveTable, table } from "./table.js";

/** @typedef {import("./columns.js").Column} Column */

/** A pinned model in the closed board. @param {Column} c */
const chip = (c) =>
  h(
    "li",
    { class: `pin-chip${c.index < 0 ? " me" : ""}` },
    h("b", null, c.name),
    c.comparison
      ? ` ${
        errorText(c.comparison.rmse_beyond_accuracy, c.comparison.unit, c.comparison.predicted, units.value)
      }`
      : compare.value.pins[c.index]?.rmse != null
      ? ` ${
        errorText(
          compare.value.pins[c.index].rmse,
          answer.value?.unit ?? "N",
          answer.value?.predicted ?? "force",
          units.value,
        )
      }`
      : "",
  );

export function boardCard() {
  const open = () => compare.value.board;
  return h(
    "section",
    { class: "card board", "aria-label": "Model board" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Model board"),
      h("small", null, () => `${compare.value.pins.length} of ${MOST_PINS} pinned`),
      () =>
        open()
          ? h(
            "label",
            { class: "check differences" },
            h("input", {
              type: "checkbox",
              checked: compare.value.differing,
              onchange: () => lookCompare({ differing: !compare.peek().differing }),
            }),
            h(
              "span",
              null,
              "Differences only",
              compare.value.differing ? ` (${hidden.value} equal rows hidden)` : "",
            ),
          )
          : null,
      () => open() ? h("button", { type: "button", class: "small", onclick: saveTable }, "Table .csv") : null,
      () =>
        steps.value.length && !compare.value.pins.length
          ? h("button", { type: "button", class: "small", onclick: pinStart }, "Pin the start")
          : null,
      h(
        "button",
        {
          type: "button",
          class: "small",
          disabled: () => !canPin.value,
          onclick: pin,
        },
        icon("pin"),
        "Pin this model",
      ),
      h("button", {
        type: "button",
        class: "small",
        "aria-expanded": () => String(open()),
        onclick: () => lookCompare({ board: !compare.peek().board }),
      }, () => open() ? "Close" : "Open"),
    ),
    () => open() ? table() : h("ul", { class: "pin-chips" }, ...columns.value.map(chip)),
  );
}
