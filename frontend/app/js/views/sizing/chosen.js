// @ts-check
// The selected proposal in figures, what can be done with it, and how the search went.
import { h, icon } from "../../dom.js";
import { openPopover } from "../../ui/dialog.js";
import { openInDesign, openInTransient, saveReport, writing } from "./actions.js";
import { marginBars } from "./margins.js";
import { answer, chosen, chosenIndex, proposals } from "./model.js";
import { asText, driveWords, partsWords, percent } from "./words.js";

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
      "Fulfils the task as computed. Its probability is not known: no specimens were simulated.",
    );
  }
  const grade = probability >= LIKELY ? "good" : probability >= DOUBTFUL ? "warn" : "bad";
  const range = error ? ` ± ${percent(error)}` : "";
  return h(
    "p",
    { class: `verdict ${grade}` },
    icon(grade === "good" ? "check" : "warn"),
    h(
      "span",
      null,
      h("b", null, `${percent(probability)}${range}`),
      ` probability that the real drive fulfils the task (${p.specimens} simulated specimens).`,
    ),
  );
}

/** @param {Proposal} p @returns {[string, string][]} */
const figures = (p) => [
  ["Time for the stroke", asText(p.time, "time")],
  ["Time for the return", asText(p.time_down, "time")],
  ["Air per cycle", asText(p.air_volume_anr, "normal")],
  ["Supply pressure", asText(p.pressure, "pressure")],
  ["Lowest sufficient pressure", asText(p.needed_pressure, "pressure")],
  ["Pressure at the start", asText(p.pressure_start, "pressure")],
  ["Pressure on arrival", asText(p.pressure_end, "pressure")],
  ["Contraction", asText(p.contraction, "ratio")],
  ["Force reserve", percent(p.force_reserve)],
  ["Peak muscle force", asText(p.peak_force, "force")],
  ["Stiffness, valve open", asText(p.stiffness, "stiffness")],
  ["Stiffness, valve closed", asText(p.stiffness_closed, "stiffness")],
  ["Energy at impact", asText(p.impact_energy, "energy")],
  ["End speed", asText(p.end_speed, "speed")],
  ["Largest speed", asText(p.max_speed, "speed")],
  ["Installed length", asText(p.installed_length, "length")],
  ["Diameter, contracted", asText(p.diameter, "length")],
  ["Life, unverified", `${Number(p.life.toPrecision(2)).toLocaleString("en")} cycles`],
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
    h("dl", null, () => figures(p).flatMap(([name, text]) => [h("dt", null, name), h("dd", null, text)])),
    h("h3", { class: "second" }, "Margins"),
    marginBars(p),
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
  const count = (/** @type {number} */ n) => n.toLocaleString("en");
  return h(
    "p",
    { class: "muted search-line" },
    `${
      count(a.combinations)
    } combinations of muscle, length, number, pressure, valve and tube within the limits; `,
    `${count(a.pruned)} rejected by static calculation, ${count(a.simulated)} simulated, and ${
      count(a.specimens)
    } specimens simulated, `,
    `in ${(a.wall_ms / 1e3).toFixed(1)} s.`,
  );
}
