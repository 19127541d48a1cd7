// @ts-check
// The time cursor of plots, animation and readout; it moves without a redraw.
import { h } from "../../dom.js";
import { apart, computed, effect, signal } from "../../reactive.js";
import { run, timeWindow } from "./model.js";
import { rowAt } from "./series.js";

/** @typedef {import("../../plots/chart.js").Chart} Chart */

/** Where the user put the cursor [s]. */
const wanted = signal(0);

/** The time range shown: the window, else the whole run.
 * @type {import("../../reactive.js").Signal<[number, number]>} */
export const span = computed(() => timeWindow.value ?? [0, run.value?.duration ?? 1]);

/** The cursor, within what is shown [s]. */
export const cursor = computed(() => Math.min(span.value[1], Math.max(span.value[0], wanted.value)));

/** The second cursor, which stays where it was put [s]; null: there is none. */
export const second = signal(/** @type {number | null} */ (null));
/** Puts the second cursor where the first one is, or takes it away. */
export const toggleSecond = () => (second.value = second.peek() === null ? cursor.peek() : null);
/** The row of the run under the second cursor. */
export const secondRow = computed(() =>
  run.value && second.value !== null ? rowAt(run.value.time, second.value) : null
);

/** The row of the run under the cursor. */
export const row = computed(() => run.value ? rowAt(run.value.time, cursor.value) : 0);

/** @param {number} t [s] */
const moveCursor = (t) => (wanted.value = t);

/** @param {number} rows */
function stepCursor(rows) {
  const time = run.peek()?.time;
  if (!time) return;
  moveCursor(time[Math.min(time.length - 1, Math.max(0, row.peek() + rows))]);
}

const KEYS =
  /** @type {Record<string, number>} */ ({ ArrowLeft: -1, ArrowRight: 1, PageUp: 20, PageDown: -20 });

/** @param {KeyboardEvent} event */
function cursorKeys(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Home") moveCursor(span.peek()[0]);
  else if (event.key === "End") moveCursor(span.peek()[1]);
  else if (event.key.toLowerCase() === "b") toggleSecond();
  else if (event.key in KEYS) stepCursor(KEYS[event.key] * (event.shiftKey ? 10 : 1));
  else return;
  event.preventDefault();
}

/** How far a pointer may move in a click [px]. */
const CLICK_PX = 4;

/** Two lines over every plot: pointer and arrow keys move the first, a click puts the second. @param {Chart[]} charts */
export function followTime(charts) {
  for (const chart of charts) {
    const lines = ["cursor", "cursor second"].map((kind) => h("div", { class: kind, hidden: true }));
    chart.over.append(...lines);
    const show = () => {
      const axes = chart.axes;
      [cursor.value, second.value].forEach((at, i) => {
        const line = lines[i], px = axes && at !== null ? axes.xaxis.c2p(at) : -1;
        line.hidden = !axes || !run.peek() || px < -0.5 || px > axes.xaxis._length + 0.5;
        if (line.hidden) return;
        line.style.height = `${axes.yaxis._length}px`;
        line.style.transform = `translate(${axes.xaxis._offset + px}px,${axes.yaxis._offset}px)`;
      });
    };
    chart.host.addEventListener("pointerdown", ({ clientX: down }) => {
      // Plotly lays a cover over the page while the button is down.
      addEventListener("pointerup", ({ clientX }) => {
        if (Math.abs(clientX - down) > CLICK_PX || !chart.axes) return;
        const px = clientX - chart.host.getBoundingClientRect().left - chart.axes.xaxis._offset;
        second.value = px >= 0 && px <= chart.axes.xaxis._length ? chart.axes.xaxis.p2c(px) : null;
      }, { once: true, capture: true });
    }, { capture: true });
    effect(show);
    // Drawing must not depend on the cursor: what runs after it subscribes to nothing.
    chart.after.add(() => apart(show));
    chart.host.addEventListener("pointermove", (event) => {
      const axes = chart.axes;
      if (!axes) return;
      const px = event.clientX - chart.host.getBoundingClientRect().left - axes.xaxis._offset;
      if (px >= 0 && px <= axes.xaxis._length) moveCursor(axes.xaxis.p2c(px));
    });
    chart.host.tabIndex = 0;
    chart.host.addEventListener("keydown", cursorKeys);
  }
}
