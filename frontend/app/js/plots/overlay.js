// @ts-check
// What is drawn over the plots and moves without a redraw: cursor, load line, labels of lines and zones.
import { h } from "../dom.js";

/** @typedef {import("./chart.js").Chart} Chart */

/** One vertical cursor over all plots that share an x quantity.
 * @param {Chart[]} charts @param {(x: number | null) => void} moved in shown units; null: over no plot */
export function linkCursor(charts, moved) {
  const lines = charts.map((chart) => {
    const line = h("div", { class: "cursor", hidden: true });
    chart.over.append(line);
    return line;
  });
  /** @type {number | null} */
  let at = null;
  const show = () =>
    charts.forEach((chart, i) => {
      const axes = chart.axes;
      if (at === null || !axes) return void (lines[i].hidden = true);
      const px = axes.xaxis.c2p(at);
      lines[i].hidden = px < 0 || px > axes.xaxis._length;
      lines[i].style.height = `${axes.yaxis._length}px`;
      lines[i].style.transform = `translate(${axes.xaxis._offset + px}px,${axes.yaxis._offset}px)`;
    });
  /** @param {number | null} x */
  const move = (x) => {
    at = x;
    show();
    moved(x);
  };
  for (const chart of charts) {
    chart.after.add(show);
    chart.host.addEventListener("pointermove", (event) => {
      const axes = chart.axes;
      if (!axes) return;
      const px = event.clientX - chart.host.getBoundingClientRect().left - axes.xaxis._offset;
      move(px >= 0 && px <= axes.xaxis._length ? axes.xaxis.p2c(px) : null);
    });
    chart.host.addEventListener("pointerleave", () => move(null));
  }
}

/** A horizontal line moved by pointer or arrow keys. It is not a shape of Plotly, which sends no events while a
 * shape moves.
 * @param {Chart} chart
 * @param {{label: string, get: () => number, text: () => string, set: (shown: number, done: boolean) => void,
 *   step: () => number, left: () => boolean}} o in shown units; `left`: whether the tag is at the left end */
export function dragLine(chart, o) {
  const tag = h("span", { class: "tag" });
  const line = h("div", {
    class: "dragline",
    tabindex: 0,
    role: "slider",
    "aria-label": o.label,
    "aria-orientation": "vertical",
    "aria-valuemin": 0,
  }, tag);
  chart.over.append(line);
  const place = () => {
    const axes = chart.axes;
    const y = axes ? axes.yaxis.c2p(o.get()) : -1;
    line.hidden = !axes || y < -1 || y > axes.yaxis._length + 1;
    line.setAttribute("aria-valuenow", String(Math.round(o.get() * 100) / 100));
    line.setAttribute("aria-valuetext", o.text());
    tag.textContent = o.text();
    if (!axes || line.hidden) return;
    line.setAttribute("aria-valuemax", String(Math.round(axes.yaxis.range[1])));
    line.classList.toggle("below", y < 22);
    line.classList.toggle("left", o.left());
    line.style.width = `${axes.xaxis._length}px`;
    line.style.transform = `translate(${axes.xaxis._offset}px,${axes.yaxis._offset + y}px)`;
  };
  /** @param {PointerEvent} event */
  const drag = (event) => {
    const axes = chart.axes;
    if (!axes) return;
    const px = event.clientY - chart.host.getBoundingClientRect().top - axes.yaxis._offset;
    o.set(Math.max(0, axes.yaxis.p2c(Math.min(axes.yaxis._length, Math.max(0, px)))), false);
  };
  line.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    line.setPointerCapture(event.pointerId);
    line.focus();
    line.addEventListener("pointermove", drag);
    line.addEventListener("lostpointercapture", () => {
      line.removeEventListener("pointermove", drag);
      o.set(o.get(), true);
    }, { once: true });
  });
  line.addEventListener("keydown", (event) => {
    /** @type {Record<string, number>} */
    const steps = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10 };
    const by = steps[event.key];
    if (!by && event.key !== "Home") return;
    event.preventDefault();
    o.set(event.key === "Home" ? 0 : Math.max(0, o.get() + by * o.step()), true);
  });
  chart.after.add(place);
  return place;
}

const CLEAR_PX = 15, NAME_PX = 13;

/** Writes the name of each line beside its start, and the name of each shaded zone into it.
 * @param {Chart} chart */
export function writeLabels(chart) {
  const box = h("div", { class: "labels" });
  chart.over.prepend(box);
  chart.after.add(() => {
    const axes = chart.axes;
    if (!axes || !chart.spec) return;
    const inside = (/** @type {any} */ axis, /** @type {number} */ px) => px >= 0 && px <= axis._length;
    /** @type {HTMLElement[]} */
    const nodes = [];
    let above = -Infinity;
    const lines = [...chart.spec.labels ?? []].sort((a, b) => b.y - a.y);
    for (const { text, x, y, color } of lines) {
      const px = axes.xaxis.c2p(x), py = axes.yaxis.c2p(y);
      if (!inside(axes.xaxis, px) || !inside(axes.yaxis, py)) continue;
      if (!chart.spec.room && py - above < CLEAR_PX) continue;
      above = Math.max(py, chart.spec.room ? above + NAME_PX : py);
      const label = h("span", { style: `color:${color}` }, text);
      if (chart.spec.room) {
        nodes.push(place(label, axes, axes.xaxis._length + 4, above - 8));
        continue;
      }
      const right = px > 0.5 * axes.xaxis._length;
      nodes.push(
        place(label, axes, px + (right ? -4 : 4), Math.max(0, py - 18), right ? "translateX(-100%)" : ""),
      );
    }
    for (const zone of chart.spec.zones) nodes.push(...zoneLabel(zone, axes));
    box.replaceChildren(...nodes);
  });
}

/** @param {import("./chart.js").Zone} zone @param {any} axes */
function zoneLabel(zone, axes) {
  const span = h("span", { class: "zone" }, zone.text);
  if (zone.y) {
    const top = axes.yaxis.c2p(zone.y[0]);
    if (top < 16) return [];
    return [place(span, axes, axes.xaxis._length - 8, top - 17, "translateX(-100%)")];
  }
  if (!zone.x) return [];
  const [from, to] = zone.x.map((v) => Math.min(axes.xaxis._length, Math.max(0, axes.xaxis.c2p(v))));
  if (Math.abs(to - from) < 15 || axes.yaxis._length < 150) return [];
  const middle = (from + to) / 2;
  return [place(span, axes, middle, 8, "rotate(90deg) translateY(-50%)")];
}

/** @param {HTMLElement} el @param {any} axes @param {number} x @param {number} y @param {string} [more] */
function place(el, axes, x, y, more = "") {
  el.style.transform = `translate(${axes.xaxis._offset + x}px,${axes.yaxis._offset + y}px) ${more}`;
  return el;
}

/** Draws the bands and marks of a plot behind its lines, without a redraw. @param {Chart} chart */
export function drawBands(chart) {
  const box = h("div", { class: "under", "aria-hidden": "true" });
  chart.host.prepend(box);
  chart.after.add(() => {
    const axes = chart.axes, spec = chart.spec;
    if (!axes || !spec) return;
    const width = axes.xaxis._length;
    const at = (/** @type {number} */ x) => Math.min(width, Math.max(0, axes.xaxis.c2p(x)));
    const bands = (spec.bands ?? []).map(({ x, kind }) => [at(x[0]), at(x[1]), kind])
      .filter(([from, to]) => to > from)
      .map(([from, to, kind]) =>
        h("i", {
          class: `band ${kind}`,
          style: `left:${from}px;width:${Math.max(1, Number(to) - Number(from))}px`,
        })
      );
    const marks = (spec.marks ?? []).filter((x) => axes.xaxis.c2p(x) >= 0 && axes.xaxis.c2p(x) <= width)
      .map((x) => h("i", { class: "mark", style: `left:${at(x)}px` }));
    box.style.cssText = `left:${axes.xaxis._offset}px;top:${axes.yaxis._offset}px;width:${width}px;` +
      `height:${axes.yaxis._length}px`;
    box.replaceChildren(...bands, ...marks);
  });
}
