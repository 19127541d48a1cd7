// @ts-check
// The inputs of the Transient view: scenario, muscle, air supply, load, command or controller, surroundings.
import { h } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { design, showMuscle } from "../../../muscle/document.js";
import { siOf, withUnit } from "../../../format.js";
import { effectsRow } from "../../../muscle/effects.js";
import { preset } from "../../../muscle/preset.js";
import { studyTolerance } from "../../../drive/study.js";
import { driveField, partMessage } from "./fields.js";
import {
  arrangement,
  editTransient,
  messageWithin,
  mode,
  muscleName,
  presetEffects,
  regulated,
  run,
  scenario,
  scenarios,
  transient,
  untouched,
  useScenario,
} from "../model.js";
import { airCard } from "./air.js";
import { loadCard } from "./load.js";
import { setPointFields } from "./set-points.js";
import { signalFields } from "./signals.js";
import { supplyCard } from "./supply.js";
import { segments } from "../../../ui/segments.js";

function scenarioField() {
  return h(
    "div",
    { class: "scenario" },
    h("select", {
      id: "scenario",
      "aria-label": "Scenario",
      onchange: (/** @type {Event} */ e) => useScenario(/** @type {HTMLSelectElement} */ (e.target).value),
    }, () => [
      h(
        "option",
        { value: "", selected: !scenario.value },
        scenarios.value.length ? "Own drive" : "No scenarios on this server",
      ),
      ...scenarios.value.map((s) =>
        h(
          "option",
          { value: s.id, selected: s.id === transient.value.scenario },
          s === scenario.value && !untouched.value ? `Changed from: ${s.title}` : s.title,
        )
      ),
    ]),
    () => {
      const words = untouched.value
        ? scenario.value?.description
        : "The drive below is no longer that of the scenario.";
      return words ? h("p", { class: "hint" }, words) : null;
    },
    () =>
      scenario.value
        ? h(
          "button",
          { type: "button", class: "link", onclick: () => useScenario(scenario.peek()?.id ?? "") },
          "Reset to the scenario",
        )
        : null,
  );
}

const lengthText = computed(() => {
  const set = design.value.muscle.values.nominal_length;
  const ofPreset = preset.value?.geometry?.nominal_length;
  const length = set ?? (ofPreset ? siOf(ofPreset) : run.value?.geometry.nominal_length);
  return length ? withUnit(length, "length", units.value) : "";
});

function muscleLine() {
  return h(
    "div",
    { class: "part" },
    h("span", null, "Muscle"),
    h("b", { id: "drive-muscle" }, () => [muscleName.value, lengthText.value].filter(Boolean).join(" · ")),
    h("button", { type: "button", class: "link", onclick: showMuscle }, "Change in Design"),
    h("p", { class: "error" }, () => messageWithin("muscle") ?? ""),
  );
}

/** @type {["command" | "controller", string, string][]} */
const MODES = [
  ["command", "Command", "The valve follows a signal"],
  ["controller", "Controller", "A PID controller moves the valve so that the position follows a reference"],
];

function commandCard() {
  const body = () => {
    if (mode.value === "controller") {
      return [
        partMessage("controller"),
        ...["kp", "ki", "kd"].map((key) => driveField(`controller.${key}`)),
        h(
          "details",
          null,
          h("summary", null, "Feed forward, sampling, limits"),
          ...["feed_forward", "derivative_filter", "sample_time", "output_min", "output_max"].map((key) =>
            driveField(`controller.${key}`)
          ),
        ),
        ...setPointFields(),
      ];
    }
    return signalFields({
      path: "command",
      quantity: "ratio",
      low: () => regulated.value ? 0 : -1,
      high: 1,
      rest: () => regulated.value ? 0 : -1,
      full: 1,
    }, "Shape");
  };
  return h(
    "section",
    { class: "card", "aria-label": "Command" },
    segments("Control of the valve", MODES, () => mode.value, (id) => editTransient({ mode: id }, id)),
    driveField("duration"),
    body,
    () =>
      mode.value === "command"
        ? h(
          "p",
          { class: "hint" },
          regulated.value ? "Share of the regulator’s range." : "100 % fills, 0 % is closed, −100 % vents.",
          arrangement.value !== "antagonist"
            ? null
            : regulated.value
            ? " The second muscle gets the rest of the range."
            : " The second muscle gets the opposite.",
        )
        : null,
  );
}

export function inputCards() {
  return [
    h(
      "section",
      { class: "card", "aria-label": "Drive" },
      h("div", { class: "card-head" }, h("h2", null, "Drive")),
      scenarioField(),
      muscleLine(),
      h(
        "button",
        {
          type: "button",
          class: "block",
          title: "Monte Carlo of load, supply pressure and length",
          onclick: () => studyTolerance("drive"),
        },
        "How much does tolerance matter?",
      ),
    ),
    commandCard(),
    loadCard(),
    supplyCard(),
    airCard(),
  ];
}

export const driveEffects = () =>
  effectsRow("transient", {
    preset: presetEffects,
    active: computed(() => design.value.effects ?? presetEffects.value),
    defaults: () => run.value?.model.defaults,
    message: messageWithin,
  });
