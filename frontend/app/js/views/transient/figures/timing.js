// @ts-check
// The timing table: figures, their definitions, and why one is missing.
import { h } from "../../../dom.js";
import { figuresOf, inSentence, UNITS } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief, capitalized, scaleOf, toShown, unbroken } from "../../../format.js";
import { run } from "../model.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {import("../../../facts.js").DeclaredFigure} DeclaredFigure */
/** @typedef {import("../../../types.js").PhaseFigure} PhaseFigure */
/** A figure with its name in the timing table. @typedef {DeclaredFigure & {name: PhaseFigure}} Figure */

/** The timing table, in the order an engineer reads it. @type {Figure[]} */
export const TIMING = figuresOf("timing").map((each) => ({
  ...each,
  name: /** @type {PhaseFigure} */ (each.key.split(".")[1]),
}));

/** @type {["extend" | "retract", string][]} */
const PHASES = /** @type {any} */ (Object.entries(UNITS.phases));

/** The full name of a figure, for use outside the table. @param {Figure} figure
 * @param {"extend" | "retract"} phase */
export const figureName = ({ label }, phase) => `${label}, ${UNITS.phases[phase]}`;

/** How a figure is shown. @param {DeclaredFigure} figure */
const scaleOfFigure = ({ quantity }) => scaleOf(/** @type {Quantity} */ (quantity), units.value);

/** @param {Run} r @param {"extend" | "retract"} phase @param {Figure} figure */
export const figureOf = (r, phase, { name }) => r.timing[phase][name] ?? null;

/** @param {Run} r @param {"extend" | "retract"} phase @param {Figure} figure */
function cell(r, phase, figure) {
  const value = figureOf(r, phase, figure), why = r.timing.notes[`${phase}.${figure.name}`];
  if (value === null) return h("td", null, h("abbr", { title: why ?? figure.otherwise }, "–"));
  return h("td", why ? { title: why } : null, brief(toShown(value, scaleOfFigure(figure))));
}

/** How the motion of each phase ends. */
export function motions() {
  const r = run.value;
  if (!r) return null;
  const said = PHASES.filter(([phase]) => r.timing[phase].motion);
  return said.length
    ? h(
      "ul",
      { class: "plain motions" },
      ...said.map(([phase, name]) =>
        h("li", null, unbroken(`${capitalized(name)}: the load ${r.timing[phase].motion}.`))
      ),
    )
    : null;
}

export function timingTable() {
  const r = run.value;
  if (!r) return null;
  return h(
    "table",
    { class: "data timing" },
    h("caption", { class: "unseen" }, Object.values(UNITS.phases).join(" and ")),
    h(
      "thead",
      null,
      h(
        "tr",
        null,
        h("td", null),
        ...PHASES.map(([, name]) => h("th", { scope: "col" }, capitalized(name))),
        h("td", null),
      ),
    ),
    ...[...new Set(TIMING.map(({ section }) => section))].map((section) =>
      h(
        "tbody",
        null,
        h("tr", { class: "group-row" }, h("th", { scope: "rowgroup", colspan: 4 }, section)),
        ...TIMING.filter((figure) => figure.section === section).map((figure) =>
          h(
            "tr",
            null,
            h("th", { scope: "row", title: figure.definition }, unbroken(figure.label)),
            ...PHASES.map(([phase]) => cell(r, phase, figure)),
            h("td", { class: "text" }, scaleOfFigure(figure).unit),
          )
        ),
      )
    ),
  );
}

/** Why figures are missing, and remarks on others; each text once. */
export function reasons() {
  const r = run.value;
  if (!r) return null;
  /** @type {Map<string, string[]>} */
  const why = new Map(), remarks = new Map();
  for (const [phase, name] of PHASES) {
    for (const figure of TIMING) {
      const isMissing = figureOf(r, phase, figure) === null, note = r.timing.notes[`${phase}.${figure.name}`];
      if (!isMissing && !note) continue;
      const text = `${capitalized(name)}: ${note ?? figure.otherwise}`, group = isMissing ? why : remarks;
      group.set(text, [...group.get(text) ?? [], inSentence(figure.label)]);
    }
  }
  return [noteList("Why figures are missing", why), noteList("Remarks on figures", remarks)];
}

/** @param {string} title @param {Map<string, string[]>} notes text -> names of the figures */
function noteList(title, notes) {
  if (!notes.size) return null;
  return h(
    "details",
    { class: "figure-notes" },
    h("summary", null, title),
    h(
      "ul",
      { class: "plain muted" },
      ...[...notes].map(([text, labels]) =>
        h("li", null, `${text} (${labels.length > 4 ? `${labels.length} figures` : labels.join(", ")}).`)
      ),
    ),
  );
}

/** Times in milliseconds below a second. @param {number | null} t */
export const lapse = (t) => t === null ? "–" : t < 1 ? `${brief(1e3 * t)}\u00a0ms` : `${brief(t)}\u00a0s`;
