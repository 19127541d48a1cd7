// @ts-check
// Pinned runs, up to four, and a table of their inputs and figures; the first run is the baseline.
import { h, icon } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { number, scaleOf, toShown } from "../../../format.js";
import { palette } from "../../../plots/theme.js";
import { figureRows, inputRows } from "./rows.js";
import { differenceText, pinNames } from "../run-names.js";
import { MOST_PINS } from "../document.js";
import { at } from "../../../paths.js";
import { documentNow, editTransient, muscleName, run, transient } from "../model.js";
import { openDrive } from "../../../drive/open.js";
import { pinKey, pinRuns, pins } from "../pinned-runs.js";
import { pinColours } from "../plots/specs.js";
import { siNumber } from "../../../quantities.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../types.js").Drive} Drive */
/** @typedef {import("./rows.js").Column} Column */

const colours = computed(() => pinColours(palette.value));

/** A short name for a drive: muscle, mass, pressure. @param {Drive} d */
function nameOf(d) {
  const asText = (/** @type {string} */ path, /** @type {Quantity} */ q) => {
    const si = siNumber(at(d, path));
    const s = scaleOf(q, units.peek());
    return si === null ? "" : `${number(toShown(si, s), 2)} ${s.unit}`;
  };
  const base = [
    muscleName.peek().replace(/^Festo /, ""),
    asText("load.mass", "mass"),
    asText("supply.pressure", "pressure"),
  ];
  return base.filter(Boolean).join(" · ");
}

export function pin() {
  if (pins.peek().length >= MOST_PINS || !run.peek()) return;
  const document = documentNow();
  editTransient({ pins: [...pins.peek(), { name: nameOf(document), drive: document }] }, "pin run");
}
/** @param {number} index */
const unpin = (index) => editTransient({ pins: pins.peek().filter((_, i) => i !== index) }, "unpin run");

/** @returns {Column[]} the pinned runs and the current one */
function columns() {
  const runs = pinRuns.value;
  const pinned = pins.value.map((p, i) => {
    const answer = runs.get(pinKey(p.drive));
    const wrong = answer instanceof ApiError ? answer.words : null;
    return {
      name: pinNames.value[i],
      drive: p.drive,
      run: answer instanceof ApiError ? null : answer ?? null,
      color: colours.value[i],
      wrong,
    };
  });
  return [...pinned, {
    name: (pins.value.length && differenceText(pins.value[0].drive, documentNow())) || "now",
    drive: documentNow(),
    run: run.value,
    color: palette.value.accent,
    wrong: null,
  }];
}

/** @param {number | null} d relative to the baseline */
const delta = (d) => {
  if (d === null) return h("small");
  if (Math.abs(d) < 5e-4) return h("small", null, "=");
  const percent = Math.abs(100 * d);
  return h(
    "small",
    { class: d > 0 ? "more" : "less" },
    `${d > 0 ? "▲" : "▼"} ${percent < 9.95 ? percent.toFixed(1) : percent.toFixed(0)} %`,
  );
};

/** @typedef {{label: string, unit: string, texts: string[], deltas: (number | null)[]}} Row */

/** Whether it is a row of figures, whose numbers have room for a difference beside them. @param {Row} r */
const hasDeltas = (r) => r.unit !== "" || r.deltas.some((d) => d !== null);

/** @param {Row} r */
const tableRow = (r) =>
  h(
    "tr",
    null,
    h("th", { scope: "row" }, r.label, r.unit ? h("small", null, ` ${r.unit}`) : null),
    ...r.texts.map((text, i) => h("td", null, text, " ", i && hasDeltas(r) ? delta(r.deltas[i]) : null)),
  );

function table() {
  const all = columns();
  const inputs = inputRows(all), figures = figureRows(all);
  const shownRows = transient.value.differing ? figures.filter((r) => new Set(r.texts).size > 1) : figures;
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": "Pinned runs and the current run" },
    h(
      "table",
      { class: "data pinned", style: `--runs:${all.length}` },
      h("caption", { class: "unseen" }, "Pinned runs and the current run; the first is the baseline"),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("td", null),
          ...all.map((c, i) =>
            h(
              "th",
              { scope: "col" },
              h("span", { class: "pin-name" }, h("i", { style: `background:${c.color}` }), c.name),
              c.wrong
                ? h("small", { class: "error" }, c.wrong)
                : i === 0
                ? h("small", null, "baseline")
                : null,
              i < all.length - 1 ? pinButtons(c, i) : null,
            )
          ),
        ),
      ),
      inputs.length
        ? h("tbody", null, groupRow("Different inputs", all.length), ...inputs.map(tableRow))
        : null,
      h("tbody", null, groupRow("Figures", all.length), ...shownRows.map(tableRow)),
    ),
  );
}

/** @param {string} name @param {number} n */
const groupRow = (name, n) =>
  h("tr", { class: "group-row" }, h("th", { scope: "rowgroup", colspan: n + 1 }, name));

/** @param {Column} c @param {number} i */
const pinButtons = (c, i) =>
  h(
    "span",
    { class: "pin-buttons" },
    h("button", {
      type: "button",
      class: "mini",
      "aria-label": `Go back to ${c.name}`,
      title: "Make this drive the current one",
      onclick: () => openDrive(c.drive, { label: `back to ${c.name}` }),
    }, icon("reset")),
    h("button", {
      type: "button",
      class: "mini",
      "aria-label": `Unpin ${c.name}`,
      title: "Unpin",
      onclick: () => unpin(i),
    }, icon("close")),
  );

export function compareCard() {
  return h(
    "section",
    { class: "card compare-card", "aria-label": "Compare runs" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Compare runs"),
      () =>
        pins.value.length
          ? h(
            "label",
            { class: "check" },
            h("input", {
              type: "checkbox",
              checked: () => transient.value.differing,
              onchange: (/** @type {Event} */ e) =>
                editTransient(
                  { differing: /** @type {HTMLInputElement} */ (e.target).checked },
                  "differences only",
                ),
            }),
            "Differences only",
          )
          : null,
      h(
        "button",
        {
          type: "button",
          disabled: () => !run.value || pins.value.length >= MOST_PINS,
          title: () =>
            pins.value.length >= MOST_PINS
              ? `At most ${MOST_PINS} runs. Unpin one first.`
              : "Keep this run for comparison",
          onclick: pin,
        },
        icon("pin"),
        "Pin this run",
      ),
    ),
    () =>
      pins.value.length ? table() : h(
        "p",
        { class: "muted" },
        "Pin a run, then change something. The table compares the figures of up to four pinned runs.",
      ),
  );
}
