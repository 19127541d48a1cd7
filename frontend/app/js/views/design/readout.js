// @ts-check
// The values under the linked cursor, in one line.
import { h } from "../../dom.js";
import { signal } from "../../reactive.js";
import { figure } from "../../facts.js";
import { units } from "../../state.js";
import { withUnit } from "../../format.js";
import { palette, pressureColour } from "../../plots/theme.js";
import { pressureName, shareOf, xColumn } from "../../muscle/curve-axes.js";

/** @typedef {import("../../muscle/curve-axes.js").View} View */

/** Where the cursor is on the x axis, in shown units; null: over no plot. */
export const cursor = signal(/** @type {number | null} */ (null));

/** @param {View | null} v */
export function readout(v) {
  const at = cursor.value, answer = v?.curves;
  if (at === null || !answer || !v) {
    return h("span", { class: "muted" }, "Move the pointer over a plot to read values.");
  }
  const column = /** @type {number[]} */ (xColumn(v));
  let i = 0;
  column.forEach((x, k) => {
    if (Math.abs(x - at) < Math.abs(column[i] - at)) i = k;
  });
  const system = units.value, colours = palette.value;
  const one = (/** @type {"contraction" | "length" | "braid_angle" | "diameter" | "volume"} */ name) => {
    const { label, symbol, quantity } = figure(`curves.${name}`);
    return h("span", { title: label }, `${symbol} `, withUnit(answer[name][i], quantity, system));
  };
  return [
    h("b", null, withUnit(answer.contraction[i], "ratio", system)),
    one("length"),
    one("braid_angle"),
    ...answer.pressure.map((p, k) =>
      h(
        "span",
        { title: `${pressureName(v, p)}` },
        h("i", { style: `background:${pressureColour(shareOf(p, answer), colours)}` }),
        withUnit(answer.force[k][i], "force", system),
      )
    ),
    one("diameter"),
    one("volume"),
  ];
}
