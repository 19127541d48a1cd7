// @ts-check
// Files to be imported: each is looked at first; files of one kind are asked about together.
import { ApiError } from "../server/client.js";
import { previewOf, refusal } from "../server/measurements.js";
import { assumablesOf, withAssumed } from "./choices.js";
import { isOpen } from "./fields.js";
import { forget, recall, remember, signatureOf } from "./memory.js";
import { eachOf } from "./model.js";
import { openImport } from "./panel.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Imported} Imported */
/** @typedef {import("./types.js").Mapping} Mapping */
/** @typedef {import("./types.js").Experiment} Experiment */
/** @typedef {import("./memory.js").Kept} Kept */
/** @typedef {{file: File, preview: Preview}} Seen */

/** `asks`: the experiment has to be answered, because a model is compared with the file. `complain`: takes what is
 * wrong with a file that cannot be looked at. `reading`: takes the name of the file that is read, "" at the end.
 * @typedef {{asks: boolean, complain: (name: string, words: string) => void,
 *   reading: (name: string) => void}} Options */

/** The files as the user wants them read; those of a cancelled panel are left out.
 * @param {File[]} list @param {Options} o @returns {Promise<Imported[]>} */
export async function importFiles(list, o) {
  const good = list.filter((file) => {
    const refused = refusal(file);
    if (refused) o.complain(file.name, refused);
    return !refused;
  });
  /** @type {[string, string][]} */
  const notes = [];
  const looked = await eachOf(good, async (file) => {
    o.reading(file.name);
    return await look(file, {}, o, good.length > 1 ? notes : null);
  });
  const read = looked.filter((seen) => seen !== null);
  const all = notes.length && read.length
    ? await eachOf(read, ({ file }) => look(file, { notes }, o))
    : looked;
  o.reading("");
  /** @type {Map<string, Seen[]>} */
  const kinds = new Map();
  for (const seen of all) {
    if (!seen) continue;
    const signature = signatureOf(seen.preview);
    kinds.set(signature, [...kinds.get(signature) ?? [], seen]);
  }
  /** @type {Imported[]} */
  const results = [];
  const begun = notes.length ? { notes } : {};
  for (const [signature, seen] of kinds) results.push(...await askAbout(seen, signature, begun, o));
  // In the order in which they came.
  return results.sort((a, b) => good.indexOf(a.file) - good.indexOf(b.file));
}

const MOST_OF_NOTES = 20_000, LINES = 40, LONGEST = 200;

/** The lines of a text beside the readings, each with its place; none = it is no short text.
 * @param {File} file @returns {Promise<[string, string][]>} */
async function linesOf(file) {
  if (file.size > MOST_OF_NOTES || !/\.(txt|md|log|csv|tsv)$/i.test(file.name)) return [];
  return (await file.text()).split(/\r?\n/)
    .map((line, i) => /** @type {[string, string]} */ ([`${file.name}, line ${i + 1}`, line.trim()]))
    .filter(([, line]) => line && line.length <= LONGEST && !line.includes("\0"))
    .slice(0, LINES);
}

/** @param {File} file @param {Mapping} mapping @param {Options} o
 * @param {[string, string][] | null} [notes] takes the lines of a file that holds no table
 * @returns {Promise<Seen | null>} */
async function look(file, mapping, o, notes = null) {
  try {
    return { file, preview: await previewOf(file, mapping) };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    const lines = notes && error.field === "file" ? await linesOf(file) : [];
    notes?.push(...lines);
    o.complain(
      file.name,
      lines.length ? "it holds no readings; its lines count for the files beside it." : error.words,
    );
    return null;
  }
}

/** Whether nothing of a preview is open, proposed or assumed. @param {Preview} p @param {boolean} asks */
const isSettled = (p, asks) =>
  p.measurement !== null && !p.problem && !p.questions.some((q) => q.stops) &&
  !(asks && (p.experiment ?? []).some((f) => isOpen(f, undefined) || f.origin === "assumed"));

/** The files as they are read with the proposals of questions; as before where they cannot be.
 * @param {import("./types.js").OpenQuestion[]} asked @param {Seen[]} seen @param {Preview[]} previews
 * @param {Mapping} mapping */
async function assuming(asked, seen, previews, mapping) {
  const assumed = withAssumed(asked, previews[0], mapping);
  try {
    return { previews: await eachOf(seen, ({ file }) => previewOf(file, assumed)), mapping: assumed };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    return { previews, mapping };
  }
}

/** @param {Seen[]} seen files of one kind @param {string} signature
 * @param {Mapping} begun what counts for all files that were opened together @param {Options} o
 * @returns {Promise<Imported[]>} */
async function askAbout(seen, signature, begun, o) {
  const kept = recall(signature);
  let previews = seen.map((one) => one.preview), used = kept;
  if (kept && Object.keys(kept.mapping).length) {
    try {
      previews = await eachOf(seen, ({ file }) => previewOf(file, { ...kept.mapping, ...begun }));
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      used = null; // the mapping does not fit this file after all
    }
  }
  const mapping = { ...used?.mapping, ...begun };
  if (used && previews.every((p) => isSettled(p, o.asks))) {
    return seen.map(({ file }) => ({ file, mapping, experiment: {}, kept: used }));
  }
  const files = seen.map((one) => one.file);
  const asked = o.asks ? assumablesOf(seen[0].preview) : [];
  const begin = asked.length && !used
    ? await assuming(asked, seen, previews, mapping)
    : { previews, mapping };
  const answer = await openImport({
    files,
    ...begin,
    experiments: [],
    kept: used,
    signature,
    asks: o.asks,
    taken: asked,
  }); // deno-fmt-ignore
  return answer ? keepAnswers(answer, signature) : [];
}

/** @param {Imported[]} answer @param {string} signature */
function keepAnswers(answer, signature) {
  const [{ file, mapping, experiment }] = answer;
  const { conditions: _, notes: _notes, ...columns } = mapping;
  remember({ signature, name: file.name, mapping: columns, said: experiment });
  return answer;
}

/** Files of this kind are asked about again. @param {Kept} kept */
export const forgetKind = (kept) => forget(kept.signature);

/** Reads a file again, with its answers or without the mapping of the file before; null: it stays as it is.
 * @param {File} file @param {Mapping} mapping @param {Experiment} experiment @param {Options} o
 * @returns {Promise<Imported | null>} */
export async function importAgain(file, mapping, experiment, o) {
  const plain = await look(file, {}, o), now = plain && await look(file, mapping, o);
  if (!plain || !now) return null;
  const signature = signatureOf(plain.preview), asked = assumablesOf(plain.preview);
  const answer = await openImport({
    files: [file],
    previews: [now.preview],
    mapping,
    experiments: [experiment],
    kept: null,
    signature,
    asks: o.asks,
    taken: asked,
  }); // deno-fmt-ignore
  return answer ? keepAnswers(answer, signature)[0] : null;
}
