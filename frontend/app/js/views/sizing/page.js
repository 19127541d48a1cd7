// @ts-check
// The page of a task: inputs, ranked proposals with trade-offs and reasons, the selected proposal.
import { h, icon } from "../../dom.js";
import { examples, proposeButton, taskCard, taskCards } from "./cards.js";
import { chosenCard, searchLine } from "./chosen.js";
import { differences } from "./differences.js";
import { frontCard } from "./front.js";
import {
  answer,
  cancel,
  fault,
  faultField,
  headingOf,
  nothingWords,
  openExample,
  proposals,
  propose,
  share,
  stage,
  stale,
  startSizing,
  waiting,
} from "./model.js";
import { faultNotice, goToField } from "../../ui/fault.js";
import { proposalsCard } from "./proposals.js";
import { rejectedCard } from "./rejected.js";

/** @param {import("../../dom.js").Child[]} body */
const notice = (...body) => h("div", { class: "notice", role: "status" }, icon("info"), ...body);

/** Errors and messages about the search. */
function notices() {
  if (stage.value === "running") return null;
  const error = fault.value, field = faultField();
  if (error) {
    return faultNotice(error.words, {
      goTo: field === null ? null : () => goToField(field, ".sizing"),
      retry: propose,
    });
  }
  if (stale.value) {
    return notice(
      h("span", null, "The task has changed. These drives belong to the previous task."),
      h("button", { type: "button", onclick: propose }, "Propose again"),
    );
  }
  if (stage.value === "cancelled" && !answer.value) {
    return notice(h("span", null, "The search was cancelled."));
  }
  const message = answer.value?.message;
  return message ? notice(h("span", null, message)) : null;
}

function progress() {
  if (stage.value !== "running") return null;
  return h(
    "section",
    { class: "card searching", "aria-label": "Search" },
    h(
      "p",
      { role: "status" },
      () =>
        waiting.value ||
        "Searching the catalogue: static calculation first, then every remaining drive is simulated…",
    ),
    h(
      "div",
      null,
      h("progress", { max: 1, value: () => share.value, "aria-label": "Search" }),
      h("span", { class: "num" }, () => `${Math.round(100 * share.value)}\u00a0%`),
      h("button", { type: "button", onclick: cancel }, icon("close"), "Cancel"),
    ),
  );
}

/** Before the first search. */
function start() {
  if (answer.value || stage.value === "running") return null;
  return h(
    "section",
    { class: "card empty-state", "aria-label": "Start" },
    h("h2", null, "Find a drive for your task"),
    h(
      "p",
      null,
      "Enter what is to be moved, how far and how fast, the supply pressure and the available space. The chosen " +
        "muscles, valves and tubes of the catalogue are combined. You get a ranked list of drives that fulfil the task, " +
        "each with its limits and the share of its simulated specimens that succeed, and the reasons against others.",
    ),
    h(
      "p",
      { class: "muted" },
      "An example is filled in. Use it, change it, or open another.",
    ),
    proposeButton(),
    h("h3", null, "Example tasks"),
    h("div", { class: "tiles" }, () =>
      examples().map((p) =>
        h(
          "button",
          { type: "button", class: "tile", onclick: () => openExample(p) },
          h("b", null, p.title),
          h("small", null, p.description ?? ""),
        )
      )),
  );
}

function nothing() {
  if (!answer.value || proposals.value.length) return null;
  return h(
    "section",
    { class: "card", "aria-label": "No drive" },
    h("div", { class: "card-head" }, h("h2", null, nothingWords(answer.value))),
    h("p", { class: "of-task" }, headingOf(answer.value)),
    h(
      "p",
      { class: "verdict bad" },
      icon("warn"),
      h(
        "span",
        null,
        "The list below gives for each candidate the reason and what would make it work, closest first.",
      ),
    ),
  );
}

export function taskPage() {
  const dimmed = () => stale.value || fault.value || stage.value === "running" ? " stale" : "";
  const page = h(
    "div",
    {
      class: () =>
        `design sizing${answer.value ? "" : " is-empty"}${proposals.value.length ? "" : " without-drives"}`,
    },
    h("div", { class: "column inputs" }, taskCard(), ...taskCards()),
    h(
      "div",
      { class: "column ranked" },
      h("div", { class: "column" }, notices),
      h("div", { class: "column" }, progress),
      h("div", { class: "column" }, start),
      h("div", { class: () => `column${dimmed()}` }, nothing),
      h("div", { class: () => `column${dimmed()}`, hidden: () => !proposals.value.length }, proposalsCard()),
    ),
    h(
      "div",
      { class: () => `column results${dimmed()}`, hidden: () => !proposals.value.length },
      differences,
      chosenCard(),
    ),
    h("div", { class: () => `column further${dimmed()}` }, frontCard(), rejectedCard(), searchLine),
  );
  startSizing();
  return page;
}
