// @ts-check
// The test rig of a transient measurement: valve, supply, load; from the Transient view or a drive document.
import { h, icon } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { commit, doc, edit, preview, units } from "../../../state.js";
import { presets } from "../../../store.js";
import { scaleOf } from "../../../format.js";
import { openDialog } from "../../../ui/dialog.js";
import { quantityField } from "../../../ui/field.js";
import { at, put } from "../../../paths.js";
import { siNumber } from "../../../quantities.js";
import { countedAt } from "../../../drive/document.js";
import { IDEAL, PROVIDED, withStartModel } from "../document.js";
import { driveFor, needsDrive, readDrive } from "../drive-document.js";
import { infos } from "../measurement/files.js";
import { chosen, compare, editCompare, messageFor, patchCompare } from "../answers.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */

const drive = computed(() => compare.value.drive);
const conditions = computed(() =>
  Object.assign({}, ...chosen.value.map(({ id }) => infos.value.get(id)?.conditions ?? {}))
);
/** Whether a file has a valve command. */
const wanted = computed(() =>
  chosen.value.some(({ id }) => {
    const info = infos.value.get(id);
    return info ? needsDrive(info) : false;
  })
);

const take = () =>
  editCompare(
    { drive: driveFor(doc.peek().transient.drive, conditions.peek()) },
    "rig of the Transient view",
  );

function openText() {
  const text = h("textarea", { rows: 14, "aria-label": "Drive document as JSON", spellcheck: "false" });
  const wrong = h("p", { class: "error", role: "alert" });
  const file = h("input", {
    type: "file",
    accept: ".json,application/json",
    "aria-label": "Open a drive document",
    onchange: async () => {
      text.value = await file.files?.[0]?.text() ?? text.value;
    },
  });
  const use = () => {
    try {
      const read = readDrive(text.value);
      const { muscle, effects } = read, { start_pressure: begun } = conditions.peek();
      const drive = { ...(begun === undefined ? {} : { start_pressure: begun }), ...read.drive };
      const start = effects ? { effects, label: Object.keys(effects).length ? PROVIDED : IDEAL } : {};
      edit((d) => {
        const c = effects ? withStartModel(d.compare, "ideal") : d.compare;
        return { ...d, compare: { ...c, drive, muscle, ...start } };
      }, "drive document");
      dialog.close();
    } catch (error) {
      wrong.textContent = `This drive document cannot be used: ${/** @type {Error} */ (error).message}.`;
    }
  };
  if (drive.peek()) text.value = JSON.stringify({ schema: 1, muscle: {}, ...drive.peek() }, null, 2);
  const dialog = openDialog(
    { title: "Drive document" },
    h("p", { class: "muted" }, "As exported by the Transient view: muscle, supply, valve, tube, load."),
    file,
    text,
    wrong,
    h(
      "div",
      { class: "foot" },
      h("button", { type: "button", class: "primary", onclick: use }, "Use this drive"),
    ),
  );
}

/** @param {string} path @param {string} label @param {Quantity} quantity @param {string} [empty] */
const field = (path, label, quantity, empty) =>
  quantityField({
    key: `rig.${path}`,
    label,
    quantity,
    empty,
    slider: false,
    scale: () => scaleOf(quantity, units.value),
    get: () => siNumber(at(drive.value ?? {}, path), countedAt(drive.value ?? {}, path)),
    counted: () => countedAt(drive.peek() ?? {}, path),
    put: (si, done) => {
      preview(patchCompare({ drive: put(compare.peek().drive ?? {}, path, si) }));
      if (done) commit(label.toLowerCase());
    },
    message: () => messageFor(`drive.${path}`),
  });

const valveSelect = () =>
  h(
    "div",
    { class: "field choice" },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: "rig-valve" }, "Valve"),
      h("select", {
        id: "rig-valve",
        onchange: (/** @type {Event} */ e) => {
          const id = /** @type {HTMLSelectElement} */ (e.target).value;
          if (id) {
            editCompare({ drive: put(compare.peek().drive ?? {}, "valve", { preset: id }) }, `valve ${id}`);
          }
        },
      }, () => {
        const now = at(drive.value ?? {}, "valve.preset");
        return [
          now ? null : h("option", { value: "", selected: true }, "Own values"),
          ...(presets.value.valves ?? []).map((p) =>
            h("option", { value: p.id, selected: p.id === now }, p.title)
          ),
        ];
      }),
    ),
    h("p", { class: "error" }, () => messageFor("drive.valve") ?? ""),
  );

/** Shown if the data need a rig, or if there is one. */
export function rigCard() {
  if (!wanted.value && !drive.value) return null;
  return h(
    "section",
    { class: "card", "aria-label": "Rig" },
    h("div", { class: "card-head" }, h("h2", null, "Rig")),
    () =>
      drive.value ? null : h(
        "p",
        { class: "flag note" },
        icon("info"),
        h(
          "span",
          null,
          "The file has a valve command. Valve, supply and load are needed to simulate it.",
        ),
      ),
    h("p", { class: "error" }, () => (messageFor("drive") && !drive.value ? messageFor("drive") : "") ?? ""),
    () =>
      drive.value
        ? [
          valveSelect(),
          field("supply.pressure", "Supply pressure", "pressure"),
          field("start_pressure", "Start pressure", "pressure", "0"),
          field("load.mass", "Mass", "mass"),
          field("tube.length", "Tube length", "length", "no tube"),
          field("stops.max_contraction", "Upper stop", "ratio"),
        ]
        : null,
    h("button", { type: "button", class: "link", onclick: take }, "Use the rig of the Transient view"),
    h("button", { type: "button", class: "link", onclick: openText }, "Drive document…"),
  );
}
