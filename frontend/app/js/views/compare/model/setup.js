// @ts-check
// The model the measurement is compared with: muscle, start model, fitted geometry, noise of the data.
import { h, icon } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { commit, edit, preview, units } from "../../../state.js";
import { muscles } from "../../../store.js";
import { capitalized, plainScale, quantityOf, scaleOf, siOf, withUnit } from "../../../format.js";
import { quantityField } from "../../../ui/field.js";
import { unverifiedBadge } from "../../../ui/sources.js";
import { needsDrive } from "../drive-document.js";
import { infos, unknownMuscle } from "../measurement/files.js";
import { freeOfOther, PROVIDED, START, withStartModel } from "../document.js";
import {
  answer,
  chosen,
  compare,
  editCompare,
  fault,
  faultField,
  messageFor,
  patchCompare,
  preset,
  steps,
} from "../answers.js";
import { segments } from "../../../ui/segments.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */

const DEG = Math.PI / 180;
/** @type {Record<string, {label: string, quantity: Quantity, bounds: [number, number]}>} */
const GEOMETRY = {
  nominal_length: { label: "Length", quantity: "length", bounds: [0.02, 10] },
  braid_angle: { label: "Braid angle", quantity: "angle", bounds: [5 * DEG, 80 * DEG] },
  braid_diameter: { label: "Braid diameter", quantity: "length", bounds: [1e-3, 0.2] },
  inside_diameter: { label: "Inside diameter", quantity: "length", bounds: [1e-3, 0.2] },
  wall_thickness: { label: "Wall thickness", quantity: "length", bounds: [0, 0.02] },
};
/** Geometry that can be fitted. */
const FREE = ["braid_angle", "braid_diameter"];

/** @param {string} key */
function valueOf(key) {
  const set = compare.value.muscle.values[key];
  if (set !== undefined) return set;
  const ofPreset = preset.value?.geometry?.[key];
  return ofPreset ? siOf(ofPreset) : /** @type {any} */ (answer.value?.geometry)?.[key] ?? null;
}

/** @param {string} key */
function isChanged(key) {
  const set = compare.value.muscle.values[key], ofPreset = preset.value?.geometry?.[key];
  return set !== undefined && ofPreset !== undefined && Math.abs(set - siOf(ofPreset)) > 1e-9;
}

/** The files with another rest length, where the user said the same one for all of them; specimens with lengths of
 * their own keep them. @param {import("../../../types.js").Chosen[]} files @param {number | null} si */
function withRestLengthOf(files, si) {
  const said = files.flatMap(({ experiment }) => {
    const one = experiment?.rest_length;
    return one === undefined ? [] : [typeof one === "string" ? one : one.value];
  });
  if (new Set(said).size !== 1) return files;
  return files.map((file) => {
    const { rest_length: before, ...experiment } = file.experiment ?? {};
    if (before === undefined) return file;
    return { ...file, experiment: si === null ? experiment : { ...experiment, rest_length: `${si} m` } };
  });
}

/** @param {string} key @param {number | null} si null: that of the preset @param {boolean} [done] */
function put(key, si, done = true) {
  const { muscle, files } = compare.peek();
  const values = { ...muscle.values };
  if (si === null) delete values[key];
  else values[key] = si;
  const said = key === "nominal_length" ? { files: withRestLengthOf(files, si) } : {};
  preview(patchCompare({ muscle: { ...muscle, values }, ...said }));
  if (done) commit(GEOMETRY[key].label.toLowerCase());
}

/** @param {string} key */
const field = (key) =>
  quantityField({
    key: `compare.${key}`,
    label: GEOMETRY[key].label,
    quantity: GEOMETRY[key].quantity,
    slider: false,
    scale: () => scaleOf(GEOMETRY[key].quantity, units.value),
    bounds: () => GEOMETRY[key].bounds,
    get: () => valueOf(key),
    put: (si, done) => put(key, si, done),
    changed: () => isChanged(key),
    reset: () => put(key, null),
    message: () => messageFor(`muscle.${key}`),
  });

/** @param {string} key of what is fitted @param {string} name @param {Record<string, unknown>} [attributes] */
const freeBox = (key, name, attributes = {}) =>
  h(
    "label",
    { class: "check" },
    h("input", {
      type: "checkbox",
      ...attributes,
      checked: () => compare.value.free.includes(key),
      onchange: (/** @type {Event} */ e) => {
        const on = /** @type {HTMLInputElement} */ (e.target).checked;
        const free = compare.peek().free.filter((k) => k !== key);
        editCompare({ free: on ? [...free, key] : free }, `${on ? "fit" : "keep"} ${name}`);
      },
    }),
    h("span", null, `Fit the ${name} too`),
  );

/** Whether a file has runs that begin from a reading: under a measured pressure, without a valve command. */
const hasRuns = computed(() =>
  chosen.value.some(({ id }) => {
    const info = infos.value.get(id);
    return info
      ? info.kind === "transient" && !needsDrive(info)
      : answer.value?.kind === "transient" && !compare.value.drive;
  })
);
const FOUND = /^start of (the run|run \d+), fitted: /;

/** The starts that were found, in the words of the command line. */
const foundStarts = computed(() =>
  compare.value.free.includes(START)
    ? answer.value?.messages.filter((words) => FOUND.test(words)).map(capitalized) ?? []
    : []
);

/** Where and how fast runs begin: shown where there are some, and where other data refuse what was chosen. */
const starts = () => [
  h(
    "div",
    { class: "run-starts", hidden: () => !hasRuns.value && !compare.value.free.includes(START) },
    freeBox(START, "start of each run", { "aria-describedby": "compare-start-help" }),
    h(
      "p",
      { class: "hint", id: "compare-start-help" },
      "Stroke and speed at its first row, if the load moves there or the first reading is off.",
    ),
    () =>
      foundStarts.value.length
        ? h(
          "ul",
          { class: "plain muted", "aria-label": "Found starts" },
          ...foundStarts.value.map((words) => h("li", null, `${words}.`)),
        )
        : null,
  ),
  h("p", { class: "error" }, () => messageFor("free") ?? ""),
];

/** Changes the muscle, which starts again from the start model. @param {string} id "": own geometry */
function choose(id) {
  const { muscle } = compare.peek();
  const length = muscle.values.nominal_length;
  if (id) {
    const values = /** @type {Record<string, number>} */ (length ? { nominal_length: length } : {});
    return edit((d) => ({
      ...d,
      compare: { ...withStartModel(d.compare), muscle: { preset: id, form: "braid", values } },
    }), `muscle ${id}`);
  }
  const values = Object.keys(GEOMETRY).flatMap((key) => {
    const value = valueOf(key);
    return value === null ? [] : [[key, value]];
  });
  edit((d) => ({
    ...d,
    compare: {
      ...withStartModel(d.compare, "ideal"),
      muscle: { preset: null, form: "braid", values: Object.fromEntries(values) },
    },
  }), "own geometry");
}

/** File and muscle state different rest lengths: the user says which one is right. */
function lengthConflict() {
  const path = faultField() ?? "", error = fault.value;
  if (!error || !path.endsWith("experiment.rest_length")) return null;
  const file = chosen.value[Number(/measurements\.(\d+)/.exec(path)?.[1] ?? 0)];
  const stated = file && infos.value.get(file.id)?.conditions.nominal_length;
  const own = valueOf("nominal_length");
  const text = (/** @type {number} */ si) => withUnit(si, "length", units.value);
  /** The user's word for this file. @param {number} length */
  const say = (length) =>
    editCompare({
      files: compare.peek().files.map((f) =>
        f.id === file?.id ? { ...f, experiment: { ...f.experiment, rest_length: `${length} m` } } : f
      ),
    }, "rest length");
  return h(
    "div",
    { class: "flag note conflict", role: "alert" },
    icon("warn"),
    h(
      "div",
      null,
      h(
        "p",
        null,
        typeof stated === "number" && own !== null
          ? `${file.name} says a rest length of ${text(stated)}, the field says ${
            text(own)
          }. Which one is right?`
          : error.words,
      ),
      typeof stated === "number"
        ? h(
          "button",
          { type: "button", class: "link", onclick: () => put("nominal_length", stated) },
          `${text(stated)} is right, as the file says`,
        )
        : null,
      own === null
        ? null
        : h("button", { type: "button", class: "link", onclick: () => say(own) }, `${text(own)} is right`),
    ),
  );
}

function presetSelect() {
  return h("select", {
    id: "compare-preset",
    "aria-label": "Muscle that was measured",
    onchange: (/** @type {Event} */ e) => choose(/** @type {HTMLSelectElement} */ (e.target).value),
  }, () => [
    h("option", { value: "", selected: compare.value.muscle.preset === null }, "Own geometry"),
    ...muscles.value.map((m) =>
      h("option", { value: m.id, selected: m.id === compare.value.muscle.preset }, m.title)
    ),
  ]);
}

/** A muscle that a file names and that is not in the catalogue. */
const unknownName = computed(() => {
  for (const { id } of chosen.value) {
    const info = infos.value.get(id);
    const name = info && unknownMuscle(info);
    if (name) return name;
  }
  return null;
});

/** @type {["ideal" | "preset", string, string][]} */
const STARTS = [
  ["ideal", "Ideal", "Ideal braid without further effects"],
  ["preset", "Preset’s effects", "With the effects of the preset"],
];

/** Whether the start model came with a mystery or a drive document. */
const isProvided = () => (steps.value[0] ?? compare.value).label === PROVIDED;

const startChoice = () =>
  segments(
    "Start model",
    STARTS,
    () => compare.value.start === "ideal" && isProvided() ? null : compare.value.start,
    (id) => edit((d) => ({ ...d, compare: withStartModel(d.compare, id) }), `start from ${id}`),
  );

const noiseScale = () => {
  const unit = answer.value?.unit ?? "N";
  const quantity = quantityOf(unit);
  return quantity ? scaleOf(quantity, units.value) : plainScale(unit);
};

const noiseField = () =>
  quantityField({
    key: "noise",
    label: "Noise of the data (σ)",
    quantity: "force",
    slider: false,
    empty: "estimated",
    scale: noiseScale,
    get: () => compare.value.noise,
    put: (si) => editCompare({ noise: si }, "noise"),
    clear: () => editCompare({ noise: null }, "noise estimated"),
    message: () => messageFor("noise"),
  });

export function setupCard() {
  return h(
    "section",
    { class: "card", "aria-label": "Muscle and start model" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Muscle"),
      () => unverifiedBadge(preset.value, "unverified"),
    ),
    presetSelect(),
    h("p", { class: "error" }, () => messageFor("muscle.preset") ?? messageFor("measurement") ?? ""),
    () =>
      unknownName.value
        ? h(
          "p",
          { class: "flag note" },
          icon("info"),
          h(
            "span",
            null,
            `The file names the muscle “${unknownName.value}”, which is not in the catalogue. Check the muscle above.`,
          ),
        )
        : null,
    field("nominal_length"),
    lengthConflict,
    h(
      "details",
      null,
      h("summary", null, () => `Geometry${freeOfOther(compare.value.free).length ? ": fitted too" : ""}`),
      ...["braid_angle", "braid_diameter", "inside_diameter", "wall_thickness"].map(field),
      ...FREE.map((key) => freeBox(key, GEOMETRY[key].label.toLowerCase())),
    ),
    ...starts(),
    h("p", { class: "label" }, "Start model"),
    startChoice(),
    noiseField(),
    h(
      "p",
      { class: "hint" },
      () =>
        compare.value.noise === null && answer.value?.noise_how ? `Noise: ${answer.value.noise_how}.` : "",
    ),
  );
}
