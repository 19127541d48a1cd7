// @ts-check
// The field of a table over time: typed or pasted rows, or a file.
import { h } from "../../../dom.js";
import { computed, signal } from "../../../reactive.js";
import { units } from "../../../state.js";
import { number, scaleOf, toShown } from "../../../format.js";
import { at } from "../../../paths.js";
import { choiceField } from "./fields.js";
import { drive, messageFor, setDrive } from "../model.js";
import { readTable, textOf } from "./table-file.js";

/** @typedef {import("./signals.js").Signal} Signal */

const MOST_BYTES = 20e6, MOST_ROWS = 14, LEAST_ROWS = 4;

/** @param {Signal} s */
export function tableField(s) {
  const name = s.path.split(".").at(-1), id = `t-${s.path.replace(/\W/g, "-")}`;
  const wrong = signal("");
  /** How the last file was read, for as long as its points are those of the table. */
  const reading = signal(/** @type {{times: number[], words: string} | null} */ (null));
  const table = () => at(drive.value, s.path) ?? {};
  const scale = () => scaleOf(s.quantity, units.value);
  const short = (/** @type {number} */ v) => String(Number(v.toPrecision(8)));
  const text = computed(() => {
    const { times = [], values = [] } = table();
    return times.map((/** @type {number} */ t, /** @type {number} */ i) =>
      `${short(t)}  ${short(toShown(values[i], scale()))}`
    ).join("\n");
  });

  /** @param {string} rows @param {string | null} file its name @returns {void} */
  const take = (rows, file) => {
    try {
      const { times, values, words, thinned } = readTable(rows, s.quantity, units.peek(), {
        header: file !== null,
      });
      wrong.value = "";
      reading.value = file === null ? null : { times, words: `${file}: ${words}` };
      const old = at(drive.peek(), s.path);
      const next = thinned ? { ...old, interpolation: "linear" } : { ...old };
      setDrive(s.path, { ...next, times, values }, file === null ? `${name} table` : `${name} from ${file}`);
    } catch (error) {
      const { message } = /** @type {Error} */ (error);
      wrong.value = file === null ? message : `${file}: ${message}`;
    }
  };
  /** @param {File | undefined} file */
  const open = async (file) => {
    if (!file) return;
    if (file.size > MOST_BYTES) wrong.value = `${file.name}: The file is larger than 20 MB.`;
    else take(await textOf(file), file.name);
  };

  const area = h("textarea", {
    id,
    rows: () => Math.min(MOST_ROWS, Math.max(LEAST_ROWS, (table().times?.length ?? 0) + 1)),
    spellcheck: "false",
    "aria-invalid": () => wrong.value ? "true" : null,
    "aria-describedby": `${id}-m`,
    onchange: () => take(area.value, null),
    value: () => text.value,
  });
  const input = h("input", {
    type: "file",
    hidden: true,
    id: `${id}-file`,
    accept: ".csv,.txt,.tsv,.dat,text/csv,text/plain",
    onchange: () => {
      open(input.files?.[0]);
      input.value = "";
    },
  });
  const summary = () => {
    const { times = [] } = table(), newest = reading.value;
    if (newest && newest.times === times) return newest.words;
    const count = `${times.length} point${times.length === 1 ? "" : "s"}`;
    return times.length
      ? `${count}, ${number(times[0], 3)} to ${number(times.at(-1), 3)} s.`
      : "No points yet.";
  };
  return h(
    "div",
    {
      class: "field table",
      ondragover: (/** @type {DragEvent} */ e) => e.preventDefault(),
      ondrop: (/** @type {DragEvent} */ e) => {
        if (!e.dataTransfer?.files.length) return;
        e.preventDefault();
        open(e.dataTransfer.files[0]);
      },
    },
    h(
      "div",
      { class: "field-head" },
      h("label", { for: id }, () => `Rows of time (s) and value (${scale().unit})`),
      h("button", {
        type: "button",
        title: "Two columns: time and value, with or without a header",
        onclick: () => input.click(),
      }, "From file…"),
    ),
    input,
    area,
    h("p", { class: "hint points", role: "status" }, summary),
    h(
      "p",
      { class: "error", id: `${id}-m`, role: "alert" },
      () => wrong.value || messageFor(`${s.path}.times`) || messageFor(`${s.path}.values`) || "",
    ),
    choiceField(
      "Between the rows",
      () => [["linear", "linear interpolation"], ["hold", "hold the value"]],
      () => at(drive.value, `${s.path}.interpolation`) ?? "linear",
      (way) => setDrive(`${s.path}.interpolation`, way, "interpolation"),
      `${s.path}.interpolation`,
    ),
  );
}
