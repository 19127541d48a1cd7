// @ts-check
// The board: up to six pinned models beside the case.
import { h } from "../../../dom.js";

export function boardCard() {
  return h(
    "section",
    { class: "card board", "aria-label": "Model board" },
    h("div", { class: "card-head" }, h("h2", null, "Model board")),
  );
}
