// @ts-check
// Colours of the plots, light and dark. Pressures take the viridis colours, whose lightness follows the order.
import { signal } from "../reactive.js";

/** @typedef {{dark: boolean, ink: string, soft: string, grid: string, line: string, card: string,
 *   load: string,
 *   zone: string, accent: string, second: string, pressures: [number, number, number][]}} Palette */

/** @type {Palette} */
export const LIGHT = {
  dark: false,
  ink: "#17212b",
  soft: "#4d5b6a",
  grid: "#e9edf1",
  line: "#c0c9d2",
  card: "#ffffff",
  load: "#b93815",
  zone: "rgba(120,132,146,0.13)",
  accent: "#1257b8",
  second: "#a3591a",
  pressures: [[34, 154, 136], [33, 131, 141], [45, 106, 142], [61, 78, 138], [71, 45, 123], [66, 4, 84]],
};

/** @type {Palette} */
const DARK = {
  dark: true,
  ink: "#e8edf3",
  soft: "#a7b4c2",
  grid: "#28323d",
  line: "#47535f",
  card: "#182029",
  load: "#ff9d76",
  zone: "rgba(160,175,190,0.13)",
  accent: "#79b4ff",
  second: "#f0b070",
  pressures: [[92, 126, 196], [52, 148, 172], [41, 172, 140], [94, 201, 98], [173, 220, 48], [253, 231, 37]],
};

/** @param {number} share 0…1 from the lowest to the highest pressure @param {Palette} palette */
export function pressureColour(share, palette) {
  const stops = palette.pressures;
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  const mixed = stops[i].map((c, k) => Math.round(c + (stops[i + 1][k] - c) * (at - i)));
  return `rgb(${mixed.join(",")})`;
}

/** @typedef {"system" | "light" | "dark"} Choice */
const KEY = "mckibben-theme";
const dark = matchMedia("(prefers-color-scheme: dark)");

/** Private windows may refuse storage; the choice then lasts until the page is closed. */
function stored() {
  try {
    return /** @type {Choice} */ (localStorage.getItem(KEY) ?? "system");
  } catch {
    return "system";
  }
}

export const themeChoice = signal(/** @type {Choice} */ (stored()));
export const palette = signal(LIGHT);

function apply() {
  const choice = themeChoice.peek();
  const isDark = choice === "dark" || (choice === "system" && dark.matches);
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
  palette.value = isDark ? DARK : LIGHT;
}

/** @param {Choice} choice */
export function setTheme(choice) {
  themeChoice.value = choice;
  try {
    localStorage.setItem(KEY, choice);
  } catch {
    // then it lasts until the page is closed
  }
  apply();
}
dark.addEventListener("change", apply);
apply();
