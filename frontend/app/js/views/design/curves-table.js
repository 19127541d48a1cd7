// @ts-check
// The curves as one table, for "Curves as CSV".
import { figure } from "../../facts.js";
import { units } from "../../state.js";
import { shown } from "../../plots/axes.js";
import { scaleOf } from "../../format.js";
import { curves } from "./model.js";

/** Columns along the length, and those that the pressure changes too. */
const ALONG = /** @type {const} */ (["contraction", "length", "braid_angle"]);
const EACH = /** @type {const} */ ([
  "force",
  "stiffness",
  "stiffness_closed",
  "stiffness_from_force",
  "stiffness_secant",
]);
const SHAPE = /** @type {const} */ (["volume", "diameter", "outer_diameter"]);

/** Every number behind the plots, one row per pressure and contraction.
 * @returns {import("../../ui/table.js").Table} */
export function curvesTable() {
  const answer = curves.peek(), system = units.peek();
  const each = EACH.filter((name) => answer?.[name]);
  const names = ["pressure", ...ALONG, ...each, ...SHAPE];
  const inUnits = (/** @type {string} */ name, /** @type {(number | null)[]} */ values) =>
    shown(values, figure(`curves.${name}`).quantity, system);
  const rows = answer?.pressure.flatMap((p, k) => {
    const columns = [
      answer.contraction.map(() => p),
      ...ALONG.map((name) => answer[name]),
      ...each.map((name) => answer[name]?.[k] ?? []),
      ...SHAPE.map((name) => answer[name]),
    ].map((values, i) => inUnits(names[i], values));
    return answer.contraction.map((_, i) => columns.map((column) => column[i]));
  });
  return {
    columns: names.map((name) => ({
      title: name,
      unit: scaleOf(figure(`curves.${name}`).quantity, system).unit,
    })),
    rows: rows ?? [],
  };
}
