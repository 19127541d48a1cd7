// @ts-check
// The measurement files of the comparison: imported, sent to the server, used or not.
import { apart, computed, effect, signal } from "../../../reactive.js";
import { doc, edit, view } from "../../../state.js";
import { ApiError } from "../../../server/client.js";
import { muscles, references, status } from "../../../store.js";
import { freeOfOther, MOST_FILES, withStartModel } from "../document.js";
import { driveFor, needsDrive, startOf } from "../drive-document.js";
import { caseId } from "../cases.js";
import { again, chosen, compare, editCompare, fault, files } from "../answers.js";
import { conditionsOf, muscleOf, presetNamed, withRestLength } from "../muscle-values.js";
import { keep, measurement } from "../../../server/measurements.js";
import { untilLoaded } from "../../../server/patience.js";
import { cameBack, has, lacks, missing } from "../../../server/missing.js";

/** @typedef {import("../types.js").FileInfo} FileInfo */
/** @typedef {import("../types.js").Mapping} Mapping */
/** @typedef {import("../../../measurement/types.js").Imported} Imported */
/** A file that the server has, and what the user says of its experiment.
 * @typedef {{info: FileInfo, experiment: import("../../../types.js").Experiment}} Kept */
/** @typedef {import("../../../types.js").Compare} Compare */
/** @typedef {import("../../../types.js").Use} Use */
/** A message about a file. @typedef {{name: string, words: string}} Complaint */

const SHA256 = /^[0-9a-f]{64}$/;

/** How the server read each file, by its id. */
export const infos = signal(/** @type {Map<string, FileInfo>} */ (new Map()));
export const complaints = signal(/** @type {Complaint[]} */ ([]));
/** The name of the file that is being read. */
export const reading = signal("");
/** Files of this session, which can be imported once more.
 * @type {Map<string, Pick<Imported, "file" | "mapping" | "kept">>} */
const sources = new Map();
/** The file whose mapping was used for this one; null: its own answers. @param {string} id */
export const keptFor = (id) => (infos.value, sources.get(id)?.kept ?? null);
export const hasSource = (/** @type {string} */ id) => (infos.value, sources.has(id));

/** @param {string} name @param {string} words */
const complain = (name, words) => (complaints.value = [...complaints.peek(), { name, words }]);

/** @type {import("../../../measurement/import.js").Options} */
const ASKING = { asks: true, complain, reading: (name) => (reading.value = name) };

/** Imports files: they are looked at, asked about and kept. @param {Iterable<File>} list */
export async function addFiles(list) {
  complaints.value = [];
  const { importFiles } = await untilLoaded(() => import("../../../measurement/import.js"));
  const read = await importFiles([...list], ASKING);
  /** @type {Kept[]} */
  const kept = [];
  for (const one of read) {
    const answer = await send(one);
    if (answer) kept.push(answer);
  }
  if (!kept.length) return;
  takeIn(kept.filter((one) => !isBack(one)), read);
}

/** Whether a file is one that the server lacked: then all that was said of it stays. @param {Kept} kept */
function isBack({ info }) {
  const lacked = missing.peek().some(({ id }) => id === info.id);
  has([info.id]);
  if (lacked) status.value = `${info.name} is back.`;
  return lacked;
}

/** The missing file that this one is, read in another way. @param {Kept} kept */
const insteadOf = ({ info }) =>
  missing.peek().find(({ name, view }) => view === "compare" && name === info.name)?.id ?? null;

/** Puts files into the case. @param {Kept[]} kept @param {Imported[]} read */
function takeIn(kept, read) {
  if (!kept.length) return;
  const there = files.peek().filter((f) => SHA256.test(f.id) && !kept.some(({ info }) => info.id === f.id));
  for (const { info } of kept.slice(Math.max(0, MOST_FILES - there.length))) {
    complain(info.name, `It is left out: ${MOST_FILES} files are compared at most.`);
  }
  const names = kept.map(({ info }) => info.name).join(", ");
  edit((d) => ({
    ...d,
    compare: kept.reduce((c, one) => withFile(c, one, insteadOf(one)), d.compare),
  }), kept.length > 1 ? `${kept.length} measurements` : `measurement ${names}`);
  const like = read.find((one) => one.kept)?.kept;
  if (like) status.value = `Read like ${like.name}; Files and experiment can undo that.`;
}

/** Imports a file of this session again, with its answers. @param {string} id
 * @param {boolean} [plain] without the mapping of another file */
export async function importOnceMore(id, plain = false) {
  const source = sources.get(id);
  if (!source) return;
  complaints.value = [];
  const { forgetKind, importAgain } = await untilLoaded(() => import("../../../measurement/import.js"));
  if (plain && source.kept) forgetKind(source.kept);
  const said = files.peek().find((f) => f.id === id)?.experiment ?? {};
  const read = await importAgain(source.file, plain ? {} : source.mapping, said, ASKING);
  const answer = read && await send(read);
  if (!answer) return;
  edit((d) => ({ ...d, compare: withFile(d.compare, answer, id) }), `measurement ${answer.info.name}`);
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

/** Sends a file; null: the server refused it. @param {Imported} one @returns {Promise<Kept | null>} */
async function send({ file, mapping, experiment, kept }) {
  reading.value = file.name;
  try {
    const info = await completed(await keep(file, mapping));
    sources.set(info.id, { file, mapping, kept });
    infos.value = new Map(infos.peek()).set(info.id, info);
    return { info, experiment };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    complain(file.name, error.words);
    return null;
  } finally {
    reading.value = "";
  }
}

const SAME_LENGTH = 1e-3;

/** The muscle without a rest length, where the specimens of the files have different ones: each has its own.
 * @param {Compare["muscle"]} muscle @param {import("../../../types.js").Chosen[]} list */
function withOneLength(muscle, list) {
  const lengths = list.flatMap(({ id, experiment }) => {
    const conditions = { ...infos.peek().get(id)?.conditions, ...conditionsOf(experiment ?? {}) };
    return typeof conditions.nominal_length === "number" ? [conditions.nominal_length] : [];
  });
  if (!lengths.length || Math.max(...lengths) < Math.min(...lengths) * (1 + SAME_LENGTH)) return muscle;
  const { nominal_length: _, ...values } = muscle.values;
  return { ...muscle, values };
}

/** @param {Compare} c @param {Kept} kept @param {string | null} instead the id of the file it replaces
 * @returns {Compare} */
function withFile(c, { info, experiment }, instead) {
  const conditions = { ...info.conditions, ...conditionsOf(experiment) };
  const muscle = muscleOf(muscles.peek(), conditions) ?? withRestLength(c.muscle, conditions);
  const others = c.files.filter((f) => SHA256.test(f.id) && f.id !== info.id && f.id !== instead);
  // The muscle of the view is that of the file, and can be changed there; another one is the file's own.
  const { muscle: own, ...rest } = experiment;
  const said = others.length && own !== c.muscle.preset ? experiment : rest;
  const added = {
    id: info.id,
    name: info.name,
    use: /** @type {Use} */ ("fit"),
    ...(Object.keys(said).length ? { experiment: said } : {}),
  };
  if (instead) {
    const list = c.files.map((f) =>
      f.id === instead ? { ...added, use: f.use, ...(f.prepare ? { prepare: f.prepare } : {}) } : f
    );
    const files = list.filter((f, i) => list.findIndex((g) => g.id === f.id) === i);
    return { ...c, files, ...(files.length === 1 ? { muscle } : {}) };
  }
  // A file of the user replaces an example.
  const kept = c.files.filter((f) => SHA256.test(f.id) && f.id !== info.id);
  const files = [...kept, added].slice(0, MOST_FILES);
  if (kept.length) return { ...c, files, muscle: withOneLength(c.muscle, files) };
  const drive = needsDrive(info) ? driveFor(doc.peek().transient.drive, conditions) : null;
  return { ...withStartModel(c), files, muscle, drive, mystery: null, free: freeOfOther(c.free) };
}

/** The muscle a file names, if there is no preset for it.
 * @param {FileInfo} info @returns {string | null} */
export function unknownMuscle(info) {
  const name = info.conditions.muscle ?? info.conditions.sample;
  return typeof name === "string" && !presetNamed(muscles.value, name) ? name : null;
}

/** Opens a measurement that comes with the program. @param {string} id */
export function openBuiltIn(id) {
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
      free: freeOfOther(d.compare.free),
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

/** @param {string} id @param {string[]} steps */
export function setPreparation(id, steps) {
  const file = files.peek().find((f) => f.id === id);
  editCompare(
    {
      files: files.peek().map((f) => {
        if (f.id !== id) return f;
        const { prepare: _, ...rest } = f;
        return steps.length ? { ...rest, prepare: steps } : rest;
      }),
    },
    `${file?.name ?? "file"}: ${steps.length ? `prepared: ${steps.join(", ")}` : "as it was read"}`,
  );
}

/** @param {string} id */
export function removeFile(id) {
  const file = files.peek().find((f) => f.id === id);
  const left = files.peek().filter((f) => f.id !== id);
  if (left.length) return editCompare({ files: left }, `remove ${file?.name}`);
  edit((d) => ({
    ...d,
    compare: {
      ...withStartModel(d.compare),
      files: [],
      drive: null,
      mystery: null,
      free: freeOfOther(d.compare.free),
    },
  }), `remove ${file?.name}`);
}

/** Fetches information about files that came with a link or an undo. */
export function followFiles() {
  let last = caseId.peek();
  effect(() => {
    if (caseId.value !== last) complaints.value = [];
    last = caseId.value;
  });
  const wanted = computed(() => files.value.map((f) => f.id).filter((id) => SHA256.test(id)).join(" "));
  effect(() => {
    if (view.value !== "compare") return;
    cameBack.value;
    for (const id of wanted.value.split(" ")) if (id && !infos.peek().has(id)) fetchInfo(id);
  });
  effect(() => {
    const at = fault.value?.status === 404
      ? /^(?:body\.)?measurements\.(\d+)/.exec(fault.value.field ?? "")
      : null;
    const file = at && chosen.peek()[Number(at[1])];
    if (file && SHA256.test(file.id)) sendAgain(file);
  });
  effect(() => {
    if (cameBack.value && fault.peek()?.status === 404) apart(again);
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
    if (error.status === 404) return lacks({ id, name: file.name, view: "compare" });
    complain(file.name, error.words);
  }
}

/** Sends a file that the server has lost once more, if this page still has it; else the banner asks for it.
 * @param {import("../../../types.js").Chosen} file */
async function sendAgain({ id, name }) {
  const source = sources.get(id);
  sources.delete(id); // once: a server that loses it again has no room for it
  try {
    if (source && (await keep(source.file, source.mapping)).id === id) {
      sources.set(id, source);
      return again();
    }
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
  }
  lacks({ id, name, view: "compare" });
}
