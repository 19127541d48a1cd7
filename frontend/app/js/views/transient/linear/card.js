// @ts-check
// The card of the linear view: operating point and goals, Bode diagram, poles, margins, controller design.
import { h, icon } from "../../../dom.js";
import { computed, effect } from "../../../reactive.js";
import { units, view } from "../../../state.js";
import { withUnit } from "../../../format.js";
import { chartMenu } from "../../../plots/export.js";
import { plotlyReady } from "../../../plots/library.js";
import { palette } from "../../../plots/theme.js";
import { menuButton } from "../../../ui/menu.js";
import { plot } from "../plots/plot.js";
import { regulated } from "../model.js";
import {
  goals,
  linear,
  linearError,
  linearise,
  linearStage,
  outdated,
  point,
  stop,
  takeOver,
} from "./model.js";
import { channelFields, channelText } from "./channel.js";
import { gainSpec, legendOfBode, phaseSpec, stepSpec, trialLooks } from "./specs.js";
import {
  marginsTable,
  matrixTables,
  modelsTable,
  polesTable,
  robustTable,
  TRIALS,
  trialsTable,
} from "./tables.js";

/** @typedef {import("./model.js").PointKind} PointKind */
/** @typedef {import("./model.js").Linear} Linear */
/** @typedef {import("./specs.js").Entry} Entry */

const gain = plot("linear-gain", "Gain", "Gain over frequency: linear models and the nonlinear drive");
const phase = plot("linear-phase", "Phase", "Phase over frequency: linear models and the nonlinear drive");
const steps = plot("linear-steps", "Steps", "Steps of the position with each controller");

/** @type {Record<PointKind, [string, string]>} kind -> words, example */
const POINTS = {
  middle: ["the middle of the range", ""],
  position: ["position", "40 mm"],
  contraction: ["contraction", "10 %"],
  pressure: ["pressure", "3 bar"],
  command: ["command", "50 %"],
};

const asking = computed(() => linearStage.value === "asking");
const design = computed(() => linear.value?.design ?? null);

function draw() {
  const answer = linear.value, system = units.value;
  palette.value;
  if (!answer || view.value !== "transient") return;
  gain.chart.show((p) => gainSpec(answer, p));
  phase.chart.show((p) => phaseSpec(answer, p));
  const { design } = answer;
  if (design) steps.chart.show((p) => stepSpec(design, p, system));
}

/** @param {Entry[]} entries */
const legend = (entries) =>
  h(
    "ul",
    { class: "legend" },
    ...entries.map((e) =>
      h(
        "li",
        null,
        h("i", { class: e.symbol ? "sign" : e.dash ? "dash" : "", style: `color:${e.color}` }),
        e.name,
      )
    ),
  );

const pointFields = () =>
  h(
    "div",
    { class: "linear-row" },
    h(
      "label",
      null,
      "Operating point ",
      h("select", {
        id: "linear-point",
        onchange: (/** @type {Event} */ e) => {
          const kind = /** @type {PointKind} */ (/** @type {HTMLSelectElement} */ (e.target).value);
          point.value = { kind, value: POINTS[kind][1] };
        },
      }, () =>
        /** @type {PointKind[]} */ (Object.keys(POINTS))
          .filter((kind) => kind !== "command" || regulated.value)
          .map((kind) => h("option", { value: kind, selected: point.value.kind === kind }, POINTS[kind][0]))),
    ),
    () =>
      point.value.kind === "middle" ? null : h("input", {
        type: "text",
        "aria-label": `${POINTS[point.value.kind][0]} of the operating point`,
        value: point.peek().value,
        onchange: (/** @type {Event} */ e) => {
          const { value } = /** @type {HTMLInputElement} */ (e.target);
          point.value = { kind: point.peek().kind, value };
        },
      }),
    h("button", {
      type: "button",
      class: "primary",
      disabled: () => asking.value,
      onclick: () => linearise(false),
    }, "Linearise"),
  );

/** @param {"overshoot" | "settling" | "step"} key @param {string} label @param {string} [empty] */
const goalField = (key, label, empty) =>
  h(
    "label",
    { class: empty ? "wide" : null },
    `${label} `,
    h("input", {
      type: "text",
      placeholder: empty,
      value: goals.peek()[key],
      onchange: (/** @type {Event} */ e) => {
        goals.value = { ...goals.peek(), [key]: /** @type {HTMLInputElement} */ (e.target).value };
      },
    }),
  );

const goalFields = () =>
  h(
    "div",
    { class: "linear-row" },
    goalField("overshoot", "Overshoot"),
    goalField("settling", "Settling"),
    goalField("step", "Step", "10 % of the range"),
    h(
      "label",
      { class: "tick" },
      h("input", {
        type: "checkbox",
        onchange: (/** @type {Event} */ e) => {
          const { checked } = /** @type {HTMLInputElement} */ (e.target);
          goals.value = { ...goals.peek(), unsaturated: checked };
        },
      }),
      " no saturation",
    ),
    h("button", {
      type: "button",
      disabled: () => asking.value,
      onclick: () => linearise(true),
    }, "Design a controller"),
    () => asking.value ? h("button", { type: "button", class: "link", onclick: stop }, "Stop") : null,
  );

function words() {
  const answer = linear.value;
  if (asking.value) return h("p", { class: "muted", role: "status" }, "Linearising…");
  if (linearError.value) return h("p", { class: "error", role: "alert" }, linearError.value.words);
  if (!answer) {
    return h(
      "p",
      { class: "hint" },
      "Linear models of this drive at an operating point: Bode diagram with points of the nonlinear drive, " +
        "poles, margins of the loop, and a position controller by rule and refinement.",
    );
  }
  const { position, contraction, pressure, command } = answer.point, system = units.value;
  return h(
    "p",
    null,
    `At ${withUnit(position, "length", system)} (${withUnit(contraction, "ratio", system)}), ` +
      `${withUnit(pressure, "pressure", system)}, command ${withUnit(command, "ratio", system)}. `,
    answer.smooth
      ? "Nothing sticks or switches here in a way that the motion shows."
      : "Something sticks or switches here: each case has its model.",
    ` Bode diagram, poles and zeros from ${channelText(answer)}.`,
    answer.dead_band
      ? ` Nothing reacts to commands between ${
        answer.dead_band.map((one) => withUnit(one, "ratio", system)).join(" and ")
      }.`
      : null,
    outdated.value ? h("b", null, " The drive has changed since.") : null,
  );
}

/** @param {import("../plots/plot.js").Plot} one */
const chartCard = (one) =>
  h(
    "div",
    { class: "linear-plot" },
    h(
      "div",
      { class: "card-head" },
      h("h3", null, one.title),
      menuButton({
        label: icon("more"),
        name: `${one.title}: save or show as table`,
        class: "mini",
        items: () => chartMenu(one.chart, one.title),
      }),
    ),
    one.host,
  );

function designPart() {
  const found = design.value;
  if (!found) return null;
  const last = found.trials[found.trials.length - 1];
  return [
    legend([
      { name: "reference", color: palette.value.soft },
      ...trialLooks(found, palette.value).map(({ trial, color, dash }) => ({
        name: TRIALS[trial.name],
        color,
        dash,
      })),
    ]),
    h(
      "div",
      { class: "linear-pair" },
      trialsTable(found),
      h(
        "div",
        null,
        h("p", { class: "hint" }, "Refined, with another mass and supply:"),
        robustTable(found),
      ),
    ),
    ...found.remarks.map((text) => h("p", { class: "flag" }, icon("warn"), h("span", null, text))),
    h("p", { class: "hint" }, `Rule: ${found.rule}. Refined in ${found.evaluations} runs.`),
    h("button", {
      type: "button",
      class: "primary",
      onclick: () => takeOver(last),
    }, "Use the refined controller"),
  ];
}

/** The loop of the controller, and what a run with its gains does. @param {Linear} answer */
const loopOf = ({ loop }) =>
  loop
    ? [
      marginsTable(loop.margins),
      loop.run ? h("p", { class: "muted" }, `A run with these gains: ${loop.run}`) : null,
    ]
    : [];

function results() {
  const answer = linear.value;
  if (!answer) return null;
  return [
    legend(legendOfBode(answer, palette.value)),
    h(
      "div",
      { class: "linear-pair" },
      polesTable(answer),
      h("div", null, modelsTable(answer), ...loopOf(answer)),
    ),
    h(
      "details",
      null,
      h("summary", null, "What the linear models do not contain"),
      h("ul", { class: "plain muted" }, ...[...answer.lost, ...answer.notes].map((t) => h("li", null, t))),
    ),
    h("details", null, h("summary", null, "Matrices A, B, C, D"), ...matrixTables(answer)),
  ];
}

export function linearCard() {
  const isShown = computed(() => linear.value !== null);
  const card = h(
    "section",
    {
      class: () => `card linear-card${outdated.value || asking.value ? " stale" : ""}`,
      "aria-label": "Linear view",
    },
    h("div", { class: "card-head" }, h("h2", null, "Linear view and controller")),
    pointFields(),
    channelFields(),
    goalFields(),
    words,
    h("div", { class: "linear-plots", hidden: () => !isShown.value }, chartCard(gain), chartCard(phase)),
    results,
    h("div", { class: "linear-steps", hidden: () => design.value === null }, chartCard(steps)),
    designPart,
  );
  effect(() => {
    if (plotlyReady.value) draw();
  });
  return card;
}
