// @ts-check
// Pinned runs: computed again whenever another time window is shown, with as many rows as the run itself.
import { computed, signal } from "../../reactive.js";
import { ApiError } from "../../server/client.js";
import { Memory, Question } from "../../server/question.js";
import { siNumber } from "../../quantities.js";
import { runRequest, shownNow, simulate, timeWindow, transient, within } from "./model.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../types.js").Drive} Drive */
/** @typedef {import("../../types.js").Pin} Pin */

/** How long the server runs a document that does not say it [s]. */
const USUAL_DURATION = 4;
const REMEMBERED = 32;

/** @type {import("../../reactive.js").Signal<Pin[]>} */
export const pins = computed(() => transient.value.pins);
/** The newest run of each pinned drive document, or why it failed. */
export const pinRuns = signal(/** @type {Map<string, Run | ApiError>} */ (new Map()));
/** @param {Drive} document */
export const pinKey = (document) => JSON.stringify(document);

/** Runs, and refusals by the server, by their request.
 * @type {Memory<Run | ApiError>} */
const memory = new Memory(REMEMBERED);

/** @param {string} request @param {AbortSignal} signal @throws {ApiError} if the server was not reached */
async function runOf(request, signal) {
  const known = memory.get(request);
  if (known) return known;
  /** @type {Run | ApiError} */
  let answer;
  try {
    answer = await simulate(JSON.parse(request), signal);
  } catch (error) {
    if (!(error instanceof ApiError) || !error.status) throw error;
    answer = error;
  }
  memory.set(request, answer);
  return answer;
}

/** One run after the other, each shown as soon as it is there. */
const runs = new Question(async (text, signal) => {
  /** @type {{key: string, request: string}[]} */
  const all = JSON.parse(text);
  for (const { key, request } of all) {
    try {
      show(key, await runOf(request, signal), signal);
    } catch (error) {
      if (error instanceof ApiError) show(key, error, signal);
      throw error;
    }
  }
}, { patience: 0 });

/** @param {string} key @param {Run | ApiError} answer @param {AbortSignal} signal */
function show(key, answer, signal) {
  if (!signal.aborted && pinRuns.peek().get(key) !== answer) {
    pinRuns.value = new Map(pinRuns.peek()).set(key, answer);
  }
}

/** Starts asking; called once. */
export const startPins = () =>
  runs.follow(() =>
    JSON.stringify(pins.value.map(({ drive }) => {
      const rows = within(timeWindow.value, siNumber(drive.duration) ?? USUAL_DURATION);
      return { key: pinKey(drive), request: JSON.stringify(runRequest(drive, rows)) };
    })), { active: () => shownNow.value });
