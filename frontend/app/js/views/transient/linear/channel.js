// @ts-check
// Which input and output the linear view shows: of the command, the supply or the load, on what.
import { h } from "../../../dom.js";
import { arrangement } from "../model.js";
import { channel } from "./model.js";

/** @typedef {import("./model.js").Linear} Linear */

/** Name on the wire -> on screen. @type {Record<string, string>} */
const INPUTS = {
  command: "command",
  supply_pressure: "supply pressure",
  load_force: "external force",
};
/** @type {Record<string, string>} */
const OUTPUTS = {
  position: "position",
  velocity: "velocity",
  pressure: "pressure",
  force: "force of the muscle",
  mass_flow: "mass flow",
  position_reading: "reading of the sensor",
};
const SECOND = ", second muscle";
const isPair = () => arrangement.value === "antagonist";

/** @param {string} name */
function nameOf(name) {
  const own = name.replace(/^counter_/, "");
  return `${INPUTS[own] ?? OUTPUTS[own] ?? own}${own === name ? "" : SECOND}`;
}

/** @param {Linear} answer */
export const channelText = (answer) => `${nameOf(answer.input.name)} to ${nameOf(answer.output.name)}`;

/** @param {"input" | "output"} end @param {string} label @param {() => string[]} names */
const select = (end, label, names) =>
  h(
    "label",
    null,
    `${label} `,
    h("select", {
      "aria-label": `${label} which ${end}`,
      onchange: (/** @type {Event} */ e) => {
        channel.value = { ...channel.peek(), [end]: /** @type {HTMLSelectElement} */ (e.target).value };
      },
    }, () =>
      names().map((name) =>
        h("option", { value: name, selected: channel.value[end] === name }, nameOf(name))
      )),
  );

const outputs = () => {
  const own = Object.keys(OUTPUTS);
  return isPair() ? [...own, "counter_pressure", "counter_force", "counter_mass_flow"] : own;
};

export const channelFields = () =>
  h(
    "div",
    { class: "linear-row" },
    select("input", "From", () => [...Object.keys(INPUTS), ...(isPair() ? ["counter_command"] : [])]),
    select("output", "to", outputs),
  );
