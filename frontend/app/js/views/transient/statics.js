// @ts-check
// The muscle at rest, behind the phase plot: its curves while filling and while venting.
import { computed, effect, signal } from "../../reactive.js";
import { design, muscleInput } from "../../muscle/document.js";
import { latest, post } from "../../server/client.js";
import { numberAt, shownNow } from "./model.js";

/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {{filling: Curves, venting: Curves}} Statics */

const PRESSURES = 11, POINTS = 90, AFTER_MS = 60;

/** Static curves in both directions, from no pressure up to the supply. */
export const statics = signal(/** @type {Statics | null} */ (null));
const supplyPressure = computed(() => Math.max(numberAt("supply.pressure") ?? 6e5, 1e4));

const request = computed(() =>
  JSON.stringify({
    muscle: muscleInput(design.value.muscle),
    effects: design.value.effects,
    pressures: Array.from({ length: PRESSURES + 1 }, (_, i) => (i * supplyPressure.value) / PRESSURES),
    points: POINTS,
    temperature: numberAt("gas.temperature") ?? 293.15,
  })
);

const ask = latest(
  async (/** @type {string} */ body, control) => {
    const [filling, venting] = await Promise.all(
      [-1, 1].map((direction) => post("/api/curves", { ...JSON.parse(body), direction }, control)),
    );
    return { filling, venting };
  },
  (answer) => {
    statics.value = answer;
  },
  () => {
    statics.value = null; // the run's own message says what is wrong with the muscle
  },
);

/** Starts asking; called once. */
export function startStatics() {
  let timer = 0, asked = "";
  effect(() => {
    const body = request.value;
    if (!shownNow.value || body === asked) return;
    clearTimeout(timer);
    timer = setTimeout(() => {
      asked = body;
      ask(body);
    }, AFTER_MS);
  });
}
