// @ts-check
// Colours of the map, and the ink that reads best on them. Pure functions.

/** Zero, negative and positive, as the style sheet has them: the contrast is computed from these. */
const COLOURS = {
  light: { zero: [244, 246, 248], low: [28, 95, 189], high: [194, 65, 12] },
  dark: { zero: [34, 44, 54], low: [106, 168, 255], high: [255, 138, 92] },
};
// Pure black and white: on any colour one of them has a contrast of at least √21 = 4.58, enough for WCAG AA (4.5).
const DARK_INK = "#000000", LIGHT_INK = "#ffffff";

/** The colour of a place on the scale. @param {number} share −1…1 of the full colour */
export const tint = (share) => {
  const size = Math.round(100 * Math.min(1, Math.abs(share)));
  return `color-mix(in srgb, var(${share < 0 ? "--heat-low" : "--heat-high"}) ${size}%, var(--heat-zero))`;
};

/** Relative luminance (WCAG 2). @param {number[]} rgb 0…255 */
function luminance(rgb) {
  const [r, g, b] = rgb.map((v) => v / 255).map((v) =>
    v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4
  );
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** The ink with the larger contrast. @param {number} share @param {boolean} dark */
export function inkOn(share, dark) {
  const { zero, low, high } = COLOURS[dark ? "dark" : "light"], end = share < 0 ? low : high;
  const size = Math.min(1, Math.abs(share));
  const behind = luminance(zero.map((v, i) => v + (end[i] - v) * size));
  return 1.05 / (behind + 0.05) > (behind + 0.05) / 0.05 ? LIGHT_INK : DARK_INK;
}
