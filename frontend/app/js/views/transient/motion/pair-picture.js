// @ts-check
// A joint from the side, to scale: one muscle or both, cable, pulley with pointer and stops. A cam is drawn as the
// pulley of its lever in the middle.
import { computed, effect } from "../../../reactive.js";
import { row } from "../cursor.js";
import { numberAt, run } from "../model.js";
import { draw, outline, place } from "./outline.js";
import { middleOf } from "../series.js";

/** @typedef {import("../../../types.js").Run} Run */

const HEIGHT = 168, LEFT = 26, MARGIN = 26, GAP = 10, APART = 6;

/** Braid diameter at a contraction, with threads of constant length.
 * @param {Run["geometry"]} g @param {number} k */
function widthAt(g, k) {
  const cosine = Math.min(1, (1 - k) * Math.cos(g.braid_angle));
  return (g.braid_diameter * Math.sqrt(1 - cosine ** 2)) / Math.sin(g.braid_angle);
}

/** Contraction at a braid diameter, the other way round. @param {Run["geometry"]} g @param {number} diameter */
function contractionAt(g, diameter) {
  const sine = Math.min(1, diameter * Math.sin(g.braid_angle) / g.braid_diameter);
  return 1 - Math.sqrt(1 - sine ** 2) / Math.cos(g.braid_angle);
}

/** Radius of the pulley: way of its rim over the angle. @param {Run} r */
function rimOf(r) {
  const angles = r.joint?.angle ?? [];
  let most = -1;
  angles.forEach((/** @type {number | null} */ a, /** @type {number} */ i) => {
    if (a != null && (most < 0 || Math.abs(a) > Math.abs(angles[most] ?? 0))) most = i;
  });
  return most >= 0 && angles[most] ? (r.position[most] ?? 0) / (angles[most] ?? 1) : 0;
}

/** Scale and positions, which stay the same while the cursor moves. @param {Run} r @param {number} width @param {number} radius */
function sceneOf(r, width, radius) {
  const rest = r.geometry.nominal_length, middle = middleOf(r);
  const { position_min: low, position_max: high } = r.limits;
  const reach = r.joint?.counter_pressure ? Math.max(-low, high) : -low;
  const longest = rest * (1 - middle) + reach, widest = widthAt(r.geometry, middle + reach / rest);
  const tall = 2 * Math.max(radius, widest / 2) + widest;
  const scale = Math.min(
    (width - LEFT - MARGIN - GAP) / (longest + 2 * radius),
    (HEIGHT - 14 - APART) / tall,
  );
  const apart = Math.max(scale * radius, (scale * widest + APART) / 2);
  const y = HEIGHT / 2, rim = scale * radius;
  return { scale, rest, middle, y, rim, rows: [y - apart, y + apart], x: LEFT + scale * longest + GAP + rim };
}

/** @param {import("../../../reactive.js").Signal<number>} width of the picture */
export function pairPicture(width) {
  const wall = draw("rect", { class: "wall", x: LEFT - 10, y: 8, width: 10, height: HEIGHT - 16 });
  const bodies = [draw("path", { class: "body" }), draw("path", { class: "body second" })];
  const cables = [draw("line", { class: "rod" }), draw("line", { class: "rod" })];
  const names = ["1", "2"].map((text) => {
    const el = draw("text", { class: "mass" });
    el.textContent = text;
    return el;
  });
  const wheel = draw("circle", { class: "wheel" }), hub = draw("circle", { class: "cap", r: 3.5 });
  const hand = draw("line", { class: "hand" }), zero = draw("line", { class: "zero" });
  const stops = [draw("line", { class: "limit" }), draw("line", { class: "limit" })];
  const svg = draw("svg", {
    class: "side double",
    role: "img",
    height: HEIGHT,
    "aria-label": "The muscles and the pulley of the joint from the side",
  });
  svg.append(wall, ...cables, wheel, ...bodies, ...names, zero, ...stops, hand, hub);

  const radius = computed(() => numberAt("load.pulley_radius") ?? (run.value ? rimOf(run.value) : 0));
  const scene = computed(() => {
    const r = run.value;
    const room = width.value > LEFT + MARGIN + GAP; // the width is not known before the first layout
    return r?.joint && room && radius.value > 0 ? sceneOf(r, width.value, radius.value) : null;
  });
  /** @param {{x: number, y: number}} s @param {number} angle @param {number} far */
  const rimAt = (s, angle, far) => [s.x + far * Math.cos(angle), s.y - far * Math.sin(angle)];
  /** @param {Element} line @param {{x: number, y: number}} s @param {number} angle @param {number} from
   * @param {number} to */
  const spoke = (line, s, angle, from, to) => {
    const [x1, y1] = rimAt(s, angle, from), [x2, y2] = rimAt(s, angle, to);
    place(line, { x1, y1, x2, y2 });
  };
  effect(() => {
    const s = scene.value, r = run.value;
    svg.setAttribute("viewBox", `0 0 ${width.value} ${HEIGHT}`);
    if (!s || !r) return;
    for (const part of [bodies[1], cables[1], names[1]]) {
      part.setAttribute("visibility", r.joint?.counter_pressure ? "visible" : "hidden");
    }
    place(wheel, { cx: s.x, cy: s.y, r: s.rim });
    place(hub, { cx: s.x, cy: s.y });
    spoke(zero, s, 0, s.rim, s.rim + 7);
    [r.limits.position_min, r.limits.position_max].forEach((x, i) =>
      spoke(stops[i], s, x / radius.value, s.rim - 1, s.rim + 9)
    );
  });
  effect(() => {
    const s = scene.value, r = run.value, i = row.value;
    const angle = r?.joint?.angle[i], position = r?.position[i];
    if (!s || !r || angle == null || position == null) return;
    const pressures = [r.pressure[i] ?? 0, r.joint?.counter_pressure?.[i] ?? 0];
    const most = [...r.pressure, ...r.joint?.counter_pressure ?? []].reduce(
      (/** @type {number} */ top, v) => Math.max(top, v ?? 0),
      1,
    );
    const cap = (s.scale * r.geometry.braid_diameter) / 2;
    const cams = numberAt("load.pulley_radius") == null;
    const contractions = [
      r.contraction[i] ?? 0,
      contractionAt(r.geometry, r.joint?.counter_diameter?.[i] ?? 0),
    ];
    [1, -1].forEach((sense, n) => {
      const k = cams ? contractions[n] : s.middle + (sense * position) / s.rest;
      const length = s.scale * s.rest * (1 - k);
      const y = s.rows[n], x = LEFT + length;
      place(bodies[n], {
        d: outline(length, cap, (s.scale * widthAt(r.geometry, k)) / 2, y),
        transform: `translate(${LEFT})`,
        style: `--full:${Math.max(0, pressures[n] / most)}`,
      });
      place(cables[n], { x1: x, y1: y, x2: s.x, y2: s.y - sense * s.rim });
      place(names[n], { x: LEFT + 16, y: y + 4 });
    });
    bodies[0].classList.toggle("slack", r.slack[i]); // the answer says it of the first muscle only
    spoke(hand, s, angle, 0, s.rim + 5);
    hand.classList.toggle("touching", Boolean(r.contact[i]));
  });
  return svg;
}
