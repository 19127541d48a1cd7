// @ts-check
// The menu of the project in the bar above the views.
import { h, icon } from "../dom.js";
import { fileOf } from "../server/projects.js";
import { menuButton } from "../ui/menu.js";
import * as session from "./session.js";

const WORDS = {
  saved: "saved",
  changed: "not saved yet",
  saving: "saving",
  elsewhere: "saved in another window",
  failed: "could not be saved",
};

const dialogs = () => import("./dialogs.js");

/** @returns {import("../ui/menu.js").Item[]} */
function items() {
  const project = session.open.peek();
  /** @type {import("../ui/menu.js").Item[]} */
  const always = [
    { label: "Open project…", run: async () => (await dialogs()).showProjects() },
    {
      label: "Import project…",
      note: "a file with its data",
      run: async () => (await dialogs()).choosePacked(),
    },
  ];
  const saveAs = { label: "Save as project…", run: async () => (await dialogs()).askTitle() };
  if (!project) return [saveAs, ...always];
  return [
    { heading: project.title },
    { label: "Save now", note: WORDS[session.state.peek()], run: () => session.saveNow(false) },
    { label: "History…", run: async () => (await dialogs()).showHistory(project) },
    {
      label: "Title and notes…",
      run: () => session.attempt(async () => (await dialogs()).askTitle(project)),
    },
    {
      label: "Export project",
      note: "one file with its data",
      run: () => h("a", { href: fileOf(project.id), download: "" }).click(),
    },
    { label: "Close project", run: session.close },
    { heading: "Others" },
    saveAs,
    ...always,
  ];
}

export const projectButton = () =>
  menuButton({
    label: [
      h(
        "span",
        { class: "project-label" },
        h("span", { class: "project-title" }, () => session.open.value?.title ?? "Project"),
        () =>
          session.open.value
            ? h("span", {
              class: `project-state ${session.state.value}`,
              role: "img",
              "aria-label": WORDS[session.state.value],
              title: WORDS[session.state.value],
            })
            : null,
      ),
      icon("down"),
    ],
    name: "Project",
    class: "quiet project",
    visible: true,
    items,
  });

/** What the command palette offers. */
export const projectCommands = () =>
  items().flatMap((item) => "run" in item ? [{ label: item.label, kind: "project", run: item.run }] : []);
