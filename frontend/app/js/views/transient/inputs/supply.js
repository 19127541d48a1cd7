// @ts-check
// The air supply: pressure, valve or regulator, tube; from presets or entered values.
import { h } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { presets } from "../../../store.js";
import { siOf } from "../../../format.js";
import { unverifiedBadge } from "../../../ui/sources.js";
import { at } from "../../../paths.js";
import { choiceField, driveField, partMessage } from "./fields.js";
import { pulseWidth } from "./pulse-width.js";
import { muscleValves } from "./muscle-valves.js";
import { changePart, drive, numberAt, partPreset, regulated } from "../model.js";

const OWN = "own", NONE = "none";

/** @param {"valves" | "tubes"} kind @returns {[string, string][]} */
const partOptions = (kind) => (presets.value[kind] ?? []).map((p) => [p.id, p.title]);

/** Entered values start from those of the preset. @param {string} id */
function chooseValve(id) {
  if (id !== OWN) return changePart("valves", "valve", { preset: id }, `valve ${id}`);
  const answer = partPreset("valves", "valve.preset")?.data ?? {};
  const read = (/** @type {string} */ key) => answer[key] ? siOf(answer[key]) : undefined;
  const conductance = read("sonic_conductance") ?? 1e-8;
  changePart("valves", "valve", {
    sonic_conductance: conductance,
    exhaust_conductance: read("exhaust_conductance") ?? conductance,
    critical_pressure_ratio: read("critical_pressure_ratio") ?? 0.3,
  }, "own valve");
}

/** @param {string} id */
function chooseTube(id) {
  const length = numberAt("tube.length") ?? 1;
  if (id === NONE) return changePart("tubes", "tube", undefined, "no tube");
  if (id !== OWN) return changePart("tubes", "tube", { preset: id, length }, `tube ${id}`);
  const bore = partPreset("tubes", "tube.preset")?.data?.inside_diameter;
  changePart("tubes", "tube", { inside_diameter: bore ? siOf(bore) : 4e-3, length }, "own tube");
}

const valveId = computed(() => at(drive.value, "valve.preset") ?? OWN);
const tubeId = computed(() => at(drive.value, "tube") ? at(drive.value, "tube.preset") ?? OWN : NONE);
const hasOwnFlow = computed(() => numberAt("valve.sonic_conductance") !== null);

export function supplyCard() {
  return h(
    "section",
    { class: "card", "aria-label": "Air supply" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Air supply"),
      () => unverifiedBadge(partPreset("valves", "valve.preset"), "unverified"),
    ),
    driveField("supply.pressure"),
    choiceField(
      "Valve",
      () => [...partOptions("valves"), [OWN, "Own values"]],
      () => valveId.value,
      chooseValve,
      "valve.preset",
    ),
    partMessage("valve"),
    () =>
      valveId.value === OWN ? valveFields() : h(
        "details",
        { open: () => hasOwnFlow.value },
        h("summary", null, "Flow of the valve"),
        ...valveFields(),
      ),
    () =>
      regulated.value
        ? [
          ...["range", "time"].map((key) => driveField(`regulator.${key}`)),
          h(
            "details",
            null,
            h("summary", null, "Regulator in detail"),
            ...["damping", "band", "dead_band"].map((key) => driveField(`regulator.${key}`)),
          ),
        ]
        : null,
    ...pulseWidth(),
    choiceField(
      "Tube",
      () => [[NONE, "None"], ...partOptions("tubes"), [OWN, "Own values"]],
      () => tubeId.value,
      chooseTube,
      "tube.preset",
    ),
    () => {
      if (tubeId.value === NONE) return null;
      return [tubeId.value === OWN ? driveField("tube.inside_diameter") : null, driveField("tube.length")];
    },
    ...muscleValves(),
  );
}

const valveFields = () =>
  ["sonic_conductance", "exhaust_conductance", "critical_pressure_ratio"].map((key) =>
    driveField(`valve.${key}`)
  );
