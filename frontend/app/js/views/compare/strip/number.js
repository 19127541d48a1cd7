// @ts-check
// The error as the one big number, which counts to its new value; and the course of all steps beside it.
import { h, svg } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { computed, effect, signal } from "../../../reactive.js";
import { brief } from "../../../format.js";
import { units } from "../../../state.js";
import { caseId } from "../cases.js";
import { ahead, answer, diagnosis, heldOut, stale, steps } from "../answers.js";
import { state, wideNoise } from "../list/state.js";
import { errorText, errorUnit, overNoise } from "../words.js";

const ERROR = figure("comparison.rmse_beyond_accuracy"), RMS = figure("comparison.rmse");
const HELD_OUT = figure("comparison.holdout_rmse");
const COUNT_MS = 450;
const still = matchMedia("(prefers-reduced-motion: reduce)");

/** @param {number | null | undefined} si @param {boolean} [unit] */
const asText = (si, unit = true) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value, unit);
};

/** The noise in the unit of the error. */
const noise = computed(() => {
  const a = answer.value;
  if (!a) return null;
  return Object.keys(a.channels).length > 1 ? 1 : diagnosis.value?.noise_floor.rmse ?? a.noise_floor;
});

/** The value on screen; it runs to the error of the model. */
const at = signal(/** @type {number | null} */ (null));
const counting = signal(false);

/** Starts counting; called once. */
function follow() {
  let frame = 0, of = caseId.peek();
  effect(() => {
    const to = answer.value?.rmse_beyond_accuracy ?? null, from = at.peek();
    const isOther = of !== caseId.value; // the error of another case does not count down to this one
    of = caseId.value;
    cancelAnimationFrame(frame);
    counting.value = false;
    if (to === null || from === null || still.matches || from === to || isOther) return void (at.value = to);
    const begun = performance.now();
    counting.value = true;
    const tick = (/** @type {number} */ now) => {
      const t = Math.min(1, Math.max(0, now - begun) / COUNT_MS);
      at.value = to + (from - to) * (1 - t) ** 3;
      if (t < 1) frame = requestAnimationFrame(tick);
      else counting.value = false;
    };
    frame = requestAnimationFrame(tick);
  });
}

/** The error over the noise in words. */
const ratio = () => {
  const times = answer.value?.over_noise ?? null;
  return times === null ? null : overNoise(times);
};

const WIDTH = 196, HEIGHT = 62;

/** The errors so far and, dashed, those that the proposal would leave, over a logarithmic axis. */
export function course() {
  const a = answer.value;
  if (!a) return null;
  const past = steps.value.map((s) => s.rmse), now = stale.value ? null : a.rmse_beyond_accuracy;
  const done = [...past, now].filter((e) => e !== null && e > 0).map(Number);
  const open = stale.value || state.value !== "verdict"
    ? []
    : ahead.value.map((s) => s.rmse).filter((e) => e > 0);
  const floor = noise.value, all = [...done, ...open];
  if (!all.length) return null;
  const low = Math.log(Math.min(...all, floor || Infinity) * 0.82), high = Math.log(Math.max(...all) * 1.12);
  const x = (/** @type {number} */ i) => 10 + (i * (WIDTH - 52)) / (Math.max(all.length, 5) - 1);
  const y = (/** @type {number} */ e) => 8 + ((high - Math.log(e)) / (high - low || 1)) * (HEIGHT - 20);
  const path = (/** @type {number[]} */ list, /** @type {number} */ from) =>
    list.map((e, i) => `${i ? "L" : "M"}${x(i + from).toFixed(1)} ${y(e).toFixed(1)}`).join("");
  const last = done.length - 1;
  return svg(
    "svg",
    {
      class: "course",
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      role: "img",
      "aria-label": `Error of each step: ${done.map((e) => asText(e)).join(", ")}` +
        (open.length ? `; proposed: ${open.map((e) => asText(e)).join(", ")}` : ""),
    },
    floor ? svg("line", { class: "floor", x1: 4, x2: WIDTH - 40, y1: y(floor), y2: y(floor) }) : null,
    floor ? svg("text", { class: "floor", x: WIDTH - 36, y: y(floor) + 4 }, "noise") : null,
    open.length
      ? svg("path", { class: "open", d: path([done[last] ?? open[0], ...open], Math.max(last, 0)) })
      : null,
    ...open.map((e, i) => svg("circle", { class: "open", cx: x(i + last + 1), cy: y(e), r: 3 })),
    svg("path", { class: "done", d: path(done, 0) }),
    ...done.map((e, i) =>
      svg("circle", { class: i === last ? "now" : "done", cx: x(i), cy: y(e), r: i === last ? 4.5 : 3 })
    ),
    last > 0
      ? svg("text", { x: x(0) - 5, y: Math.min(y(done[0]) + 16, HEIGHT - 1) }, asText(done[0], false))
      : null,
  );
}

/** The newest error, for screen readers: once per step. */
const spoken = computed(() => {
  const a = answer.value;
  if (!a || stale.value) return "";
  const times = wideNoise.value ? null : ratio();
  return `${ERROR.label} ${asText(a.rmse_beyond_accuracy)}${times ? `, ${times} times the noise` : ""}`;
});

/** The error of a length as a share of the measured stroke, in words; empty for other quantities. */
const ofStroke = computed(() => {
  const share = answer.value?.stroke_percent ?? null;
  if (share === null) return "";
  // Far off it needs fewer letters, which have room.
  return share > 100 ? ` · ${brief(share / 100)}\u00a0× stroke` : ` · ${brief(share)}\u00a0% of stroke`;
});

const NOTABLE = 1.01;

/** What the error leaves out, where the accuracy of the readings explains a part. */
const beyond = () => {
  const a = answer.value, error = a?.rmse_beyond_accuracy ?? 0, all = a?.rmse ?? 0;
  return error && all > NOTABLE * error
    ? ` ${RMS.label}: ${asText(all)}; the accuracy of the readings explains the rest.`
    : "";
};

export function errorNumber() {
  follow();
  const unit = () => errorUnit(answer.value?.unit ?? "N", answer.value?.predicted ?? "force", units.value);
  return h(
    "div",
    { class: () => `error-value${stale.value ? " stale" : ""}` },
    h("p", { class: "unseen", "aria-live": "polite" }, () => spoken.value),
    h(
      "p",
      {
        class: () => `big${counting.value ? " counting" : ""}`,
        id: "error-now",
        hidden: () => at.value === null,
      },
      // Written anew with each number: a unit that is pushed aside by it would be a shift of the layout.
      () => [at.value === null ? "–" : asText(at.value, false), h("u", null, `\u00a0${unit()}`)],
    ),
    h("p", { class: "big none", hidden: () => at.value !== null }, "–"),
    h(
      "p",
      {
        class: "sub",
        id: "error-facts",
        title: () =>
          `${ERROR.label}: ${ERROR.definition}${beyond()} ${HELD_OUT.label}: ${HELD_OUT.definition}`,
      },
      () => {
        const times = ratio(), held = heldOut(), check = answer.value?.validation?.rmse ?? null;
        const isScaled = answer.value?.unit === "1", wide = isScaled ? null : wideNoise.value;
        return [
          wide
            ? `noise ${asText(wide.low)} to ${asText(wide.high)}`
            : times && !isScaled
            ? `${times} × noise`
            : isScaled
            ? "all channels"
            : answer.value
            ? "noise not known"
            : "",
          h("span", { class: "of-stroke" }, ofStroke.value),
          h(
            "span",
            { class: "more" },
            held === null || check !== null || ofStroke.value ? "" : ` · held-out ${asText(held, !isScaled)}`,
          ),
          check === null ? null : h("span", { id: "validation-error" }, ` · check ${asText(check)}`),
        ];
      },
    ),
  );
}
