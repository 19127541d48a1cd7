// @ts-check
// The one recommended action: what it is, what it will do, and its button. Nothing else on the page recommends.
import { computed } from "../../../reactive.js";
import { changeText } from "../../../format.js";
import { units } from "../../../state.js";
import { status } from "../../../store.js";
import { missing } from "../../../server/missing.js";
import { goToField } from "../../../ui/fault.js";
import { again, answer, cancel, diagnosis, diagnosisError, fault, faultField, stale } from "../answers.js";
import { openSetup, setupHas } from "../setup-panel.js";
import { asked, subject, use, useLabel } from "../list/context.js";
import { fallText, glance, REFIT } from "../list/entry.js";
import { add, entries, modelOf, refits } from "../list/plan.js";
import { share, state, wideNoise } from "../list/state.js";
import { triedText } from "../list/tried.js";
import { copyPlan, nextMeasurement } from "../list/unknown.js";
import { chooseFiles } from "../measurement/card.js";
import { fitting, refit } from "../model/history.js";
import { showTake } from "../take.js";
import { errorText, titleOf } from "../words.js";

/** `bar`: share of the error that is left, or of the work that is done.
 * @typedef {{tone: "" | "warn" | "good" | "idle", what: string, effect: string, more?: string, label: string,
 *   run: () => unknown, name?: string, bar?: number | null, primary?: boolean,
 *   listeners?: Record<string, () => void>}} Next */

/** Status of an answer: as many jobs wait as may. */
const BUSY = 429;

/** Names that keep their capital inside a sentence. */
const NAMED =
  /^(?:[A-Z][a-z]+(?: |-)(?:friction|hysteresis|slip|effect|factor|wen)|Bouc|Dahl|Coulomb|Mullins|Maxwell)/i;
/** A title inside a sentence, without what it says in brackets. @param {string} whole */
const inSentence = (whole) => {
  const title = whole.replace(/ \([^)]*\)$/, "");
  return NAMED.test(title) ? title : title.replace(/^[A-Z](?![A-Z])/, (letter) => letter.toLowerCase());
};

/** "−67 %" @param {number} from @param {number} to */
const change = (from, to) => from > 0 ? changeText(from, to) : "";

/** The field of the page for a path of the request. @param {string} path */
const keyOf = (path) => path.replace(/^(muscle|effects)\./, "compare.").replace(/^drive\./, "rig.");

/** @returns {Next} */
function ofFault() {
  const [gone] = missing.value;
  if (gone) {
    return {
      tone: "warn",
      what: "Choose the file again",
      effect: `The server does not have ${gone.name}`,
      label: "Open…",
      run: chooseFiles,
    };
  }
  const field = faultField(), key = field && keyOf(field), words = fault.value?.words ?? "";
  const inPage = key !== null && !key.includes("measurement") && setupHas(key);
  return {
    tone: "warn",
    what: inPage ? "Correct an entry" : "The comparison failed",
    effect: words,
    label: inPage ? "Go to the field" : "Try again",
    run: () => {
      if (!inPage || key === null) return again();
      openSetup("");
      goToField(key, ".compare");
    },
  };
}

/** @returns {Next} */
function ofContext() {
  const result = diagnosis.value, [entry] = result ? asked(result) : [];
  if (!result || !entry) return IDLE;
  const now = answer.value?.rmse_beyond_accuracy ?? entry.rmse_after;
  return {
    tone: "warn",
    what: `Settle the ${subject(entry)} first`,
    effect: fallText(now, entry.rmse_after),
    more: "with effects",
    label: useLabel(entry),
    run: () => use(entry),
    bar: entry.rmse_after / (now || 1),
  };
}

/** @returns {Next} */
function ofVerdict() {
  const [entry] = entries.value, values = refits.value, now = diagnosis.value?.baseline.rmse ?? 0;
  if (values) {
    return {
      tone: "",
      what: REFIT,
      effect: fallText(now, values.rmse),
      more: change(now, values.rmse),
      label: "Refit",
      run: refit,
      bar: values.rmse / (now || 1),
    };
  }
  const title = titleOf(entry.chosen);
  return {
    tone: "",
    what: `Add ${inSentence(title)}`,
    effect: fallText(entry.from, entry.to),
    more: change(entry.from, entry.to),
    label: "Add",
    name: `Add ${title}`,
    run: () => add(entry),
    bar: entry.to / (entry.from || 1),
    listeners: glance(() => modelOf(entry), `+ ${title}`),
  };
}

/** @type {Next} */
const IDLE = {
  tone: "idle",
  what: "Comparing…",
  effect: "Measured and model",
  label: "Stop",
  run: cancel,
  primary: false,
};

/** @type {import("../../../reactive.js").Signal<Next>} */
export const next = computed(() => {
  const result = diagnosis.value, a = answer.value;
  switch (state.value) {
    case "empty":
      return {
        tone: "idle",
        what: "Bring a measurement",
        effect: "Open a file, or drop it here",
        label: "Open…",
        run: chooseFiles,
      };
    case "idle":
      return {
        tone: "warn",
        what: "Choose a file to fit to",
        effect: "No file is used for the fit",
        label: "Files…",
        run: () => openSetup("files"),
      };
    case "fault":
      return ofFault();
    case "comparing":
      return IDLE;
    case "running":
      return {
        tone: "idle",
        what: "Looking for what is missing",
        effect: triedText() || "Trying every effect",
        label: "Stop",
        run: cancel,
        primary: false,
        bar: share.value,
      };
    case "stopped":
      return {
        tone: "idle",
        what: "Stopped before the end",
        effect: triedText() || "No effect was tried",
        label: "Diagnose",
        run: again,
      };
    case "failed":
      return {
        tone: "warn",
        what: diagnosisError.value?.status === BUSY ? "The server is busy" : "The diagnosis failed",
        effect: diagnosisError.value?.words ?? "There is no answer.",
        label: "Try again",
        run: again,
      };
    case "context":
      return ofContext();
    case "verdict":
      return ofVerdict();
    case "adequate": {
      const floor = result?.noise_floor.rmse ?? null, wide = wideNoise.value;
      const text = (/** @type {number | null | undefined} */ si) =>
        errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value);
      return {
        tone: "good",
        what: "Nothing is missing",
        effect: floor === null || a?.unit === "1"
          ? "The error is the noise"
          : wide
          ? `Noise ${text(wide.low)} to ${text(wide.high)}`
          : `Noise ${text(floor)}`,
        label: "Take it along",
        run: showTake,
      };
    }
    case "unknown":
      return {
        tone: "warn",
        what: !result
          ? ""
          : result.verdict.status === "undecided"
          ? "Repeat the run"
          : nextMeasurement(result),
        effect: result?.verdict.status === "undecided"
          ? "These data cannot tell more"
          : "No effect explains it",
        label: "Copy plan",
        run: async () => {
          if (!result) return;
          try {
            await copyPlan(result);
            status.value = "The plan is copied.";
          } catch {
            status.value = "The browser does not allow copying: the plan is in the list.";
          }
        },
      };
  }
});

/** Whether its button can be pressed. */
export const isReady = computed(() =>
  !fitting.value &&
  (!stale.value ||
    ["empty", "idle", "fault", "comparing", "running", "stopped", "failed"].includes(state.value))
);
