// @ts-check
// The state of an import: files of one kind that are read the same way, and what the user says of them.
import { batch, computed, signal } from "../reactive.js";
import { units } from "../state.js";
import { ApiError } from "../server/client.js";
import { previewOf } from "../server/measurements.js";
import { Question } from "../server/question.js";
import { forget } from "./memory.js";
import { isOpen, readSaid, textOf } from "./fields.js";

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Mapping} Mapping */
/** @typedef {import("./types.js").Field} Field */
/** @typedef {import("./types.js").Said} Said */
/** @typedef {import("./types.js").Experiment} Experiment */
/** @typedef {import("./types.js").Outcome} Outcome */
/** @typedef {import("./types.js").Imported} Imported */
/** @typedef {ReturnType<typeof importModel>} Model */

const AFTER_MS = 120;
const AT_ONCE = 3; // files that are read at the same time

/** Does something for each of a list, a few at a time, in their order.
 * @template T, R @param {T[]} list @param {(one: T, i: number) => Promise<R>} act @returns {Promise<R[]>} */
export async function eachOf(list, act) {
  /** @type {R[]} */
  const results = Array(list.length);
  let next = 0;
  const worker = async () => {
    while (next < list.length) {
      const i = next++;
      results[i] = await act(list[i], i);
    }
  };
  await Promise.all(Array.from({ length: Math.min(AT_ONCE, list.length) }, worker));
  return results;
}

/** What would be right, unless in the words of requests. @param {string | null} hint */
const inView = (hint) =>
  /"\w+": /.test(hint ?? "") ? "say below what the columns are, or which row names them" : hint;

/** @typedef {{files: File[], previews: Preview[], mapping: Mapping, experiments: Experiment[],
 *   kept: import("./memory.js").Kept | null, signature: string, asks: boolean,
 *   taken?: import("./types.js").OpenQuestion[]}} Start */

/** `asks`: the experiment has to be answered before the files are used; `taken`: questions whose proposal the
 * mapping assumes.
 * @param {Start} start */
export function importModel(
  { files, previews, mapping: first, experiments, kept, signature, asks, taken = [] },
) {
  const mapping = signal(first);
  /** The file that is shown. */
  const at = signal(0);
  /** What is said of all files, and of single ones. */
  const common = signal(/** @type {Experiment} */ (files.length === 1 ? experiments[0] ?? {} : {}));
  const own = signal(
    /** @type {Experiment[]} */ (files.map((_, i) => files.length > 1 ? experiments[i] ?? {} : {})),
  );
  /** Fields with which the user goes on without an answer. */
  const ways = signal(/** @type {Record<string, import("./fields.js").Way>} */ ({}));
  /** What was typed and cannot be used, by field. */
  const wrong = signal(/** @type {Record<string, string>} */ ({}));
  const usesKept = signal(kept !== null);

  let last = previews;
  const muscle = computed(() => common.value.muscle === undefined ? "" : textOf(common.value.muscle));
  const reading = new Question(async (text, abort) => {
    const asked = JSON.parse(text);
    /** @type {Outcome[]} */
    const outcomes = await eachOf(files, async (file, i) => {
      try {
        return { preview: await previewOf(file, asked.mapping, abort, asked.muscle), wrong: "" };
      } catch (error) {
        if (!(error instanceof ApiError)) throw error;
        return { preview: last[i], wrong: error.words };
      }
    });
    last = outcomes.map((one) => one.preview);
    return outcomes;
  }, { patience: 0 });
  const stop = reading.follow(
    () =>
      mapping.value === first && !muscle.value
        ? null
        : JSON.stringify({ mapping: mapping.value, muscle: muscle.value }),
    { delay: AFTER_MS },
  );
  const outcomes = computed(() =>
    reading.answer.value ?? previews.map((preview) => /** @type {Outcome} */ ({ preview, wrong: "" }))
  );
  const preview = computed(() => outcomes.value[at.value].preview);

  const assumed = computed(() =>
    taken.filter(({ column }) => column && mapping.value.columns?.[column]?.assumed)
  );

  /** @param {number} i @param {string} field */
  const saidOf = (i, field) => own.value[i][field] ?? common.value[field];
  /** @param {number} i */
  const fieldsOf = (i) => outcomes.value[i].preview.experiment ?? [];
  /** Fields of all files, each once. */
  const fields = computed(() => {
    /** @type {Map<string, Field>} */
    const all = new Map();
    for (const i of [at.value, ...files.keys()]) {
      for (const field of fieldsOf(i)) if (!all.has(field.field)) all.set(field.field, field);
    }
    return [...all.values()];
  });
  /** Titles of fields without an answer, and in which file. */
  const missing = computed(() =>
    !asks ? [] : files.flatMap((file, i) =>
      fieldsOf(i)
        .filter((f) => isOpen(f, saidOf(i, f.field), ways.value[f.field]))
        .map((f) => ({ field: f.field, title: f.title, file: file.name, i }))
    )
  );
  /** Why a file cannot be read as it is; "" = it can. @param {number} i */
  const problemOf = (i) => {
    const { preview: p, wrong: refused } = outcomes.value[i];
    return refused ||
      (p.problem ? [p.problem.message, inView(p.problem.hint)].filter(Boolean).join(": ") : "");
  };
  const isReading = () => reading.stage.value === "asking";
  const ready = computed(() =>
    !isReading() && !reading.error.value && !missing.value.length && !Object.keys(wrong.value).length &&
    files.every((_, i) => !problemOf(i) && outcomes.value[i].preview.measurement !== null)
  );

  /** @param {Field} f @param {string} text "": nothing is said @param {number | null} [file] null: of all files
   * @param {"suggested" | null} [origin] */
  function say(f, text, file = null, origin = null) {
    const key = file === null ? f.field : `${f.field} ${file}`;
    const got = text.trim() ? readSaid(f, text, units.peek()) : null;
    const { [key]: _, ...others } = wrong.peek();
    if (got && "error" in got) return void (wrong.value = { ...others, [key]: got.error });
    /** @type {Said | null} */
    const value = got && (origin ? { value: got.said, origin } : got.said);
    /** @param {Experiment} said @returns {Experiment} */
    const changed = ({ [f.field]: _old, ...rest }) => value === null ? rest : { ...rest, [f.field]: value };
    batch(() => {
      wrong.value = others;
      if (file === null) common.value = changed(common.peek());
      else own.value = own.peek().map((said, i) => i === file ? changed(said) : said);
    });
  }

  return {
    files,
    mapping,
    at,
    asks,
    kept,
    signature,
    usesKept,
    common,
    own,
    ways,
    wrong,
    outcomes,
    preview,
    /** Questions whose proposal is assumed. */
    assumed,
    fields,
    missing,
    ready,
    fieldsOf,
    saidOf,
    problemOf,
    isReading,
    /** Why no file could be read, as when the server does not answer. */
    failure: () => reading.error.value?.words ?? "",
    /** @param {(mapping: Mapping) => Mapping} patch */
    change: (patch) => (mapping.value = patch(mapping.peek())),
    say,
    /** Goes on without an answer. @param {string[]} names @param {import("./fields.js").Way} way */
    goOn: (
      names,
      way,
    ) => (ways.value = { ...ways.peek(), ...Object.fromEntries(names.map((name) => [name, way])) }),
    /** Reads the files without the mapping of the file before, which is forgotten. */
    undoKept: () => {
      forget(signature);
      batch(() => {
        usesKept.value = false;
        mapping.value = {};
      });
    },
    /** @returns {Imported[]} */
    result: () =>
      files.map((file, i) => ({
        file,
        mapping: mapping.peek(),
        experiment: { ...common.peek(), ...own.peek()[i] },
        kept: usesKept.peek() && mapping.peek() === first ? kept : null,
      })),
    stop,
  };
}
