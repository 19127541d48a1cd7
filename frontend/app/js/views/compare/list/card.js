// @ts-check
// "What is missing": the verdict is this list. Entries that may be wrong come first, then the effects in the order of
// the joint proposal, then everything else that was tried.
import { waitingWords } from "../../../server/waiting.js";
import { h, icon } from "../../../dom.js";
import { effect } from "../../../reactive.js";
import { units } from "../../../state.js";
import { answer, brush, diagnosis, diagnosisError, lookCompare, progress, stage, stale } from "../answers.js";
import { fitting } from "../model/history.js";
import { errorText, rangeText } from "../words.js";
import { adequate, notNeeded, openChoices, setAside, settling } from "./adequate.js";
import { contextBlock, contextLine } from "./context.js";
import { entryRow, refitRow, skeletonRow, soFarRow } from "./entry.js";
import { kept, remaining } from "./kept.js";
import { addAll, entries, refits, soFar } from "./plan.js";
import { overWhat } from "./sketch.js";
import { insideOf } from "./selection.js";
import { share, state, unfinished } from "./state.js";
import { triedFold, triedText } from "./tried.js";
import { unknown } from "./unknown.js";

const SKELETONS = 3;
/** Height of what stands under the list, as the last verdict drew it [px]. */
let heightOfFold = 0;

/** @param {number | null} si */
const asText = (si) => {
  const a = answer.value;
  return errorText(si, a?.unit ?? "N", a?.predicted ?? "force", units.value);
};

/** The noise in the unit of the error. */
const noise = () => {
  const a = answer.value;
  return a && Object.keys(a.channels).length > 1
    ? 1
    : (diagnosis.value ?? kept.value?.result)?.noise_floor.rmse ?? null;
};

const AT_FLOOR = 1.15;

/** "All 3: 1.91 N, the noise is 1.85 N", with the button. @param {import("./plan.js").Entry[]} [all]
 * @param {boolean} [isWaiting] the next verdict is on its way */
function allRow(all = entries.value, isWaiting = false) {
  const last = all.at(-1), floor = noise();
  if (!last) return null;
  const isNoise = floor !== null && last.to <= AT_FLOOR * floor;
  return h(
    "div",
    { class: "all-row" },
    h(
      "span",
      { id: "verdict-fall" },
      all.length > 1 ? `All ${all.length}: ` : "With it: ",
      h("b", null, asText(last.to)),
      floor === null ? "" : isNoise ? `, the noise is ${asText(floor)}` : `; the noise is ${asText(floor)}`,
    ),
    all.length > 1
      ? h("button", {
        type: "button",
        id: "add-all",
        disabled: () => isWaiting || stale.value || fitting.value,
        onclick: () => addAll(),
      }, `Add all ${all.length}`)
      : null,
  );
}

/** What the chosen range asks, with the way back. */
function question() {
  const b = brush.value;
  if (!b || !entries.value.length) return null;
  const ranges = Object.entries(b).map(([name, range]) => rangeText(name, range, units.value)).filter(
    Boolean,
  );
  const known = entries.value.map((e) => insideOf(e.effect));
  const hidden = known.filter((one) => one && !one.cause).length;
  return h(
    "div",
    { class: "asked-range" },
    h(
      "span",
      null,
      h("b", null, "What would cause this? "),
      ranges.join(", "),
      hidden
        ? ` · ${hidden === known.length ? "none of these effects shows" : `${hidden} not shown`} there`
        : "",
    ),
    h("button", {
      type: "button",
      class: "link",
      onclick: () => lookCompare({ brush: null }),
    }, "Show all"),
  );
}

/** The entries; with a range chosen, those that explain what is seen there. */
function rows() {
  const all = entries.value, floor = noise();
  const inside = all.filter((e) => insideOf(e.effect)?.cause ?? true);
  return inside.map((e) => entryRow(e, all.indexOf(e), floor));
}

const key = () =>
  h(
    "p",
    { class: "sketch-key", "aria-hidden": "true" },
    h("i", { class: "line" }),
    "what it would explain",
    h("i", { class: "dot" }),
    () => `seen, over ${overWhat.value}`,
  );

/** What the last verdict said, while the model of now is diagnosed; null: nothing is known yet. */
function expected() {
  const was = kept.value, left = remaining.value, floor = noise();
  if (!was?.entries.length) return null;
  if (left.length) {
    return [
      contextLine(),
      key(),
      h("ol", { class: "plain" }, ...left.map((e, i) => entryRow(e, i, floor, was.sketches))),
      allRow(left, true),
      openChoices(),
    ];
  }
  const end = was.entries.at(-1)?.to ?? Infinity;
  return floor !== null && end <= AT_FLOOR * floor ? [contextLine(), ...settling(was.result)] : null;
}

/** @param {string} words */
const quiet = (words) => h("p", { class: "list-part muted" }, words);

/** Why more may be missing than what is named. @param {Record<string, string>} whyNot */
const moreMay = (whyNot) => {
  const { noise_known: lasts, white, rival_gains_nothing: rival } = whyNot;
  const reasons = [lasts, white, rival].filter(Boolean);
  return reasons.length ? quiet(`Whether more is missing is open: ${reasons.join("; ")}.`) : null;
};

/** What the limit of time left untried. */
const unfinishedLine = () =>
  h(
    "p",
    { class: "list-part flag note", id: "unfinished" },
    icon("info"),
    h("span", null, h("b", null, "Not finished. "), diagnosis.value?.verdict.sentence ?? ""),
  );

function body() {
  const result = diagnosis.value;
  switch (state.value) {
    case "empty":
    case "idle":
      return quiet("Nothing to compare yet. Drop a file anywhere on this page.");
    case "fault":
      return quiet("There is no comparison to diagnose.");
    case "failed":
      return quiet(diagnosisError.value?.words ?? "The diagnosis failed.");
    case "comparing":
    case "running": {
      const now = expected(), best = soFar.value;
      if (now) return now;
      const waiting = [...Array(SKELETONS).keys()].slice(best ? 1 : 0);
      return [
        contextLine(),
        key(),
        h("ol", { class: "plain" }, best ? soFarRow(best) : null, ...waiting.map(skeletonRow)),
      ];
    }
    case "stopped": {
      const best = soFar.value;
      return [
        unfinished.value
          ? unfinishedLine()
          : quiet("The diagnosis was stopped before all effects were tried."),
        best ? soFarRow(best) : null,
      ];
    }
    case "context":
      return result && contextBlock(result);
    case "verdict":
      return result && [
        contextLine(),
        h("p", { class: "unseen", id: "verdict-status" }, result.verdict.title),
        unfinished.value ? unfinishedLine() : null,
        question(),
        key(),
        refits.value ? refitRow(refits.value, result.baseline.rmse, noise()) : null,
        h("ol", { class: "plain found-missing" }, ...rows()),
        allRow(),
        result.verdict.status === "unknown_effect"
          ? quiet(`${result.verdict.sentence}`)
          : result.verdict.at_bounds && quiet(result.verdict.at_bounds),
        result.verdict.status === "unknown_effect" ? null : moreMay(result.verdict.why_not),
        setAside(result),
        openChoices(),
        notNeeded(result),
      ];
    case "adequate":
      return result && [contextLine(), ...adequate(result)];
    case "unknown":
      return result && [contextLine(), ...unknown(result)];
  }
}

function notes() {
  const messages = diagnosis.value?.messages ?? [];
  if (!messages.length || state.value === "running") return null;
  return h(
    "details",
    { class: "notes" },
    h("summary", null, "Notes"),
    h("ul", { class: "plain muted" }, ...messages.map((m) => h("li", null, m))),
  );
}

/** What stands at the right of the heading. */
const aside = () => {
  const result = diagnosis.value;
  const { waiting } = progress.value;
  if (state.value === "running" && waiting) return waitingWords(waiting);
  if (state.value === "running") {
    return [triedText(), "the order may still change"].filter(Boolean).join(" · ");
  }
  if (state.value === "context") return "entries first";
  if (state.value === "verdict" && result) {
    const n = entries.value.length;
    return `${n} effect${n === 1 ? "" : "s"} of ${triedText()}${unfinished.value ? " · not finished" : ""}`;
  }
  return triedText();
};

export function listCard() {
  const fold = h(
    "div",
    { class: "list-fold" },
    () => state.value === "context" ? null : triedFold(),
    notes,
  );
  effect(() => {
    // What was tried is known at the end again; its place stays.
    if (!kept.value) fold.style.minHeight = "";
    else if (!fold.style.minHeight) fold.style.minHeight = `${heightOfFold}px`;
  });
  effect(() => {
    if (stage.value !== "done") return;
    diagnosis.value;
    requestAnimationFrame(() => (heightOfFold = fold.offsetHeight));
  });
  return h(
    "section",
    {
      class: "card missing-card",
      "aria-label": "What is missing",
      "aria-busy": () => String(state.value === "running"),
    },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "What is missing"),
      h("small", null, () => h("span", null, aside())),
    ),
    h(
      "div",
      {
        class: "progress",
        role: "progressbar",
        "aria-label": "Diagnosis",
        "aria-valuenow": () => state.value === "running" ? Math.round(100 * share.value) : null,
        style: () => `visibility:${state.value === "running" ? "visible" : "hidden"}`,
      },
      h("i", { style: () => `width:${Math.max(3, 100 * share.value)}%` }),
    ),
    body,
    fold,
  );
}
