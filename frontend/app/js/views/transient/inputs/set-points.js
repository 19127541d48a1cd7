// @ts-check
// What a controller follows: a position, or the angle of a joint, or its angle and its stiffness.
import { h } from "../../../dom.js";
import { at, isObject } from "../../../paths.js";
import { arrangement, drive, run, setDrive } from "../model.js";
import { choiceField, driveField } from "./fields.js";
import { signalFields } from "./signals.js";

/** @typedef {"position" | "angle" | "both"} Followed */

/** @type {[Followed, string][]} */
const FOLLOWED = [["position", "Position"], ["angle", "Angle"], ["both", "Angle and stiffness"]];
const USUAL_ANGLE = { shape: "square", level: 0.17, initial: 0, period: 2 };
const USUAL_STIFFNESS = { reference: 20 };
const USUAL_POSITION = { shape: "triangle", amplitude: 0.02, period: 1 };

/** @returns {Followed} */
function followed() {
  const controller = at(drive.value, "controller");
  if (controller?.stiffness && controller?.angle !== undefined) return "both";
  return controller?.angle === undefined ? "position" : "angle";
}

/** Before a pair becomes another arrangement: there is no joint to follow. */
export function followPosition() {
  const controller = at(drive.peek(), "controller");
  if (controller?.angle !== undefined || controller?.stiffness) follow("position", false);
}

/** @param {Followed} next @param {boolean} [done] */
function follow(next, done = true) {
  const controller = at(drive.peek(), "controller");
  const { reference, angle, stiffness, output_min: _low, output_max: _high, ...rest } = isObject(controller)
    ? controller
    : {};
  /** @type {Record<string, unknown>} */
  const points = next === "position" ? { reference: reference ?? USUAL_POSITION } : {
    angle: angle ?? USUAL_ANGLE,
    ...(next === "both" ? { stiffness: stiffness ?? USUAL_STIFFNESS } : {}),
  };
  setDrive("controller", { ...rest, ...points }, `set points: ${next}`, done);
}

const positionFields = () =>
  signalFields({
    path: "controller.reference",
    quantity: "length",
    low: () => 0,
    high: Math.max(run.peek()?.limits.position_max ?? 0.05, 0.01),
    rest: () => 0,
    full: Number((0.6 * (run.peek()?.limits.position_max ?? 0.03)).toPrecision(2)),
  }, "Reference");

const angleFields = () =>
  signalFields({
    path: "controller.angle",
    quantity: "angle",
    low: () => -0.5,
    high: 0.5,
    rest: () => 0,
    full: 0.17,
    constant: true,
  }, "Angle over time");

const stiffnessFields = () => [
  signalFields({
    path: "controller.stiffness.reference",
    quantity: "rotary",
    low: () => 0,
    high: 100,
    rest: () => 20,
    full: 25,
    constant: true,
  }, "Stiffness over time"),
  h(
    "details",
    null,
    h("summary", null, "Gains of the stiffness"),
    driveField("controller.stiffness.kp"),
    driveField("controller.stiffness.ki"),
  ),
];

/** The set points of the controller. @returns {HTMLElement[]} */
export function setPointFields() {
  if (arrangement.value !== "antagonist") return [positionFields()];
  const now = followed();
  return [
    choiceField("Set points", () => FOLLOWED, followed, follow, "controller.follows"),
    now === "position" ? positionFields() : angleFields(),
    ...(now === "both" ? stiffnessFields() : []),
  ];
}
