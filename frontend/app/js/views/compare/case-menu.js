// @ts-check
// The switch between the cases of the project: one at hand at a time; new, copied, renamed, removed.
import { h, icon } from "../../dom.js";
import { computed } from "../../reactive.js";
import { doc, edit, goTo, look } from "../../state.js";
import { status } from "../../store.js";
import { openDialog } from "../../ui/dialog.js";
import { menuButton } from "../../ui/menu.js";
import {
  atCase,
  caseId,
  casesOf,
  LONGEST_NAME,
  MOST_CASES,
  withCopy,
  withName,
  withNewCase,
  withoutCase,
} from "./cases.js";

/** @typedef {import("../../types.js").Case} Case */

const several = computed(() => doc.value.cases.rest.length > 0);

/** "run1.csv + 2" @param {Case} one */
const filesOf = ({ compare: { files: [first, ...more] } }) =>
  first ? `${first.name}${more.length ? ` + ${more.length}` : ""}` : "no file yet";

/** Shows another case, in this view. @param {number} id */
export const showCase = (id) => look((d) => ({ ...atCase(d, id), view: "compare" }));

function newCase() {
  edit(withNewCase, "new case");
  goTo("compare");
}

const copyCase = () => edit(withCopy, `copy of ${doc.peek().cases.name}`);

function removeCase() {
  const { name } = doc.peek().cases;
  edit(withoutCase, `remove ${name}`);
  status.value = `“${name}” is removed. Undo brings it back.`;
}

/** Asks for another name of the case at hand. */
function askName() {
  const field = h("input", {
    id: "case-name",
    type: "text",
    maxlength: LONGEST_NAME,
    value: doc.peek().cases.name,
    autocomplete: "off",
  });
  const dialog = openDialog(
    { title: "Rename case" },
    h(
      "form",
      {
        onsubmit: (/** @type {Event} */ event) => {
          event.preventDefault();
          const name = field.value;
          dialog.close();
          if (name.trim() && name.trim() !== doc.peek().cases.name) {
            edit((d) => withName(d, name), `name the case ${name.trim()}`);
          }
        },
      },
      h("label", { for: "case-name" }, "Name"),
      field,
      h("div", { class: "foot" }, h("button", { type: "submit", class: "primary" }, "Rename")),
    ),
  );
  field.select();
}

/** What can be done with the cases. @returns {{label: string, note?: string, run: () => void}[]} */
function actions() {
  const d = doc.peek(), isFull = casesOf(d).length >= MOST_CASES, isEmpty = !d.compare.files.length;
  return [
    ...(isFull || isEmpty ? [] : [
      { label: "New case", note: "other files, another model", run: newCase },
      { label: "Copy this case", note: "the same files, another way", run: copyCase },
    ]),
    { label: "Rename this case…", run: askName },
    ...(several.peek() ? [{ label: "Remove this case", note: "undo brings it back", run: removeCase }] : []),
  ];
}

/** @returns {import("../../ui/menu.js").Item[]} */
const items = () => [
  ...casesOf(doc.peek()).map((one) => ({
    label: one.name,
    note: filesOf(one),
    checked: one.id === caseId.peek(),
    run: () => showCase(one.id),
  })),
  { heading: "Case" },
  ...actions(),
];

/** The button of the switch, with the name of the case at hand. */
export const caseMenu = () =>
  menuButton({
    label: [h("span", { class: "case-name" }, () => doc.value.cases.name), icon("down")],
    name: "Cases of this project",
    class: "quiet case-menu",
    visible: true,
    items,
  });

/** Where a phone has no strip: the switch of a case without a file, if there are others. */
export const otherCases = () => several.value ? h("p", { class: "other-cases" }, "Case ", caseMenu()) : null;

/** What the command palette offers. */
export const caseCommands = () => [
  ...casesOf(doc.peek()).filter(({ id }) => id !== caseId.peek()).map((one) => ({
    label: `${one.name}: ${filesOf(one)}`,
    kind: "case",
    run: () => showCase(one.id),
  })),
  ...actions().map(({ label, run }) => ({
    label,
    kind: "case",
    run: () => {
      goTo("compare");
      run();
    },
  })),
];
