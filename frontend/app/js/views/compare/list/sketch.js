// @ts-check
// The signature of each proposed effect: what it would explain (line) beside what is seen of it (dots). Seen is the
// residual of the whole proposal without this effect, its other values unchanged.
import { svg } from "../../../dom.js";
import { computed } from "../../../reactive.js";
import { view } from "../../../state.js";
import { Question } from "../../../server/question.js";
import { ahead, compare, comparisonsWith, diagnosis, stage } from "../answers.js";
import { keyOf, valuesOf } from "../request.js";
import { column, varies } from "../words.js";
import { entries } from "./plan.js";

/** @typedef {import("../types.js").Comparison} Comparison */
/** A curve over bins 0…1; `shortening`: of that direction only.
 * @typedef {{x: number, seen: number, expected: number}[]} Curve */
/** @typedef {{over: string, lengthening: Curve, shortening: Curve | null, most: number}} Sketch */

const BINS = 9, APART = 0.12;

/** @param {Comparison} whole @param {Comparison} less @returns {Sketch | null} */
function sketchOf(whole, less) {
  const over = ["contraction", "pressure", "time"].find((name) => varies(less.series, name));
  if (!over) return null;
  const all = less.series.flatMap((s) => column(s, over)).filter((v) => v !== null);
  const low = Math.min(...all), span = Math.max(...all) - low;
  /** @param {(direction: number) => boolean} belongs @returns {Curve} */
  const curve = (belongs) => {
    const bins = Array.from({ length: BINS }, () => ({ n: 0, seen: 0, expected: 0 }));
    less.series.forEach((s, k) => {
      const x = column(s, over);
      s.residual.forEach((r, i) => {
        const at = x[i], whole_ = whole.series[k]?.predicted[i], mine = s.predicted[i];
        if (r === null || at === null || whole_ == null || mine === null) return;
        if (!belongs(Math.sign(s.direction[i] ?? 0))) return;
        const bin = bins[Math.min(BINS - 1, Math.floor(((at - low) / span) * BINS))];
        bin.n++;
        bin.seen += r;
        bin.expected += whole_ - mine;
      });
    });
    return bins.flatMap(({ n, seen, expected }, i) =>
      n ? [{ x: (i + 0.5) / BINS, seen: seen / n, expected: expected / n }] : []
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
  return gap > APART * most && down.length
    ? { over, lengthening: up, shortening: down, most }
    : { over, lengthening: both, shortening: null, most };
}

/** A simulated drive has no sketches: each would be a run. */
export const hasSketches = computed(() => diagnosis.value?.kind !== "transient");

/** The effects of the proposal. */
const ids = computed(() =>
  stage.value === "done" && diagnosis.value && hasSketches.value ? entries.value.map((e) => e.effect) : []
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

const question = new Question((text, stop) => comparisonsWith(JSON.parse(text), stop), { patience: 0 });
/** Starts asking; called once. */
export const followSketches = () =>
  question.follow(() => texts.value, { active: () => view.value === "compare" });

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
      const sketch = whole ? sketchOf(whole, one) : null;
      return sketch ? [[id, sketch]] : [];
    }),
  );
});

const WIDTH = 124, HEIGHT = 54, EDGE = 5;

/** @param {Sketch | undefined} sketch @param {string} title */
export function drawSketch(sketch, title) {
  const frame = { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "sketch" };
  if (!sketch) return svg("svg", { ...frame, "aria-hidden": "true" });
  const { lengthening, shortening, most } = sketch;
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
      "aria-label":
        `Over ${sketch.over}: the force that ${title} would explain (line) and the residual seen (dots)`,
    },
    svg("line", { class: "zero", x1: EDGE, x2: WIDTH - EDGE, y1: y(0), y2: y(0) }),
    ...lines.map((line, i) =>
      svg("path", {
        class: i ? "expected dashed" : "expected",
        d: line.map((p, k) => `${k ? "L" : "M"}${x(p.x).toFixed(1)} ${y(p.expected).toFixed(1)}`).join(""),
      })
    ),
    ...lines.flat().map((p) => svg("circle", { class: "seen", cx: x(p.x), cy: y(p.seen), r: 2.3 })),
  );
}
