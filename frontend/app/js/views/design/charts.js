// @ts-check
// The four plots: cards with title, legend and menu; all are drawn when an answer arrives.
import { h, icon } from "../../dom.js";
import { computed, effect, signal } from "../../reactive.js";
import { commit, look, preview, units } from "../../state.js";
import { status } from "../../store.js";
import { design, editDesign, patchDesign } from "../../muscle/document.js";
import { brief, niceStep, scaleOf, toShown, toSi, withUnit } from "../../format.js";
import { Chart } from "../../plots/chart.js";
import { plotlyReady } from "../../plots/library.js";
import { dragLine, linkCursor, writeLabels } from "../../plots/overlay.js";
import { palette } from "../../plots/theme.js";
import { menuButton } from "../../ui/menu.js";
import { curves, curvesAreCurrent, fault, faultField, loadOf, loadText, reference, retry } from "./model.js";
import { faultNotice, goToField } from "../../ui/fault.js";
import { forgetRanges } from "../../plots/axes.js";
import { ACROSS, atFixedLength, OVER, STIFFNESS } from "../../muscle/curve-axes.js";
import { cursor, readout } from "./readout.js";
import { residualWords, showResiduals } from "./residuals.js";

/** @typedef {import("../../muscle/curve-axes.js").View} View */

const across = computed(() => design.value.across);
const overWhat = computed(() => design.value.over);
const definition = computed(() => design.value.stiffness);

/** What is drawn. It follows the answers and the display, not the inputs: new inputs with old curves would be
 * wrong.
 * @returns {View | null} */
const viewNow = () => {
  const answer = curves.value;
  return answer && {
    place: "design",
    curves: answer,
    across: across.value,
    over: overWhat.value,
    definition: definition.value,
    system: units.value,
    reference: reference.value,
  };
};

/** @param {string} id @param {string} title @param {string} label @param {boolean} [small] */
function chartCard(id, title, label, small) {
  const host = h("div", { class: "plot", id, role: "figure", "aria-label": label });
  return { title, chart: new Chart(host, id, small), host };
}

const force = chartCard("force", "Force", "Force over contraction, one line per pressure, with the load");
const stiffness = chartCard(
  "stiffness",
  "Stiffness",
  "Stiffness over contraction, valve open and closed",
  true,
);
const volume = chartCard(
  "volume",
  "Volume and diameter",
  "Gas volume and braid diameter over contraction",
  true,
);
const over = chartCard(
  "over-pressure",
  "Over pressure",
  "Position or force over pressure, filling and venting",
  true,
);

/** All plots with their titles, for the export as one sheet. */
export const charts = [force, stiffness, volume, over].map(({ title, chart }) => ({ title, chart }));

/** @param {ReturnType<typeof chartCard>} card @param {import("../../dom.js").Child[]} head */
function frame(card, ...head) {
  return h(
    "section",
    { class: `card chart ${card.host.id}`, "aria-label": card.title },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, card.title),
      ...head,
      menuButton({
        label: icon("more"),
        name: `${card.title}: save or show as table`,
        class: "mini",
        items: async () => (await import("../../plots/export.js")).chartMenu(card.chart, card.title),
      }),
    ),
    card.host,
    card === force
      ? h("div", { class: "readout", "aria-live": "off" }, () => residualWords() ?? readout(viewNow()))
      : null,
  );
}

/** Unit of an axis in the head of a strip. @param {() => import("../../format.js").Quantity} quantity */
const unitOf = (quantity) => h("span", { class: "muted" }, () => scaleOf(quantity(), units.value).unit);

/** @template {string} T
 * @param {string} label @param {[T, string][]} options @param {() => T} get
 * @param {(value: T) => void} set @param {() => string | null} [explained] what the chosen one means */
const choice = (label, options, get, set, explained) =>
  h("select", {
    "aria-label": label,
    title: explained ?? null,
    class: "small",
    onchange: (/** @type {Event} */ e) =>
      set(/** @type {T} */ (/** @type {HTMLSelectElement} */ (e.target).value)),
  }, () => options.map(([value, text]) => h("option", { value, selected: value === get() }, text)));

function stateNote() {
  const error = fault.value, field = faultField();
  if (!error) return curves.value ? null : h("p", { class: "notice waiting" }, "Computing the curves…");
  return faultNotice(`${error.words}${curves.value ? " The plots show the last valid model." : ""}`, {
    goTo: field === null ? null : () => goToField(field, ".design"),
    retry,
  });
}

/** How many pressures were measured. */
function pointsText() {
  const values = new Set(
    reference.value?.data_columns?.pressure?.values.map((p) => Number(p.toPrecision(2))),
  );
  return values.size === 1 ? "1 pressure" : `${values.size} pressures`;
}

function overHint() {
  const d = design.value;
  const system = units.value;
  if (d.fixed_length != null) return `at ${withUnit(d.fixed_length, "length", system)}`;
  return h("button", {
    type: "button",
    class: "link",
    onclick: () =>
      editDesign({ fixed_length: curves.peek()?.geometry.nominal_length ?? 0.3 }, "fixed length"),
  }, "fix the length");
}

/** The load as a line in the force plot that can be dragged. */
function loadHandle() {
  const scale = () => scaleOf("force", units.peek());
  return dragLine(force.chart, {
    label: "Load line in the force plot",
    left: () => across.peek() === "length",
    get: () => toShown(design.peek().load, scale()),
    text: () => {
      const force = `${brief(toShown(design.peek().load, scale()))} ${scale().unit}`;
      return `Load ${design.peek().load_as === "mass" ? `${loadText.peek()} = ` : ""}${force}`;
    },
    step: () => niceStep(Math.abs(force.chart.spec?.y.range[1] ?? 100) / 150),
    set: (value, done) => {
      const grain = niceStep(Math.abs(force.chart.spec?.y.range[1] ?? 100) / 1000);
      preview(patchDesign({ load: toSi(Math.round(value / grain) * grain, scale()) }));
      if (done) commit("load", loadOf);
    },
  });
}

/** What the plots show; fetched together with Plotly, without which nothing is drawn. */
const specs = signal(/** @type {typeof import("./specs.js") | null} */ (null));
async function fetchSpecs() {
  try {
    specs.value = await import("./specs.js");
  } catch {
    status.value = "The plots did not load. Reload the page.";
  }
}

let drawings = 0;

/** Changes when the axes need new ranges; until then they stay the same while a slider moves. */
const picture = computed(() => {
  const { muscle, pressures, clipped, range } = design.value;
  return JSON.stringify([
    muscle.preset,
    pressures,
    clipped,
    range,
    across.value,
    overWhat.value,
    definition.value,
    reference.value?.id,
  ]);
});
let drawnPicture = "";
/** The answer that was on screen when the picture changed: it sets no ranges for the next one.
 * @type {unknown} */
let outdated = null;

/** Redraws every plot; the count and the performance marks are for tests. */
function drawAll() {
  const v = viewNow(), draw = specs.value;
  palette.value;
  if (!v || !draw) return;
  performance.mark("draw-start");
  if (picture.peek() !== drawnPicture) outdated = v.curves;
  else if (outdated && outdated !== v.curves) outdated = forgetRanges();
  drawnPicture = picture.peek();
  force.chart.show((p) => draw.forceSpec(v, p));
  stiffness.chart.show((p) => draw.stiffnessSpec(v, p));
  volume.chart.show((p) => draw.volumeSpec(v, p));
  over.chart.show((p) => draw.overPressureSpec(v, p));
  if (!force.chart.axes) return;
  performance.measure("draw", "draw-start");
  document.documentElement.dataset.drawn = String(++drawings);
}

export function chartColumn() {
  const acrossOptions = /** @type {[import("../../types.js").Across, string][]} */ (
    Object.entries(ACROSS).map(([key, { title }]) => [key, `over ${title.toLowerCase()}`])
  );
  const overOptions = /** @type {[import("../../types.js").Over, string][]} */ (
    Object.entries(OVER).map(([key, { title }]) => [key, title])
  );
  const stiffnessOptions = /** @type {[import("../../types.js").StiffnessOf, string][]} */ (
    Object.entries(STIFFNESS).map(([key, { title }]) => [key, title])
  );
  const column = h(
    "div",
    { class: () => `column centre${fault.value || !curvesAreCurrent.value ? " stale" : ""}` },
    stateNote,
    frame(
      force,
      choice(
        "Quantity along the x axis",
        acrossOptions,
        () => across.value,
        (key) => editDesign({ across: key }, `plots over ${ACROSS[key].title.toLowerCase()}`),
      ),
      () =>
        reference.value
          ? h(
            "ul",
            { class: "legend" },
            h("li", null, h("i", { class: "ring" }), `measured, ${pointsText()}`),
          )
          : null,
    ),
    frame(
      stiffness,
      choice(
        "Definition of the stiffness",
        stiffnessOptions,
        () => definition.value,
        (value) => editDesign({ stiffness: value }, "definition of the stiffness"),
        () => STIFFNESS[definition.value].text,
      ),
      unitOf(() => "stiffness"),
    ),
    frame(volume),
    frame(
      over,
      choice(
        "Quantity over pressure",
        overOptions,
        () => overWhat.value,
        (value) => look(patchDesign({ over: value })),
      ),
      h("span", { class: "muted" }, () => {
        const unit = scaleOf(OVER[overWhat.value].quantity, units.value).unit;
        return `${unit} / ${scaleOf("pressure", units.value).unit}`;
      }),
      () => atFixedLength(overWhat.value) ? h("span", { class: "muted" }, overHint) : null,
    ),
  );
  linkCursor([force.chart, stiffness.chart, volume.chart], (x) => (cursor.value = x));
  charts.forEach(({ chart }) => writeLabels(chart));
  showResiduals(force.chart, viewNow);
  const placeLoad = loadHandle();
  effect(() => {
    design.value.load;
    units.value;
    placeLoad();
  });
  effect(() => {
    if (plotlyReady.value) fetchSpecs();
  });
  effect(drawAll);
  return column;
}
