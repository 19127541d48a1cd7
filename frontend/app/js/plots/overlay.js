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
/** Letters of a name, and its height. */
const LETTER_PX = 6.6, HIGH_PX = 16;
/** What it costs to lie over another name, beside 1 for each point that is covered. */
const OVER_COST = 100;
/** Number of lines from which on a name that costs so much is left out. */
const CROWD = 12, MOST_COST = 3;
/** Distance of the places at which a line is looked at [px]. */
const STROKE_PX = 4;

/** Writes the name of each line beside it, and the name of each shaded zone into it. A name that would lie over
 * another one, along a line or over a crowd of points moves along its line.
 * @param {Chart} chart */
export function writeLabels(chart) {
  const box = h("div", { class: "labels" });
  chart.over.prepend(box);
  chart.after.add(() => {
    const axes = chart.axes;
    if (!axes || !chart.spec) return;
    const lines = [...chart.spec.labels ?? []].map((label) => ({
      ...label,
      along: label.along ?? alongOf(chart.spec, label),
      px: axes.xaxis.c2p(label.x),
      py: axes.yaxis.c2p(label.y),
    })).filter(({ px, py }) => px >= 0 && px <= axes.xaxis._length && py >= 0 && py <= axes.yaxis._length)
      .sort((a, b) => a.py - b.py);
    const { room = 0 } = chart.spec;
    const nodes = room && !lines.some((line) => line.end)
      ? besideAxis(lines, axes)
      : overPlot(lines, axes, pointsOf(chart.spec, axes), strokesOf(chart.spec, axes), room);
    const points = chart.spec.zones.some((zone) => zone.above) ? pointsOf(chart.spec, axes) : [];
    for (const zone of chart.spec.zones) nodes.push(...zoneLabel(zone, axes, chart.spec.zones, points));
    box.replaceChildren(...nodes);
  });
}

/** The points of the line that a name belongs to. @param {import("./chart.js").Spec | null} spec
 * @param {import("./chart.js").Label} label */
function alongOf(spec, { x, y }) {
  const line = spec?.traces.find((t) => !t.marker && t.x.some((at, k) => at === x && t.y[k] === y));
  return line?.x.map((at, k) => /** @type {const} */ ([at, line.y[k]]));
}

/** @typedef {import("./chart.js").Label & {px: number, py: number}} PlacedLabel */

/** @param {PlacedLabel} label */
const nameOf = ({ text, color }) => h("span", { style: `color:${color}` }, text);

/** Names right of the axes, moved apart as far as they would touch. @param {PlacedLabel[]} lines from the top
 * @param {any} axes */
function besideAxis(lines, axes) {
  const step = Math.min(NAME_PX, (axes.yaxis._length + NAME_PX) / Math.max(1, lines.length));
  const tops = lines.map(({ py }) => py);
  for (let i = 1; i < tops.length; i++) tops[i] = Math.max(tops[i], tops[i - 1] + step);
  let floor = axes.yaxis._length + step / 2;
  for (let i = tops.length - 1; i >= 0; i--) {
    tops[i] = Math.min(tops[i], floor);
    floor = tops[i] - step;
  }
  return lines.map((line, i) => place(nameOf(line), axes, axes.xaxis._length + 4, tops[i] - 8));
}

/** Names over the plot, where they cover least: behind the end of a line, above or below it, or further along it.
 * @param {PlacedLabel[]} lines from the top @param {any} axes @param {[number, number][]} points
 * @param {[number, number][]} strokes places on the lines @param {number} room right of the axes [px] */
function overPlot(lines, axes, points, strokes, room) {
  const { _length: width } = axes.xaxis, { _length: height } = axes.yaxis;
  /** @type {HTMLElement[]} */
  const nodes = [];
  /** Left, top and width of the names that stand. @type {[number, number, number][]} */
  const taken = [];
  for (const line of lines) {
    const wide = 6 + LETTER_PX * line.text.length;
    const inner = line.px > 0.5 * width ? line.px - 4 - wide : line.px + 4;
    const end = line.end && [axes.xaxis.c2p(line.end.x), axes.yaxis.c2p(line.end.y)];
    const every = Math.max(1, Math.round((line.along?.length ?? 0) / 12));
    const further = (line.along ?? []).filter(([x, y], k) => k % every === 0 && x != null && y != null)
      .flatMap(([x, y]) => {
        const px = axes.xaxis.c2p(x), py = axes.yaxis.c2p(y);
        return [[px - wide / 2, py - 19], [px - wide / 2, py + 3]];
      });
    const places = [
      ...(end ? [[end[0] + 6, end[1] - 0.5 * HIGH_PX], [end[0] - wide, end[1] - 19]] : []),
      [inner, Math.max(0, line.py - 18)],
      [inner, line.py + 3],
      ...further,
    ].map(([left, top]) => [
      Math.min(Math.max(0, left), width + room - wide),
      Math.min(Math.max(0, top), height - HIGH_PX),
    ]);
    const costs = places.map(([left, top], k) => {
      const over = taken.filter(([x, y, w]) =>
        left < x + w && left + wide > x && Math.abs(top - y) < CLEAR_PX
      ).length;
      const covered = points.filter(([x, y]) =>
        x > left - 3 && x < left + wide + 3 && y > top - 2 && y < top + HIGH_PX + 2
      ).length;
      const struck = strokes.filter(([x, y]) =>
        x > left && x < left + wide && y > top + 3 && y < top + HIGH_PX - 3
      ).length * STROKE_PX / wide;
      const moved = k < (end ? 4 : 2) ? 0.4 * k : 1.5; // it stays at the end of its line unless that costs more
      return OVER_COST * over + covered + 2 * struck + moved;
    });
    const least = Math.min(...costs);
    // Two names in one place are worse than one, and in a crowd of lines so is a name that they run through.
    const most = lines.length > CROWD ? MOST_COST : OVER_COST;
    if (least >= most && line !== lines[0] && line !== lines.at(-1)) continue;
    const [left, top] = places[costs.indexOf(least)];
    taken.push([left, top, wide]);
    nodes.push(place(nameOf(line), axes, left, top));
  }
  return nodes;
}

/** Places of the drawn points in pixels. @param {import("./chart.js").Spec} spec @param {any} axes
 * @returns {[number, number][]} */
const pointsOf = (spec, axes) =>
  spec.traces.filter((t) => t.marker).flatMap((t) =>
    t.x.flatMap((x, k) => {
      const y = t.y[k];
      return x == null || y == null
        ? []
        : [/** @type {[number, number]} */ ([axes.xaxis.c2p(x), axes.yaxis.c2p(y)])];
    })
  );

/** Places along the drawn lines in pixels, `STROKE_PX` apart. @param {import("./chart.js").Spec} spec @param {any} axes
 * @returns {[number, number][]} */
const strokesOf = (spec, axes) =>
  spec.traces.filter((t) => !t.marker).flatMap((t) => {
    /** @type {[number, number][]} */
    const places = [];
    for (let k = 1; k < t.x.length; k++) {
      const [x0, y0, x1, y1] = [t.x[k - 1], t.y[k - 1], t.x[k], t.y[k]];
      if (x0 == null || y0 == null || x1 == null || y1 == null) continue;
      const from = [axes.xaxis.c2p(x0), axes.yaxis.c2p(y0)], to = [axes.xaxis.c2p(x1), axes.yaxis.c2p(y1)];
      const parts = Math.max(1, Math.round(Math.abs(to[0] - from[0]) / STROKE_PX));
      for (let i = 0; i < parts; i++) {
        places.push([from[0] + (to[0] - from[0]) * i / parts, from[1] + (to[1] - from[1]) * i / parts]);
      }
    }
    return places;
  });

/** @param {import("./chart.js").Zone} zone @param {any} axes @param {import("./chart.js").Zone[]} all
 * @param {[number, number][]} points what a name above a zone should not cover */
function zoneLabel(zone, axes, all, points) {
  const span = h("span", { class: "zone" }, zone.text);
  if (zone.y) {
    const low = axes.yaxis.c2p(zone.y[zone.above ? 1 : 0]);
    if (low < 16) return [];
    // Left of a zone that ends the axis, whose name runs down there.
    const ends = all.flatMap(({ x }) => x && axes.xaxis.c2p(x[1]) > axes.xaxis._length - 2 ? [x[0]] : []);
    const right = Math.min(axes.xaxis._length, ...ends.map((x) => axes.xaxis.c2p(x)));
    if (!zone.above) return [place(span, axes, right - 8, low - 17, "translateX(-100%)")];
    // Above or below the band, at the right or the left end: where it covers fewest points.
    const wide = LETTER_PX * zone.text.length, under = axes.yaxis.c2p(zone.y[0]) + 3;
    const places = [[right - 8, low - 17], [wide + 8, low - 17], [right - 8, under], [wide + 8, under]]
      .filter(([, top]) => top + HIGH_PX <= axes.yaxis._length);
    const covered = places.map(([end, top]) =>
      points.filter(([x, y]) => x > end - wide - 3 && x < end + 3 && y > top - 2 && y < top + HIGH_PX + 2)
        .length
    );
    const [end, top] = places[covered.indexOf(Math.min(...covered))];
    return [place(span, axes, end, top, "translateX(-100%)")];
  }
  if (!zone.x) return [];
  const [from, to] = zone.x.map((v) => Math.min(axes.xaxis._length, Math.max(0, axes.xaxis.c2p(v))));
  if (Math.abs(to - from) < 15 || axes.yaxis._length < 150) return [];
  // The names of the lines stand at the start of the axis.
  const at = from < 1 ? to - 8 : (from + to) / 2;
  return [place(span, axes, at, 8, "rotate(90deg) translateY(-50%)")];
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
