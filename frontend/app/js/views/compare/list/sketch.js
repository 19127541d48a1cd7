// @ts-check
// The signature of each proposed effect: what it would explain (line) beside what is seen of it (dots). Seen is the
// residual of the whole proposal without this effect, its other values unchanged.
import { svg } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { view } from "../../../state.js";
import { Question } from "../../../server/question.js";
import { ahead, brush, compare, compareWith, comparisonsWith, diagnosis, stage } from "../answers.js";
import { keyOf, valuesOf } from "../request.js";
import { channelWords, column, varies } from "../words.js";
import { entries } from "./plan.js";

/** @typedef {import("../types.js").Comparison} Comparison */
/** A curve over bins 0…1; `shortening`: of that direction only.
 * @typedef {{x: number, seen: number, expected: number}[]} Curve */
/** `channel`: of several, the one in which the effect shows most.
 * @typedef {{over: string, channel: string, lengthening: Curve, shortening: Curve | null, most: number}} Sketch */

const BINS = 9, INSTANTS = 24, APART = 0.12;

/** Of several channels the one that an effect changes most, in units of its noise.
 * @param {Comparison} whole @param {Comparison} less */
function channelOf(whole, less) {
  const names = Object.keys(less.channels);
  /** @param {string} name */
  const size = (name) => {
    let n = 0, sum = 0;
    less.series.forEach((s, k) => {
      if (s.channel !== name) return;
      s.predicted.forEach((mine, i) => {
        const both = whole.series[k]?.predicted[i];
        if (mine === null || both == null) return;
        n++;
        sum += (both - mine) ** 2;
      });
    });
    return n ? Math.sqrt(sum / n) / less.channels[name].noise_floor : 0;
  };
  const sizes = names.map(size);
  return names[sizes.indexOf(Math.max(...sizes))] ?? less.series[0]?.channel ?? "";
}

/** @param {Comparison} whole @param {Comparison} less @param {boolean} isRun @returns {Sketch | null} */
function sketchOf(whole, less, isRun) {
  const channel = channelOf(whole, less), own = less.series.filter((s) => s.channel === channel);
  const over = (isRun ? ["time"] : ["contraction", "pressure", "time"]).find((name) => varies(own, name));
  if (!over) return null;
  const count = over === "time" ? INSTANTS : BINS;
  let low = Infinity, high = -Infinity;
  for (const v of own.flatMap((s) => column(s, over))) {
    if (v === null) continue;
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  const span = high - low;
  /** @param {(direction: number) => boolean} belongs @returns {Curve} */
  const curve = (belongs) => {
    const bins = Array.from({ length: count }, () => ({ n: 0, seen: 0, expected: 0 }));
    less.series.forEach((s, k) => {
      if (s.channel !== channel) return;
      const x = column(s, over);
      s.residual.forEach((r, i) => {
        const at = x[i], whole_ = whole.series[k]?.predicted[i], mine = s.predicted[i];
        if (r === null || at === null || whole_ == null || mine === null) return;
        if (!belongs(Math.sign(s.direction[i] ?? 0))) return;
        const bin = bins[Math.min(count - 1, Math.floor(((at - low) / span) * count))];
        bin.n++;
        bin.seen += r;
        bin.expected += whole_ - mine;
      });
    });
    return bins.flatMap(({ n, seen, expected }, i) =>
      n ? [{ x: (i + 0.5) / count, seen: seen / n, expected: expected / n }] : []
    );
  };
  const both = curve(() => true), up = curve((d) => d >= 0), down = curve((d) => d < 0);
  const most = Math.max(
    ...[...both, ...up, ...down].flatMap((p) => [Math.abs(p.seen), Math.abs(p.expected)]),
    1e-12,
  );
  const gap = Math.max(
    0,
    ...up.map((p) => Math.abs(p.expected - (down.find((q) => q.x === p.x) ?? p).expected)),
  );
  return !isRun && gap > APART * most && down.length
    ? { over, channel, lengthening: up, shortening: down, most }
    : { over, channel, lengthening: both, shortening: null, most };
}

const isRun = computed(() => diagnosis.value?.kind === "transient");

/** The variable of the sketches, as their key names it. */
export const overWhat = computed(() => (isRun.value ? "time" : "ε"));

/** The effects of the proposal. */
const ids = computed(() =>
  stage.value === "done" && diagnosis.value ? entries.value.map((e) => e.effect) : []
);

/** The comparisons to ask for: with the whole proposal, then without each of its effects. */
const texts = computed(() => {
  const end = ahead.value.at(-1);
  if (!ids.value.length || !end) return null;
  const c = compare.peek(), model = /** @type {import("../types.js").Model} */ (end.model);
  const values = { ...c.muscle.values, ...valuesOf(model.muscle) };
  const ask = (/** @type {string} */ less) =>
    keyOf(c, {
      effects: Object.fromEntries(Object.entries(model.effects).filter(([id]) => id !== less)),
      freed: [],
      values,
    });
  return JSON.stringify(["", ...ids.value].map(ask));
});

/** What each effect of the whole proposal explains in the chosen range. */
const explained = new Question(compareWith, { patience: 0 });
/** The answer; null while it is not known. */
export const explains = computed(() =>
  explained.stale.value ? null : explained.answer.value?.explains ?? null
);

const question = new Question((text, stop) => comparisonsWith(JSON.parse(text), stop), { patience: 0 });
/** Starts asking; called once. */
export function followSketches() {
  const active = () => view.value === "compare";
  question.follow(() => texts.value, { active });
  explained.follow(() => {
    const range = brush.value, whole = texts.value && JSON.parse(texts.value)[0];
    return range && whole ? JSON.stringify({ ...JSON.parse(whole), within: range, explain: true }) : null;
  }, { active });
}

/** Effect -> the comparison of the whole proposal without it, and "": with all.
 * @type {import("../../../reactive.js").Signal<Record<string, Comparison>>} */
export const without = computed(() => {
  const found = question.stale.value ? null : question.answer.value;
  const names = ["", ...ids.peek()];
  return Object.fromEntries((found ?? []).flatMap((one, i) => one ? [[names[i], one]] : []));
});

/** Effect -> its sketch. @type {import("../../../reactive.js").Signal<Record<string, Sketch>>} */
export const sketches = computed(() => {
  const { "": whole, ...less } = without.value;
  return Object.fromEntries(
    Object.entries(less).flatMap(([id, one]) => {
      const sketch = whole ? sketchOf(whole, one, isRun.value) : null;
      return sketch ? [[id, sketch]] : [];
    }),
  );
});

const WIDTH = 124, HEIGHT = 54, EDGE = 5;

/** @param {Sketch | undefined} sketch @param {string} title */
export function drawSketch(sketch, title) {
  const frame = { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "sketch" };
  if (!sketch) return svg("svg", { ...frame, "aria-hidden": "true" });
  const { lengthening, shortening, most, over } = sketch, r = over === "time" ? 1.6 : 2.3;
  const lines = [lengthening, ...(shortening ? [shortening] : [])];
  const values = lines.flat().flatMap((p) => [p.seen, p.expected]);
  const low = Math.min(0, ...values), high = Math.max(0, ...values), span = high - low || most;
  const x = (/** @type {number} */ t) => EDGE + t * (WIDTH - 2 * EDGE);
  const y = (/** @type {number} */ v) => EDGE + ((high - v) / span) * (HEIGHT - 2 * EDGE);
  return svg(
    "svg",
    {
      ...frame,
      role: "img",
      "aria-label": `Over ${over}: the ${
        channelWords(sketch.channel)
      } that ${title} would explain (line) and the residual seen (dots)`,
    },
    svg("line", { class: "zero", x1: EDGE, x2: WIDTH - EDGE, y1: y(0), y2: y(0) }),
    ...lines.map((line, i) =>
      svg("path", {
        class: i ? "expected dashed" : "expected",
        d: line.map((p, k) => `${k ? "L" : "M"}${x(p.x).toFixed(1)} ${y(p.expected).toFixed(1)}`).join(""),
      })
    ),
    ...lines.flat().map((p) => svg("circle", { class: "seen", cx: x(p.x), cy: y(p.seen), r })),
  );
}
