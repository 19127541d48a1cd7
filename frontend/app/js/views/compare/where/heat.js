// @ts-check
// "Where it fails": the map of the residual. A cell chosen shows its points everywhere and asks what would cause it.
import { h, icon } from "../../../dom.js";
import { figure, inSentence } from "../../../facts.js";
import { computed } from "../../../reactive.js";
import { units } from "../../../state.js";
import { number, scaleOf, toShown } from "../../../format.js";
import { palette } from "../../../plots/theme.js";
import { brush, fault, lookCompare, shown, stale } from "../answers.js";
import { channelScale, channelWords, errorText, errorUnit, rangeText, VARIABLES } from "../words.js";
import { inkOn, tint } from "./colours.js";
import { isQuiet, mapScale, marksOf, placeOf } from "./scale.js";

/** @typedef {import("../types.js").Grid} Grid */
/** @typedef {import("../types.js").Row} Row */
/** @typedef {import("../types.js").Cell} Cell */
/** @typedef {import("../types.js").Comparison} Comparison */
/** @typedef {[number, number]} Range */

const MEAN = figure("residual.mean");
/** Height of all rows together, and of a row at least and at most. */
const ROWS_PX = 272, LEAST_PX = 24, MOST_PX = 128;

const grid = computed(() => shown.value?.heat_map ?? null);

/** @param {Grid} map @param {number} ix @returns {Range} */
const columnRange = (map, ix) => [map.edges[ix] ?? 0, map.edges[ix + 1] ?? 0];

/** @param {Row} row @returns {Range} */
const rowRange = (row) => [row.low, row.high];

/** @param {Range} a @param {Range | undefined} b */
const within = (a, b) => {
  if (!b) return false;
  const slack = 1e-9 * Math.max(Math.abs(b[0]), Math.abs(b[1]), 1e-12);
  return a[0] >= b[0] - slack && a[1] <= b[1] + slack;
};

/** @param {Grid} map @param {number} ix @param {number} iy */
const isChosen = (map, ix, iy) => {
  const b = brush.value;
  return Boolean(b) && within(columnRange(map, ix), b?.[map.x]) &&
    (map.rows[iy].channel !== null || within(rowRange(map.rows[iy]), b?.[map.y]));
};

/** Chooses a cell; with Shift the range grows to it; the chosen cell alone again clears the choice.
 * @param {Grid} map @param {number} ix @param {number} iy @param {boolean} more */
function choose(map, ix, iy, more) {
  const b = brush.peek(), x = columnRange(map, ix), y = rowRange(map.rows[iy]);
  const same = (/** @type {Range | undefined} */ r, /** @type {Range} */ to) =>
    r !== undefined && r[0] === to[0] && r[1] === to[1];
  if (map.rows[iy].channel !== null) {
    const was = b?.[map.x], isSame = was?.[0] === x[0] && was?.[1] === x[1];
    const range = more && was ? /** @type {Range} */ ([Math.min(was[0], x[0]), Math.max(was[1], x[1])]) : x;
    return lookCompare({ brush: !more && isSame ? null : { [map.x]: range } });
  }
  if (!more) {
    const again = same(b?.[map.x], x) && same(b?.[map.y], y);
    return lookCompare({ brush: again ? null : { [map.x]: x, [map.y]: y } });
  }
  const wider = (
    /** @type {Range | undefined} */ r,
    /** @type {Range} */ to,
  ) => /** @type {Range} */ (r ? [Math.min(r[0], to[0]), Math.max(r[1], to[1])] : to);
  lookCompare({ brush: { [map.x]: wider(b?.[map.x], x), [map.y]: wider(b?.[map.y], y) } });
}

/** @param {KeyboardEvent} event */
function walk(event) {
  const cell = /** @type {HTMLElement} */ (event.target);
  const [ix, iy] = (cell.dataset.at ?? "0,0").split(",").map(Number);
  /** @type {Record<string, [number, number]>} */
  const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  if (event.key === "Escape") return lookCompare({ brush: null });
  const move = by[event.key], map = grid.peek();
  if (!move || !map) return;
  event.preventDefault();
  const to = { x: ix + move[0], y: iy + move[1] };
  const next = cell.closest("table")?.querySelector(`[data-at="${to.x},${to.y}"]`);
  if (!(next instanceof HTMLElement)) return;
  cell.tabIndex = -1;
  next.tabIndex = 0;
  next.focus();
  if (event.shiftKey) choose(map, to.x, to.y, true);
}

/** The number of shown units that stands in a cell, a dot inside the noise, "" where there is no value.
 * @param {number | null} mean @param {Comparison} a */
function valueText(mean, a) {
  const s = mapScale.value;
  if (mean === null || !s) return "";
  if (isQuiet(mean, s)) return "·";
  const { factor } = channelScale(a.unit, a.predicted, units.value), size = Math.abs(mean) / factor;
  const text = size >= 9.95 ? String(Math.round(size)) : size.toFixed(size >= 0.095 ? 1 : 2);
  return `${mean < 0 ? "−" : "+"}${text}`;
}

/** A value of the map. @param {number | null} mean @param {Comparison} a @param {"" | "●" | "□"} way */
function value(mean, a, way) {
  const s = mapScale.value;
  if (mean === null || !s) return h("span", { class: "half none" });
  const quiet = isQuiet(mean, s);
  const share = quiet ? 0 : placeOf(mean, s), p = palette.value;
  return h(
    "span",
    {
      class: `half${quiet ? " quiet" : ""}`,
      "data-way": way || null,
      style: `background:${tint(share)};color:${quiet ? "var(--soft)" : inkOn(share, p.dark)}`,
    },
    valueText(mean, a),
  );
}

/** @param {Cell} c @param {Comparison} a @param {string} at @param {boolean} split */
function describe(c, a, at, split) {
  const asText = (/** @type {number | null} */ si) => errorText(si, a.unit, a.predicted, units.value);
  const means = split
    ? `lengthening ${asText(c.lengthening)}, shortening ${asText(c.shortening)}`
    : `mean ${asText(c.mean)}`;
  return `${at}: ${means}, RMS ${asText(c.rms)}, ${c.count} rows`;
}

/** The name of a cell: what stands in it comes first, as who speaks to the page says what is seen.
 * @param {Cell} c @param {Comparison} a @param {string} at @param {boolean} split */
function nameOf(c, a, at, split) {
  const seen = (split ? [c.lengthening, c.shortening] : [c.mean]).map((mean) => valueText(mean, a)).filter(
    Boolean,
  );
  const what = split ? "lengthening and shortening" : "mean";
  return seen.every((text) => text === "·")
    ? describe(c, a, at, split)
    : `${seen.join(" ")}: ${what} at ${at}, RMS ${
      errorText(c.rms, a.unit, a.predicted, units.value)
    }, ${c.count} rows`;
}

/** Numbers of an axis with one number of decimals, as many as one of them needs; 0 has none.
 * @param {number[]} values @param {number} most */
function evenly(values, most) {
  const places = values.every((v) => Math.abs(v - Math.round(v)) < 0.5 * 10 ** -most) ? 0 : most;
  return values.map((v) => (Math.abs(v) < 0.5 * 10 ** -places ? "0" : v.toFixed(places)).replace("-", "−"));
}

/** @param {Comparison} a @param {Grid} map */
function table(a, map) {
  const system = units.value, ys = VARIABLES[map.y], xs = VARIABLES[map.x];
  const xScale = xs ? scaleOf(xs.quantity, system) : null;
  const yScale = ys ? scaleOf(ys.quantity, system) : null;
  const inRows = (/** @type {number} */ si) => yScale ? toShown(si, yScale) : si;
  const inColumns = (/** @type {number} */ si) => xScale ? toShown(si, xScale) : si;
  const edges = map.edges.slice(0, -1).map((v) => v ?? 0), edgeTexts = evenly(edges.map(inColumns), 1);
  const ranges = map.rows.filter((row) => row.channel === null && row.level === null);
  const ends = evenly(ranges.flatMap((row) => rowRange(row).map(inRows)), 1);
  const shownAt = (/** @type {number} */ si) => number(inRows(si), 2);
  const label = (/** @type {Row} */ row) =>
    row.channel !== null
      ? channelWords(row.channel)
      : row.level === null
      ? ends.slice(2 * ranges.indexOf(row), 2 * ranges.indexOf(row) + 2).join("…")
      : `${shownAt(row.level)} ${yScale?.unit ?? ""}`;
  const cell = (/** @type {Cell | null} */ c, /** @type {number} */ ix, /** @type {number} */ iy) => {
    if (!c) return h("td", null, h("span", { class: "none" }));
    const range = rowRange(map.rows[iy]);
    const where = `${
      map.rows[iy].level === null && map.rows[iy].channel === null
        ? rangeText(map.y, range, system)
        : label(map.rows[iy])
    }, ${rangeText(map.x, columnRange(map, ix), system)}`;
    return h(
      "td",
      null,
      h(
        "button",
        {
          type: "button",
          title: describe(c, a, where, map.split),
          "aria-label": nameOf(c, a, where, map.split),
          "aria-pressed": () => String(isChosen(map, ix, iy)),
          "data-at": `${ix},${iy}`,
          tabindex: -1,
          onkeydown: walk,
          onclick: (/** @type {MouseEvent} */ e) => choose(map, ix, iy, e.shiftKey),
        },
        ...(map.split
          ? [value(c.lengthening, a, "●"), " ", value(c.shortening, a, "□")]
          : [value(c.mean, a, "")]),
      ),
    );
  };
  const tall = `height:${Math.max(LEAST_PX, Math.min(MOST_PX, Math.floor(ROWS_PX / map.rows.length)))}px`;
  const made = h(
    "table",
    { class: `heat${map.split ? " split" : map.rows[0]?.level === null ? " ranges" : ""}` },
    h("caption", { class: "unseen" }, `${MEAN.label} by ${channelWords(map.y)} and ${channelWords(map.x)}`),
    h("colgroup", null, h("col", { class: "levels" }), h("col", { span: map.edges.length - 1 })),
    h(
      "tbody",
      null,
      ...map.rows.map((row, iy) =>
        h(
          "tr",
          { style: tall },
          h(
            "th",
            { scope: "row" },
            row.within_noise
              ? h("span", { class: "is-noise", title: "Its error is within the noise" }, icon("check"))
              : null,
            h("span", null, label(row)),
            row.within_noise ? h("span", { class: "unseen" }, ", within the noise") : null,
            map.split ? h("small", { "aria-hidden": "true" }, h("i", null, "●"), h("i", null, "□")) : null,
          ),
          ...row.cells.map((c, ix) => cell(c, ix, iy)),
        )
      ),
      h(
        "tr",
        { class: "foot-row" },
        h("td", null),
        ...edgeTexts.map((text) => h("th", { scope: "col" }, text)),
      ),
    ),
  );
  made.querySelector("button")?.setAttribute("tabindex", "0");
  return made;
}

/** The colours with their values. @param {Comparison} a */
function key(a) {
  const s = mapScale.value;
  if (!s) return null;
  const c = channelScale(a.unit, a.predicted, units.value);
  return h(
    "div",
    { class: "heat-key" },
    h("small", null, errorUnit(a.unit, a.predicted, units.value)),
    h(
      "div",
      null,
      h("i", { class: "ramp", "aria-hidden": "true" }),
      h(
        "p",
        null,
        ...marksOf(s, c.factor).map((m) =>
          h("span", {
            style: `left:${50 + 50 * m.at}%`,
            class: Math.abs(m.at) === 1 ? (m.at < 0 ? "low" : "high") : "",
          }, m.text)
        ),
      ),
    ),
  );
}

/** What the map shows, in the head. */
const aside = () => {
  const a = shown.value, map = grid.value;
  if (!a || !map) return "";
  const unit = errorUnit(a.unit, a.predicted, units.value);
  const ys = VARIABLES[map.y];
  if (map.scaled) return `${inSentence(MEAN.label)}, × noise`;
  if (map.rows[0]?.level === null) {
    return `${inSentence(MEAN.label)}, ${unit} · rows: ${channelWords(map.y)}, ${
      ys ? scaleOf(ys.quantity, units.value).unit : ""
    }`;
  }
  return map.split ? `mean, ${unit} · ● lengthening, □ shortening` : `${inSentence(MEAN.label)}, ${unit}`;
};

export function whereCard() {
  return h(
    "section",
    { class: () => `card where${stale.value ? " stale" : ""}`, "aria-label": "Where it fails" },
    h(
      "div",
      { class: "card-head" },
      h("h2", null, "Where it fails"),
      h("small", null, () => h("span", null, aside())),
    ),
    h("div", { class: "where-body" }, () => {
      const a = shown.value, map = grid.value;
      if (!a) {
        return fault.value
          ? h("p", { class: "muted" }, "There is no comparison yet.")
          : h("i", { class: "bone fill" });
      }
      if (!map) {
        return h("p", { class: "muted" }, "These data have one pressure and one length: there is no map.");
      }
      const xs = VARIABLES[map.x];
      return [
        table(a, map),
        h(
          "p",
          { class: "axis-note" },
          `${xs?.title ?? channelWords(map.x)} (${xs ? scaleOf(xs.quantity, units.value).unit : ""})`,
        ),
        key(a),
      ];
    }),
  );
}
