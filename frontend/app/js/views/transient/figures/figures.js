// @ts-check
// Results of a run: verdict, key figures, tracking, timing.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { brief, readable, withUnit } from "../../../format.js";
import { jointCard } from "../plots/joint.js";
import { fault, roundTrip, run, timeWindow } from "../model.js";
import { paperCard } from "./paper.js";
import { lapse, reasons, timingTable } from "./timing.js";

/** @typedef {import("../../../types.js").Run} Run */

/** @param {string} name @param {string} value @param {string} [title] */
const big = (name, value, title) =>
  h("div", { class: "big", title: title ?? null }, h("span", null, name), h("b", { class: "num" }, value));

const ANR_DENSITY = 1.185; // kg/m³ at 20 °C, 100 kPa, 65 % humidity

/** Air taken from the supply in the time shown [m³ ANR]. @param {Run} r */
const airOf = ({ time, supply_flow: flow }) =>
  time.reduce(
    (sum, t, i) => i ? sum + 0.5 * (t - time[i - 1]) * ((flow[i] ?? 0) + (flow[i - 1] ?? 0)) : 0,
    0,
  ) / ANR_DENSITY;

/** The most important figures. @param {Run} r */
function keyFigures(r) {
  const system = units.value, { extend } = r.timing;
  const first = r.tracking
    ? [
      big("Error, RMS", withUnit(r.tracking.rms, "length", system)),
      big("Lag", r.tracking.lag === null ? "–" : lapse(r.tracking.lag), r.tracking.notes.lag),
    ]
    : [
      big("Positioning", lapse(extend.positioning_time), r.timing.notes["extend.positioning_time"]),
      big("Largest speed", withUnit(extend.max_speed, "speed", system), r.timing.notes["extend.max_speed"]),
    ];
  return h(
    "div",
    { class: "bigs", id: "key-figures" },
    ...first,
    r.tracking ? big("Largest error", withUnit(r.tracking.max, "length", system)) : big(
      "Impact",
      withUnit(extend.impact_energy, "energy", system),
      r.timing.notes["extend.impact_energy"],
    ),
    r.tracking || extend.air_volume_anr == null
      ? big(
        timeWindow.value ? "Air in the window" : "Air of the run",
        withUnit(airOf(r), "normal", system),
        `Taken from the supply ${timeWindow.value ? "in the time shown" : "over the whole run"}, at ANR`,
      )
      : big(
        "Air per cycle",
        withUnit(extend.air_volume_anr, "normal", system),
        [
          "Taken from the supply for one filling, with the tube, at ANR.",
          r.timing.notes["extend.air_volume_anr"] ?? r.timing.notes["extend.air_mass"],
        ].filter(Boolean).join(" "),
      ),
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
  // A complete run in which nothing moves is a warning.
  const still = r.timing.extend.max_speed == null && !r.tracking
    ? r.timing.notes["extend.max_speed"] ?? null
    : null;
  const grade = !done ? "bad" : hard.length || still ? "warn" : "good";
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
          ? hard.length
            ? `${still ? ` Nothing moves: ${still}.` : ""} It leaves the permitted range:`
            : still
            ? ` Nothing moves: ${still}.`
            : " Within all limits."
          : ` It ended at ${lapse(end)}. ${r.message ?? ""}`,
      ),
    ),
    ...hard.map((f) => h("p", { class: "flag bad" }, icon("warn"), h("span", null, f.message))),
    keyFigures(r),
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

/** Notes on the document; those on figures are shown in the tables. @param {Run} r */
const remarks = (r) =>
  Object.entries(r.notes).filter(([where]) => !/^(timing|tracking)\./.test(where)).map(([where, text]) =>
    h("p", { class: "muted" }, `${readable(where)}: ${text}`)
  );

/** Where the run starts and why, and how the air is modelled. */
function conditions() {
  const r = run.value;
  if (!r) return "";
  const { position, contraction, reason } = r.start, system = units.value;
  return `Starts at ${withUnit(position, "length", system)} (${withUnit(contraction, "ratio", system)}), ` +
    `${reason}. Air: ${r.gas}.`;
}

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
      h("dt", null, "Largest error"),
      h("dd", null, withUnit(t.max, "length", system)),
      h("dt", { title: "Delay of the reference that fits the position best." }, "Lag"),
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

/** How long the simulation took, and with what. */
function runLine() {
  const r = run.value;
  if (!r) return "";
  return `${r.outcome === "completed" ? "Completed" : r.outcome.replace("_", " ")} in ${
    brief(r.wall_ms)
  } ms · ${r.engine} · ` +
    `${r.steps} steps · answer after ${Math.round(roundTrip.value)} ms`;
}

/** @returns {(HTMLElement | (() => HTMLElement | null))[]} */
export function figureCards() {
  return [
    h(
      "section",
      { class: "card", "aria-label": "Run" },
      h("div", { class: "card-head" }, h("h2", null, "Run")),
      h("div", { class: "verdicts" }, verdict),
      h("p", { class: "hint", id: "run-start" }, conditions),
      h("p", { class: "runline" }, runLine),
    ),
    jointCard,
    tracking,
    paperCard,
    h(
      "section",
      { class: "card timing-card", "aria-label": "Timing" },
      h("div", { class: "card-head" }, h("h2", null, "Timing")),
      h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Timing table" }, timingTable),
      reasons,
    ),
  ];
}
