// @ts-check
// The strip that never scrolls: file, experiment, error, and the one next action.
import { h, icon } from "../../../dom.js";
import { missing } from "../../../server/missing.js";
import { answer, chosen, files } from "../answers.js";
import { caseMenu } from "../case-menu.js";
import { state } from "../list/state.js";
import { hasSource, importOnceMore, infos } from "../measurement/files.js";
import { openSetup } from "../setup-panel.js";
import { allFacts, facts, hasAssumed } from "./facts.js";
import { isReady, next } from "./next.js";
import { course, errorNumber } from "./number.js";

/** @param {number} number @param {() => "" | "done" | "now" | "warn"} tone */
const mark = (number, tone) =>
  h(
    "i",
    { class: () => `mark ${tone()}`, "aria-hidden": "true" },
    () => tone() === "done" ? icon("check") : number,
  );

const fileName = () => {
  const [first, ...more] = files.value;
  return first ? `${first.name}${more.length ? ` + ${more.length}` : ""}` : "No file yet";
};

/** "445 of 480 rows used" */
const rows = () => {
  const a = answer.value;
  return a && files.value.length
    ? `${a.rows_used} of ${a.rows} rows used`
    : missing.value.length
    ? "not on the server"
    : files.value.length
    ? "being read"
    : "";
};

/** "isobaric, 6 levels" */
const kind = () => {
  const a = answer.value;
  if (!a || !files.value.length) return "";
  const levels =
    new Set(a.series.flatMap((s) => s.pressure === null ? [] : [Math.round(s.pressure / 100)])).size;
  return levels ? `${a.kind}, ${levels} level${levels > 1 ? "s" : ""}` : a.kind;
};

function change() {
  const [only, ...more] = chosen.peek();
  if (only && !more.length && hasSource(only.id)) return importOnceMore(only.id);
  openSetup("files");
}

const fileLine = () => [
  h("button", {
    type: "button",
    class: "name",
    title: () => files.value.map((f) => f.name).join(", "),
    "aria-label": () => `Files: ${fileName()}`,
    onclick: () => openSetup("files"),
  }, fileName),
  h("p", { class: "sub" }, rows),
  h("p", { class: "sub" }, () => (infos.value, kind())),
];

const changeButton = () =>
  h("button", {
    type: "button",
    class: "link",
    hidden: () => !files.value.length,
    "aria-label": "Change the file",
    onclick: change,
  }, "Change");

/** The next action. */
function nextCell() {
  const button = h("button", {
    type: "button",
    id: "next-action",
    class: () => next.value.primary === false ? "" : "primary",
    "aria-label": () => next.value.name ?? next.value.label,
    // Not disabled, which would take the focus from it: it stays here from step to step.
    "aria-disabled": () => isReady.value ? null : "true",
    // The second click of a double click would do what the button says after the first: stop the diagnosis.
    onclick: (/** @type {MouseEvent} */ e) => {
      if (e.detail < 2 && isReady.peek()) next.peek().run();
    },
    ...Object.fromEntries(
      ["onpointerenter", "onpointerleave", "onfocus", "onblur"].map((name) => [
        name,
        () => next.peek().listeners?.[name]?.(),
      ]),
    ),
  }, () => next.value.label);
  return h(
    "section",
    { class: () => `cell next ${next.value.tone}`, "aria-label": "Next" },
    h(
      "p",
      { class: "lab" },
      mark(4, () => {
        const { tone } = next.value;
        return tone === "good" ? "done" : tone === "warn" ? "warn" : tone === "idle" ? "" : "now";
      }),
      "Next",
    ),
    h(
      "div",
      { class: "next-step" },
      h(
        "div",
        null,
        h(
          "p",
          { class: "do", id: "next-what", title: () => next.value.what },
          () => h("span", null, next.value.what),
        ),
        h(
          "p",
          { class: "eff", title: () => next.value.effect },
          h("b", null, () => next.value.effect),
          h("span", { class: "more" }, () => next.value.more ? ` (${next.value.more})` : ""),
        ),
        h(
          "div",
          { class: "next-bar", style: () => `visibility:${next.value.bar == null ? "hidden" : "visible"}` },
          h("i", { style: () => `width:${Math.min(100, Math.max(2, 100 * (next.value.bar ?? 0)))}%` }),
        ),
      ),
      button,
    ),
  );
}

export function strip() {
  return h(
    "section",
    {
      class: () => `strip${state.value === "adequate" ? " solved" : ""}`,
      "aria-label": "Case",
      "data-state": () => state.value,
    },
    h(
      "div",
      { class: "cell file-cell" },
      h(
        "p",
        { class: "lab" },
        mark(1, () => missing.value.length ? "warn" : files.value.length ? "done" : "now"),
        h("span", { class: "unseen" }, "File"),
        caseMenu(),
        h("span", { class: "space" }),
        changeButton(),
      ),
      ...fileLine(),
    ),
    h(
      "div",
      { class: "cell experiment-cell" },
      h(
        "p",
        { class: "lab" },
        mark(2, () => state.value === "context" || hasAssumed() ? "warn" : answer.value ? "done" : ""),
        "Experiment",
      ),
      facts(),
    ),
    h(
      "div",
      { class: "cell error-cell" },
      h(
        "p",
        { class: "lab" },
        mark(3, () => state.value === "adequate" ? "done" : answer.value ? "now" : ""),
        "Error",
      ),
      h("div", { class: "err" }, errorNumber(), h("div", { class: "course-box" }, course)),
    ),
    nextCell(),
  );
}

/** File and experiment as a card: on a phone, where the strip has no room for them. */
export const caseCard = () =>
  h(
    "section",
    { class: "card case-card", "aria-label": "File and experiment", hidden: () => !files.value.length },
    h("div", { class: "card-head" }, h("h2", null, "File and experiment"), caseMenu(), changeButton()),
    ...fileLine(),
    allFacts(),
  );
