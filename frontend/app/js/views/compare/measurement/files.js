// @ts-check
// Measurement files: a preview first; if it leaves questions the user is asked, then the file is sent.
import { computed, effect, signal } from "../../../reactive.js";
import { doc, edit, view } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { muscles, references } from "../../../store.js";
import { MOST_FILES, withStartModel } from "../document.js";
import { driveFor, needsDrive, startOf } from "../drive-document.js";
import { openMapping } from "./mapping.js";
import { compare, editCompare, files } from "../answers.js";
import { muscleOf, presetNamed } from "../muscle-values.js";
import { keep, measurement, missingFile, previewOf, refusal } from "../../../server/measurements.js";

/** @typedef {import("../types.js").FileInfo} FileInfo */
/** @typedef {import("../types.js").Preview} Preview */
/** @typedef {import("../types.js").Mapping} Mapping */
/** @typedef {import("../../../types.js").Compare} Compare */
/** @typedef {import("../../../types.js").Use} Use */
/** A message about a file. @typedef {{name: string, words: string}} Complaint */

const SHA256 = /^[0-9a-f]{64}$/;

/** How the server read each file, by its id. */
export const infos = signal(/** @type {Map<string, FileInfo>} */ (new Map()));
export const complaints = signal(/** @type {Complaint[]} */ ([]));
/** The name of the file that is being read. */
export const reading = signal("");
/** Files of this session, which can be read again with other columns. @type {Map<string, {file: File, mapping: Mapping}>} */
const sources = new Map();
export const hasSource = (/** @type {string} */ id) => (infos.value, sources.has(id));

/** @param {string} name @param {string} words */
const complain = (name, words) => (complaints.value = [...complaints.peek(), { name, words }]);

/** Whether the user must be asked: something is missing, or a unit is guessed and may be wrong by any factor.
 * @param {Preview} p */
const isUnsure = (p) =>
  p.problem !== null || p.missing.length > 0 ||
  p.columns.some((column) =>
    column.channel && !column.unit_given &&
    (p.channel_choices.find((one) => one.name === column.channel)?.si_unit ?? "1") !== "1"
  );

/** Adds files one after the other. @param {Iterable<File>} list */
export async function addFiles(list) {
  complaints.value = [];
  for (const file of list) {
    const refused = refusal(file);
    if (refused) {
      complain(file.name, refused);
      continue;
    }
    reading.value = file.name;
    try {
      const preview = await previewOf(file, {});
      reading.value = "";
      const mapping = isUnsure(preview) ? await openMapping(file, preview, {}) : {};
      if (mapping) await send(file, mapping, null);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      complain(file.name, error.words);
    } finally {
      reading.value = "";
    }
  }
}

/** Reads a file of this session again, with other columns. @param {string} id */
export async function remap(id) {
  const source = sources.get(id);
  if (!source) return;
  complaints.value = [];
  try {
    const preview = await previewOf(source.file, source.mapping);
    const mapping = await openMapping(source.file, preview, source.mapping);
    if (mapping) await send(source.file, mapping, id);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    complain(source.file.name, error.words);
  }
}

/** The file with its initial pressure, from the first rows unless the file gives it.
 * @param {FileInfo} info @param {Record<string, unknown>} columns @returns {FileInfo} */
function withInitialPressure(info, columns) {
  const start = needsDrive(info) ? startOf(columns.pressure) : null;
  return start === null ? info : { ...info, conditions: { start_pressure: start, ...info.conditions } };
}

/** @param {FileInfo} info */
const completed = async (info) =>
  needsDrive(info) ? withInitialPressure(info, (await measurement(info.id)).columns) : info;

/** @param {File} file @param {Mapping} mapping @param {string | null} instead the id of the file it replaces */
async function send(file, mapping, instead) {
  reading.value = file.name;
  const info = await completed(await keep(file, mapping));
  sources.set(info.id, { file, mapping });
  infos.value = new Map(infos.peek()).set(info.id, info);
  edit((d) => ({ ...d, compare: withFile(d.compare, info, instead) }), `measurement ${info.name}`);
}

/** @param {Compare} c @param {FileInfo} info @param {string | null} instead @returns {Compare} */
function withFile(c, info, instead) {
  const added = { id: info.id, name: info.name, use: /** @type {Use} */ ("fit") };
  if (instead) {
    const list = c.files.map((f) => f.id === instead ? { ...added, use: f.use } : f);
    return { ...c, files: list.filter((f, i) => list.findIndex((g) => g.id === f.id) === i) };
  }
  // A file of the user replaces an example.
  const kept = c.files.filter((f) => SHA256.test(f.id) && f.id !== info.id);
  const files = [...kept, added].slice(0, MOST_FILES);
  if (kept.length) return { ...c, files };
  const muscle = muscleOf(muscles.peek(), info.conditions) ?? c.muscle;
  const drive = needsDrive(info) ? driveFor(doc.peek().transient.drive, info.conditions) : null;
  return { ...withStartModel(c), files, muscle, drive, mystery: null, guided: false };
}

/** The muscle a file names, if there is no preset for it.
 * @param {FileInfo} info @returns {string | null} */
export function unknownMuscle(info) {
  const name = info.conditions.muscle ?? info.conditions.sample;
  return typeof name === "string" && !presetNamed(muscles.value, name) ? name : null;
}

/** Opens a measurement that comes with the program. @param {string} id @param {boolean} [guided] */
export function openBuiltIn(id, guided = false) {
  const preset = references.peek().find((r) => r.id === id);
  if (!preset) return;
  complaints.value = [];
  const named = presetNamed(muscles.peek(), preset.muscle);
  const rest = preset.nominal_length ? preset.nominal_length.value / 1000 : null;
  const muscle = named
    ? {
      preset: named.preset.id,
      form: /** @type {const} */ ("braid"),
      values: /** @type {Record<string, number>} */ (rest ? { nominal_length: rest } : {}),
    }
    : compare.peek().muscle;
  edit((d) => ({
    ...d,
    compare: {
      ...withStartModel(d.compare, "ideal"),
      files: [{ id, name: preset.title, use: "fit" }],
      muscle,
      drive: null,
      mystery: null,
      guided,
    },
  }), `measurement ${preset.title}`);
}

/** @param {string} id @param {Use} use */
export function setUse(id, use) {
  const file = files.peek().find((f) => f.id === id);
  editCompare(
    { files: files.peek().map((f) => f.id === id ? { ...f, use } : f) },
    `${file?.name ?? "file"}: ${
      use === "fit" ? "used for the fit" : use === "off" ? "not used" : "validation"
    }`,
  );
}

/** @param {string} id */
export function removeFile(id) {
  const file = files.peek().find((f) => f.id === id);
  const left = files.peek().filter((f) => f.id !== id);
  if (left.length) return editCompare({ files: left }, `remove ${file?.name}`);
  edit((d) => ({
    ...d,
    compare: { ...withStartModel(d.compare), files: [], drive: null, mystery: null, guided: false },
  }), `remove ${file?.name}`);
}

/** Fetches information about files that came with a link or an undo. */
export function followFiles() {
  const wanted = computed(() => files.value.map((f) => f.id).filter((id) => SHA256.test(id)).join(" "));
  effect(() => {
    if (view.value !== "compare") return;
    for (const id of wanted.value.split(" ")) if (id && !infos.peek().has(id)) fetchInfo(id);
  });
}

/** @param {string} id */
async function fetchInfo(id) {
  try {
    const { columns, ...info } = await measurement(id);
    infos.value = new Map(infos.peek()).set(id, withInitialPressure(info, columns));
  } catch (error) {
    const file = files.peek().find((f) => f.id === id);
    if (!(error instanceof ApiError) || !file) return;
    complain(file.name, missingFile(error));
  }
}
