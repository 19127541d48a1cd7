// @ts-check
// The page of the Compare & diagnose view: one case, from a file to the noise of its data. The strip holds what is
// known and what comes next; under it plots, map and the list of what is missing.
import { h } from "../../dom.js";
import { capitalized } from "../../format.js";
import { computed, effect } from "../../reactive.js";
import { missing } from "../../server/missing.js";
import { answer, compare, fault, files, showToAtlas, stage, startComparing } from "./answers.js";
import { boardCard } from "./board/card.js";
import { ladderCard } from "./ladder.js";
import { listCard } from "./list/card.js";
import { followVerdicts } from "./list/kept.js";
import { followSketches } from "./list/sketch.js";
import { complaintNotices, measurementsCard } from "./measurement/card.js";
import { dropping } from "./measurement/drop.js";
import { emptyCard } from "./measurement/empty.js";
import { followFiles } from "./measurement/files.js";
import { fetchMysteries, mysteryCard } from "./measurement/mysteries.js";
import { modelCard } from "./model/card.js";
import { rigCard } from "./model/rig.js";
import { setupCard } from "./model/setup.js";
import { followPins } from "./pinned.js";
import { setupPanel } from "./setup-panel.js";
import { caseCard, strip } from "./strip/strip.js";
import { takeCard } from "./take.js";
import { whereCard } from "./where/heat.js";
import { overlayCards } from "./where/overlay.js";
import { residualCard } from "./where/residual.js";

/** Why the newest comparison failed, in full: the strip has room for a line. */
const faultWords = () =>
  fault.value && !missing.value.length
    ? h(
      "p",
      { class: "notice bad", role: "alert" },
      `${fault.value.words}${answer.value ? " The plots show the last valid comparison." : ""}`,
    )
    : null;

/** Runs of the model that ended early: every figure of the page is of the rows before. */
const stopWords = () =>
  answer.value?.sentences.slice(0, answer.value.stopped.length).map((words) =>
    h("p", { class: "notice bad", role: "alert" }, `${capitalized(words)}.`)
  ) ?? [];

export function comparePage() {
  const empty = computed(() => files.value.length === 0);
  const page = h(
    "div",
    { class: () => `compare${empty.value ? " is-empty" : ""}` },
    strip(),
    setupPanel(measurementsCard(), setupCard(), h("div", { class: "column" }, rigCard)),
    h("div", { class: "case-notices" }, complaintNotices, faultWords, stopWords),
    h("div", { class: "case-start", hidden: () => !empty.value }, emptyCard()),
    h(
      "div",
      { class: () => `case-body${compare.value.board ? " is-board" : ""}`, hidden: () => empty.value },
      caseCard(),
      h("div", { class: "area-over" }, overlayCards()),
      h("div", { class: "area-where" }, whereCard()),
      h("div", { class: "area-list" }, mysteryCard, listCard()),
      h("div", { class: "area-residual" }, residualCard()),
      h("div", { class: "area-ladder" }, ladderCard()),
      h("div", { class: "area-take" }, takeCard(), modelCard()),
      h("div", { class: "area-board" }, boardCard()),
    ),
    h(
      "div",
      { class: "drop-here", hidden: () => !dropping.value },
      h("b", null, "Drop the measurement files"),
    ),
  );
  followFiles();
  startComparing();
  followSketches();
  followVerdicts();
  followPins();
  fetchMysteries();
  showToAtlas();
  effect(() => {
    document.documentElement.dataset.diagnosis = stage.value;
  });
  return page;
}
