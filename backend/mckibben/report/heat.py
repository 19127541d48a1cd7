"""Heat map with numbers in its cells, as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mckibben.report.chart import label, margin, text
from mckibben.report.html import Html, tag
from mckibben.report.marks import EDGE, INK, SOFT, Axis

_LOW, _ZERO, _HIGH = (33, 102, 172), (247, 247, 247), (178, 24, 43)
_TOP, _BOTTOM = 8.0, 44.0
_CELL, _LOW_CELL, _MANY = 23.0, 16.5, 7  # height of a row, and from how many rows on it is lower
_DARK = 0.55  # share of the scale above which numbers are white
_LINEAR, _NONE = 2.0, 0.75  # standard deviations: end of the linear part; a smaller mean is none

Values = Sequence[Sequence[float]]


@dataclass(frozen=True)
class Shade:
    """From a value to its colour.

    Attributes:
        most: value of the full colour.
        sigma: of one reading: colours are linear up to twice it and logarithmic beyond, and a mean below
            three quarters of it is drawn as a dot. None: linear, every value is written.
    """

    most: float
    sigma: float | None = None

    def share(self, value: float) -> float:
        """Place on the scale, -1 to 1."""
        if self.sigma is None:
            return value / self.most
        linear = _LINEAR * self.sigma
        return math.asinh(value / linear) / math.asinh(self.most / linear)

    def is_quiet(self, value: float) -> bool:
        """Whether the value is none beside the noise."""
        return self.sigma is not None and abs(value) < _NONE * self.sigma


def heat(
    x: Axis, y: Axis, x_edges: Sequence[float], y_edges: Sequence[float] | Sequence[str], values: Values, *,
    title: str, shade: Shade | None = None, width: float = 720.0,
) -> Html:  # fmt: skip
    """The drawing: blue below zero, red above; cells without a value stay empty.

    Args:
        x, y: the axes, in the units of the edges.
        x_edges: limits of the columns, one more than there are.
        y_edges: limits of the rows, one more than there are; or a name for each row.
        values: shape (y cells, x cells), lowest y first; NaN for an empty cell.
        title: description for screen readers.
        shade: the colours; None for a linear scale up to the largest value.
        width: of the drawing; the page scales it to its own width.
    """
    rows, columns = len(values), len(x_edges) - 1
    high = _CELL if rows < _MANY else _LOW_CELL
    limits = [edge for edge in y_edges if not isinstance(edge, str)]
    names = [name for name in y_edges if isinstance(name, str)] or [_edge(edge, limits) for edge in limits]
    begin = margin(names)
    wide, bottom = (width - begin - 24.0) / columns, _TOP + high * rows
    largest = max((abs(v) for row in values for v in row if not math.isnan(v)), default=0.0) or 1.0
    colours = shade or Shade(largest)
    parts: list[Html] = []
    for j, row in enumerate(values):
        for i, value in enumerate(row):
            left, top = begin + wide * i, bottom - high * (j + 1)
            quiet = colours.is_quiet(value)
            share = None if math.isnan(value) else 0.0 if quiet else colours.share(value)
            parts.append(
                tag(
                    "rect", x=f"{left:.1f}", y=f"{top:.1f}", width=f"{wide:.1f}", height=f"{high:g}",
                    fill="#fff" if share is None else _colour(share), stroke="#fff",
                )
            )  # fmt: skip
            if share is not None:
                ink = "#fff" if abs(share) > _DARK else INK
                shown = "·" if quiet else _number(value, largest)
                parts.append(
                    text(
                        shown, f"{left + 0.5 * wide:.1f}", top + 0.5 * high + 4.0, anchor="middle", colour=ink
                    )
                )
    for i, edge in enumerate(x_edges):
        parts.append(text(_edge(edge, x_edges), f"{begin + wide * i:.1f}", bottom + 16.0, anchor="middle"))
    up = 4.0 if limits else 4.0 - 0.5 * high  # a limit stands at its line, a name in the middle of its row
    for j, name in enumerate(names):
        parts.append(text(name, begin - 7.0, bottom - high * j + up, anchor="end"))
    frame = f"M{begin:g} {_TOP:g}V{bottom:g}H{begin + wide * columns:.1f}"
    parts.append(tag("path", d=frame, stroke=EDGE, fill="none"))
    middle, centre = begin + 0.5 * wide * columns, 0.5 * (_TOP + bottom)
    parts.append(text(x.text, f"{middle:.1f}", bottom + 36.0, anchor="middle", colour=INK))
    rotation = f"rotate(-90 14 {centre:.1f})"
    parts.append(text(y.text, 14.0, centre, anchor="middle", colour=INK, transform=rotation))
    return tag(
        "svg",
        tag("title", title),
        *parts,
        viewBox=f"0 0 {width:g} {bottom + _BOTTOM:g}",
        role="img",
        fill=SOFT,
        xmlns="http://www.w3.org/2000/svg",
    )


def _number(value: float, largest: float) -> str:
    """The number in a cell: all have the decimals that two digits of the largest one need."""
    decimals = max(1 - math.floor(math.log10(largest)), 0)
    shown = f"{value:.{decimals}f}"
    return shown.lstrip("-") if float(shown) == 0.0 else shown.replace("-", "\N{MINUS SIGN}")


def _colour(share: float) -> str:
    end, size = _LOW if share < 0.0 else _HIGH, min(abs(share), 1.0)
    mixed = [round(a + (b - a) * size) for a, b in zip(_ZERO, end, strict=True)]
    return f"rgb({mixed[0]},{mixed[1]},{mixed[2]})"


def _edge(value: float, edges: Sequence[float]) -> str:
    """Label of an edge with enough digits to distinguish neighbours."""
    step = (edges[-1] - edges[0]) / max(len(edges) - 1, 1) or 1.0
    return label(round(value, max(1 - math.floor(math.log10(step)), 0)))
