// @ts-check
// Take it along: a model or drive as files for other programs, in the formats that the server has.
import { h } from "../dom.js";
import { signal } from "../reactive.js";
import { ApiError, get, postForFile } from "../server/client.js";
import { status } from "../store.js";
import { openDialog } from "./dialog.js";
import { download } from "./table.js";

/** @typedef {import("../types.js").ExportFormat} Format */

/** @type {Promise<Format[]> | null} */
let known = null;

/** The formats; asked for again after a failure. @returns {Promise<Format[]>} */
function formats() {
  known ??= get("/api/exports").then((answer) => answer.formats, (error) => {
    known = null;
    throw error;
  });
  return /** @type {Promise<Format[]>} */ (known);
}

/** @param {unknown} error */
const wordsOf = (error) => {
  if (!(error instanceof ApiError)) throw error;
  return error.words;
};

/** Opens the dialog with one button for each format.
 * @param {{what: string, drive?: boolean, body: () => object}} o `what`: what is written; `drive`: whether it is a
 *   whole drive; `body`: the request without its format, as it is when a button is pressed */
export async function openTakeAlong({ what, drive = false, body }) {
  const message = signal(""), writing = signal("");
  /** @param {Format} format */
  const save = async (format) => {
    writing.value = format.id;
    message.value = "";
    try {
      const file = await postForFile("/api/exports", { ...body(), as: format.id });
      download(file.name, file.blob);
      status.value = `Saved ${file.name}.`;
      dialog.close();
    } catch (error) {
      message.value = wordsOf(error);
    }
    writing.value = "";
  };
  /** @param {Format} format */
  const way = (format) =>
    h(
      "button",
      {
        type: "button",
        "aria-label": format.title,
        disabled: () => writing.value !== "",
        onclick: () => save(format),
      },
      h("b", null, () => writing.value === format.id ? "Writing…" : format.title),
      h("small", null, drive && !format.drives ? `${format.note}; of the muscle alone` : format.note),
    );
  const list = h("div", { class: "formats" });
  const dialog = openDialog(
    { title: "Take it along" },
    h(
      "p",
      null,
      `${what}, for other programs. Each file names the model, the source of every constant, `,
      "the range it holds in, and what it leaves out.",
    ),
    list,
    h("p", { class: "error", role: "alert" }, () => message.value),
  );
  try {
    list.append(...(await formats()).filter((format) => drive || format.muscles).map(way));
    list.querySelector("button")?.focus();
  } catch (error) {
    message.value = wordsOf(error);
  }
}
