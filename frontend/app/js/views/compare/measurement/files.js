// @ts-check
// Measurement files: looked at first, sent when they are understood, else put before the user.
import { computed, effect, signal } from "../../../reactive.js";
import { doc, edit, view } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { muscles, references } from "../../../store.js";
import { fresh, MOST_FILES } from "../document.js";
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
/** Something about a file that the user has to know. @typedef {{name: string, words: string}} Complaint */

const SHA256 = /^[0-9a-f]{64}$/;

/** How the server understood each file. */
export const infos = signal(/** @type {Map<string, FileInfo>} */ (new Map()));
export const complaints = signal(/** @type {Complaint[]} */ ([]));
/** The file that is being read. */
export const reading = signal("");
/** Files of this page's life, to be read another way. @type {Map<string, {file: File, mapping: Mapping}>} */
const sources = new Map();
export const hasSource = (/** @type {string} */ id) => (infos.value, sources.has(id));

/** @param {string} name @param {string} words */
const complain = (name, words) => (complaints.value = [...complaints.peek(), { name, words }]);

/** Is there something only the user knows? A unit that is guessed may be off by any factor.
 * @param {Preview} p */
const isUnsure = (p) =>
  p.problem !== null || p.missing.length > 0 ||
  p.columns.some((column) =>
    column.channel && !column.unit_given &&
    (p.channel_choices.find((one) => one.name === column.channel)?.si_unit ?? "1") !== "1"
  );

/** Files chosen or dropped, one after the other. @param {Iterable<File>} list */
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

/** Reads a file of this session another way. @param {string} id */
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

/** A run that a valve made begins at the pressure of its first rows, unless the file says another.
 * @param {FileInfo} info @param {Record<string, unknown>} columns @returns {FileInfo} */
function begun(info, columns) {
  const start = needsDrive(info) ? startOf(columns.pressure) : null;
  return start === null ? info : { ...info, conditions: { start_pressure: start, ...info.conditions } };
}

/** @param {FileInfo} info */
const withStart = async (info) => needsDrive(info) ? begun(info, (await measurement(info.id)).columns) : info;

/** @param {File} file @param {Mapping} mapping @param {string | null} instead of which file it comes */
async function send(file, mapping, instead) {
  reading.value = file.name;
  const info = await withStart(await keep(file, mapping));
  sources.set(info.id, { file, mapping });
  infos.value = new Map(infos.peek()).set(info.id, info);
  edit((d) => ({ ...d, compare: taken(d.compare, info, instead) }), `measurement ${info.name}`);
}

/** @param {Compare} c @param {FileInfo} info @param {string | null} instead @returns {Compare} */
function taken(c, info, instead) {
  const own = { id: info.id, name: info.name, use: /** @type {Use} */ ("fit") };
  if (instead) {
    const list = c.files.map((f) => f.id === instead ? { ...own, use: f.use } : f);
    return { ...c, files: list.filter((f, i) => list.findIndex((g) => g.id === f.id) === i) };
  }
  // A file of the user's takes the place of an example.
  const kept = c.files.filter((f) => SHA256.test(f.id) && f.id !== info.id);
  const files = [...kept, own].slice(0, MOST_FILES);
  if (kept.length) return { ...c, files };
  const muscle = muscleOf(muscles.peek(), info.conditions) ?? c.muscle;
  const drive = needsDrive(info) ? driveFor(doc.peek().transient.drive, info.conditions) : null;
  return { ...fresh(c), files, muscle, drive, mystery: null, guided: false };
}

/** The muscle a file names, if this page knows no preset of it.
 * @param {FileInfo} info @returns {string | null} */
export function unknownMuscle(info) {
  const name = info.conditions.muscle ?? info.conditions.sample;
  return typeof name === "string" && !presetNamed(muscles.value, name) ? name : null;
}

/** A measurement that comes with the program. @param {string} id @param {boolean} [guided] */
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
      ...fresh(d.compare, "ideal"),
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
    compare: { ...fresh(d.compare), files: [], drive: null, mystery: null, guided: false },
  }), `remove ${file?.name}`);
}

/** What is known of files that came with a link or an undo is asked for. */
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
    infos.value = new Map(infos.peek()).set(id, begun(info, columns));
  } catch (error) {
    const file = files.peek().find((f) => f.id === id);
    if (!(error instanceof ApiError) || !file) return;
    complain(file.name, missingFile(error));
  }
}
