"""Curves and points over two axes, as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mckibben.report.figures import plain
from mckibben.report.html import Html, html, tag
from mckibben.report.marks import (
    EDGE,
    GRID,
    INK,
    SOFT,
    Axis,
    Band,
    Dots,
    Line,
    Mark,
    Rule,
)

# Viridis without its bright end: the order is still visible in black and white.
_FAMILY = ((34, 154, 136), (33, 131, 141), (45, 106, 142), (61, 78, 138), (71, 45, 123), (66, 4, 84))
_RIGHT, _TOP, _BOTTOM, _BARE = 12.0, 10.0, 44.0, 8.0
_DIGIT = 6.9  # width of a digit of a tick label
_LETTER, _CAP = 6.3, 8.0  # mean width and height of a letter
_LEGEND = 128.0
_MOST_ENTRIES = 12


def family(count: int) -> list[str]:
    """Colours for a family of curves, from light to dark."""
    colours = []
    for number in range(count):
        place = number / max(count - 1, 1) * (len(_FAMILY) - 1)
        low = min(int(place), len(_FAMILY) - 2)
        mixed = [
            round(a + (b - a) * (place - low)) for a, b in zip(_FAMILY[low], _FAMILY[low + 1], strict=True)
        ]
        colours.append(f"rgb({mixed[0]},{mixed[1]},{mixed[2]})")
    return colours


def ticks(low: float, high: float, about: int = 6) -> list[float]:
    """Round values (1, 2 or 5 times a power of ten) inside a range."""
    raw = (high - low) / about
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= raw * 0.999)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [number * step for number in range(first, last + 1)]


def chart(
    x: Axis,
    y: Axis,
    marks: Sequence[Mark],
    *,
    title: str,
    width: float = 720.0,
    height: float = 270.0,
    left: float | None = None,
    legend: bool | None = None,
    room: float = _LEGEND,
) -> Html:
    """The drawing.

    Args:
        x, y: the axes; their ranges follow the marks unless `Axis.ends` is set.
        marks: bands are drawn first, everything else on top in this order.
        title: description for screen readers.
        width, height: of the drawing; the page scales it to its own width.
        left: where the axes begin, to align several drawings; None for as much as the labels need.
        legend: whether to leave space for a legend; None for "if any mark has a label".
        room: width of the legend.
    """
    labelled = [mark for mark in marks if mark.label]
    right = _RIGHT + (room if (bool(labelled) if legend is None else legend) else 0.0)
    heights = [[m.low, m.high] if isinstance(m, Band) else m.y for m in marks if not isinstance(m, Rule)]
    foot = height - (_BARE if x.bare else _BOTTOM)
    vertical = _Scale(*_range(y, heights, pad=0.04), foot, _TOP)
    begin = margin([label(v) for v in ticks(vertical.low, vertical.high, 5)]) if left is None else left
    horizontal = _Scale(*_range(x, [m.x for m in marks if isinstance(m, Line | Dots)]), begin, width - right)
    bands = [_band(mark, vertical, horizontal) for mark in marks if isinstance(mark, Band)]
    rest = [_mark(mark, horizontal, vertical) for mark in marks if not isinstance(mark, Band)]
    box = (begin, _TOP, horizontal.end - begin, foot - _TOP)
    return tag(
        "svg",
        tag("title", title),
        _clipped(box, bands),
        _grid(x, y, horizontal, vertical),
        _clipped(box, rest),
        [_names(mark, horizontal, vertical) for mark in marks if isinstance(mark, Dots) and mark.names],
        _legend(labelled, horizontal.end + 14.0),
        viewBox=f"0 0 {width:g} {height:g}",
        role="img",
        xmlns="http://www.w3.org/2000/svg",
    )


@dataclass(frozen=True)
class _Scale:
    low: float
    high: float
    begin: float
    end: float

    def at(self, value: float) -> float:
        return self.begin + (value - self.low) / (self.high - self.low) * (self.end - self.begin)

    def all(self, values: ArrayLike) -> NDArray:
        share = (_numbers(values) - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)


def _numbers(values: ArrayLike) -> NDArray[np.float64]:
    """Floats; None becomes NaN, which leaves a gap."""
    return np.array(values, dtype=float)


def _range(axis: Axis, values: Sequence[ArrayLike], pad: float = 0.02) -> tuple[float, float]:
    if axis.ends is not None:
        return axis.ends
    finite = [numbers[np.isfinite(numbers)] for numbers in map(_numbers, values)]
    joined = np.concatenate([*finite, [0.0]] if axis.zero or not any(map(len, finite)) else finite)
    low, high = float(np.min(joined)), float(np.max(joined))
    span = high - low or abs(high) or 1.0
    return low - (pad * span if low or not axis.zero else 0.0), high + pad * span


def _clipped(box: tuple[float, float, float, float], marks: Sequence[Html]) -> Html:
    """Marks clipped to the axes by an inner svg."""
    left, top, wide, high = (f"{value:g}" for value in box)
    return tag("svg", *marks, x=left, y=top, width=wide, height=high, viewBox=f"{left} {top} {wide} {high}")


def _band(band: Band, y: _Scale, x: _Scale) -> Html:
    top, bottom = y.at(band.high), y.at(band.low)
    return tag(
        "rect", x=f"{x.begin:g}", y=f"{top:.1f}", width=f"{x.end - x.begin:.1f}",
        height=f"{bottom - top:.1f}", fill=GRID,
    )  # fmt: skip


def _mark(mark: Line | Dots | Rule, x: _Scale, y: _Scale) -> Html:
    if isinstance(mark, Rule):
        return _rule(mark, x.at(mark.x), y.end, y.begin)
    across, up = x.all(mark.x), y.all(mark.y)
    steps, pen = [], "M"
    for a, b in zip(across.tolist(), up.tolist(), strict=True):
        if not (math.isfinite(a) and math.isfinite(b)):
            pen = "M"
        elif isinstance(mark, Dots):
            steps.append(f"M{a:.1f} {b:.1f}h0")
        else:
            steps.append(f"{pen}{a:.1f} {b:.1f}")
            pen = "L"
    return _path("".join(steps), mark)


def _rule(mark: Rule, at: float, top: float, bottom: float) -> Html:
    return tag(
        "path", d=f"M{at:.1f} {top:.1f}V{bottom:.1f}", stroke=mark.colour, stroke_dasharray=mark.dash,
        stroke_width=1.2, fill="none",
    )  # fmt: skip


def _names(mark: Dots, x: _Scale, y: _Scale) -> Html:
    """Labels at the right of the dots; at the left where there is no space."""
    across, up = x.all(mark.x), y.all(mark.y)
    away = 0.5 * mark.size + 3.0
    parts = []
    for a, b, name in zip(across.tolist(), up.tolist(), mark.names, strict=True):
        left = a + away + _LETTER * len(name) > x.end
        place = a - away if left else a + away
        height = b + away + _CAP if mark.below else b - away
        anchor = "end" if left else "start"
        # A white outline keeps the letters readable on top of lines.
        parts += [
            tag(
                "text", name, x=f"{place:.1f}", y=f"{height:.1f}", text_anchor=anchor, fill=INK,
                stroke="#fff", stroke_width=3, paint_order="stroke", stroke_linejoin="round",
            )
        ]  # fmt: skip
    return html(parts)


def _path(course: str, mark: Line | Dots) -> Html:
    """A line; a dot is a stroke of zero length with round caps."""
    if isinstance(mark, Dots):
        return tag(
            "path", d=course, stroke=mark.colour, stroke_width=mark.size, stroke_linecap="round", fill="none"
        )
    return tag(
        "path", d=course, stroke=mark.colour, stroke_width=mark.width, stroke_dasharray=mark.dash,
        stroke_linejoin="round", fill="none",
    )  # fmt: skip


def _grid(x: Axis, y: Axis, across: _Scale, up: _Scale) -> Html:
    parts: list[Html] = []
    for value in [] if x.bare else ticks(across.low, across.high, 7):
        a = f"{across.at(value):.1f}"
        parts.append(tag("line", x1=a, x2=a, y1=f"{up.begin:g}", y2=f"{up.begin + 4:g}", stroke=EDGE))
        parts.append(text(label(value), a, up.begin + 17.0, anchor="middle"))
    for value in ticks(up.low, up.high, 5):
        b = up.at(value)
        colour = EDGE if value == 0.0 else GRID
        parts.append(
            tag(
                "line",
                x1=f"{across.begin:g}",
                x2=f"{across.end:g}",
                y1=f"{b:.1f}",
                y2=f"{b:.1f}",
                stroke=colour,
            )
        )
        parts.append(text(label(value), across.begin - 7.0, b + 4.0, anchor="end"))
    frame = f"M{across.begin:g} {up.end:g}V{up.begin:g}H{across.end:g}"
    parts.append(tag("path", d=frame, stroke=EDGE, fill="none"))
    middle, centre = 0.5 * (across.begin + across.end), 0.5 * (up.begin + up.end)
    if not x.bare:
        parts.append(text(x.text, middle, up.begin + 36.0, anchor="middle", colour=INK))
    for words, at in _lines(y, up.begin - up.end):
        rotation = f"rotate(-90 {at:g} {centre:.1f})"
        parts.append(text(words, at, centre, anchor="middle", colour=INK, transform=rotation))
    return html(parts)


def _lines(axis: Axis, length: float) -> list[tuple[str, float]]:
    """Title of a vertical axis and where it stands; the unit has a second line beside a low drawing."""
    if not axis.unit or _LETTER * len(axis.text) <= length + _TOP:
        return [(axis.text, 14.0)]
    return [(axis.title, 11.0), (f"[{axis.unit}]", 25.0)]


def label(value: float) -> str:
    """A tick label, without floating-point noise in the last digits."""
    return plain(float(f"{value:.9g}"), 6, exact=True)


def margin(labels: Sequence[str]) -> float:
    """Width for the tick labels and the rotated title of an axis."""
    return 34.0 + _DIGIT * max(map(len, labels), default=1)


def text(
    words: str,
    x: float | str,
    y: float,
    *,
    anchor: str = "start",
    colour: str = SOFT,
    transform: str | None = None,
) -> Html:
    """Text in a drawing."""
    return tag("text", words, x=x, y=f"{y:.1f}", text_anchor=anchor, fill=colour, transform=transform)


def _legend(marks: Sequence[Mark], left: float) -> Html:
    """One row per label; marks with the same label share it. A long legend shows evenly chosen rows."""
    rows: dict[str, list[Mark]] = {}
    for mark in marks:
        rows.setdefault(mark.label, []).append(mark)
    names = list(rows)
    omitted = max(len(names) - _MOST_ENTRIES, 0)
    if omitted:
        names = [names[round(k * (len(names) - 1) / (_MOST_ENTRIES - 1))] for k in range(_MOST_ENTRIES)]
    parts: list[Html] = []
    for row, name in enumerate(names):
        y = _TOP + 8.0 + 19.0 * row
        for mark in rows[name]:
            if isinstance(mark, Band):
                parts.append(tag("rect", x=left, y=f"{y - 5:g}", width=20, height=10, fill=GRID))
            elif isinstance(mark, Dots):
                parts.append(_path(f"M{left + 10:g} {y:g}h0", mark))
            elif isinstance(mark, Rule):
                parts.append(_rule(mark, left + 10.0, y - 7.0, y + 7.0))
            else:
                parts.append(_path(f"M{left:g} {y:g}h20", mark))
        parts.append(text(name, left + 26.0, y + 4.0, colour=INK))
    if omitted:
        parts.append(text(f"and {omitted} more", left + 26.0, _TOP + 12.0 + 19.0 * len(names)))
    return html(parts)
