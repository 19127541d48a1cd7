// @ts-check
// The muscle from the side, to scale, at the time of the cursor; play, pause, time slider.
import { h, icon } from "../../../dom.js";
import { computed, effect, signal } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { brief, withUnit } from "../../../format.js";
import { paired, readout, setWindow } from "../plots/charts.js";
import { cursor, cursorKeys, moveCursor, row, span } from "../cursor.js";
import { numberAt, run, timeWindow } from "../model.js";
import { draw, outline, place } from "./outline.js";
import { pairPicture } from "./pair-picture.js";

/** @typedef {import("../../../types.js").Run} Run */

const HEIGHT = 118, LEFT = 26, RIGHT = 92, BLOCK = 56, STEPPED_MS = 250;
const SAG = 8; // px: that a muscle is slack, not by how much

/** @param {(number | null)[]} values */
const greatest = (values) => values.reduce((/** @type {number} */ most, v) => Math.max(most, v ?? 0), 0);

/** Scale and stops, which stay the same while the cursor moves. @param {Run} r @param {number} width */
function sceneOf(r, width) {
  const rest = r.geometry.nominal_length, ratio = numberAt("load.lever_ratio") ?? 1;
  const longest = Math.max(greatest(r.length), rest - ratio * r.limits.position_min, rest);
  const widest = greatest(r.diameter);
  const scale = Math.min((width - LEFT - RIGHT) / longest, (HEIGHT - 26) / widest);
  const stop = (/** @type {number} */ x) => LEFT + scale * (rest - ratio * x);
  return {
    scale,
    low: stop(r.limits.position_min),
    high: stop(r.limits.position_max),
    rest: LEFT + scale * rest,
  };
}

function picture() {
  const width = signal(600);
  const wall = draw("rect", { class: "wall", x: LEFT - 10, y: 12, width: 10, height: HEIGHT - 24 });
  const ghost = draw("path", { class: "ghost" }), body = draw("path", { class: "body" });
  const rod = draw("line", { class: "rod" }), block = draw("rect", { class: "weight", rx: 5 });
  const mass = draw("text", { class: "mass" }), pull = draw("path", { class: "pull" });
  const pullText = draw("text", { class: "note" });
  const stops = [draw("rect", { class: "stop" }), draw("rect", { class: "stop" })];
  const first = draw("circle", { class: "cap", r: 4 });
  const svg = draw("svg", {
    class: "side",
    role: "img",
    height: HEIGHT,
    "aria-label": "The muscle from the side",
  });
  svg.append(wall, ghost, ...stops, rod, body, first, block, mass, pull, pullText);
  const box = h("div", { class: () => `stage${paired.value ? " paired" : ""}` });
  box.append(svg, pairPicture(width));
  new ResizeObserver(([entry]) => (width.value = Math.round(entry.contentRect.width))).observe(box);

  const scene = computed(() => run.value ? sceneOf(run.value, width.value) : null);
  const y = HEIGHT / 2;
  effect(() => {
    const s = scene.value, r = run.value;
    svg.setAttribute("viewBox", `0 0 ${width.value} ${HEIGHT}`);
    if (!s || !r) return;
    const cap = (s.scale * r.geometry.braid_diameter) / 2;
    ghost.setAttribute("d", outline(s.rest - LEFT, cap, cap, y));
    ghost.setAttribute("transform", `translate(${LEFT})`);
    // The load touches the upper stop with its left side, the lower one with its right side.
    const right = s.low + 12 + BLOCK, left = s.high + 12;
    for (const [stop, x] of /** @type {[Element, number][]} */ ([[stops[0], right], [stops[1], left - 4]])) {
      place(stop, { x, y: y - 29, width: 4, height: 58 });
    }
    const { weight } = r;
    mass.textContent = withUnit(numberAt("load.mass") ?? 0, "mass", units.value);
    pullText.textContent = Math.abs(weight) > 0.5 ? withUnit(Math.abs(weight), "force", units.value) : "";
    pull.setAttribute("visibility", Math.abs(weight) > 0.5 ? "visible" : "hidden");
    pull.setAttribute("d", weight > 0 ? "M0 0h16m-5 -4 5 4-5 4" : "M16 0h-16m5 -4-5 4 5 4");
  });
  effect(() => {
    const s = scene.value, r = run.value, i = row.value;
    const length = r?.length[i], diameter = r?.diameter[i];
    if (!s || !r || length == null || diameter == null) return;
    const cap = (s.scale * r.geometry.braid_diameter) / 2, end = s.scale * length, x = LEFT + end;
    body.setAttribute("d", outline(end, cap, (s.scale * diameter) / 2, y, r.slack[i] ? SAG : 0));
    body.classList.toggle("slack", r.slack[i]);
    body.setAttribute("transform", `translate(${LEFT})`);
    place(rod, { x1: x, x2: x + 12, y1: y, y2: y });
    place(first, { cx: x, cy: y });
    place(block, { x: x + 12, y: y - 23, width: BLOCK, height: 46 });
    place(mass, { x: x + 12 + BLOCK / 2, y: y + 4 });
    block.classList.toggle("touching", Boolean(r.contact[i]));
    pull.setAttribute("transform", `translate(${x + 14} ${y + 41})`);
    place(pullText, { x: x + 35, y: y + 45 });
    // The pressure of the muscle is its colour.
    const most = Math.max(1, greatest(r.pressure));
    body.style.setProperty("--full", String(Math.max(0, (r.pressure[i] ?? 0) / most)));
  });
  return box;
}

const playing = signal(false);
const speed = signal(0);

/** Seconds of the run per second: real time, unless the user chose a speed or the run is long. */
const rate = computed(() => speed.value || Math.max(1, (span.value[1] - span.value[0]) / 20));

/** Plays from the cursor to the end, or from the start if the cursor is at the end; in steps if the system asks for
 * reduced motion. */
function play() {
  const [from, to] = span.peek();
  if (cursor.peek() >= to - 1e-9) moveCursor(from);
  playing.value = true;
  const reduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
  let last = performance.now();
  const step = () => {
    if (!playing.peek() || view.peek() !== "transient") return void (playing.value = false);
    const now = performance.now();
    const next = cursor.peek() + ((now - last) / 1000) * rate.peek();
    last = now;
    moveCursor(Math.min(next, span.peek()[1]));
    if (next >= span.peek()[1]) playing.value = false;
    else if (reduced) setTimeout(step, STEPPED_MS);
    else requestAnimationFrame(step);
  };
  step();
}
export const togglePlay = () => playing.peek() ? void (playing.value = false) : play();

/** @type {[number, string][]} */
const RATES = [[0, "real time"], [0.5, "½ speed"], [0.2, "⅕ speed"], [0.05, "1/20 speed"]];

function controls() {
  const scrub = h("input", {
    type: "range",
    min: 0,
    max: 1000,
    step: "any",
    "aria-label": "Time of the cursor",
    oninput: () => {
      const [from, to] = span.peek();
      moveCursor(from + (Number(scrub.value) / 1000) * (to - from));
    },
    onkeydown: cursorKeys,
  });
  effect(() => {
    const [from, to] = span.value, share = (cursor.value - from) / (to - from || 1);
    scrub.value = String(1000 * share);
    scrub.style.setProperty("--at", `${100 * share}%`);
    scrub.setAttribute("aria-valuetext", `${brief(cursor.value)} s`);
  });
  return h(
    "div",
    { class: "transport" },
    h("button", {
      type: "button",
      class: "primary play",
      "aria-label": () => playing.value ? "Pause" : "Play",
      title: () => `${playing.value ? "Pause" : "Play"}  (space)`,
      disabled: () => !run.value,
      onclick: togglePlay,
    }, () => icon(playing.value ? "pause" : "play")),
    scrub,
    h("b", { class: "num clock" }, () => `${cursor.value.toFixed(span.value[1] < 10 ? 3 : 2)} s`),
    h("select", {
      "aria-label": "Playing speed",
      class: "small",
      onchange: (
        /** @type {Event} */ e,
      ) => (speed.value = Number(/** @type {HTMLSelectElement} */ (e.target).value)),
    }, ...RATES.map(([value, name]) => h("option", { value: String(value) }, name))),
    windowFields(),
  );
}

/** The time window as numbers, which can also be dragged in the plots. */
function windowFields() {
  /** @param {0 | 1} side @param {string} label */
  const entry = (side, label) =>
    h("input", {
      type: "text",
      inputmode: "decimal",
      "aria-label": label,
      value: () => brief(span.value[side]),
      onchange: (/** @type {Event} */ e) => {
        const input = /** @type {HTMLInputElement} */ (e.target);
        const typed = Number(input.value.replace(",", ".").replace(/\s*s$/, ""));
        /** @type {[number, number]} */
        const next = [...span.peek()];
        next[side] = typed;
        if (Number.isFinite(typed) && next[0] < next[1]) setWindow(next);
        input.value = brief(span.peek()[side]);
      },
    });
  return h(
    "span",
    { class: "window" },
    h("small", null, "Window"),
    entry(0, "Window from, in seconds"),
    h("small", null, "to"),
    entry(1, "Window to, in seconds"),
    h("small", null, "s"),
    h("button", {
      type: "button",
      class: "link",
      disabled: () => timeWindow.value === null,
      title: "Also: double click in a plot",
      onclick: () => setWindow(null),
    }, "All"),
  );
}

export function stageCard() {
  return h(
    "section",
    { class: "card stage-card", "aria-label": "Motion" },
    picture(),
    controls(),
    h("div", { class: "values", "aria-live": "off" }, readout),
    h(
      "ul",
      { class: "legend key" },
      h("li", null, h("i", { class: "hatch" }), "on a stop"),
      h("li", null, h("i", { class: "slack" }), () => paired.value ? "muscle 1 slack" : "muscle slack"),
      h(
        "li",
        { hidden: () => !run.value?.stuck.includes(true) },
        h("i", { class: "stuck" }),
        "stuck by friction",
      ),
      h("li", null, h("i", { class: "fill" }), "choked filling"),
      h("li", null, h("i", { class: "exhaust" }), "choked venting"),
      h("li", null, h("i", { class: "instant" }), "switching"),
    ),
  );
}
