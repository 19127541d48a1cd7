// @ts-check
// Measured points and model; one plot for each predicted channel.
import { figure } from "../../../facts.js";
import { capitalized } from "../../../format.js";
import { h, icon } from "../../../dom.js";
import { computed, effect, signal } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { Chart } from "../../../plots/chart.js";
import { writeLabels } from "../../../plots/overlay.js";
import { palette } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { menuButton } from "../../../ui/menu.js";
import { plotlyReady } from "../../../plots/library.js";
import {
  brush,
  compare,
  fault,
  isBefore,
  lookCompare,
  previewLabel,
  previous,
  shown,
  stale,
  steps,
} from "../answers.js";
import { pinnedAnswers } from "../pinned.js";
import { across, channels, over, viewOf } from "./pictures.js";
import { overlaySpec } from "./specs.js";
import { channelWords, rangeText, VARIABLES } from "../words.js";

/** The plots on the page, for the export. @type {{title: string, chart: Chart}[]} */
export const overlays = [];
let drawings = 0;

/** Switches between the current model and the one before it. */
export function toggleBefore() {
  if (previous.peek()) lookCompare({ before: !compare.peek().before });
}

const overChoice = () =>
  h("select", {
    "aria-label": "Quantity along the x axis",
    class: "small",
    onchange: (/** @type {Event} */ e) =>
      lookCompare({ over: /** @type {HTMLSelectElement} */ (e.target).value, brush: null }),
  }, () =>
    across.value.map((name) =>
      h(
        "option",
        { value: name, selected: name === over.value },
        `over ${VARIABLES[name].short}`,
      )
    ));

/** Whether the model one step before is drawn too; it is, until its name in the legend is pressed. */
export const ghostShown = signal(true);

/** A name in the legend that draws or hides its line. @param {import("../../../dom.js").Leaf[]} name @param {() => boolean} isOn
 * @param {() => void} flip @param {import("../../../dom.js").Child} sign */
const toggle = (name, isOn, flip, sign) =>
  h(
    "li",
    null,
    h(
      "button",
      {
        type: "button",
        class: "legend-toggle",
        "aria-pressed": () => String(isOn()),
        onclick: flip,
      },
      sign,
      ...name,
    ),
  );

/** How well a model fits, beside its name. @param {import("../types.js").Comparison} a */
const fitOf = ({ fit_percent: share }) =>
  share === null
    ? null
    : h("small", { class: "fit", title: FIT }, `\u00a0${share < 0 ? "< 0" : share.toFixed(1)}\u00a0%`);
const FIT = `${figure("comparison.fit_percent").label}: ${figure("comparison.fit_percent").definition}`;

/** What the signs mean; lines that can be drawn or not are buttons. */
function legend() {
  const a = shown.value;
  if (!a) return null;
  const turns = a.series.some((s) => s.direction?.some((d) => (d ?? 0) < 0));
  const { pins, traces } = compare.value;
  return h(
    "ul",
    { class: "legend" },
    h("li", null, h("i", { class: "dot" }), turns ? "lengthening" : "measured"),
    turns ? h("li", null, h("i", { class: "square" }), "shortening") : null,
    h("li", null, h("i"), "model", fitOf(a)),
    a.reversals
      ? h(
        "li",
        { title: figure("reversals.rows").definition },
        h("i", { class: "reversal" }),
        // Without friction the model has no range there.
        a.reversals.high.some((high, i) => (high ?? 0) > (a.reversals?.low[i] ?? 0))
          ? "reversal, range of friction"
          : "reversal",
      )
      : null,
    previous.value
      ? toggle(
        [h("span", { class: "wider" }, "one step\u00a0"), "before"],
        () => ghostShown.value,
        () => (ghostShown.value = !ghostShown.peek()),
        h("i", { class: "ghost" }),
      )
      : null,
    ...traces.flatMap((i) =>
      pins[i]
        ? [toggle(
          [pins[i].name, pinnedAnswers.value[i] && fitOf(pinnedAnswers.value[i])],
          () => true,
          () => lookCompare({ traces: compare.peek().traces.filter((k) => k !== i) }),
          h("i", { class: "pin" }),
        )]
        : []
    ),
  );
}

/** What is drawn instead of the model of now, or which points are chosen. */
function tag() {
  if (previewLabel.value) return h("p", { class: "on-tag" }, `Preview: ${previewLabel.value}`);
  if (isBefore.value) {
    return h("p", { class: "on-tag before-tag" }, `Before: ${steps.value.at(-1)?.label ?? ""}`);
  }
  const b = brush.value;
  if (!b) return null;
  const ranges = Object.entries(b).map(([name, range]) => rangeText(name, range, units.value)).filter(
    Boolean,
  );
  return h(
    "button",
    {
      type: "button",
      class: "on-tag",
      "aria-label": `${ranges.join(", ")}: show all points`,
      title: "Show all points (Esc)",
      onclick: () => lookCompare({ brush: null }),
    },
    ranges.join(", "),
    icon("close"),
  );
}

/** @param {string} name @param {boolean} first */
function plotCard(name, first) {
  const title = `${capitalized(channelWords(name))}: measured and model`;
  const host = h("div", {
    class: "plot",
    id: `overlay-${name}`,
    role: "figure",
    "aria-label": `Measured and modelled ${channelWords(name)}`,
  });
  const chart = new Chart(host, `compare-${name}`);
  writeLabels(chart);
  overlays.push({ title, chart });
  effect(() => {
    palette.value;
    const found = viewOf(name, over.value);
    const v = found && !ghostShown.value && !previewLabel.value ? { ...found, ghost: [] } : found;
    if (!plotlyReady.value || !v || view.value !== "compare") return;
    chart.show((p) => overlaySpec(v, p));
    if (chart.axes) document.documentElement.dataset.compared = String(++drawings);
  });
  return h(
    "section",
    { class: "card chart overlay", "aria-label": title },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, title),
      first ? overChoice() : null,
      menuButton({
        label: icon("more"),
        name: `${title}: save or show as table`,
        class: "mini",
        items: () => chartMenu(chart, title),
      }),
    ),
    first ? legend : null,
    h("div", { class: "on-plot" }, first ? tag : null),
    host,
  );
}

export function overlayCards() {
  const names = computed(() => channels.value.join());
  return h(
    "div",
    { class: () => `column${stale.value ? " stale" : ""}` },
    () => {
      overlays.length = 0;
      // A drive predicts pressure and stroke: the places of both are kept free.
      if (!names.value) {
        return fault.value ? null : compare.value.drive ? [skeleton(), skeleton(false)] : skeleton();
      }
      return names.value.split(",").map((name, i) => plotCard(name, i === 0));
    },
  );
}

/** @param {boolean} [first] has the legend */
const skeleton = (first = true) =>
  h(
    "section",
    { class: "card chart overlay", "aria-label": "Overlay" },
    h("div", { class: "card-head" }, h("h2", null, "Measured and model")),
    first ? h("ul", { class: "legend", "aria-hidden": "true" }) : null,
    h("div", { class: "plot skeleton", role: "status" }, h("span", { class: "unseen" }, "Comparing…")),
  );
