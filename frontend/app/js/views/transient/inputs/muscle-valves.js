// @ts-check
// Valves on the muscle: flow control and quick exhaust, with entered values only.
import { at } from "../../../paths.js";
import { siOf } from "../../../format.js";
import { choiceField, driveField, partMessage } from "./fields.js";
import { drive, numberAt, partPreset, setDrive } from "../model.js";

/** @typedef {import("./fields.js").Spec} Spec */

const NONE = "none", QUICK = "quick";
/** @type {[number, number]} */
const CONDUCTANCES = [1e-10, 1e-7];
/** Shares of the conductance of the valve that new parts start with. */
const THROTTLED = 0.3, QUICKER = 3;

/** @type {Record<string, Spec>} */
const SPECS = {
  "flow_control.sonic_conductance": {
    label: "Conductance, throttled",
    symbol: "C_t",
    quantity: "conductance",
    bounds: CONDUCTANCES,
    log: true,
    hint: "As the screw is set.",
  },
  "flow_control.free_conductance": {
    label: "Conductance, free direction",
    quantity: "conductance",
    bounds: CONDUCTANCES,
    log: true,
    slider: false,
    empty: "free",
    hint: "Of the check valve.",
  },
  "flow_control.critical_pressure_ratio": {
    label: "Critical ratio",
    quantity: "number",
    bounds: [0.05, 0.6],
    usual: 0.3,
  },
  "quick_exhaust.sonic_conductance": {
    label: "Conductance, quick exhaust",
    symbol: "C_q",
    quantity: "conductance",
    bounds: CONDUCTANCES,
    log: true,
  },
  "quick_exhaust.critical_pressure_ratio": {
    label: "Critical ratio",
    quantity: "number",
    bounds: [0.05, 0.6],
    usual: 0.3,
  },
  "quick_exhaust.band": {
    label: "Fully open at",
    quantity: "pressure",
    bounds: [1e2, 1e5],
    log: true,
    usual: 1e4,
    hint: "Pressure in the muscle above that in the tube. 0.1 bar is an estimate.",
  },
};
const fields = (/** @type {string} */ part) =>
  Object.keys(SPECS).filter((path) => path.startsWith(`${part}.`)).map((path) =>
    driveField(path, SPECS[path])
  );

/** The conductance that a new part starts with. @param {number} share */
function startOf(share) {
  const figure = partPreset("valves", "valve.preset")?.data?.sonic_conductance;
  return share * (numberAt("valve.sonic_conductance") ?? (figure ? siOf(figure) : 1e-8));
}

/** @param {string} meter */
function chooseControl(meter) {
  if (meter === NONE) return setDrive("flow_control", undefined, "no flow control");
  const given = at(drive.peek(), "flow_control") ?? { sonic_conductance: startOf(THROTTLED) };
  setDrive("flow_control", { ...given, meter }, `flow control meter-${meter}`);
}

/** @param {string} choice */
function chooseQuick(choice) {
  const part = choice === NONE ? undefined : { sonic_conductance: startOf(QUICKER) };
  setDrive("quick_exhaust", part, part ? "quick exhaust" : "no quick exhaust");
}

export const muscleValves = () => [
  choiceField(
    "Flow control",
    () => [[NONE, "None"], ["in", "Meter-in: throttles filling"], ["out", "Meter-out: throttles venting"]],
    () => at(drive.value, "flow_control.meter") ?? NONE,
    chooseControl,
    "flow_control.meter",
  ),
  partMessage("flow_control"),
  () => at(drive.value, "flow_control") ? fields("flow_control") : null,
  choiceField(
    "Quick exhaust",
    () => [[NONE, "None"], [QUICK, "On the muscle"]],
    () => at(drive.value, "quick_exhaust") ? QUICK : NONE,
    chooseQuick,
    "quick_exhaust",
  ),
  () => at(drive.value, "quick_exhaust") ? fields("quick_exhaust") : null,
];
