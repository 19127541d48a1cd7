// @ts-check
// Measured points and model; one plot for each predicted channel.
import { capitalized, readable } from "../../../format.js";
import { h, icon } from "../../../dom.js";
import { computed, effect } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { Chart } from "../../../plots/chart.js";
import { writeLabels } from "../../../plots/overlay.js";
import { palette } from "../../../plots/theme.js";
import { chartMenu } from "../../../plots/export.js";
import { menuButton } from "../../../ui/menu.js";
import { plotlyReady } from "../../../plots/library.js";
import { compare, fault, isBefore, lookCompare, previous, shown, stale, steps } from "../answers.js";
import { channels, over, variables, viewOf } from "./pictures.js";
import { colours, overlaySpec, pressureText } from "./specs.js";
import { VARIABLES } from "../words.js";

/** The plots on the page, for the export. @type {{title: string, chart: Chart}[]} */
export const overlays = [];
let drawings = 0;

/** Switches between the current model and the one before it. */
export function toggleBefore() {
  if (previous.peek()) lookCompare({ before: !compare.peek().before });
}

const flip = () =>
  h(
    "div",
    { class: "group", role: "group", "aria-label": "Model shown" },
    ...[true, false].map((before) =>
      h("button", {
        type: "button",
        id: before ? "show-before" : "show-after",
        title: "Switch with B",
        disabled: () => previous.value === null,
        "aria-pressed": () => String(isBefore.value === before),
        onclick: () => lookCompare({ before }),
      }, before ? "Before" : "After")
    ),
  );

const overChoice = () =>
  h("select", {
    "aria-label": "Quantity along the x axis",
    class: "small",
    onchange: (/** @type {Event} */ e) =>
      lookCompare({ over: /** @type {HTMLSelectElement} */ (e.target).value, brush: null }),
  }, () =>
    variables.value.map((name) =>
      h(
        "option",
        { value: name, selected: name === over.value },
        `over ${VARIABLES[name].title.toLowerCase()}`,
      )
    ));

const SHOWN = 6;

/** Pressures by colour: the lowest, the highest and some between. */
function legend() {
  const a = shown.value, system = units.value, p = palette.value;
  if (!a) return null;
  const known = a.series.filter((s) => s.pressure !== null);
  const tints = colours(a.series, p);
  const all = [...new Map(known.map((s) => [s.pressure, tints[a.series.indexOf(s)]])).entries()]
    .sort((one, other) => (one[0] ?? 0) - (other[0] ?? 0));
  const step = Math.max(1, Math.ceil((all.length - 1) / (SHOWN - 1)));
  const some = all.filter((_one, i) => i % step === 0 || i === all.length - 1);
  const turns = a.series.some((s) => s.direction?.some((d) => (d ?? 0) < 0));
  return h(
    "ul",
    { class: "legend" },
    h("li", null, h("i", { class: "ring" }), "measured"),
    h("li", null, h("i"), turns ? "model, lengthening" : "model"),
    turns ? h("li", null, h("i", { class: "dash" }), "shortening") : null,
    previous.value ? h("li", null, h("i", { class: "ghost" }), isBefore.value ? "after" : "before") : null,
    ...some.map(([pressure, color]) =>
      h("li", null, h("i", { style: `background:${color}` }), pressureText(pressure ?? 0, system))
    ),
  );
}

/** @param {string} name @param {boolean} first */
function plotCard(name, first) {
  const title = `${capitalized(readable(name))}: measured and model`;
  const host = h("div", {
    class: "plot",
    id: `overlay-${name}`,
    role: "figure",
    "aria-label": `Measured and modelled ${readable(name)}`,
  });
  const chart = new Chart(host, `compare-${name}`);
  writeLabels(chart);
  overlays.push({ title, chart });
  effect(() => {
    palette.value;
    const v = viewOf(name, over.value);
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
      first ? flip() : null,
      menuButton({
        label: icon("more"),
        name: `${title}: save or show as table`,
        class: "mini",
        items: () => chartMenu(chart, title),
      }),
    ),
    first ? legend : null,
    h(
      "div",
      { class: "on-plot" },
      () =>
        isBefore.value ? h("p", { class: "before-tag" }, `Before: ${steps.value.at(-1)?.label ?? ""}`) : null,
    ),
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
      if (!names.value) return fault.value ? null : skeleton();
      return names.value.split(",").map((name, i) => plotCard(name, i === 0));
    },
  );
}

const skeleton = () =>
  h(
    "section",
    { class: "card chart", "aria-label": "Overlay" },
    h("div", { class: "card-head" }, h("h2", null, "Overlay")),
    h("div", { class: "plot skeleton", role: "status" }, h("span", { class: "unseen" }, "Comparing…")),
  );
