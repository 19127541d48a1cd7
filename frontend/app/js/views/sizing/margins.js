// @ts-check
// The margin of a proposal to each limit, as a bar: empty at the limit, full at 100 % or more.
import { h } from "../../dom.js";
import { limitName, sizingFigure, spare } from "./words.js";

/** @param {import("../../types.js").S["ProposedDrive"]} p */
export function marginBars(p) {
  const { label, definition } = sizingFigure("margins");
  const rows = Object.entries(p.margins).sort(([, a], [, b]) => a - b);
  return [
    h("h3", { class: "second", title: definition }, label),
    h(
      "div",
      { class: "margins" },
      ...rows.map(([name, left]) =>
        h(
          "div",
          { class: name === p.binding ? "binding" : "" },
          h("span", null, limitName(name)),
          h("span", { class: "bar" }, h("i", { style: `width:${100 * Math.min(1, Math.max(0, left))}%` })),
          h("span", { class: "num" }, `${spare(left)}${name === p.binding ? ", nearest" : ""}`),
        )
      ),
    ),
  ];
}
