// @ts-check
// Opening a drive document: it replaces muscle, effects and drive in one undo step.
import { edit } from "../state.js";
import { partsOfDrive } from "./document.js";

/** @param {import("../types.js").Drive} document
 * @param {{label: string, scenario?: string | null, reference?: string | null}} o  `label` of the undo step;
 *   `scenario`: its id, if the document is one; `reference`: the points the model is compared with
 * @throws {Error} says what cannot be read */
export function openDrive(document, { label, scenario = null, reference = "auto" }) {
  const { muscle, effects, transient } = partsOfDrive(document, scenario);
  edit((d) => ({
    ...d,
    view: "transient",
    design: { ...d.design, muscle, effects, reference },
    transient: { ...d.transient, ...transient },
  }), label);
}
