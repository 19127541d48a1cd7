// @ts-check
// A signal over time: its shape, and the fields of that shape.
import { h } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { at } from "../../../paths.js";
import { choiceField, driveField } from "./fields.js";
import { drive, numberAt, setDrive } from "../model.js";
import { tableField } from "./table-field.js";

/** @typedef {import("../../../format.js").Quantity} Quantity */
/** @typedef {{path: string, quantity: Quantity, low: () => number, high: number, rest: () => number,
 *   full: number, constant?: boolean}} Signal  `low`, `high`: of the slider; `rest`, `full`: start values of low and high levels */
/** @typedef {"time" | "value" | "share" | "frequency" | "angle" | "seed"} Kind */
/** @typedef {[key: string, label: string, kind: Kind, start: (o: Start) => number]} Row */
/** What start values depend on.
 * @typedef {{duration: number, rest: number, full: number}} Start */

/** @type {Row} */
const LEVEL = ["level", "Level", "value", (o) => o.full];
/** @type {Row} */
const INITIAL = ["initial", "Base level", "value", (o) => o.rest];
/** @type {Row} */
const PERIOD = ["period", "Period", "time", (o) => o.duration / 2];
/** @type {Row} */
const OFFSET = ["offset", "Offset", "value", () => 0];
/** @type {Row} */
const AMPLITUDE = ["amplitude", "Amplitude", "value", (o) => o.full];

/** The shapes and their fields, in the words of the drive document.
 * @type {Record<string, [string, Row[]]>} */
const SHAPES = {
  step: ["Step", [["at", "At", "time", () => 0], LEVEL, INITIAL]],
  pulse: ["Pulse", [
    ["on", "On at", "time", () => 0],
    ["off", "Off at", "time", (o) => o.duration / 2],
    LEVEL,
    INITIAL,
  ]],
  square: ["Square wave", [PERIOD, ["duty", "Duty", "share", () => 0.5], LEVEL, INITIAL]],
  triangle: ["Triangle", [["amplitude", "Height, peak to peak", "value", (o) => o.full], PERIOD, OFFSET]],
  ramp: ["Ramp", [
    ["from", "From", "value", (o) => o.rest],
    ["to", "To", "value", (o) => o.full],
    ["start", "Start at", "time", () => 0],
    ["duration", "Ramp time", "time", (o) => o.duration],
  ]],
  sine: ["Sine", [AMPLITUDE, ["frequency", "Frequency", "frequency", (o) => 2 / o.duration], OFFSET, [
    "phase",
    "Phase",
    "angle",
    () => 0,
  ]]],
  chirp: ["Chirp", [
    AMPLITUDE,
    ["from", "From", "frequency", (o) => 1 / o.duration],
    ["to", "To", "frequency", (o) => 20 / o.duration],
    ["duration", "Sweep time", "time", (o) => o.duration],
    OFFSET,
  ]],
  random: ["Random levels", [
    ["hold", "Hold time", "time", (o) => o.duration / 8],
    ["lower", "Lowest", "value", (o) => o.rest],
    ["upper", "Highest", "value", (o) => o.full],
    ["seed", "Seed", "seed", () => 1],
  ]],
  table: ["Table", []],
};
/** Fields the server requires; it has defaults for the others. */
const NEEDED = new Set(["off", "period", "duration", "frequency", "hold"]);
const LEVELS = new Set(["level", "amplitude", "to", "upper"]);

/** @param {Signal} s @returns {Start} */
const startOf = (s) => ({ duration: numberAt("duration") ?? 4, rest: s.rest(), full: s.full });

/** The same signal in another shape: fields of the same name are kept.
 * @param {Signal} s @param {string} shape */
function reshape(s, shape) {
  const label = `${s.path.split(".").at(-1)} ${shape}`;
  if (shape === "constant") return setDrive(s.path, 0, label);
  const old = at(drive.peek(), s.path), o = startOf(s);
  if (shape === "table") {
    return setDrive(s.path, {
      shape,
      times: [0, o.duration / 2, o.duration],
      values: [s.rest(), s.full, s.rest()],
    }, label);
  }
  const isShare = s.quantity === "ratio";
  const kept = typeof old === "object" && old ? old : {};
  const entries = SHAPES[shape][1].flatMap(([key, , kind, start]) => {
    const same = kept[key] !== undefined &&
      SHAPES[kept.shape]?.[1].some(([k, , itsKind]) => k === key && itsKind === kind);
    if (same) return [[key, kept[key]]];
    return NEEDED.has(key) || (LEVELS.has(key) && !isShare) || kind === "frequency" ? [[key, start(o)]] : [];
  });
  setDrive(s.path, { shape, ...Object.fromEntries(entries) }, label);
}

/** @type {Record<Kind, Quantity | null>} */
const QUANTITIES = {
  time: "time",
  value: null,
  share: "ratio",
  frequency: "frequency",
  angle: "angle",
  seed: "number",
};

/** The signals of a drive: name, and quantity of the levels. @type {Record<string, [string, Quantity]>} */
const WHOSE = {
  command: ["Command", "ratio"],
  "load.force": ["External force", "force"],
  "controller.reference": ["Reference", "length"],
  "controller.angle": ["Angle", "angle"],
  "controller.stiffness.reference": ["Stiffness", "rotary"],
};

/** Name and quantity of a field of a signal by its path; null: it is no such field.
 * @param {string} path @param {any} signal @returns {{label: string, quantity: Quantity} | null} */
export function signalField(path, signal) {
  const dot = path.lastIndexOf("."), whose = WHOSE[path.slice(0, dot)], key = path.slice(dot + 1);
  const row = whose && SHAPES[signal?.shape]?.[1].find(([name]) => name === key);
  if (!row) return null;
  return { label: `${whose[0]}: ${row[1].toLowerCase()}`, quantity: QUANTITIES[row[2]] ?? whose[1] };
}

/** @param {Signal} s @param {Row} row */
function field(s, [key, label, kind, start]) {
  /** @type {Record<Kind, {quantity: Quantity, bounds: [number, number], log?: boolean}>} */
  const kinds = {
    time: { quantity: "time", bounds: [0, Math.max(numberAt("duration") ?? 4, 1e-3)] },
    value: { quantity: s.quantity, bounds: [s.low(), s.high] },
    share: { quantity: "ratio", bounds: [0.01, 0.99] },
    frequency: { quantity: "frequency", bounds: [0.01, 50], log: true },
    angle: { quantity: "angle", bounds: [0, 2 * Math.PI] },
    seed: { quantity: "number", bounds: [0, 100] },
  };
  return driveField(`${s.path}.${key}`, { label, ...kinds[kind], usual: () => start(startOf(s)) });
}

/** @param {Signal} s @param {string} label */
export function signalFields(s, label) {
  const shape = computed(() => {
    const value = at(drive.value, s.path);
    return typeof value === "object" && value ? String(value.shape) : "constant";
  });
  /** @returns {[string, string][]} */
  const options = () => [
    ...(s.constant ? [/** @type {[string, string]} */ (["constant", "Constant"])] : []),
    ...Object.entries(SHAPES).map(([id, [title]]) => /** @type {[string, string]} */ ([id, title])),
  ];
  return h(
    "div",
    { class: "signal" },
    choiceField(
      label,
      options,
      () => shape.value,
      (next) => reshape(s, next),
      s.constant ? `${s.path}.shape` : s.path,
    ),
    () => {
      if (shape.value === "constant") return s.constant ? driveField(s.path) : null;
      if (shape.value === "table") return tableField(s);
      return (SHAPES[shape.value]?.[1] ?? []).map((row) => field(s, row));
    },
  );
}

/** The times at which the command jumps or bends [s].
 * @param {any} signal @param {number} duration */
export function switchings(signal, duration) {
  const {
    shape,
    at: when = 0,
    on = 0,
    off,
    period,
    duty = 0.5,
    times = [],
    hold,
    start = 0,
    duration: takes,
  } = signal ?? {};
  const waves = (/** @type {number} */ step, /** @type {number[]} */ shares) =>
    step > 0 && duration / step <= 40
      ? Array.from({ length: Math.ceil(duration / step) }, (_, k) => shares.map((x) => (k + x) * step)).flat()
      : [];
  /** @type {Record<string, () => number[]>} */
  const all = {
    step: () => [when],
    pulse: () => [on, off],
    square: () => waves(period, [0, duty]),
    random: () => waves(hold, [0]),
    ramp: () => [start, start + takes],
    table: () => times.length <= 40 ? times : [],
  };
  return (all[shape]?.() ?? []).filter((t) => typeof t === "number" && t > 0 && t < duration);
}
