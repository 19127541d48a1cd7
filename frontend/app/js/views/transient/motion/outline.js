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
 * @param {number} length @param {number} cap @param {number} bulge half widths @param {number} y
 * @param {number} [sag] how far its middle hangs down */
export function outline(length, cap, bulge, y, sag = 0) {
  const bend = Math.min(0.22 * length, 2.2 * Math.max(bulge, cap)), middle = length / 2;
  const side = (/** @type {1 | -1} */ s) => ({
    cap: y - s * cap,
    top: y - s * bulge,
    middle: y - s * bulge + 2 * sag, // a quadratic curve passes its control point at half the distance
  });
  const up = side(1), down = side(-1);
  return [
    `M0 ${up.cap}`,
    `C${bend / 2} ${up.cap} ${bend / 2} ${up.top} ${bend} ${up.top}`,
    `Q${middle} ${up.middle} ${length - bend} ${up.top}`,
    `C${length - bend / 2} ${up.top} ${length - bend / 2} ${up.cap} ${length} ${up.cap}`,
    `L${length} ${down.cap}`,
    `C${length - bend / 2} ${down.cap} ${length - bend / 2} ${down.top} ${length - bend} ${down.top}`,
    `Q${middle} ${down.middle} ${bend} ${down.top}`,
    `C${bend / 2} ${down.top} ${bend / 2} ${down.cap} 0 ${down.cap}`,
    "Z",
  ].join("");
}
