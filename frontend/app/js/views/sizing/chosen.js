// @ts-check
// The selected proposal in figures, what can be done with it, and how the search went.
import { inSentence } from "../../facts.js";
import { h, icon } from "../../dom.js";
import { number, scaleOf, toShown } from "../../format.js";
import { units } from "../../state.js";
import { openPopover } from "../../ui/dialog.js";
import { openInDesign, openInTransient, saveReport, writing } from "./actions.js";
import { marginBars } from "./margins.js";
import { hanging } from "../../muscle/hanging.js";
import { answer, answeredTask, chosen, chosenIndex, proposals } from "./model.js";
import { fieldOf } from "./specs.js";
import { asText, driveWords, partsWords, percent, sizingFigure, terms } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */

const LIKELY = 0.9, DOUBTFUL = 0.5;

/** @param {Proposal} p */
function verdict(p) {
  const { probability, probability_error: error } = p;
  if (probability == null) {
    return h(
      "p",
      { class: "verdict warn" },
      icon("info"),
      "Fulfils the task as computed. How many built drives would is not known: no specimens were simulated.",
    );
  }
  const grade = probability >= LIKELY ? "good" : probability >= DOUBTFUL ? "warn" : "bad";
  const { definition } = sizingFigure("probability"), { label } = sizingFigure("probability_error");
  const range = error ? ` ± ${percent(error)} (${inSentence(label)})` : "";
  return h(
    "p",
    { class: `verdict ${grade}` },
    icon(grade === "good" ? "check" : "warn"),
    h(
      "span",
      { title: definition },
      h("b", null, percent(probability)),
      `${range} of ${p.specimens} simulated specimens reach the end in time and stay there.`,
    ),
  );
}

/** @type {import("./words.js").Name[]} */
const FIGURES = [
  "time",
  "time_down",
  "air_volume_anr",
  "pressure",
  "needed_pressure",
  "pressure_start",
  "pressure_end",
  "contraction",
  "force_reserve",
  "peak_force",
  "stiffness",
  "stiffness_closed",
  "impact_energy_stroke",
  "impact_energy_return",
  "end_speed",
  "max_speed",
  "installed_length",
  "outer_diameter",
  "life",
];

/** @param {Proposal} p */
function unverifiedBadge(p) {
  if (!p.unverified.length) return null;
  const button = h(
    "button",
    {
      type: "button",
      class: "badge warn",
      "aria-expanded": "false",
      onclick: () =>
        openPopover(button, "Unverified values", () => [
          h("h3", null, "Unverified values"),
          h(
            "p",
            null,
            "The result depends on these values, which are not from a verified source. Check them before you buy.",
          ),
          h("ul", { class: "plain" }, ...p.unverified.map((text) => h("li", null, text))),
        ]),
    },
    icon("warn"),
    "unverified",
  );
  return button;
}

/** The drive as it is mounted: hanging, or lying where the load does not hang. @param {Proposal} p */
function mounting(p) {
  const { load = {} } = answeredTask();
  if (load.pair || (load.lever_ratio ?? 1) !== 1) return null;
  const inclination = load.inclination ?? fieldOf("load.inclination").default ?? Math.PI / 2;
  const near = (/** @type {number} */ angle) => Math.abs(inclination - angle) < 0.01;
  const word = near(Math.PI / 2) ? "hanging" : near(0) ? "lying" : "inclined";
  if (word === "inclined") return null; // no drawing is better than one of another mounting
  const text = (/** @type {number} */ si) => asText(si, "length");
  const end = p.nominal_length * (1 - p.contraction);
  const s = scaleOf("mass", units.value);
  const mass = load.mass
    ? `${number(toShown(load.mass, s), s.digits)} ${s.unit}`
    : asText(load.force ?? 0, "force");
  return h(
    "figure",
    { class: `mounting ${word}` },
    hanging(
      [
        { length: p.nominal_length, width: p.outer_diameter, below: text(p.nominal_length) },
        { length: end, width: p.outer_diameter, below: text(end), filled: true },
      ],
      { load: mass, rise: "" },
      176,
    ),
    h(
      "figcaption",
      { class: "muted" },
      `${word}: ${asText(answeredTask().stroke, "length")} in ${asText(p.time, "time")} at ${
        asText(p.pressure, "pressure")
      }`,
    ),
  );
}

/** @param {Proposal} p */
function card(p) {
  return [
    h(
      "div",
      { class: "card-head" },
      h("h2", null, () => `Proposal ${chosenIndex.value + 1} of ${proposals.value.length}`),
      unverifiedBadge(p),
    ),
    h("h3", null, () => driveWords(p)),
    h("p", { class: "muted" }, () => partsWords(p)),
    mounting(p),
    verdict(p),
    h(
      "div",
      { class: "act" },
      h(
        "button",
        { type: "button", class: "primary", onclick: () => openInTransient(p) },
        "Open in Transient",
      ),
      h("button", { type: "button", onclick: () => openInDesign(p) }, "Open in Design"),
      h(
        "button",
        { type: "button", disabled: () => writing.value, onclick: () => saveReport(chosenIndex.peek()) },
        () => writing.value ? "Writing…" : "Report",
      ),
    ),
    h("dl", null, () => terms(p, FIGURES)),
    ...marginBars(p),
    ...p.notes.map((note) => h("p", { class: "flag note" }, icon("info"), h("span", { title: note }, note))),
  ];
}

export function chosenCard() {
  return h(
    "section",
    { class: "card chosen-drive", "aria-label": "Chosen proposal", hidden: () => !chosen.value },
    () => chosen.value ? card(chosen.value) : null,
  );
}

/** The extent of the search in one line. */
export function searchLine() {
  const a = answer.value;
  if (!a) return null;
  return h("p", { class: "muted search-line" }, `${a.searched} It took ${(a.wall_ms / 1e3).toFixed(1)} s.`);
}
