// @ts-check
// The curves as one table, for "Curves as CSV".
import { units } from "../../state.js";
import { scaleOf, toShown } from "../../format.js";
import { acrossAt } from "../../muscle/curve-axes.js";
import { curves } from "./model.js";

/** Every number behind the plots, one row per pressure and contraction.
 * @returns {import("../../ui/table.js").Table} */
export function curvesTable() {
  const answer = curves.peek(), system = units.peek();
  const unit = (/** @type {import("../../format.js").Quantity} */ q) => scaleOf(q, system).unit;
  const write = (/** @type {number | null} */ v, /** @type {import("../../format.js").Quantity} */ q) =>
    v == null ? null : toShown(v, scaleOf(q, system));
  const further = /** @type {const} */ (["stiffness_from_force", "stiffness_secant"])
    .filter((name) => answer?.[name]);
  const rows = answer?.pressure.flatMap((p, k) =>
    answer.contraction.map((c, i) => [
      write(p, "pressure"),
      c * 100,
      write(answer.length[i], "length"),
      write(acrossAt(answer, "braid_angle", c), "angle"),
      write(answer.force[k][i], "force"),
      write(answer.stiffness[k][i], "stiffness"),
      write(answer.stiffness_closed[k][i], "stiffness"),
      ...further.map((name) => write(answer[name]?.[k][i] ?? null, "stiffness")),
      write(answer.volume[i], "volume"),
      write(answer.diameter[i], "length"),
    ])
  );
  return {
    columns: [
      { title: "pressure", unit: unit("pressure") },
      { title: "contraction", unit: "%" },
      { title: "length", unit: unit("length") },
      { title: "braid_angle", unit: "deg" },
      { title: "force", unit: unit("force") },
      { title: "stiffness", unit: unit("stiffness") },
      { title: "stiffness_closed", unit: unit("stiffness") },
      ...further.map((title) => ({ title, unit: unit("stiffness") })),
      { title: "volume", unit: unit("volume") },
      { title: "diameter", unit: unit("length") },
    ],
    rows: rows ?? [],
  };
}
