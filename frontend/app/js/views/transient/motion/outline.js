// @ts-check
// Drawing muscles from the side.

const SVG = "http://www.w3.org/2000/svg";

/** @param {Element} el @param {Record<string, string | number>} attributes */
export function place(el, attributes) {
  for (const [key, value] of Object.entries(attributes)) el.setAttribute(key, String(value));
}

/** @param {string} tag @param {Record<string, string | number>} [attributes] */
export function draw(tag, attributes = {}) {
  const el = document.createElementNS(SVG, tag);
  place(el, attributes);
  return el;
}

/** The outline of a muscle from x = 0 to its length: caps as wide as the braid at rest, a bulge between them.
 * @param {number} length @param {number} cap @param {number} bulge half widths @param {number} y */
export function outline(length, cap, bulge, y) {
  const bend = Math.min(0.22 * length, 2.2 * Math.max(bulge, cap));
  const side = (/** @type {1 | -1} */ s) => ({
    cap: y - s * cap,
    top: y - s * bulge,
  });
  const up = side(1), down = side(-1);
  return [
    `M0 ${up.cap}`,
    `C${bend / 2} ${up.cap} ${bend / 2} ${up.top} ${bend} ${up.top}`,
    `L${length - bend} ${up.top}`,
    `C${length - bend / 2} ${up.top} ${length - bend / 2} ${up.cap} ${length} ${up.cap}`,
    `L${length} ${down.cap}`,
    `C${length - bend / 2} ${down.cap} ${length - bend / 2} ${down.top} ${length - bend} ${down.top}`,
    `L${bend} ${down.top}`,
    `C${bend / 2} ${down.top} ${bend / 2} ${down.cap} 0 ${down.cap}`,
    "Z",
  ].join("");
}
