// @ts-check
// Two ticked drives side by side: what differs, and which is better where more or less is better.
import { h } from "../../dom.js";
import { signal } from "../../reactive.js";
import { units } from "../../state.js";
import { brief, scaleOf, toShown } from "../../format.js";
import { proposals } from "./model.js";
import { driveWords, sizingFigure, valueText } from "./words.js";

/** @typedef {import("../../types.js").S["ProposedDrive"]} Proposal */
/** @typedef {import("../../format.js").Quantity} Quantity */

/** Indices of the drives to compare, at most two. */
export const ticked = signal(/** @type {number[]} */ ([]));
/** Ticks a drive or takes its tick away; a third one takes the place of the first. @param {number} i */
export const tick = (i) => {
  const now = ticked.peek();
  ticked.value = now.includes(i) ? now.filter((one) => one !== i) : [...now, i].slice(-2);
};

/** Figures with the sign of what is better; 0: neither. @type {[import("./words.js").Name, -1 | 0 | 1][]} */
const FIGURES = [
  ["nominal_length", -1],
  ["installed_length", -1],
  ["outer_diameter", -1],
  ["time", -1],
  ["time_down", -1],
  ["air_volume_anr", -1],
  ["impact_energy", -1],
  ["pressure", -1],
  ["contraction", -1],
  ["force_reserve", 1],
  ["probability", 1],
  ["peak_force", -1],
  ["stiffness", 0],
  ["end_speed", -1],
  ["max_speed", 0],
  ["life", 1],
];

/** @param {Proposal} a @param {Proposal} b @param {import("./words.js").Name} name @param {-1 | 0 | 1} better */
function row(a, b, name, better) {
  const { label, definition, quantity } = sizingFigure(name),
    s = scaleOf(/** @type {Quantity} */ (quantity), units.value);
  const [from, to] = [a[name], b[name]];
  const gap = from == null || to == null ? null : to - from;
  const grade = gap === null || better === 0 ? "" : gap * better > 0 ? "better" : "worse";
  // An estimate of a life has two digits.
  const short = (/** @type {number} */ x) =>
    Math.abs(x) >= 1e4 ? Number(x.toPrecision(2)).toLocaleString("en") : brief(x);
  const text = (/** @type {number | null | undefined} */ si) => si == null ? "–" : short(toShown(si, s));
  const sign = (gap ?? 0) > 0 ? "+" : "";
  return h(
    "tr",
    { title: definition },
    h("th", { scope: "row" }, label, h("small", null, ` ${s.unit}`)),
    h("td", null, text(from)),
    h("td", null, text(to)),
    h(
      "td",
      { class: grade },
      gap === null ? "" : `${sign}${short(gap / s.factor)}`,
      grade ? h("span", { class: "unseen" }, ` ${grade}`) : null,
    ),
  );
}

/** The card of the differences; nothing unless two are ticked. */
export function differences() {
  const [i, j] = [...ticked.value].sort((one, other) => one - other),
    a = proposals.value[i],
    b = proposals.value[j];
  if (!a || !b) return null;
  const same = FIGURES.filter(([name]) => valueText(a, name) === valueText(b, name));
  const other = FIGURES.filter((each) => !same.includes(each));
  const parts = /** @type {const} */ ([["Valve", "valve"], ["Tube", "tube"]]);
  return h(
    "section",
    { class: "card differences", "aria-label": "Difference" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Difference"),
      h("button", { type: "button", class: "link", onclick: () => (ticked.value = []) }, "Remove the ticks"),
    ),
    ...parts.filter(([, key]) => a[key] !== b[key]).map(([label, key]) =>
      h("p", { class: "muted" }, `${label}: ${a[key] ?? "none"} → ${b[key] ?? "none"}`)
    ),
    h(
      "table",
      { class: "data" },
      h("caption", { class: "unseen" }, `${driveWords(a)} and ${driveWords(b)}`),
      h(
        "thead",
        null,
        h(
          "tr",
          null,
          h("td", null),
          h("th", { scope: "col" }, `No. ${i + 1}`),
          h("th", { scope: "col" }, `No. ${j + 1}`),
          h("th", { scope: "col" }, `${j + 1} − ${i + 1}`),
        ),
      ),
      h(
        "tbody",
        null,
        ...other.map(([name, better]) => row(a, b, name, better)),
      ),
    ),
    same.length
      ? h(
        "p",
        { class: "muted" },
        `Equal: ${same.map(([name]) => sizingFigure(name).label.toLowerCase()).join(", ")}.`,
      )
      : null,
  );
}
