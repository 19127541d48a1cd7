// @ts-check
// Which parts of the catalogue may be used; none selected means the default choice.
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { presets } from "../../store.js";
import { openOnError } from "./fields.js";
import { fieldOf } from "./specs.js";
import { messageFor, setTask, valueAt } from "./model.js";

/** @typedef {import("../../types.js").Preset} Preset */

/** A valve without any flow figure, or a regulator, cannot be used. @param {Preset} p */
const usable = (p) =>
  p.kind !== "valve" || (!("regulator" in p) && Boolean(p.data?.sonic_conductance ?? p.data?.nominal_flow));

/** @param {"muscles" | "valves" | "tubes"} kind @param {string} usual the default choice */
export function partsField(kind, usual) {
  const path = `catalogue.${kind}`, { label: title, definition } = fieldOf(path);
  const chosen = computed(() => /** @type {string[]} */ (valueAt(path) ?? []));
  const offered = computed(() => (presets.value[kind] ?? []).filter(usable));
  /** @param {string} id @param {boolean} on */
  const tick = (id, on) => {
    const next = offered.peek().map((p) => p.id).filter((one) =>
      one === id ? on : chosen.peek().includes(one)
    );
    setTask(path, next.length ? next : undefined, title.toLowerCase());
  };
  return h(
    "details",
    { class: "parts-choice", "data-field": path, ref: openOnError([path]) },
    h(
      "summary",
      null,
      h("b", null, title),
      h("span", null, () => chosen.value.length ? chosen.value.join(", ") : usual),
    ),
    h(
      "fieldset",
      null,
      h("legend", { class: "hint" }, definition),
      () =>
        offered.value.map((p) =>
          h(
            "label",
            { class: "check" },
            h("input", {
              type: "checkbox",
              checked: () => chosen.value.includes(p.id),
              onchange: (/** @type {Event} */ e) =>
                tick(p.id, /** @type {HTMLInputElement} */ (e.target).checked),
            }),
            h(
              "span",
              null,
              p.id,
              p.verified ? null : h(
                "span",
                { class: "doubt", title: "Has unverified values" },
                icon("warn"),
                h("span", { class: "unseen" }, "unverified values"),
              ),
            ),
          )
        ),
    ),
    h("p", { class: "error" }, () => messageFor(path) ?? ""),
  );
}
