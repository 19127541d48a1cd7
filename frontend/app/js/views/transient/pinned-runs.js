// @ts-check
// Pinned runs, asked for once more whenever other times are looked at: as fine as the run they lie under.
import { computed, effect, signal } from "../../reactive.js";
import { ApiError } from "../../server/client.js";
import { runRequest, shownNow, simulate, timeWindow, transient, within } from "./model.js";
import { siNumber } from "../../quantities.js";

/** @typedef {import("../../types.js").Run} Run */
/** @typedef {import("../../types.js").Drive} Drive */
/** @typedef {import("../../types.js").Pin} Pin */

/** What the server runs when a document does not say how long [s]. */
const LASTS = 4;

/** @type {import("../../reactive.js").Signal<Pin[]>} */
export const pins = computed(() => transient.value.pins);
/** Answers of pinned runs by their document, as JSON: the newest rows there are. */
export const pinRuns = signal(/** @type {Map<string, Run | ApiError>} */ (new Map()));
/** @param {Drive} document */
export const pinKey = (document) => JSON.stringify(document);

/** Which request each answer belongs to, by document. @type {Map<string, string>} */
const answered = new Map();

/** @param {Pin[]} list @param {[number, number] | null} rows @param {AbortSignal} stop */
async function ask(list, rows, stop) {
  for (const { drive } of list) {
    const key = pinKey(drive);
    const body = runRequest(drive, within(rows, siNumber(drive.duration) ?? LASTS));
    const request = JSON.stringify(body);
    if (answered.get(key) === request) continue;
    /** @type {Run | ApiError} */
    let answer;
    try {
      answer = await simulate(body, stop);
    } catch (error) {
      if (!(error instanceof ApiError) && !stop.aborted) throw error;
      answer = /** @type {ApiError} */ (error);
    }
    if (stop.aborted) return;
    // A server that was away is asked again.
    if (!(answer instanceof ApiError) || answer.status) answered.set(key, request);
    pinRuns.value = new Map(pinRuns.peek()).set(key, answer);
  }
}

/** Starts asking; called once. Other pins or other times put an end to what is still under way. */
export function startPins() {
  let control = new AbortController();
  effect(() => {
    const list = pins.value, rows = timeWindow.value;
    if (!shownNow.value) return;
    control.abort();
    control = new AbortController();
    ask(list, rows, control.signal);
  });
}
