// @ts-check
// Results of a run: verdict, key figures, tracking, timing.
import { h, icon } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { units } from "../../../state.js";
import { brief, readable, scaleOf, toShown, unbroken, withUnit } from "../../../format.js";
import { jointCard } from "../plots/joint.js";
import { fault, roundTrip, run } from "../model.js";
import { paperCard } from "./paper.js";
import { lapse, motions, reasons, timingTable } from "./timing.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../types.js").Run} Run */

/** Events that the page lists; the saved answer has all. */
const MOST_EVENTS = 60;

/** The value of a figure in its unit. @param {string} key @param {number | null | undefined} value */
function shownAs(key, value) {
  const { quantity } = figure(key);
  return quantity === "lapse"
    ? lapse(value ?? null)
    : withUnit(value, /** @type {Quantity} */ (quantity), units.value);
}

/** A key figure by its declaration. @param {string} key @param {number | null | undefined} value @param {string} [note] */
function big(key, value, note) {
  const { label, definition, otherwise } = figure(key);
  return h(
    "div",
    { class: "big", title: `${definition} ${note ?? (value == null ? otherwise : "")}`.trim() },
    h("span", null, label),
    h("b", { class: "num" }, shownAs(key, value)),
  );
}

/** The most important figures. @param {Run} r */
function keyFigures(r) {
  const { tracking, timing: { extend, notes } } = r;
  const timed = (/** @type {import("../../../types.js").PhaseFigure} */ name) =>
    big(`timing.${name}`, extend[name], notes[`extend.${name}`]);
  const air = tracking || extend.supplied_volume_anr == null
    ? big("run.supplied_volume_anr", r.supplied_volume_anr)
    : timed("supplied_volume_anr");
  return h(
    "div",
    { class: "bigs", id: "key-figures" },
    ...(tracking
      ? [
        big("tracking.rms", tracking.rms),
        big("tracking.lag", tracking.lag, tracking.notes.lag),
        big("tracking.max", tracking.max),
      ]
      : [timed("positioning_time"), timed("max_speed"), timed("impact_energy")]),
    air,
  );
}

const NOTE = "unverified";
/** Remarks on what the figures are worth, which are no limits. */
const REMARKS = new Set(["curve_fit", "stretched"]);
/** @param {string} text */
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function verdict() {
  const r = run.value;
  if (!r) {
    return h("p", { class: "muted" }, fault.value ? "No valid drive yet." : "Waiting for the first run…");
  }
  const done = r.outcome === "completed";
  const beside = r.flags.filter((f) => REMARKS.has(f.code));
  const hard = r.flags.filter((f) => f.code !== NOTE && !REMARKS.has(f.code));
  const { verdict: asked } = r;
  const away = asked.met === false;
  // Green is an answer: of a run that is asked nothing there is none.
  const grade = !done ? "bad" : hard.length || away ? "warn" : asked.met === null ? "plain" : "good";
  const end = r.time.at(-1) ?? 0;
  const title = done ? asked.sentence : r.message ?? asked.sentence;
  return [
    h(
      "p",
      { class: `verdict ${grade}` },
      icon(grade === "good" ? "check" : grade === "plain" ? "info" : "warn"),
      h(
        "span",
        null,
        h("b", null, unbroken(title)),
        done && r.tracking?.advice ? h("span", { class: "advice" }, ` ${capital(r.tracking.advice)}.`) : "",
        done
          ? hard.length ? " It leaves the permitted range:" : " No permitted limit is exceeded."
          : ` It ended at ${lapse(end)}.`,
      ),
    ),
    ...hard.map((f) => h("p", { class: "flag bad" }, icon("warn"), h("span", null, unbroken(f.message)))),
    ...beside.map((f) =>
      h("p", { class: "flag note" }, icon("info"), h("span", null, `${capital(f.message)}.`))
    ),
    keyFigures(r),
  ];
}

/** Sources that nobody has verified, and notes on the document. */
function doubts() {
  const r = run.value;
  if (!r) return null;
  const unread = r.flags.filter((f) => f.code === NOTE);
  return [
    unread.length
      ? h(
        "details",
        { class: "doubts" },
        h("summary", null, icon("info"), `${unread.length} unverified source${unread.length > 1 ? "s" : ""}`),
        h("ul", { class: "plain muted" }, ...unread.map((f) => h("li", null, f.message))),
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
  const { position, contraction, reason, lowest, highest } = r.start, system = units.value;
  const held = lowest === null || highest === null
    ? ""
    : ` Dry friction holds it there from ${withUnit(lowest, "length", system)} to ${
      withUnit(highest, "length", system)
    }.`;
  return `Starts at ${withUnit(position, "length", system)} (${withUnit(contraction, "ratio", system)}), ` +
    `${reason}.${held} Air: ${r.gas}.${r.rest ? ` At the end the load ${r.rest}.` : ""}`;
}

/** @param {string} key */
function named(key) {
  const { label, definition } = figure(key);
  return h("dt", { title: definition }, label);
}

const MOST_STEPS = 12;
const OF_STEP = /** @type {const} */ (
  ["size", "overshoot", "settling_time", "steady_error", "swing_frequency", "swing_amplitude"]
);

/** How each step of the reference is answered, a column for each. @param {NonNullable<Run["tracking"]>["steps"]} steps */
function stepsTable(steps) {
  /** @param {"time" | typeof OF_STEP[number]} name */
  const row = (name) => {
    const { label, definition, quantity } = figure(`step.${name}`), s = scaleOf(quantity, units.value);
    const cells = steps.map((step) => step[name] == null ? "–" : brief(toShown(step[name], s)));
    return { head: { title: definition }, label: unbroken(label), unit: s.unit, cells };
  };
  const time = row("time");
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": "Steps of the reference" },
    h(
      "table",
      { class: "data timing steps" },
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("th", { scope: "row", ...time.head }, `${time.label} `, h("small", null, time.unit)),
          ...time.cells.map((text) => h("th", { scope: "col" }, text)),
        ),
      ),
      h(
        "tbody",
        null,
        ...OF_STEP.filter((name) => steps.some((step) => step[name] != null)).map(row).map((one) =>
          h(
            "tr",
            null,
            h("th", { scope: "row", ...one.head }, `${one.label} `, h("small", null, one.unit)),
            ...one.cells.map((text) => h("td", null, text)),
          )
        ),
      ),
    ),
  );
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
      named("tracking.rms"),
      h("dd", null, withUnit(t.rms, "length", system)),
      named("tracking.max"),
      h("dd", null, withUnit(t.max, "length", system)),
      named("tracking.lag"),
      h("dd", { title: t.notes.lag ?? null }, t.lag === null ? `– ${t.notes.lag ?? ""}` : lapse(t.lag)),
    ),
    t.steps.length
      ? h(
        "details",
        { open: t.steps.length <= 4 },
        h("summary", null, `${t.steps.length} step${t.steps.length > 1 ? "s" : ""} of the reference`),
        stepsTable(t.steps.slice(0, MOST_STEPS)),
      )
      : null,
  );
}

/** What happens in the run: impacts, slack, sticking. */
function eventList() {
  const r = run.value;
  if (!r || !r.events.length) return null;
  const system = units.value;
  return h(
    "details",
    null,
    h("summary", null, `${r.events.length} event${r.events.length > 1 ? "s" : ""}`),
    h(
      "ul",
      { class: "plain" },
      ...r.events.slice(0, MOST_EVENTS).map((e) =>
        h(
          "li",
          null,
          `${lapse(e.time)}: ${e.text}`,
          e.speed ? ` (${withUnit(e.speed, "speed", system)})` : "",
        )
      ),
      r.events.length > MOST_EVENTS ? h("li", null, `and ${r.events.length - MOST_EVENTS} more`) : null,
    ),
  );
}

/** How long the simulation took, and with what. */
function runLine() {
  const r = run.value;
  if (!r) return "";
  return `${r.outcome === "completed" ? "Completed" : r.outcome.replace("_", " ")} in ${
    brief(r.wall_ms)
  } ms · ` +
    `${r.steps} steps · answer after ${Math.round(roundTrip.value)} ms`;
}

/** What the run says of what was asked, above everything else. */
export const verdictBar = () =>
  h(
    "section",
    { class: "card verdict-bar", "aria-label": "Verdict" },
    h("div", { class: "verdicts", "aria-live": "polite" }, verdict),
  );

/** @returns {(HTMLElement | (() => HTMLElement | null))[]} */
export function figureCards() {
  return [
    h(
      "section",
      { class: "card", "aria-label": "Run" },
      h("div", { class: "card-head" }, h("h2", null, "Run")),
      doubts,
      h("p", { class: "hint", id: "run-start" }, conditions),
      eventList,
      h("p", { class: "runline" }, runLine),
    ),
    jointCard,
    tracking,
    paperCard,
    h(
      "section",
      { class: "card timing-card", "aria-label": "Timing" },
      h("div", { class: "card-head" }, h("h2", null, "Timing")),
      motions,
      h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Timing table" }, timingTable),
      reasons,
    ),
  ];
}
