// @ts-check
// Files, muscle, rig and noise: a panel under the strip, which lies over the page so that nothing moves.
import { h, icon } from "../../dom.js";
import { signal } from "../../reactive.js";
import { goToField } from "../../ui/fault.js";

const opened = signal(false);
/** @type {HTMLElement | null} */
let came = null;

/** Field of the experiment -> key of its field in the panel. @type {Record<string, string>} */
const KEYS = {
  muscle: "compare-preset",
  rest_length: "compare.nominal_length",
  load: "rig.load.mass",
  supply: "rig.supply.pressure",
  tube: "rig.tube.length",
  valve: "rig-valve",
  stops: "rig.stops.max_contraction",
};

/** Whether the panel has a field. @param {string} key */
export const setupHas = (key) => /^(compare|rig|noise)/.test(key);

/** Opens the panel at a field of the experiment, at the "files", or where it begins. @param {string} field */
export function openSetup(field) {
  came = /** @type {HTMLElement | null} */ (document.activeElement);
  opened.value = true;
  const panel = /** @type {HTMLElement | null} */ (document.querySelector(".setup-panel"));
  const below = document.querySelector(".strip")?.getBoundingClientRect().bottom ?? 0;
  panel?.style.setProperty("--below", `${Math.max(0, below)}px`);
  if (!field || field === "files" || !goToField(KEYS[field] ?? field, ".setup-panel")) {
    /** @type {HTMLElement | null | undefined} */ (panel?.querySelector("button, select, input"))?.focus();
  }
}

function close() {
  opened.value = false;
  came?.focus({ preventScroll: true });
}

/** @param {import("../../dom.js").Child[]} cards */
export const setupPanel = (...cards) =>
  h(
    "div",
    {
      class: "setup-panel",
      role: "dialog",
      "aria-label": "Files and experiment",
      hidden: () => !opened.value,
      onkeydown: (/** @type {KeyboardEvent} */ e) => {
        if (e.key !== "Escape" || document.querySelector("[popover]:popover-open")) return;
        e.stopPropagation();
        close();
      },
    },
    h("button", {
      type: "button",
      class: "mini setup-close",
      "aria-label": "Close files and experiment",
      onclick: close,
    }, icon("close")),
    h("div", { class: "setup-cards" }, ...cards),
  );
