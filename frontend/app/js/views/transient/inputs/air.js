// @ts-check
// The air in the muscle: energy balance or polytropic exponent, temperature, volumes, initial pressure.
import { h } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { number } from "../../../format.js";
import { at } from "../../../paths.js";
import { choiceField, driveField } from "./fields.js";
import { baseDrive, drive, numberAt, run, setDrive } from "../model.js";

/** @typedef {"energy" | "polytropic"} Closure */

const USUAL_EXPONENT = 1.2;
const BALANCE = "gas.wall_heat_transfer", EXPONENT = "gas.polytropic_exponent";

/** @type {[Closure, string][]} */
const CLOSURES = [["energy", "Energy balance"], ["polytropic", "Polytropic exponent"]];

/** @type {import("../../../reactive.js").Signal<Closure>} */
const closure = computed(() => (at(drive.value, EXPONENT) ?? null) === null ? "energy" : "polytropic");

/** The other closure, with the value of the scenario if it has one; the field of the old one leaves the document.
 * @param {Closure} next */
function close(next) {
  const { polytropic_exponent: _n, wall_heat_transfer: _h, ...rest } = drive.peek().gas ?? {};
  const base = (/** @type {string} */ path) => at(baseDrive.peek(), path) ?? undefined;
  const value = next === "polytropic"
    ? { polytropic_exponent: base(EXPONENT) ?? USUAL_EXPONENT }
    : base(BALANCE) === undefined
    ? {}
    : { wall_heat_transfer: base(BALANCE) };
  setDrive("gas", { ...rest, ...value }, next === "energy" ? "energy balance" : "polytropic exponent");
}

/** Whether an effect exchanges the heat: the fields of this card then have no influence on it. */
const byEffect = computed(() => /\bof the effect\b/.test(run.value?.gas ?? ""));

function summary() {
  const used = byEffect.value
    ? "energy balance with an effect"
    : closure.value === "energy"
    ? "energy balance"
    : `exponent ${number(numberAt(EXPONENT) ?? USUAL_EXPONENT, 3)}`;
  return `Air: ${used}, temperature, initial pressure`;
}

const OTHERS = ["gas.temperature", "gas.dead_volume", "gas.ambient_pressure", "start_pressure"];

export function airCard() {
  return h(
    "section",
    { class: "card", "aria-label": "Air and start" },
    h(
      "details",
      null,
      h("summary", null, summary),
      choiceField("Air model", () => CLOSURES, () => closure.value, close, "gas"),
      () =>
        byEffect.value
          ? h(
            "p",
            { class: "hint" },
            "An effect describes the heat exchange; the value below is not used while it is on.",
          )
          : null,
      () => driveField(closure.value === "energy" ? BALANCE : EXPONENT),
      ...OTHERS.map((path) => driveField(path)),
    ),
  );
}
