// @ts-check
// The right column: verdict in words, key figures, the timing table, tracking.
import { h, icon } from "../../dom.js";
import { units } from "../../state.js";
import { brief, scaleOf, toShown, withUnit } from "../../format.js";
import { fault, roundTrip, run } from "./model.js";

/** @typedef {import("../../format.js").Quantity} Quantity */
/** @typedef {import("../../types.js").Run} Run */
/** @typedef {[key: string, label: string, quantity: Quantity, definition: string]} Figure */

/** The timing table, in the order an engineer reads it. @type {[string, Figure[]][]} */
export const FIGURES = [
  ["Motion", [
    [
      "positioning_time",
      "Positioning time",
      "lapse",
      "From switching to arrival: the impact on the stop that ends the stroke; without one, 98 % of the stroke.",
    ],
    ["rise_time", "Rise time", "lapse", "From 10 % to 90 % of the stroke; no dead time in it."],
    ["delay_time", "Delay time", "lapse", "From switching to 50 % of the stroke."],
    ["settling_time", "Settling time", "lapse", "From here on within 2 % of the stroke."],
    ["average_speed", "Average speed", "speed", "Stroke over positioning time."],
    ["max_speed", "Greatest speed", "speed", "The instant before an impact included."],
    ["max_speed_at", "… at", "lapse", "When, from switching."],
    [
      "max_acceleration",
      "Greatest acceleration",
      "acceleration",
      "Positive towards shorter in both columns; impacts do not count.",
    ],
    ["max_acceleration_at", "… at", "lapse", "When, from switching."],
    [
      "min_acceleration",
      "Smallest acceleration",
      "acceleration",
      "Positive towards shorter in both columns; impacts do not count.",
    ],
    ["min_acceleration_at", "… at", "lapse", "When, from switching."],
    ["end_speed", "End speed", "speed", "At the impact; without one, on arrival."],
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
      "From here on within 1 % of the change: 99 % filled, or 1 % left.",
    ],
  ]],
  ["Air", [
    ["air_mass", "Air mass", "air", "Taken from the supply, or let out to the surroundings."],
    ["air_volume_anr", "Air volume", "normal", "The same at ANR: 20 °C, 1 bar absolute, 65 % humidity."],
    [
      "choked_share",
      "Valve choked",
      "ratio",
      "Share of the phase in which the flow does not depend on the pressure behind the valve.",
    ],
  ]],
];
export const ALL_FIGURES = FIGURES.flatMap(([, list]) => list);

/** @type {["extend" | "retract", string][]} */
const PHASES = [["extend", "Fill"], ["retract", "Vent"]];

/** @param {Run} r @param {"extend" | "retract"} phase @param {string} key */
const figureOf = (r, phase, key) => r.timing[phase][key] ?? null;

/** @param {Run} r @param {"extend" | "retract"} phase @param {Figure} figure */
function cell(r, phase, [key, , quantity]) {
  const value = figureOf(r, phase, key), why = r.timing.notes[`${phase}.${key}`];
  const s = scaleOf(quantity, units.value);
  if (value === null) return h("td", null, h("abbr", { title: why ?? "there is none" }, "–"));
  const text = quantity === "lapse" ? brief(1e3 * value) : brief(toShown(value, s));
  return h("td", why ? { title: why } : null, text);
}

function timingTable() {
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

/** Reasons for the figures that do not exist, each once. */
function reasons() {
  const r = run.value;
  if (!r) return null;
  /** @type {Map<string, string[]>} */
  const why = new Map();
  for (const [phase, name] of PHASES) {
    const empty = ALL_FIGURES.filter(([key]) => figureOf(r, phase, key) === null);
    for (const [key, label] of empty) {
      const text = `${name}: ${r.timing.notes[`${phase}.${key}`] ?? "there is none"}`;
      if (!label.startsWith("…")) why.set(text, [...why.get(text) ?? [], label.toLowerCase()]);
    }
  }
  if (!why.size) return null;
  return h(
    "details",
    { class: "reasons" },
    h("summary", null, "Why figures are missing"),
    h(
      "ul",
      { class: "plain muted" },
      ...[...why].map(([text, labels]) =>
        h("li", null, `${text} (${labels.length > 4 ? `${labels.length} figures` : labels.join(", ")}).`)
      ),
    ),
  );
}

/** @param {string} name @param {string} value @param {string} [title] */
const big = (name, value, title) =>
  h("div", { class: "big", title: title ?? null }, h("span", null, name), h("b", { class: "num" }, value));

/** Times in milliseconds below a second. @param {number | null} t */
export const lapse = (t) => t === null ? "–" : t < 1 ? `${brief(1e3 * t)}\u00a0ms` : `${brief(t)}\u00a0s`;

/** Air of one fill: what a full cycle takes from the supply. @param {Run} r */
function keyFigures(r) {
  const system = units.value, { extend } = r.timing;
  const first = r.tracking
    ? [
      big("Error, RMS", withUnit(r.tracking.rms, "length", system)),
      big("Lag", r.tracking.lag === null ? "–" : lapse(r.tracking.lag), r.tracking.notes.lag),
    ]
    : [
      big("Positioning", lapse(extend.positioning_time), r.timing.notes["extend.positioning_time"]),
      big("Greatest speed", withUnit(extend.max_speed, "speed", system), r.timing.notes["extend.max_speed"]),
    ];
  return h(
    "div",
    { class: "bigs", id: "key-figures" },
    ...first,
    big(
      "Air per cycle",
      withUnit(extend.air_volume_anr, "normal", system),
      "Taken from the supply in the first fill, at ANR",
    ),
    big("Impact", withUnit(extend.impact_energy, "energy", system), r.timing.notes["extend.impact_energy"]),
  );
}

/** @type {Record<string, string>} */
const OUTCOMES = {
  completed: "The run is complete.",
  stuck: "The run got stuck.",
  diverged: "The run diverged.",
  timed_out: "The run took too long.",
  cancelled: "The run was cancelled.",
};
const NOTE = "unverified";

function verdict() {
  const r = run.value;
  if (!r) {
    return h("p", { class: "muted" }, fault.value ? "No valid drive yet." : "Waiting for the first run…");
  }
  const done = r.outcome === "completed";
  const hard = r.flags.filter((f) => f.code !== NOTE), doubts = r.flags.filter((f) => f.code === NOTE);
  const grade = !done ? "bad" : hard.length ? "warn" : "good";
  const end = r.time.at(-1) ?? 0;
  return [
    h(
      "p",
      { class: `verdict ${grade}` },
      icon(grade === "good" ? "check" : "warn"),
      h(
        "span",
        null,
        OUTCOMES[r.outcome] ?? r.outcome,
        done
          ? (hard.length ? " It leaves the permitted range:" : " Within all limits.")
          : ` It ended at ${lapse(end)}. ${r.message ?? ""}`,
      ),
    ),
    keyFigures(r),
    ...hard.map((f) => h("p", { class: "flag bad" }, icon("warn"), h("span", null, f.message))),
    doubts.length
      ? h(
        "details",
        { class: "doubts" },
        h("summary", null, icon("info"), `${doubts.length} unverified source${doubts.length > 1 ? "s" : ""}`),
        h("ul", { class: "plain muted" }, ...doubts.map((f) => h("li", null, f.message))),
      )
      : null,
    ...remarks(r),
  ];
}

/** Remarks about the document; those of the tables stand with them. @param {Run} r */
const remarks = (r) =>
  Object.entries(r.notes).filter(([where]) => !/^(timing|tracking)\./.test(where)).map(([where, text]) =>
    h("p", { class: "muted" }, `${where.replaceAll("_", " ")}: ${text}`)
  );

/** @returns {import("../../dom.js").Child} */
function tracking() {
  const t = run.value?.tracking;
  if (!t) return null;
  const system = units.value;
  return h(
    "section",
    { class: "card", "aria-label": "Tracking" },
    h("div", { class: "card-head" }, h("h2", null, "Tracking")),
    h(
      "dl",
      null,
      h("dt", { title: "Root mean square of reference minus position over time." }, "Error, RMS"),
      h("dd", null, withUnit(t.rms, "length", system)),
      h("dt", null, "Greatest error"),
      h("dd", null, withUnit(t.max, "length", system)),
      h("dt", { title: "The delay that describes the position best." }, "Lag"),
      h("dd", { title: t.notes.lag ?? null }, t.lag === null ? `– ${t.notes.lag ?? ""}` : lapse(t.lag)),
    ),
    t.overshoot.length
      ? h(
        "details",
        { open: t.overshoot.length <= 4 },
        h("summary", null, `Overshoot of ${t.overshoot.length} step${t.overshoot.length > 1 ? "s" : ""}`),
        h(
          "ul",
          { class: "plain" },
          ...t.overshoot.slice(0, 12).map((o) =>
            h(
              "li",
              null,
              `${withUnit(o.overshoot, "ratio", system)} at ${lapse(o.time)} (step of ${
                withUnit(o.size, "length", system)
              })`,
            )
          ),
        ),
      )
      : null,
  );
}

/** How long it took and what computed it. */
export function runLine() {
  const r = run.value;
  if (!r) return "";
  return `${r.outcome === "completed" ? "Completed" : r.outcome.replace("_", " ")} in ${
    brief(r.wall_ms)
  } ms · ${r.engine} · ` +
    `${r.steps} steps · ${Math.round(roundTrip.value)} ms with the network`;
}

export function figureCards() {
  return [
    h(
      "section",
      { class: "card", "aria-label": "Run" },
      h("div", { class: "card-head" }, h("h2", null, "Run")),
      h("div", { class: "verdicts" }, verdict),
      h("p", { class: "runline" }, runLine),
    ),
    tracking,
    h(
      "section",
      { class: "card", "aria-label": "Timing" },
      h("div", { class: "card-head" }, h("h2", null, "Timing")),
      h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Timing table" }, timingTable),
      reasons,
    ),
  ];
}
