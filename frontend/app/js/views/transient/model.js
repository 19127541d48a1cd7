// @ts-check
// The drive, and its run by the server.
import { computed } from "../../reactive.js";
import { commit, doc, edit, look, preview, view } from "../../state.js";
import { design, muscleInput } from "../../muscle/document.js";
import { fieldMessages, post } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { presets, status } from "../../store.js";
import { openDrive } from "../../drive/open.js";
import { preset, presetEffects as muscleEffects } from "../../muscle/preset.js";
import { defaultTransient } from "./document.js";
import { arrangementOf, countedAt, driveDocument, inSi, partsOfDrive } from "../../drive/document.js";
import { at, isObject, put } from "../../paths.js";
import { siNumber } from "../../quantities.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../types.js").Preset} Preset */
/** @typedef {import("../../types.js").Drive} Drive */
/** @typedef {import("../../types.js").Transient} Transient */

const POINTS = 401, USUAL_DURATION = 4;

export const transient = computed(() => doc.value.transient);
export const drive = computed(() => transient.value.drive);
export const mode = computed(() => transient.value.mode);

// ---- changing the document

/** @typedef {import("../../types.js").Doc} Doc */
/** @param {Partial<Transient>} patch @returns {(d: Doc) => Doc} */
const patchTransient = (patch) => (d) => ({ ...d, transient: { ...d.transient, ...patch } });
/** @param {Partial<Transient>} patch @param {string} label */
export const editTransient = (patch, label) => edit(patchTransient(patch), label);
/** Changes what is shown, without an undo step. @param {Partial<Transient>} patch */
export const lookTransient = (patch) => look(patchTransient(patch));

/** Parts that say nothing when they are empty. */
const OPTIONAL = ["gas", "stops", "start"];
/** @param {Drive} drive @returns {Drive} */
const withoutEmpty = (drive) =>
  OPTIONAL.reduce(
    (rest, key) => isObject(rest[key]) && !Object.keys(rest[key]).length ? put(rest, key, undefined) : rest,
    drive,
  );

/** @param {string} path @param {unknown} value undefined removes it @param {string} label
 * @param {boolean} [done] false while a slider still moves @param {(drive: Drive) => string} [text] the value in words */
export function setDrive(path, value, label, done = true, text = undefined) {
  preview((d) => ({
    ...d,
    transient: { ...d.transient, drive: withoutEmpty(put(d.transient.drive, path, value)) },
  }));
  if (done) commit(label, text && ((d) => text(d.transient.drive)));
}

/** A number of the drive in SI; null: not given. @param {string} path @returns {number | null} */
export const numberAt = (path) => siNumber(at(drive.value, path), countedAt(drive.value, path));

export const arrangement = computed(() => arrangementOf(drive.value.load));

/** The part of a window that lies in a run; null: all of it.
 * @param {[number, number] | null} range @param {number} duration @returns {[number, number] | null} */
export function within(range, duration) {
  if (!range || range[0] >= duration) return null;
  return range[1] <= duration ? range : [range[0], duration];
}

/** The duration of the run [s]. @param {Transient} t */
const durationOf = (t) => siNumber(t.drive.duration) ?? USUAL_DURATION;
export const duration = computed(() => durationOf(transient.value));
/** @param {Transient} t */
const windowOf = (t) => within(t.window, durationOf(t));
/** The time window shown; null: the whole run. */
export const timeWindow = computed(() => windowOf(transient.value));

/** The preset of a part of the drive. @param {"valves" | "tubes"} kind @param {string} path */
export const partPreset = (kind, path) =>
  (presets.value[kind] ?? []).find((p) => p.id === at(drive.value, path)) ?? null;

/** @param {Preset | null} p @returns {Record<string, Record<string, number>>} */
const effectsOf = (p) => /** @type {any} */ (inSi(Object.fromEntries(
  Object.entries(p?.effects ?? {}).map(([id, values]) => [
    id,
    Object.fromEntries(
      Object.entries(values).map(([key, q]) => [key, `${q.value} ${q.unit === "1" ? "" : q.unit}`]),
    ),
  ]),
)));

/** The effects that come with the presets of muscle, valve and tube, unless the user chooses effects. */
export const presetEffects = computed(() => ({
  ...muscleEffects.value,
  ...effectsOf(partPreset("valves", "valve.preset")),
  ...effectsOf(partPreset("tubes", "tube.preset")),
}));

/** Changes valve or tube. If the user chose effects, those of the old part are replaced by those of the new one.
 * @param {"valves" | "tubes"} kind @param {string} path @param {object | undefined} part
 * @param {string} label */
export function changePart(kind, path, part, label) {
  const find = (/** @type {unknown} */ id) => (presets.peek()[kind] ?? []).find((p) => p.id === id) ?? null;
  const old = effectsOf(find(at(drive.peek(), `${path}.preset`)));
  const next = effectsOf(find(/** @type {any} */ (part)?.preset));
  edit((d) => {
    const { effects } = d.design;
    const kept = effects && Object.fromEntries(Object.entries(effects).filter(([id]) => !(id in old)));
    const chosen = kept && { ...kept, ...next };
    const changed = put(d.transient.drive, path, part);
    return { ...d, design: { ...d.design, effects: chosen }, transient: { ...d.transient, drive: changed } };
  }, label);
}

/** Whether a pressure regulator is commanded, by a share of its range, instead of a valve opening. */
export const regulated = computed(() =>
  Boolean(
    at(drive.value, "regulator") ?? /** @type {any} */ (partPreset("valves", "valve.preset"))?.regulator,
  )
);

// ---- scenarios

export const scenarios = computed(() => presets.value.drives ?? []);
export const scenario = computed(() =>
  scenarios.value.find((s) => s.id === transient.value.scenario) ?? null
);

/** The scenario as it was loaded; null without one, and for one that cannot be read, which is not loaded. */
const loaded = computed(() => {
  const document = scenario.value?.document;
  try {
    return document ? partsOfDrive(document, null) : null;
  } catch {
    return null;
  }
});

const start = defaultTransient().drive;
/** What fields are compared with and reset to: the scenario as it was loaded, else the default drive.
 * @type {import("../../reactive.js").Signal<Drive>} */
export const baseDrive = computed(() => loaded.value?.transient.drive ?? start);

/** @param {string} id */
export function useScenario(id) {
  const chosen = scenarios.peek().find((s) => s.id === id);
  if (!chosen?.document) return lookTransient({ scenario: null });
  try {
    openDrive(chosen.document, { label: `scenario ${chosen.title}`, scenario: id });
    status.value = [chosen.title, chosen.description].filter(Boolean).join(": ");
  } catch (error) {
    status.value = `“${chosen.title}” cannot be opened: ${/** @type {Error} */ (error).message}.`;
  }
}

/** Whether muscle, effects and drive are still those of the scenario; its words hold for no other. */
export const untouched = computed(() => {
  if (!loaded.value) return true;
  const { muscle, effects, transient: part } = loaded.value;
  const opened = driveDocument({ ...transient.value, ...part }, muscleInput(muscle), effects);
  return sorted(opened) === sorted(documentNow());
});
/** A document as a text in which the order of its keys does not matter. @param {Drive} document */
const sorted = (document) =>
  JSON.stringify(
    document,
    (_, part) => isObject(part) ? Object.fromEntries(Object.entries(part).sort()) : part,
  );

// ---- the run

/** The drive as the server and the command line take it. @returns {Drive} */
export const documentNow = () =>
  driveDocument(transient.value, muscleInput(design.value.muscle), design.value.effects);

/** The request for a run: the drive, and the time window. @param {Drive} document
 * @param {[number, number] | null} rows */
export const runRequest = (document, rows) => ({
  drive: document,
  points: POINTS,
  static: true,
  ...(rows ? { from: rows[0], to: rows[1] } : {}),
});

/** @param {unknown} body @param {AbortSignal} [signal] @returns {Promise<Run>} */
export const simulate = (body, signal) => post("/api/simulations", body, signal);

const runQuestion = new Question((text, signal) => simulate(JSON.parse(text), signal));
/** The newest run, why there is no newer one (the plots then keep the last one, dimmed), and how long its request
 * took [ms]. */
export const { answer: run, error: fault, stale, took: roundTrip } = runQuestion;
/** Asks once more, after the server was away. */
export const retry = () => runQuestion.again();

/** The field of the page for a path of the request. @param {string} path */
const fieldOf = (path) => path.replace(/^drive\./, "").replace(/^effects\./, "");
export const { field: faultField, at: messageFor, within: messageWithin } = fieldMessages(
  () => fault.value,
  fieldOf,
);

/** The name of the muscle. */
export const muscleName = computed(() => preset.value?.title ?? "Own geometry");

/** Nothing is asked while another view is shown. */
export const shownNow = computed(() => view.value === "transient");

/** Starts asking; called once, when the view is built. */
export const startRuns = () =>
  runQuestion.follow(() => JSON.stringify(runRequest(documentNow(), windowOf(transient.value))), {
    active: () => shownNow.value,
  });
