// @ts-check
// Static curves of the muscle for the phase plot, while filling and while venting.
import { computed } from "../../reactive.js";
import { design, muscleInput } from "../../muscle/document.js";
import { post } from "../../server/client.js";
import { Question } from "../../server/question.js";
import { numberAt, shownNow } from "./model.js";

/** @typedef {import("../../types.js").Curves} Curves */
/** @typedef {{filling: Curves, venting: Curves}} Statics */

const PRESSURES = 11, POINTS = 90, AFTER_MS = 60;

const staticsQuestion = new Question(async (text, signal) => {
  const [filling, venting] = await Promise.all(
    [-1, 1].map((direction) => post("/api/curves", { ...JSON.parse(text), direction }, signal)),
  );
  return /** @type {Statics} */ ({ filling, venting });
});
/** Static curves in both directions, from no pressure up to the supply. Without them the message of the run says
 * what is wrong with the muscle. */
export const statics = computed(() => staticsQuestion.error.value ? null : staticsQuestion.answer.value);
const supplyPressure = computed(() => Math.max(numberAt("supply.pressure") ?? 6e5, 1e4));

/** Starts asking; called once. */
export const startStatics = () =>
  staticsQuestion.follow(() =>
    JSON.stringify({
      muscle: muscleInput(design.value.muscle),
      effects: design.value.effects,
      pressures: Array.from({ length: PRESSURES + 1 }, (_, i) => (i * supplyPressure.value) / PRESSURES),
      points: POINTS,
      temperature: numberAt("gas.temperature") ?? 293.15,
    }), { delay: AFTER_MS, active: () => shownNow.value });
