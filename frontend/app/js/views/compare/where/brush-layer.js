// @ts-check
// A range selected on a plot by dragging; arrow keys move its edges.
import { h } from "../../../dom.js";

/** @typedef {import("../../../plots/chart.js").Chart} Chart */

const SMALLEST_PX = 4, STEPS = 50;

/** @param {Chart} chart
 * @param {{get: () => [number, number] | null, set: (range: [number, number] | null) => void,
 *   text: (x: number) => string, usable: () => boolean}} o in shown units
 * @returns {() => void} updates its position */
export function brushLayer(chart, o) {
  const band = h("div", { class: "brush-band", hidden: true });
  const area = h(
    "div",
    { class: "brush-area", hidden: true, title: "Drag to choose a range, double click to clear" },
    band,
  );
  /** @type {["from" | "to", 0 | 1][]} */
  const sides = [["from", 0], ["to", 1]];
  const handles = sides.map(([name, side]) =>
    h("div", {
      class: `brush-handle ${name}`,
      hidden: true,
      tabindex: 0,
      role: "slider",
      "aria-label": `Chosen range, ${name}`,
      onkeydown: (/** @type {KeyboardEvent} */ e) => press(e, side),
      onpointerdown: (/** @type {PointerEvent} */ e) => grab(e, side),
    })
  );
  chart.over.append(area, ...handles);

  const span = () => /** @type {[number, number]} */ (chart.spec?.x.range ?? [0, 1]);
  /** @param {number} x */
  const within = (x) => Math.min(span()[1], Math.max(span()[0], x));
  /** @param {PointerEvent} event */
  const at = (event) => {
    const axes = chart.axes;
    const px = event.clientX - chart.host.getBoundingClientRect().left - axes.xaxis._offset;
    return within(axes.xaxis.p2c(px));
  };
  /** @param {number} a @param {number} b @returns {[number, number]} */
  const ordered = (a, b) => a <= b ? [a, b] : [b, a];

  /** @param {KeyboardEvent} event @param {0 | 1} side */
  function press(event, side) {
    if (event.key === "Escape") return o.set(null);
    /** @type {Record<string, number>} */
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 };
    if (!by[event.key]) return;
    event.preventDefault();
    const [low, high] = span(), now = [...o.get() ?? [low, high]];
    now[side] = within(now[side] + (by[event.key] * (event.shiftKey ? 10 : 1) * (high - low)) / STEPS);
    o.set(ordered(now[0], now[1]));
  }

  /** Follows the pointer from a fixed end. @param {HTMLElement} el @param {PointerEvent} event
   * @param {number} fixed */
  function drag(el, event, fixed) {
    event.preventDefault();
    el.setPointerCapture(event.pointerId);
    const startPx = event.clientX;
    const move = (/** @type {PointerEvent} */ e) => {
      if (Math.abs(e.clientX - startPx) >= SMALLEST_PX) o.set(ordered(fixed, at(e)));
    };
    el.addEventListener("pointermove", move);
    el.addEventListener("lostpointercapture", () => el.removeEventListener("pointermove", move), {
      once: true,
    });
  }
  /** @param {PointerEvent} event @param {0 | 1} side */
  const grab = (event, side) => {
    handles[side].focus();
    drag(handles[side], event, (o.get() ?? span())[side ? 0 : 1]);
  };
  area.addEventListener("pointerdown", (event) => {
    if (chart.axes && event.pointerType !== "touch") drag(area, event, at(event));
  });
  area.addEventListener("dblclick", () => o.set(null));

  const place = () => {
    const axes = chart.axes, usable = Boolean(axes) && o.usable();
    area.hidden = !usable;
    handles.forEach((handle) => (handle.hidden = !usable));
    if (!usable || !axes) return;
    const { _offset: left, _length: width } = axes.xaxis, { _offset: top, _length: height } = axes.yaxis;
    area.style.cssText = `left:${left}px;top:${top}px;width:${width}px;height:${height}px`;
    const range = o.get(), [low, high] = span();
    band.hidden = !range;
    const edges = (range ?? [low, high]).map((x) => Math.min(width, Math.max(0, axes.xaxis.c2p(x))));
    band.style.cssText = `left:${edges[0]}px;width:${Math.max(1, edges[1] - edges[0])}px`;
    handles.forEach((handle, side) => {
      handle.style.cssText = `left:${left + edges[side] - 12}px;top:${top}px;height:${height}px`;
      handle.classList.toggle("resting", !range);
      const value = range?.[side] ?? [low, high][side];
      handle.setAttribute("aria-valuemin", String(low));
      handle.setAttribute("aria-valuemax", String(high));
      handle.setAttribute("aria-valuenow", String(value));
      handle.setAttribute("aria-valuetext", o.text(value));
    });
  };
  chart.after.add(place);
  return place;
}
