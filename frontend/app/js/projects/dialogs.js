// @ts-check
// Dialogs of projects: open, title, history, and the choice when another window has saved.
import { h } from "../dom.js";
import { signal } from "../reactive.js";
import * as server from "../server/projects.js";
import { doc } from "../state.js";
import { status } from "../store.js";
import { openDialog } from "../ui/dialog.js";
import * as session from "./session.js";

/** @typedef {import("../server/projects.js").Info} Info */

/** @param {number} instant seconds since 1970 */
const when = (instant) =>
  new Date(1e3 * instant).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
/** @param {number} bytes */
const size = (bytes) => bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

/** @param {string} label @param {string} name @param {() => void} run @param {string} [kind] */
const action = (label, name, run, kind = "") =>
  h("button", { type: "button", class: kind, "aria-label": `${label} ${name}`, onclick: run }, label);

/** Asks for the title of a new project, or for title and notes of the open one.
 * @param {{id: string, title: string}} [open] */
export async function askTitle(open) {
  const present = open?.title, wrong = signal("");
  const notes = open
    ? h("textarea", { id: "project-notes", rows: 6, value: (await server.project(open.id)).project.notes })
    : null;
  const field = h("input", {
    id: "project-title",
    type: "text",
    maxlength: 200,
    value: present ?? proposed(),
    autocomplete: "off",
  });
  const dialog = openDialog(
    { title: open ? "Title and notes" : "Save as project" },
    h(
      "form",
      {
        onsubmit: async (/** @type {Event} */ event) => {
          event.preventDefault();
          try {
            if (notes) await session.rename(field.value, notes.value);
            else await session.saveAs(field.value);
            dialog.close();
          } catch (error) {
            wrong.value = /** @type {any} */ (error).words ?? String(error);
            field.focus();
          }
        },
      },
      present ? null : h(
        "p",
        { class: "muted" },
        "Everything on this page with its measurements. Changes are saved automatically.",
      ),
      h("label", { for: "project-title" }, "Title"),
      field,
      ...(notes ? [h("label", { for: "project-notes" }, "Notes"), notes] : []),
      h("p", { class: "error", role: "alert" }, () => wrong.value),
      h(
        "div",
        { class: "foot" },
        h("button", { type: "submit", class: "primary" }, "Save"),
      ),
    ),
  );
  field.select();
}

/** A title from what is on the page. */
function proposed() {
  const muscle = doc.peek().design.muscle.preset;
  return muscle ? `${muscle}, ${new Date().toISOString().slice(0, 10)}` : "My project";
}

/** All projects, to open, copy, delete and restore. */
export async function showProjects() {
  const list = signal(/** @type {Info[]} */ ([])), place = signal(""), wrong = signal("");
  const bin = signal(false), gone = signal(/** @type {Info | null} */ (null));
  const load = async () => {
    try {
      const answer = await server.projects(bin.peek());
      list.value = answer.projects;
      place.value = answer.place;
      wrong.value = "";
    } catch (error) {
      list.value = [];
      wrong.value = /** @type {any} */ (error).words ?? String(error);
    }
  };
  /** @param {() => Promise<unknown>} work */
  const then = async (work) => {
    await session.attempt(work);
    await load();
  };
  /** @param {Info} p */
  const row = (p) =>
    h(
      "tr",
      { class: session.open.peek()?.id === p.id ? "chosen" : "" },
      h(
        "td",
        null,
        h("b", null, p.title),
        session.open.peek()?.id === p.id ? h("small", null, " open here") : null,
        p.notes ? h("small", { class: "notes" }, p.notes.slice(0, 200)) : null,
      ),
      h("td", null, when(p.changed)),
      h("td", { class: "number" }, String(p.files)),
      h("td", { class: "number" }, size(p.size)),
      h("td", { class: "actions" }, ...(bin.peek() ? binned(p) : kept(p))),
    );
  /** @param {Info} p */
  const kept = (p) => [
    action("Open", p.title, () =>
      session.attempt(async () => {
        await session.openProject(p.id);
        dialog.close();
      }), "primary"),
    action("Duplicate", p.title, () => then(() => server.duplicate(p.id))),
    action("Delete", p.title, () =>
      then(async () => {
        gone.value = await server.remove(p.id);
        if (session.open.peek()?.id === p.id) session.close();
      })),
  ];
  /** @param {Info} p */
  const binned = (p) => [
    action("Restore", p.title, () => then(() => server.restore(p.id)), "primary"),
    action("Erase", p.title, () => then(() => server.erase(p.id))),
  ];
  const dialog = openDialog(
    { title: "Projects", wide: true },
    h("p", { class: "error", role: "alert" }, () => wrong.value),
    () =>
      gone.value && !bin.value
        ? h(
          "p",
          { class: "undone", role: "status" },
          `“${gone.value.title}” is in the bin until its room is needed. `,
          h("button", {
            type: "button",
            onclick: () =>
              then(async () => {
                if (gone.peek()) await server.restore(/** @type {Info} */ (gone.peek()).id);
                gone.value = null;
              }),
          }, "Undo"),
        )
        : null,
    () =>
      list.value.length
        ? h(
          "div",
          { class: "scroll-x", tabindex: 0, role: "region", "aria-label": "Projects" },
          h(
            "table",
            { class: "projects" },
            h(
              "thead",
              null,
              h(
                "tr",
                null,
                ...["Project", "Changed", "Files", "Size"].map((name, i) =>
                  h("th", { scope: "col", class: i > 1 ? "number" : "" }, name)
                ),
                h("th", { scope: "col" }, h("span", { class: "unseen" }, "Actions")),
              ),
            ),
            h("tbody", null, ...list.value.map(row)),
          ),
        )
        : h(
          "p",
          { class: "muted" },
          bin.value ? "The bin is empty." : "No projects yet. “Save as project…” keeps this page.",
        ),
    h(
      "div",
      { class: "foot" },
      h("small", { class: "muted place" }, () => place.value ? `In ${place.value}` : ""),
      h("button", {
        type: "button",
        "aria-pressed": () => String(bin.value),
        onclick: () => {
          bin.value = !bin.peek();
          load();
        },
      }, () => bin.value ? "Back to the projects" : "Deleted projects"),
      h("button", { type: "button", onclick: () => choosePacked(() => dialog.close()) }, "Import…"),
    ),
  );
  await load();
}

/** The saved versions of a project. @param {{id: string, title: string}} project */
export async function showHistory(project) {
  const rows = signal(/** @type {import("../types.js").S["Revision"][]} */ ([])), wrong = signal("");
  const dialog = openDialog(
    { title: `History of ${project.title}` },
    h(
      "p",
      { class: "muted" },
      "Opening a version keeps the later ones: it becomes the next version when you go on.",
    ),
    h("p", { class: "error", role: "alert" }, () => wrong.value),
    h("ol", { class: "versions" }, () =>
      rows.value.map((r, i) =>
        h(
          "li",
          null,
          h("span", { class: "number" }, String(r.version)),
          h(
            "span",
            null,
            r.label,
            h("small", { class: "muted" }, ` ${when(r.saved)}${r.automatic ? " · automatic" : ""}`),
          ),
          i
            ? action("Open", `version ${r.version}`, () =>
              session.attempt(async () => {
                await session.openProject(project.id, r.version);
                dialog.close();
              }))
            : h("small", { class: "muted" }, "now"),
        )
      )),
  );
  try {
    rows.value = (await server.history(project.id)).history;
  } catch (error) {
    wrong.value = /** @type {any} */ (error).words ?? String(error);
  }
}

/** Imports a packed project and opens it. @param {() => void} [done] */
export function choosePacked(done = () => {}) {
  const input = h("input", { type: "file", accept: ".zip,application/zip" });
  input.addEventListener("change", () =>
    session.attempt(async () => {
      const file = input.files?.[0];
      if (!file) return;
      if (file.size > 64e6) throw new Error("The file is larger than 64 MB.");
      const made = await server.unpack(file);
      await session.openProject(made.project.id);
      done();
    }));
  input.click();
}

/** Another window has saved the project: what now? */
export async function askElsewhere() {
  const project = session.open.peek();
  if (!project || document.querySelector("dialog.elsewhere")) return;
  const there = await server.project(project.id).catch(() => null);
  const last = there
    ? `Version ${there.revision.version} (“${there.revision.label}”) was saved there on ${
      when(there.revision.saved)
    }.`
    : "It could not be read.";
  /** @param {() => Promise<unknown>} work */
  const choose = (work) => () =>
    session.attempt(async () => {
      await work();
      dialog.close();
    });
  const dialog = openDialog(
    { title: "Saved in another window", outside: false },
    h(
      "p",
      null,
      `“${project.title}” was changed in another window or by somebody else. ${last} Nothing is overwritten.`,
    ),
    h(
      "div",
      { class: "choices" },
      h("button", {
        type: "button",
        class: "primary",
        onclick: choose(() => session.openProject(project.id)),
      }, "Open theirs"),
      h("button", {
        type: "button",
        onclick: choose(() => session.saveAs(`${project.title} (mine)`.slice(0, 200))),
      }, "Save mine as a copy"),
      h("button", { type: "button", onclick: choose(session.replaceOther) }, "Replace theirs with mine"),
    ),
    h(
      "p",
      { class: "muted" },
      "Replacing keeps theirs in the history. After opening theirs, Undo brings your work back.",
    ),
  );
  dialog.classList.add("elsewhere");
  dialog.addEventListener("close", () => {
    if (session.state.peek() === "elsewhere") status.value = "The project is not saved until you choose.";
  });
}
