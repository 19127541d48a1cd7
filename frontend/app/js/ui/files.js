// @ts-check
// The document as a file: saved as JSON, opened again; other JSON files go to whoever reads them.
import { h } from "../dom.js";
import { doc, edit, readDoc } from "../state.js";
import { status } from "../store.js";
import { downloadText, fileName } from "./table.js";

/** Reads one kind of JSON file besides the document of this page; `label` is that of the undo step.
 * @typedef {{reads: (raw: unknown) => boolean,
 *   open: (raw: any, label: string) => void | Promise<void>}} Opener */

const MOST_BYTES = 1e6;

export const saveDocument = () =>
  downloadText(
    fileName("", "json"),
    JSON.stringify(doc.peek(), null, 2) + "\n",
    "application/json",
  );

/** @param {File | undefined} file @param {Opener[]} openers */
async function open(file, openers) {
  if (!file) return;
  try {
    if (file.size > MOST_BYTES) throw new Error("it is larger than any document of this program");
    const read = JSON.parse(await file.text()), label = `open ${file.name}`;
    // What “Take it along” wrote as JSON holds the document beside what it says of it.
    const raw = read?.kind === "export" ? read.document : read;
    const opener = openers.find((one) => one.reads(raw));
    if (opener) await opener.open(raw, label);
    else {
      const opened = readDoc(raw);
      edit(() => opened, label);
    }
    status.value = `Opened ${file.name}.`;
  } catch (error) {
    const why = error instanceof SyntaxError ? "it is not JSON" : /** @type {Error} */ (error).message;
    status.value = `${file.name} cannot be opened: ${why}.`;
  }
}

/** Lets the user choose a JSON file and opens it. @param {Opener[]} openers */
export function chooseDocument(openers) {
  const input = h("input", { type: "file", accept: ".json,application/json" });
  input.addEventListener("change", () => open(input.files?.[0], openers));
  input.click();
}
