// @ts-check
// The residual of a measured point: a stem to the model, and the three numbers, while the pointer is on the point.
import { h } from "../../dom.js";
import { effect, signal } from "../../reactive.js";
import { units } from "../../state.js";
import { scaleOf, toShown, withUnit } from "../../format.js";
import { ACROSS, acrossAt } from "../../muscle/curve-axes.js";
import { errors, errorsOutdated } from "./model.js";

/** @typedef {{label: string, contraction: number, measured: number, predicted: number, residual: number}} Row */

const REACH_PX = 9;

/** The point under the pointer, as the server compared it. */
const pointed = signal(/** @type {Row | null} */ (null));

/** The rows of the comparison; none while it is not of the model shown. @returns {Row[]} */
const rows = () =>
  errorsOutdated.peek()
    ? []
    : (errors.peek()?.model.series ?? []).filter(({ channel }) => channel === "force").flatMap(
      (s) =>
        s.measured.flatMap((measured, i) => {
          const [contraction, predicted, residual] = [s.contraction?.[i], s.predicted[i], s.residual[i]];
          return measured == null || contraction == null || predicted == null || residual == null
            ? []
            : [{ label: s.label, contraction, measured, predicted, residual }];
        }),
    );

/** @param {import("../../plots/chart.js").Chart} chart @param {() => import("../../muscle/curve-axes.js").View | null} view */
export function showResiduals(chart, view) {
  const stem = h("div", { class: "stem", hidden: true });
  chart.over.append(stem);
  /** Place in pixels from the corner of the plot. @param {Row} row */
  const place = (row) => {
    const axes = chart.axes, v = view();
    const x = v && acrossAt(v.curves, v.across, row.contraction);
    if (!axes || !v || x === null) return null;
    const force = scaleOf("force", v.system);
    return {
      x: axes.xaxis._offset + axes.xaxis.c2p(toShown(x, scaleOf(ACROSS[v.across].quantity, v.system))),
      y: axes.yaxis._offset + axes.yaxis.c2p(toShown(row.measured, force)),
      model: axes.yaxis._offset + axes.yaxis.c2p(toShown(row.predicted, force)),
    };
  };
  chart.host.addEventListener("pointermove", (event) => {
    const box = chart.host.getBoundingClientRect(),
      [px, py] = [event.clientX - box.left, event.clientY - box.top];
    let best = null, nearest = REACH_PX;
    for (const row of rows()) {
      const at = place(row), away = at ? Math.hypot(at.x - px, at.y - py) : Infinity;
      if (away < nearest) [best, nearest] = [row, away];
    }
    pointed.value = best;
  });
  chart.host.addEventListener("pointerleave", () => (pointed.value = null));
  effect(() => {
    const row = pointed.value, at = row && place(row);
    stem.hidden = !at;
    if (!at) return;
    stem.style.height = `${Math.max(1, Math.abs(at.model - at.y))}px`;
    stem.style.transform = `translate(${at.x - 1}px,${Math.min(at.y, at.model)}px)`;
  });
}

/** The three numbers of the point under the pointer; null where there is none. */
export function residualWords() {
  const row = pointed.value, system = units.value;
  if (!row) return null;
  const force = (/** @type {number} */ si) => withUnit(si, "force", system);
  return h(
    "span",
    null,
    `${row.label}, ${withUnit(row.contraction, "ratio", system)}: measured ${force(row.measured)}, model ${
      force(row.predicted)
    }, `,
    h("b", null, `residual ${row.residual > 0 ? "+" : ""}${force(row.residual)}`),
  );
}
