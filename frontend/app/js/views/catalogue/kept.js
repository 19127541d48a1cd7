// @ts-check
// What is kept on the server: measurement files and presets of one's own, to rename, delete and restore.
import { h } from "../../dom.js";
import { effect, signal } from "../../reactive.js";
import { view } from "../../state.js";
import { brief } from "../../format.js";
import { ApiError, get, send } from "../../server/client.js";
import { loadKind } from "../../server/presets.js";
import { KIND_TITLES } from "./columns.js";

/** @typedef {import("../../types.js").S["KeptData"]} Kept */
/** @typedef {import("../../types.js").S["KeptItem"]} Item */
/** @typedef {import("../../types.js").S["KeptSpace"]} Space */

const kept = signal(/** @type {Kept | null} */ (null));
const fault = signal("");
/** The item that was deleted last, for its Undo. */
const gone = signal(/** @type {Item | null} */ (null));
/** Items listed at first, the newest; a laboratory has hundreds. */
const MOST = 8;
const showsAll = signal(false);
/** The item whose name is being changed. */
const renaming = signal(/** @type {Item | null} */ (null));

/** @param {() => Promise<Kept>} ask @param {string} [kind] of preset that changes with it */
async function take(ask, kind) {
  try {
    kept.value = await ask();
    fault.value = "";
    if (kind && kind !== "files") await loadKind(kind);
    return true;
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    fault.value = error.words;
    return false;
  }
}

const look = () => take(() => get("/api/kept"));
/** @param {Item} item */
const place = (item) => `/api/kept/${item.kind}/${item.id}`;

/** @param {Item} item */
async function remove(item) {
  if (await take(() => send("DELETE", place(item)), item.kind)) gone.value = item;
}

/** @param {Item} item */
async function bringBack(item) {
  if (await take(() => send("POST", `${place(item)}/restore`), item.kind)) gone.value = null;
}

/** @param {Item} item */
const erase = (item) => take(() => send("DELETE", `${place(item)}?erase=true`), item.kind);

/** @param {Space["kind"]} kind */
const eraseAll = (kind) => take(() => send("DELETE", `/api/kept/space/bin/${kind}`));

/** @param {Item} item @param {string} name */
async function rename(item, name) {
  const done = name === item.name || await take(
    () => send("PATCH", place(item), { name, was: item.name }),
    item.kind,
  );
  if (done) renaming.value = null;
}

/** @param {number} bytes */
const sizeOf = (bytes) =>
  !bytes
    ? "0\u00a0kB"
    : bytes < 1e6
    ? `${brief(Math.max(bytes / 1e3, 0.1))}\u00a0kB`
    : bytes < 1e9
    ? `${brief(bytes / 1e6)}\u00a0MB`
    : `${brief(bytes / 1e9)}\u00a0GB`;

/** @param {Item} item */
const about = (item) =>
  [
    item.kind === "files" ? "Measurement" : KIND_TITLES[/** @type {keyof typeof KIND_TITLES} */ (item.kind)],
    sizeOf(item.size),
    new Date(1000 * item.changed).toLocaleDateString("en-GB"),
    item.corrected ? "with your columns" : "",
  ].filter(Boolean).join(" · ");

/** @param {Item} item */
function nameForm(item) {
  const input = h("input", {
    type: "text",
    value: item.name,
    maxlength: 120,
    "aria-label": `New name of ${item.name}`,
    onkeydown: (/** @type {KeyboardEvent} */ e) => e.key === "Escape" && (renaming.value = null),
  });
  queueMicrotask(() => input.select());
  return h(
    "form",
    {
      class: "kept-name",
      onsubmit: (/** @type {Event} */ e) => {
        e.preventDefault();
        rename(item, input.value.trim());
      },
    },
    input,
    h("button", { type: "submit", class: "link" }, "Save"),
  );
}

/** @param {Item} item */
const row = (item) =>
  h(
    "li",
    null,
    () =>
      renaming.value?.id === item.id && renaming.value.kind === item.kind
        ? nameForm(item)
        : h("b", null, item.name),
    h("small", null, about(item)),
    h(
      "span",
      { class: "kept-actions" },
      h("button", {
        type: "button",
        class: "link",
        "aria-label": `Rename ${item.name}`,
        onclick: () => renaming.value = item,
      }, "Rename"),
      h("button", {
        type: "button",
        class: "link",
        "aria-label": `Delete ${item.name}`,
        onclick: () => remove(item),
      }, "Delete"),
    ),
  );

/** @param {Item} item */
const deletedRow = (item) =>
  h(
    "li",
    null,
    h("span", null, item.name),
    h("small", null, about(item)),
    h(
      "span",
      { class: "kept-actions" },
      h("button", {
        type: "button",
        class: "link",
        "aria-label": `Restore ${item.name}`,
        onclick: () => bringBack(item),
      }, "Restore"),
      h("button", {
        type: "button",
        class: "link",
        "aria-label": `Erase ${item.name} now`,
        onclick: () => erase(item),
      }, "Erase now"),
    ),
  );

const SPACE = {
  measurements: ["Measurements", "deleted"],
  projects: ["Projects with all versions", "deleted"],
  studies: ["Rows of studies", "made again when needed"],
  diagnoses: ["Finished diagnoses", "made again when needed"],
  presets: ["Presets", "deleted"],
};

/** @param {Space} space */
const spaceRow = (space) => {
  const [title, spare] = SPACE[space.kind];
  return h(
    "li",
    null,
    h("span", null, title),
    h(
      "small",
      null,
      `${sizeOf(space.taken)} of ${sizeOf(space.quota)}` +
        (space.restorable ? `, ${sizeOf(space.restorable)} ${spare}` : ""),
    ),
    space.restorable
      ? h("button", {
        type: "button",
        class: "link",
        "aria-label": `Erase now: ${title}, ${spare}`,
        onclick: () => eraseAll(space.kind),
      }, "Erase now")
      : null,
  );
};

function undoLine() {
  const item = gone.value;
  return item === null ? null : h(
    "p",
    { class: "kept-undo" },
    `Deleted “${item.name}”. `,
    h("button", { type: "button", class: "link", onclick: () => bringBack(item) }, "Undo"),
  );
}

/** The card; nothing where nothing is kept. */
export function keptCard() {
  effect(() => {
    if (view.value === "catalogue") look();
  });
  return () => {
    const all = kept.value;
    if (!all || !(all.items.length + all.deleted.length || all.space.some((s) => s.restorable))) return null;
    return h(
      "section",
      { class: "card kept", "aria-label": "Kept" },
      h(
        "div",
        { class: "card-head" },
        h("h2", null, "Kept"),
        all.free === null ? null : h("small", null, `${sizeOf(all.free)} left on the disk`),
      ),
      h("div", { role: "status" }, undoLine),
      () => fault.value ? h("p", { class: "warn", role: "alert" }, fault.value) : null,
      () => {
        const shown = showsAll.value ? all.items : all.items.slice(0, MOST),
          more = all.items.length - shown.length;
        return [
          shown.length ? h("ul", { class: "plain" }, ...shown.map(row)) : null,
          more
            ? h(
              "button",
              { type: "button", class: "link", onclick: () => (showsAll.value = true) },
              `Show ${more} more`,
            )
            : null,
        ];
      },
      all.deleted.length
        ? h(
          "details",
          null,
          h("summary", null, `Deleted (${all.deleted.length})`),
          h("p", null, h("small", null, "Can be restored until their room is needed.")),
          h("ul", { class: "plain" }, ...all.deleted.map(deletedRow)),
        )
        : null,
      h(
        "details",
        null,
        h("summary", null, "Space"),
        h("ul", { class: "plain" }, ...all.space.map(spaceRow)),
      ),
    );
  };
}
