// @ts-check
// The residual over one variable with the band of the noise and a range to select, or as histogram and others.
import { h, icon } from "../../../dom.js";
import { figure } from "../../../facts.js";
import { apart, computed, effect } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { number, scaleOf, toShown, toSi } from "../../../format.js";
import { Chart } from "../../../plots/chart.js";
import { writeLabels } from "../../../plots/overlay.js";
import { palette } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { menuButton } from "../../../ui/menu.js";
import { plotlyReady } from "../../../plots/library.js";
import { brushLayer } from "./brush-layer.js";
import { brush, inside as inRange, lookCompare, shown, stale } from "../answers.js";
import { pinned } from "../pinned.js";
import { channel, channels, residualOver, residuals, variables, viewOf } from "./pictures.js";
import { crossCorrelation } from "./cross.js";
import { autocorrelation, histogram, loops } from "./leftover.js";
import { partsBar } from "./parts.js";
import { scale } from "./scale.js";
import { residualSpec } from "./residual-spec.js";
import { channelWords, errorText, rangeText, VARIABLES } from "../words.js";

/** @typedef {import("../../../types.js").Tab} Tab */
/** @typedef {import("./leftover.js").Picture} Picture */

/** @type {[Tab, string, string][]} */
const TABS = [
  ["angle", "Angle", "Residual over the angle of the joint"],
  ["contraction", "ε", "ε: residual over contraction"],
  ["pressure", "Pressure", "Residual over pressure"],
  ["direction", "Direction", "Residual over direction"],
  ["velocity", "Velocity", "Residual over velocity"],
  ["time", "Time", "Residual over time"],
  ["histogram", "Histogram", "Histogram: how often each size of residual occurs"],
  ["autocorrelation", "Autocorrelation", "Autocorrelation of the residual"],
  ["cross", "Input", "Input: correlation of the residual with the input of the test"],
  ["loops", "Loops", "Loops: area of each loop of the residual"],
];

const RMS = figure("residual.rms");

const host = h("div", {
  class: "plot",
  id: "residual",
  role: "figure",
  "aria-label": "Residual, measured minus model, with the band of the noise",
});
export const chart = new Chart(host, "compare-residual");
export const TITLE = "Residual: measured − model";

/** The scale of the x axis. */
const across = () => {
  const v = VARIABLES[residualOver.peek()];
  return v ? scaleOf(v.quantity, units.peek()) : null;
};

/** @returns {[number, number] | null} the brush in shown units */
function brushed() {
  const range = brush.peek()?.[residualOver.peek()], s = across();
  return range && s ? [toShown(range[0], s), toShown(range[1], s)] : null;
}

/** @param {[number, number] | null} range */
function setBrush(range) {
  const s = across();
  if (!range) return lookCompare({ brush: null });
  if (!s || !(range[1] > range[0])) return;
  const si = range.map((x) => Number(toSi(x, s).toPrecision(6)));
  lookCompare({ brush: { [residualOver.peek()]: [si[0], si[1]] } });
}

/** Histogram, autocorrelation or loops, if one of them is selected. @returns {Picture | null} */
const picture = () => {
  const a = shown.value, x = residualOver.value;
  if (!a || x in VARIABLES) return null;
  if (x === "autocorrelation") return autocorrelation(a);
  if (x === "cross") return crossCorrelation(a, channel.value);
  if (x === "loops") return loops(a, units.value);
  const v = viewOf(channel.value, "contraction");
  return v && histogram(a, v);
};
const whole = computed(picture);

/** The loops of the models of the board that are drawn: " Ideal muscle: 6 loops, mean +788 mJ." */
const ofPins = () =>
  residualOver.value === "loops"
    ? pinned.value.map(({ name, comparison }) =>
      h("span", null, ` ${name}: `, loops(comparison, units.value).words[0])
    )
    : null;

/** "contraction 5 to 10 %: RMS 63 N, 120 rows" */
function inside() {
  const b = brush.value, a = shown.value, system = units.value;
  if (!a) return null;
  if (whole.value) return h("span", null, ...whole.value.words, ofPins());
  if (!b) return h("span", { class: "muted" }, "Drag over the plot to see the error in a range.");
  const rows = inRange.value?.find((one) => one.channel === channel.value) ?? null;
  const unit = residuals.value[0]?.unit ?? a.unit;
  const ranges = Object.entries(b).map(([name, range]) => rangeText(name, range, system)).filter(Boolean);
  return [
    h(
      "span",
      { id: "brush-rms" },
      `${ranges.join(", ")}: `,
      h(
        "b",
        { title: RMS.definition },
        `RMS ${rows ? errorText(rows.rms, unit, channel.value, system) : "…"}`,
      ),
      rows ? `, ${rows.count} rows${a.validation ? " of the fit" : ""}` : "",
    ),
    h("button", {
      type: "button",
      class: "mini",
      "aria-label": "Clear the chosen range",
      onclick: () => lookCompare({ brush: null }),
    }, icon("close")),
  ];
}

const tabs = () => {
  const available = variables.value;
  return h(
    "div",
    { class: "group", role: "group", "aria-label": "Residual over" },
    ...TABS.filter(([id]) => !(id in VARIABLES) || available.includes(id)).map(([id, label, title]) =>
      h("button", {
        type: "button",
        title,
        "aria-label": title,
        "aria-pressed": () => String(residualOver.value === id),
        onclick: () => lookCompare({ tab: id }),
      }, label)
    ),
  );
};

const channelChoice = () =>
  channels.value.length > 1 && !["autocorrelation", "loops"].includes(residualOver.value)
    ? h(
      "select",
      {
        "aria-label": "Channel of the residual",
        class: "small",
        onchange: (/** @type {Event} */ e) =>
          lookCompare({ channel: /** @type {HTMLSelectElement} */ (e.target).value }),
      },
      ...channels.value.map((name) =>
        h("option", { value: name, selected: name === channel.value }, channelWords(name))
      ),
    )
    : null;

export function residualCard() {
  writeLabels(chart);
  const place = brushLayer(chart, {
    get: brushed,
    set: setBrush,
    usable: () => residualOver.peek() in VARIABLES && residualOver.peek() !== "direction",
    text: (x) => `${number(x, 2)} ${across()?.unit ?? ""}`,
  });
  effect(() => {
    palette.value;
    const all = whole.value, x = residualOver.value;
    const v = all ? null : viewOf(channel.value, x), fixed = scale.value;
    if (!plotlyReady.value || view.value !== "compare") return;
    if (all?.spec) chart.show(all.spec);
    else if (v && fixed && x in VARIABLES) chart.show((p) => residualSpec(v, p, fixed));
    apart(place);
  });
  return h(
    "section",
    { class: () => `card chart residual${stale.value ? " stale" : ""}`, "aria-label": TITLE },
    h(
      "div",
      { class: "card-head" },
      h(
        "h2",
        { title: "On the scale of the first model: linear inside the noise, logarithmic outside" },
        TITLE,
      ),
      channelChoice,
      tabs,
      menuButton({
        label: icon("more"),
        name: `${TITLE}: save or show as table`,
        class: "mini",
        items: () => chartMenu(chart, TITLE),
      }),
    ),
    h("p", { class: "brush-line", role: "status" }, inside),
    h("div", { hidden: () => whole.value !== null && whole.value.spec === null }, host),
    partsBar(),
  );
}
