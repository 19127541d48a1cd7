// @ts-check
// An order code: typed or pasted, it sets preset and length. The server knows what its parts mean.
import { h } from "../../dom.js";
import { design, editDesign } from "../../muscle/document.js";
import { computed, signal } from "../../reactive.js";
import { ApiError, get } from "../../server/client.js";

/** @typedef {import("../../types.js").OrderCode} OrderCode */
/** @typedef {{code: string, error: ApiError}} Refused */

/** The newest answer, while the muscle is the one it names. */
const ordered = signal(/** @type {OrderCode | null} */ (null));
const refused = signal(/** @type {Refused | null} */ (null));
const shown = computed(() => {
  const said = ordered.value, { preset, values } = design.value.muscle;
  return said && preset === said.preset && values.nominal_length === said.nominal_length ? said : null;
});
let asked = "";

/** @param {string} text */
async function read(text) {
  const code = text.trim();
  asked = code;
  if (code === "") return void (refused.value = null);
  try {
    const said = /** @type {OrderCode} */ (await get(`/api/order-codes/${encodeURIComponent(code)}`));
    if (asked !== code) return;
    refused.value = null;
    ordered.value = said;
    const values = { nominal_length: said.nominal_length };
    const muscle = { preset: said.preset, form: /** @type {const} */ ("braid"), values };
    editDesign({ muscle, effects: null, reference: "auto" }, `order code ${code}`);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    if (asked === code) refused.value = { code, error };
  }
}

/** The code with the part that is not understood marked: "code.2" is the third one. @param {Refused} one */
function marked({ code, error }) {
  const place = /^code\.(\d+)$/.exec(error.field ?? "")?.[1];
  if (place === undefined) return null;
  return h(
    "span",
    { class: "code" },
    ...code.split("-").flatMap((part, i) => [
      i > 0 ? "-" : null,
      String(i) === place ? h("mark", null, part) : part,
    ]),
  );
}

export function orderCodeField() {
  return h(
    "div",
    { class: () => `field order-code${refused.value ? " wrong" : ""}`, "data-field": "order_code" },
    h("div", { class: "field-head" }, h("label", { for: "order-code" }, "Order code")),
    h("input", {
      id: "order-code",
      type: "text",
      autocomplete: "off",
      autocapitalize: "characters",
      spellcheck: "false",
      placeholder: "DMSP-20-300N-RM-CM",
      title: "Sets preset and length of a fluidic muscle",
      "aria-invalid": () => refused.value ? "true" : null,
      "aria-describedby": "order-code-said",
      onchange: (/** @type {Event} */ e) => read(/** @type {HTMLInputElement} */ (e.target).value),
      oninput: (/** @type {InputEvent} */ e) => {
        if (e.inputType === "insertFromPaste") read(/** @type {HTMLInputElement} */ (e.target).value);
      },
    }),
    h("div", { id: "order-code-said", "aria-live": "polite" }, () => {
      const fault = refused.value, said = shown.value;
      if (fault) return h("p", { class: "error" }, marked(fault), " ", fault.error.words);
      return said
        ? h(
          "dl",
          { class: "code-parts muted" },
          ...said.parts.flatMap(({ text, meaning }) => [
            h("dt", { class: "code" }, text),
            h("dd", null, meaning),
          ]),
        )
        : null;
    }),
  );
}
