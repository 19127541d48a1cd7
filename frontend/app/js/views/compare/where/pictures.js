// @ts-check
// What the plots are drawn from: the comparison shown, by channel.
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { answer, brush, chosen, compare, isBefore, previewLabel, previous, shown, tab } from "../answers.js";
import { pinned } from "../pinned.js";
import { VARIABLES, varies } from "../words.js";

/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {import("../types.js").Series} Series */
/** @typedef {import("./specs.js").View} View */

/** Series of the fit and of validation. @param {Comparison} a @returns {Series[]} */
export const allSeries = (a) =>
  a.series.some((s) => s.use === "validation") ? a.series : [...a.series, ...(a.validation?.series ?? [])];

/** @param {Comparison} a @returns {string[]} */
const channelsOf = (a) => [...new Set(allSeries(a).map((s) => s.channel ?? a.predicted))];

/** @param {Comparison} a @param {string} channel */
const ofChannel = (a, channel) => allSeries(a).filter((s) => (s.channel ?? a.predicted) === channel);

/** Noise of one channel [SI]. @param {Comparison} a @param {string} channel */
export function noiseOf(a, channel) {
  const floor = a.channels?.[channel]?.noise_floor;
  return floor ?? (a.channels && Object.keys(a.channels).length ? null : a.noise_floor);
}

export const channels = computed(() => shown.value ? channelsOf(shown.value) : []);
/** The channel of the residual plot. */
export const channel = computed(() => {
  const all = channels.value, wanted = compare.value.channel;
  return wanted && all.includes(wanted) ? wanted : all[0] ?? "";
});

/** Variables that change in the data shown. */
export const variables = computed(() => {
  const a = shown.value;
  return a ? Object.keys(VARIABLES).filter((name) => varies(allSeries(a), name)) : [];
});

/** The x variable of the overlay for a kind of test; at a joint its angle. @param {string} kind */
const usualOver = (kind) => {
  if (kind === "transient") return "time";
  if (variables.value.includes("angle")) return "angle";
  return kind === "isometric" || kind === "isotonic" ? "pressure" : "contraction";
};

/** Variables that the overlay can be drawn over. */
export const across = computed(() => variables.value.filter((name) => name !== "direction"));

/** The x variable of the overlay. */
export const over = computed(() => {
  const all = across.value, wanted = compare.value.over;
  if (wanted && all.includes(wanted)) return wanted;
  const usual = usualOver(shown.value?.kind ?? "");
  return all.includes(usual) ? usual : all[0] ?? usual;
});

/** Tabs of the residual that are not over a variable. */
const WHOLE = new Set(["histogram", "autocorrelation", "cross", "loops"]);

/** The tab of the residual plot; variables that do not change in the data have none. */
export const residualOver = computed(() => {
  const all = variables.value, wanted = tab.value;
  if (WHOLE.has(wanted)) return wanted;
  return all.includes(wanted) ? wanted : all.includes(over.value) ? over.value : all[0] ?? "contraction";
});

const picture = computed(() => chosen.value.map((f) => f.id.slice(0, 12)).join());

/** @param {string} name of a channel @param {string} x variable @returns {View | null} */
export function viewOf(name, x) {
  const a = shown.value;
  if (!a) return null;
  const series = ofChannel(a, name);
  const other = isBefore.value || previewLabel.value ? answer.value : previous.value;
  return {
    series,
    ghost: other ? ofChannel(other, name) : [],
    pinned: pinned.value.map((one) => ({ name: one.name, series: ofChannel(one.comparison, name) })),
    channel: name,
    unit: series[0]?.unit ?? a.unit,
    over: x,
    system: units.value,
    brush: brush.value,
    noise: noiseOf(a, name),
    reversals: a.reversals,
    picture: picture.value,
  };
}

/** The series of the residual plot. */
export const residuals = computed(() => shown.value ? ofChannel(shown.value, channel.value) : []);
