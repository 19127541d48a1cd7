// @ts-check
// The timing table: figures, their definitions, and why one is missing.
import { h } from "../../../dom.js";
import { units } from "../../../state.js";
import { brief, scaleOf, toShown } from "../../../format.js";
import { run } from "../model.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../types.js").Run} Run */
/** @typedef {[key: string, label: string, quantity: Quantity, definition: string]} Figure */

const ALONG = "A magnitude along the motion of its column: filling shortens, venting lengthens.";
const SHORTER = "Positive when shortening, in both columns.";

/** The timing table, in the order an engineer reads it. @type {[string, Figure[]][]} */
const FIGURES = [
  ["Motion", [
    [
      "positioning_time",
      "Positioning time",
      "lapse",
      "From switching to arrival: the impact on the stop that ends the stroke, else 98 % of the stroke.",
    ],
    ["rise_time", "Rise time", "lapse", "From 10 % to 90 % of the stroke, without the dead time."],
    ["delay_time", "Delay time", "lapse", "From switching to 50 % of the stroke."],
    [
      "settling_time",
      "Settling time",
      "lapse",
      "After this time the position stays within 5 % of the stroke.",
    ],
    ["average_speed", "Average speed", "speed", `Travel up to the arrival over positioning time. ${ALONG}`],
    ["max_speed", "Largest speed", "speed", `Including the moment before an impact. ${ALONG}`],
    ["max_speed_at", "… at", "lapse", "When, from switching."],
    [
      "max_acceleration",
      "Largest acceleration",
      "acceleration",
      `${SHORTER} Impacts are not included.`,
    ],
    ["max_acceleration_at", "… at", "lapse", "When, from switching."],
    [
      "min_acceleration",
      "Smallest acceleration",
      "acceleration",
      `${SHORTER} Impacts are not included.`,
    ],
    ["min_acceleration_at", "… at", "lapse", "When, from switching."],
    ["end_speed", "End speed", "speed", `At the impact; without one, on arrival. ${ALONG}`],
    ["impact_energy", "Impact energy", "energy", "½ m v² of the first impact on a stop."],
    ["overshoot", "Overshoot", "ratio", "Largest travel beyond the stroke, as a share of it."],
  ]],
  ["Pressure", [
    ["pressure_rise_time", "Rise time", "lapse", "From 10 % to 90 % of the change in pressure."],
    ["pressure_delay_time", "Delay time", "lapse", "From switching to 50 % of the change."],
    [
      "pressure_settling_time",
      "Settling time",
      "lapse",
      "After this time the pressure stays within 1 % of the change.",
    ],
  ]],
  ["Air", [
    ["air_mass", "Air mass", "air", "Taken from the supply, or let out to the surroundings; with the tube."],
    ["tube_air_mass", "Tube air mass", "air", "The part of the air mass that fills the tube."],
    [
      "air_volume_anr",
      "Air volume",
      "normal",
      "The air mass as a volume at ANR: 20 °C, 1 bar absolute, 65 % humidity.",
    ],
    [
      "choked_share",
      "Valve choked",
      "ratio",
      "Share of this air that passes the valve while its flow does not depend on the pressure downstream.",
    ],
  ]],
];
export const ALL_FIGURES = FIGURES.flatMap(([, list]) => list);

/** @type {Record<string, string>} */
const WAYS = { extend: "fill", retract: "vent" };

/** The full name of a figure, for use outside the table. @param {Figure} figure @param {string} phase */
export function figureName(figure, phase) {
  const [key, label] = figure;
  const of = label.startsWith("…") ? `${ALL_FIGURES[ALL_FIGURES.indexOf(figure) - 1][1]}, when` : label;
  return `${of}${key.startsWith("pressure") ? " of the pressure" : ""}, ${WAYS[phase]}`;
}

/** @type {["extend" | "retract", string][]} */
const PHASES = [["extend", "Fill"], ["retract", "Vent"]];

/** @param {Run} r @param {"extend" | "retract"} phase @param {string} key */
const figureOf = (r, phase, key) =>
  r.timing[phase][/** @type {import("../../../types.js").PhaseFigure} */ (key)] ?? null;

/** @param {Run} r @param {"extend" | "retract"} phase @param {Figure} figure */
function cell(r, phase, [key, , quantity]) {
  const value = figureOf(r, phase, key), why = r.timing.notes[`${phase}.${key}`];
  const s = scaleOf(quantity, units.value);
  if (value === null) return h("td", null, h("abbr", { title: why ?? "not available" }, "–"));
  const text = quantity === "lapse" ? brief(1e3 * value) : brief(toShown(value, s));
  return h("td", why ? { title: why } : null, text);
}

export function timingTable() {
  const r = run.value;
  if (!r) return null;
  return h(
    "table",
    { class: "data timing" },
    h("caption", { class: "unseen" }, "Timing of the first fill and of the venting after it"),
    h(
      "thead",
      null,
      h(
        "tr",
        null,
        h("td", null),
        ...PHASES.map(([, name]) => h("th", { scope: "col" }, name)),
        h("td", null),
      ),
    ),
    ...FIGURES.map(([group, list]) =>
      h(
        "tbody",
        null,
        h("tr", { class: "group-row" }, h("th", { scope: "rowgroup", colspan: 4 }, group)),
        ...list.map((figure) =>
          h(
            "tr",
            { class: figure[1].startsWith("…") ? "sub" : null },
            h("th", { scope: "row", title: figure[3] }, figure[1]),
            ...PHASES.map(([phase]) => cell(r, phase, figure)),
            h("td", { class: "text" }, scaleOf(figure[2], units.value).unit),
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
    for (const [key, label] of ALL_FIGURES) {
      const isMissing = figureOf(r, phase, key) === null, note = r.timing.notes[`${phase}.${key}`];
      if (label.startsWith("…") || (!isMissing && !note)) continue;
      const text = `${name}: ${note ?? "not available"}`, group = isMissing ? why : remarks;
      group.set(text, [...group.get(text) ?? [], label.toLowerCase()]);
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
