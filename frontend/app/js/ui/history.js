// @ts-check
// Undo and redo with a word in the status line.
import { redo, undo } from "../state.js";
import { status } from "../store.js";

/** @param {string | null} step @param {string} verb */
function report(step, verb) {
  if (step) status.value = `${verb}: ${step}`;
}

export const undoAndReport = () => report(undo(), "Undone");
export const redoAndReport = () => report(redo(), "Redone");
