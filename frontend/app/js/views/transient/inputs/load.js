// @ts-check
// The load: arrangement and its fields, external force, spring, end stops, start position.
import { h } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { number, scaleOf, toShown } from "../../../format.js";
import { rearranged } from "../../../drive/document.js";
import { at } from "../../../paths.js";
import { choiceField, driveField, partMessage, SPECS } from "./fields.js";
import { arrangement, drive, numberAt, run, setDrive } from "../model.js";
import { middleOf } from "../series.js";
import { followPosition } from "./set-points.js";
import { signalFields } from "./signals.js";

/** @typedef {import("../../../types.js").DriveArrangement} Arrangement */

/** @type {[Arrangement, string][]} */
const ARRANGEMENTS = [
  ["hanging", "Hanging"],
  ["inclined", "On an incline"],
  ["horizontal", "Horizontal"],
  ["lever", "On a lever"],
  ["antagonist", "Antagonist pair"],
];
/** Of a document that states one; its levers, inertia, spring and stops are edited there.
 * @type {[Arrangement, string]} */
const JOINT = ["joint", "Joint"];

/** The fields of each arrangement besides the mass. @type {Record<Arrangement, string[]>} */
const FIELDS = {
  hanging: [],
  inclined: ["load.inclination"],
  horizontal: [],
  lever: ["load.lever_ratio", "load.inclination"],
  antagonist: ["load.pulley_radius", "load.precontraction"],
  joint: [],
};
const USUAL_MIDDLE = 0.1;
const PAIR_MASS = "As if moved at the rim of the pulley: the inertia divided by the radius squared.";
const PAIR_WEIGHT = "0°: balanced joint; 90°: the mass hangs on the rim.";

const PAIR_STOP = "Both as contractions of the first muscle.";

/** The contraction in the middle between the stops. */
function middle() {
  const r = run.peek();
  if (!r) return USUAL_MIDDLE;
  const { position_min: low, position_max: high } = r.limits, ratio = numberAt("load.lever_ratio") ?? 1;
  return Number((middleOf(r) + (0.5 * (low + high) * ratio) / r.geometry.nominal_length).toPrecision(3));
}

/** @param {Arrangement} next */
function arrange(next) {
  if (next !== "antagonist") followPosition();
  setDrive("load", rearranged(drive.peek().load ?? {}, next, middle()), `load ${next}`);
}

function arrangementFields() {
  const how = arrangement.value, pair = how === "antagonist";
  return [
    pair ? driveField("load.mass", { ...SPECS["load.mass"], hint: PAIR_MASS }) : driveField("load.mass"),
    ...(FIELDS[how] ?? []).map((path) => driveField(path)),
  ];
}

/** Whether the document gives one of these values, so that their part is opened. @param {string[]} paths */
const anyGiven = (...paths) => computed(() => paths.some((path) => numberAt(path) !== null));

function springFields() {
  const pair = arrangement.value === "antagonist";
  const isGiven = anyGiven("load.spring", ...(pair ? ["load.inclination"] : []));
  return h(
    "details",
    { open: () => isGiven.value },
    h("summary", null, pair ? "Spring and weight" : "Spring"),
    driveField("load.spring"),
    pair ? driveField("load.inclination", { ...SPECS["load.inclination"], hint: PAIR_WEIGHT }) : null,
  );
}

/** The end stops as positions of the load. */
function stopsText() {
  const r = run.value;
  if (!r) return "End stops, start";
  const { position_min: low, position_max: high } = r.limits, s = scaleOf("length", units.value);
  const asText = (/** @type {number} */ si) => number(toShown(si, s), 1);
  return `End stops: ${asText(low)} to ${asText(high)} ${s.unit}; start`;
}

/** How the load has come to rest, where dry friction leaves it a choice. */
function reachedField() {
  const start = run.value?.start, stated = at(drive.value, "start.reached");
  if (!stated && (start?.lowest ?? null) === null) return null;
  return choiceField(
    "Has come to rest",
    () => [["", "as without dry friction"], ["from below", "from below"], ["from above", "from above"]],
    () => at(drive.value, "start.reached") ?? "",
    (value) => setDrive("start.reached", value || undefined, `at rest ${value || "as without friction"}`),
    "start.reached",
  );
}

export function loadCard() {
  const stopped = anyGiven(
    "stops.min_contraction",
    "stops.max_contraction",
    "stops.restitution",
    "start.position",
    "start.reached",
  );
  return h(
    "section",
    { class: "card", "aria-label": "Load" },
    h("div", { class: "card-head" }, h("h2", null, "Load")),
    partMessage("load"),
    choiceField(
      "Arrangement",
      () => isJoint.value ? [...ARRANGEMENTS, JOINT] : ARRANGEMENTS,
      () => arrangement.value,
      arrange,
      "load.arrangement",
    ),
    () => isJoint.value ? jointText() : null,
    ...alongALine(stopped).map((child) => () =>
      isJoint.value ? null : typeof child === "function" ? child() : child
    ),
  );
}

const isJoint = computed(() => arrangement.value === "joint");

/** What a joint is made of. */
function jointText() {
  const own = at(drive.value, "load.joint"),
    muscles = own?.muscles?.length === 2 ? "Two muscles" : "One muscle";
  return h(
    "p",
    { class: "hint" },
    `${muscles} at levers that change with the angle. Levers, inertia, spring, link and stops are in the drive document.`,
  );
}

/** What moves along a line or on a pulley. @param {{value: boolean}} stopped */
function alongALine(stopped) {
  return [
    arrangementFields,
    signalFields({
      path: "load.force",
      quantity: "force",
      low: () => 0,
      high: 2000,
      rest: () => 0,
      full: 100,
      constant: true,
    }, "Force over time"),
    springFields,
    h(
      "details",
      { open: () => stopped.value },
      h("summary", null, stopsText),
      () =>
        arrangement.value === "antagonist"
          ? driveField("stops.min_contraction", { ...SPECS["stops.min_contraction"], hint: PAIR_STOP })
          : driveField("stops.min_contraction"),
      driveField("stops.max_contraction"),
      driveField("stops.restitution"),
      driveField("start.position"),
      reachedField,
    ),
  ];
}
