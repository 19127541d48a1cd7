// @ts-check
// Pulse-width modulation of switching valves.
import { at } from "../../../paths.js";
import { choiceField, driveField, partMessage } from "./fields.js";
import { drive, regulated, setDrive } from "../model.js";

/** @typedef {import("./fields.js").Spec} Spec */

const NONE = "none";
const START = { frequency: 50 };
/** @type {Record<string, Spec>} */
const SPECS = {
  "pwm.frequency": {
    label: "Carrier",
    symbol: "f_c",
    quantity: "frequency",
    bounds: [5, 500],
    log: true,
    hint: "The command is read at the start of each period.",
  },
  "pwm.min_on": { label: "Shortest pulse", quantity: "lapse", bounds: [0, 0.02], usual: 0 },
  "pwm.min_off": { label: "Shortest pause", quantity: "lapse", bounds: [0, 0.02], usual: 0 },
};

/** @param {string} valves */
function choose(valves) {
  if (valves === NONE) return setDrive("pwm", undefined, "no pulse width");
  const given = at(drive.peek(), "pwm") ?? START;
  setDrive("pwm", { ...given, valves }, "pulse width");
}

export const pulseWidth = () => [
  () =>
    regulated.value && !at(drive.value, "pwm") ? null : choiceField(
      "Pulse width",
      () => [
        [NONE, "None"],
        ["two", "Two valves: fill, vent"],
        ["one", "One 3/2 valve"],
      ],
      () => at(drive.value, "pwm") ? at(drive.value, "pwm.valves") ?? "two" : NONE,
      choose,
      "pwm.valves",
    ),
  partMessage("pwm"),
  () => at(drive.value, "pwm") ? Object.keys(SPECS).map((path) => driveField(path, SPECS[path])) : null,
];
