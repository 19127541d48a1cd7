// @ts-check
// The inputs of a task in grouped cards; what is rarely changed is collapsed.
import { inSentence } from "../../facts.js";
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { presets } from "../../store.js";
import { menuButton } from "../../ui/menu.js";
import { rearranged } from "./document.js";
import { openOnError, profileField, taskField } from "./fields.js";
import {
  arrangement,
  cancel,
  editSizing,
  messageFor,
  openExample,
  propose,
  setTask,
  sizing,
  stage,
  valueAt,
} from "./model.js";
import { partsField } from "./parts.js";
import { fieldOf, isNumber, RANKINGS, USUAL_RANKING } from "./specs.js";
import { asText } from "./words.js";
import { segments } from "../../ui/segments.js";

/** @typedef {import("../../types.js").TaskArrangement} Arrangement */

/** @type {[Arrangement, string, string][]} */
const ARRANGEMENTS = [
  ["lift", "Lift", "The muscle pulls the load directly"],
  ["lever", "Lever", "Through a lever or pulley: the muscle’s stroke differs from the load’s"],
  ["antagonist", "Antagonist", "Two muscles turn a pulley in opposite directions"],
];

export const examples = () => presets.value.tasks ?? [];

function exampleItems() {
  const all = examples();
  if (!all.length) return [{ heading: "No example tasks on this server" }];
  return all.map((p) => ({ label: p.title, note: p.description, run: () => openExample(p) }));
}

/** Starts a search; cancels it while it runs. */
export const proposeButton = () =>
  h(
    "button",
    {
      type: "button",
      class: () => `block${stage.value === "running" ? "" : " primary"}`,
      title: "Ctrl+Enter",
      onclick: () => stage.peek() === "running" ? cancel() : propose(),
    },
    () => stage.value === "running" ? "Cancel the search" : "Propose drives",
  );

export function taskCard() {
  const title = h("input", {
    type: "text",
    id: "task-title",
    maxlength: 200,
    autocomplete: "off",
    placeholder: "Name of your task (optional)",
    value: () => valueAt("title") ?? "",
    onchange: () => setTask("title", title.value.trim() || undefined, "name"),
  });
  return h(
    "section",
    { class: "card task-head", "aria-label": "Task" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Task"),
      menuButton({
        label: ["Examples", icon("down")],
        name: "Examples of tasks",
        class: "quiet",
        items: exampleItems,
      }),
    ),
    h("label", { class: "unseen", for: "task-title" }, "Name of the task"),
    title,
    h("p", { class: "error", "data-field": "title" }, () => messageFor("title") ?? ""),
    segments(
      "Arrangement",
      ARRANGEMENTS,
      () => arrangement.value,
      (id) => editSizing(rearranged(sizing.peek(), id), `arrangement ${id}`),
    ),
    () => neededFields(),
    proposeButton(),
    h("p", { class: "hint" }, "These are enough for a first answer. All else has a default, below."),
  );
}

/** A card that is collapsed; its head tells what the task states in it, so that nothing is hidden.
 * @param {string} title @param {string[]} paths of its fields @param {import("../../dom.js").Child[]} body */
const card = (title, paths, ...body) =>
  h(
    "section",
    { class: "card folded", "aria-label": title },
    h(
      "details",
      { ref: openOnError(paths) },
      h("summary", null, h("h2", null, title), h("small", null, () => statedWords(paths))),
      ...body,
    ),
  );

/** The fields that the task states, in words. @param {string[]} paths */
function statedWords(paths) {
  const stated = paths.filter((path) => valueAt(path) !== undefined);
  return stated.map((path) => {
    const { label, quantity, whole } = fieldOf(path), value = valueAt(path), name = inSentence(label);
    if (Array.isArray(value)) return value.length > 2 ? `${value.length} ${name}` : value.join(", ");
    if (typeof value !== "number") return name;
    return `${name} ${quantity && !whole ? asText(value, quantity) : String(value)}`;
  }).join(", ") || usualWords(paths[0]);
}
/** The first field of a card that states none. @param {string} path */
function usualWords(path) {
  const { label, quantity, default: usual } = fieldOf(path);
  if (!isNumber(path) || !quantity || !usual) return "defaults";
  return `defaults: ${inSentence(label)} ${asText(usual, quantity)} …`;
}
/** Fields that are rarely changed, collapsed; an error in one opens them.
 * @param {string} summary @param {string[]} paths @param {import("../../dom.js").Child[]} more */
const folded = (summary, paths, ...more) =>
  h(
    "details",
    { ref: openOnError(paths) },
    h("summary", null, summary),
    ...paths.filter((path) => path !== PROFILE).map((path) => taskField(path)),
    ...more,
  );
const PROFILE = "load.force_over_stroke";

const isPair = computed(() => arrangement.value === "antagonist");

/** What a first answer needs. */
function neededFields() {
  if (isPair.value) {
    return [
      taskField("load.pair.angle", { needed: true }),
      taskField("load.pair.torque", { needed: true }),
      taskField("load.pair.inertia", { needed: true }),
      taskField("time"),
    ];
  }
  return [
    taskField("load.mass", { needed: true }),
    taskField("stroke", { needed: true }),
    taskField("time"),
    arrangement.value === "lever" ? taskField("load.lever_ratio", { needed: true }) : null,
  ];
}

const LOAD = ["load.force", "load.inclination", "load.spring", "load.counterweight", PROFILE];

/** The other fields of the load for its arrangement. */
const loadFields = () =>
  isPair.value ? [taskField("load.pair.pulley_radius")] : [
    ...LOAD.filter((path) => path !== PROFILE).map((path) => taskField(path)),
    profileField(),
  ];

function rankField() {
  return h(
    "div",
    { class: "task-field", "data-field": "rank_by" },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: "rank-by" }, fieldOf("rank_by").label),
      h(
        "select",
        {
          id: "rank-by",
          class: "small",
          onchange: (/** @type {Event} */ e) =>
            setTask("rank_by", /** @type {HTMLSelectElement} */ (e.target).value, "ranking"),
        },
        () =>
          RANKINGS.map(([id, name]) =>
            h("option", { value: id, selected: id === (valueAt("rank_by") ?? USUAL_RANKING) }, name)
          ),
      ),
    ),
    h("p", { class: "hint" }, fieldOf("rank_by").definition),
  );
}

export function taskCards() {
  const motion = ["supply_pressure", "time_down", "cycle_time", "stiffness", "ambient_temperature"];
  const space = [
    "limits.max_length",
    "limits.max_diameter",
    "limits.max_parallel",
    "limits.max_contraction",
    "limits.force_reserve",
    "limits.pressure_reserve",
    "limits.max_impact_energy",
    "limits.end_fittings",
    "limits.life",
  ];
  const parts = ["catalogue.muscles", "catalogue.valves", "catalogue.tubes", "catalogue.tube_length"];
  const specimens = [
    "uncertainty.specimens",
    "uncertainty.blocked_force",
    "uncertainty.supply_pressure",
    "uncertainty.hysteresis",
    "max_proposals",
  ];
  const costs = ["operation.cycles_per_year", "operation.air_price"];
  return [
    card(
      "Motion and air",
      [...motion, "speed"],
      ...motion.map((path) => taskField(path)),
      () => isPair.value ? null : folded("Speed instead of time", ["speed"]),
    ),
    card("Other loads", [...LOAD, "load.pair.pulley_radius"], () => loadFields()),
    card("Space and margins", space, ...space.map((path) => taskField(path))),
    card(
      "Catalogue",
      parts,
      partsField("muscles", "all with complete data"),
      partsField("valves", "all whose flow is known"),
      partsField("tubes", "all"),
      taskField("catalogue.tube_length"),
    ),
    card(
      "Uncertainty and ranking",
      ["rank_by", ...specimens, ...costs],
      rankField(),
      folded("Specimens, tolerances, number of proposals", specimens),
      folded("Cost of the air", costs),
    ),
  ];
}
