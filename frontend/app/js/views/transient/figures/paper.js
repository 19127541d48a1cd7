// @ts-check
// The figures the paper prints for a scenario beside those of the run, and why some are not compared.
import { h, icon } from "../../../dom.js";
import { units } from "../../../state.js";
import { brief, changeText, scaleOf, toShown } from "../../../format.js";
import { run, scenario, untouched } from "../model.js";
import { figureName, figureOf, TIMING } from "./timing.js";
import { siNumber } from "../../../quantities.js";
import { misprintList } from "../../../ui/misprints.js";

/** @typedef {{figure?: string, figures?: Record<string, {value: number, unit: string}>,
 *   excluded?: Record<string, string>}} Paper */

/** @returns {Paper | null} */
const paper = () => /** @type {any} */ (scenario.value)?.paper ?? null;

function rows() {
  const printed = paper(), r = run.value, system = units.value;
  if (!printed?.figures || !r) return [];
  return Object.entries(printed.figures).flatMap(([path, q]) => {
    const [phase, key] = path.split(".");
    const figure = TIMING.find(({ name }) => name === key);
    const printedValue = siNumber(`${q.value} ${q.unit}`);
    if (!figure || printedValue === null || !(phase === "extend" || phase === "retract")) return [];
    const runValue = figureOf(r, phase, figure);
    const s = scaleOf(/** @type {import("../../../format.js").Quantity} */ (figure.quantity), system);
    const asText = (/** @type {number | null} */ si) => si == null ? "–" : brief(toShown(si, s));
    const why = printed.excluded?.[path] ?? null;
    const off = runValue == null ? null : changeText(printedValue, runValue);
    return [
      h(
        "tr",
        { class: why ? "left-out" : null },
        h(
          "th",
          { scope: "row", title: why },
          figureName(figure, phase),
          h("small", null, ` ${s.unit}`),
          why ? h("small", { class: "why" }, `Not compared: ${why}`) : null,
        ),
        h("td", null, asText(runValue)),
        h("td", null, asText(printedValue)),
        h(
          "td",
          null,
          off ?? "",
        ),
      ),
    ];
  });
}

export function paperCard() {
  const all = rows();
  if (!all.length) return null;
  return h(
    "section",
    { class: "card", "aria-label": "Compared with the paper" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Compared with the paper"),
      h("span", { class: "muted" }, paper()?.figure ?? ""),
    ),
    scenario.value ? misprintList(scenario.value) : null,
    untouched.value ? null : h(
      "p",
      { class: "flag note" },
      icon("info"),
      h("span", null, "The drive has changed since the scenario was loaded."),
    ),
    h(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Figures of the run and of the paper" },
      h(
        "table",
        { class: "data timing" },
        h("caption", { class: "unseen" }, "Figures of the run and of the paper"),
        h(
          "thead",
          null,
          h(
            "tr",
            null,
            h("td", null),
            ...["Run", "Paper", ""].map((t) => t ? h("th", { scope: "col" }, t) : h("td", null)),
          ),
        ),
        h("tbody", null, ...all),
      ),
    ),
  );
}
