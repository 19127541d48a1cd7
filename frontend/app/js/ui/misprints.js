// @ts-check
// What the source of an example prints and cannot be right.
import { h } from "../dom.js";

/** @param {import("../types.js").Preset} preset */
export const misprintList = ({ misprints }) =>
  misprints?.length
    ? h(
      "details",
      { open: true },
      h("summary", null, "Misprints of the source"),
      h("ul", { class: "plain muted" }, ...misprints.map((text) => h("li", null, text))),
    )
    : null;
