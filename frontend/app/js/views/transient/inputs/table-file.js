// @ts-check
// Reads a table of times and values from typed rows or a file with two columns. Pure functions.
import { number, parse, scaleOf } from "../../../format.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {import("../../../format.js").System} System */
/** @typedef {{times: number[], values: number[], words: string, thinned: boolean}} Read */

/** As many as fit into a link. */
const MOST_POINTS = 1000;
const NUMBER = /^[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d+)?$/i;

/** @param {string} cell @returns {number | null} decimal commas are accepted */
const numberOf = (cell) => NUMBER.test(cell) ? Number(cell.replace(",", ".")) : null;

/** The separator of the columns, from the first row of numbers. @param {string} line */
function separatorOf(line) {
  if (line.includes(";")) return /\s*;\s*/;
  if (line.includes("\t")) return /[ ]*\t\s*/;
  const commas = line.split(",").length - 1;
  return commas === 1 && !/\s/.test(line.replace(/,\s+/, ",")) ? /\s*,\s*/ : /\s+/;
}

/** @param {string} line @param {RegExp} separator */
function cellsOf(line, separator) {
  // A name and its unit in brackets are one cell, whatever separates the columns.
  const kept = line.replace(/\s+(?=[[(])/g, "\u0000");
  const cells = kept.split(separator).map((cell) =>
    cell.replaceAll("\u0000", " ").replace(/^"(.*)"$/, "$1").trim().replaceAll("−", "-")
  );
  while (cells.length > 2 && cells.at(-1) === "") cells.pop();
  return cells;
}

/** The unit in the header: "t [ms]", "F (kN)", "Kraft in N", "F / N", or a row of units.
 * @param {string[][]} header @param {number} column */
function unitIn(header, column) {
  const units = header.map((cells, row) => {
    const cell = cells.length === 2 ? cells[column] : "";
    const match = /[[(]\s*([^\])]*?)\s*[\])]$/.exec(cell) ?? /(?:\s\/|\sin|^[^\s/]+\/)\s*(\S+)$/.exec(cell);
    return match ? match[1] : row > 0 ? cell : "";
  });
  return units.findLast((unit) => unit !== "") ?? "";
}

/** The SI factor of the unit of a column. @param {string} unit @param {Quantity} quantity @param {System} system
 * @param {string} what */
function factorOf(unit, quantity, system, what) {
  const s = scaleOf(quantity, system);
  if (unit === "") return s.factor;
  if (quantity === "ratio" && /^[1-]$/.test(unit)) return 1;
  const got = parse(`1 ${unit}`, s, quantity);
  if ("error" in got) throw new Error(`The unit of the ${what}: ${got.error}`);
  return got.value;
}

/** Leaves out points close to the line between others, the closest first.
 * @param {number[]} x @param {number[]} y @param {number} most @returns {{kept: number[], off: number}}
 * `off`: the largest distance of a point from the lines */
function thin(x, y, most) {
  /** @type {{from: number, to: number, at: number, off: number}[]} */
  const pieces = [];
  const add = (/** @type {number} */ from, /** @type {number} */ to) => {
    let at = -1, off = 0;
    for (let i = from + 1; i < to; i++) {
      const share = (x[i] - x[from]) / (x[to] - x[from] || 1);
      const away = Math.abs(y[i] - y[from] - share * (y[to] - y[from]));
      if (away > off) [at, off] = [i, away];
    }
    pieces.push({ from, to, at, off });
  };
  add(0, x.length - 1);
  const kept = [0, x.length - 1];
  const nothing = 1e-9 * y.reduce((a, v) => Math.max(a, Math.abs(v)), 0);
  let off = 0;
  for (;;) {
    const worst = pieces.reduce((a, b) => b.off > a.off ? b : a);
    off = worst.off;
    if (off <= nothing || kept.length >= most) break;
    pieces.splice(pieces.indexOf(worst), 1);
    kept.push(worst.at);
    add(worst.from, worst.at);
    add(worst.at, worst.to);
  }
  return { kept: kept.sort((a, b) => a - b), off };
}

/** The numbers of the rows. @param {{cells: string[], row: number, text: string}[]} lines */
function columnsOf(lines) {
  /** @type {number[]} */
  const times = [], /** @type {number[]} */ values = [];
  for (const { cells, row, text } of lines) {
    if (cells.length !== 2) {
      const has = cells.length === 1 ? "one column" : `${cells.length} columns`;
      throw new Error(
        `Row ${row}, “${text}”, has ${has}; it must have a time and a value, such as “0.5  20”.`,
      );
    }
    const bad = cells.find((cell) => numberOf(cell) === null);
    if (bad !== undefined) {
      throw new Error(
        `Row ${row}: “${bad}” is not a number; a row must have a time and a value, such as “0.5  20”.`,
      );
    }
    const [time, value] = cells.map((cell) => numberOf(cell) ?? 0);
    if (time < (times.at(-1) ?? -Infinity)) {
      throw new Error(
        `Row ${row}: the time ${time} is earlier than that of the row before, ${times.at(-1)}.`,
      );
    }
    times.push(time);
    values.push(value);
  }
  return { times, values };
}

/** @param {string} text @param {Quantity} quantity of the values @param {System} system
 * @param {{header: boolean}} o whether the first rows may be names and units
 * @returns {Read} in SI, and in words how it was read @throws {Error} says what is wrong, and in which row */
export function readTable(text, quantity, system, { header }) {
  const lines = text.replace(/^\ufeff/, "").split(/\r\n|\n|\r/).map((line, i) => ({
    text: line.trim(),
    row: i + 1,
  })).filter((line) => line.text !== "" && !/^(#|sep=)/i.test(line.text));
  const first = header ? lines.findIndex((line) => /^["\s]*[+−-]?[.,]?\d/.test(line.text)) : 0;
  if (first < 0 || !lines.length) {
    throw new Error("There are no rows of numbers. Two columns are needed: times and values.");
  }
  const separator = separatorOf(lines[first].text);
  const split = lines.map((line) => ({ ...line, cells: cellsOf(line.text, separator) }));
  const head = split.slice(0, first).map((line) => line.cells);
  const { times, values } = columnsOf(split.slice(first));
  const units = [unitIn(head, 0), unitIn(head, 1)];
  const seconds = factorOf(units[0], "time", system, "times");
  // A command that stays within 1 % is unlikely: without a unit, numbers up to 1 are taken as shares of 1.
  const share = header && quantity === "ratio" && units[1] === "" && values.every((v) => Math.abs(v) <= 1);
  const factor = share ? 1 : factorOf(units[1], quantity, system, "values");
  const si = { times: times.map((t) => tidy(t * seconds)), values: values.map((v) => tidy(v * factor)) };
  const shownUnit = share ? "shares of 1" : units[1] || scaleOf(quantity, system).unit;
  const note = units[1] ? "" : " (the file names no unit)";
  const span = `${number(si.times[0], 3)} to ${number(si.times[si.times.length - 1], 3)} s`;
  const words = `${times.length} points, ${span}; times in ${
    units[0] || "s"
  }, values in ${shownUnit}${note}.`;
  return fewer(si, words);
}

/** Ten digits are more than any instrument resolves. @param {number} x */
const tidy = (x) => Number(x.toPrecision(10));

/** @param {{times: number[], values: number[]}} all @param {string} words @returns {Read} */
function fewer({ times, values }, words) {
  if (times.length <= MOST_POINTS) return { times, values, words, thinned: false };
  const { kept, off } = thin(times, values, MOST_POINTS);
  const range = values.reduce((a, v) => Math.max(a, v), -Infinity) -
    values.reduce((a, v) => Math.min(a, v), Infinity);
  const percent = range > 0 ? (100 * off) / range : 0;
  return {
    times: kept.map((i) => times[i]),
    values: kept.map((i) => values[i]),
    words: `${words} ${kept.length} of them are kept and joined by lines: ` +
      `at most ${percent < 0.001 ? "0.001" : percent.toPrecision(2)} % of the range away.`,
    thinned: true,
  };
}

/** The text of a file in UTF-8, or in UTF-16 as spreadsheets write it. @param {Blob} file */
export async function textOf(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const wide = bytes[0] === 0xff && bytes[1] === 0xfe ? "utf-16le" : bytes[0] === 0xfe ? "utf-16be" : "utf-8";
  return new TextDecoder(wide).decode(bytes);
}
