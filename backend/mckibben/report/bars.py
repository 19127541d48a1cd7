"""Horizontal bar chart as SVG: the error after each step, shares, margins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mckibben.report.chart import label, text, ticks
from mckibben.report.html import Html, tag
from mckibben.report.marks import ACCENT, EDGE, GRID, INK, SECOND, SOFT

_ROW, _TOP, _BOTTOM, _RIGHT = 27.0, 20.0, 42.0, 86.0
_LETTER = 6.3  # mean width of a letter


@dataclass(frozen=True)
class Bar:
    """A bar.

    Attributes:
        name: label at the left.
        value: length of the bar, in units of the axis.
        shown: text at its end.
        tick: second value, marked by a black tick; None without one.
        pale: drawn pale, as a proposal.
        strong: highlighted, as the most important bar.
    """

    name: str
    value: float
    shown: str
    tick: float | None = None
    pale: bool = False
    strong: bool = False


def bars(
    rows: Sequence[Bar],
    *,
    axis: str,
    title: str,
    level: tuple[float, str] | None = None,
    width: float = 720.0,
) -> Html:
    """The drawing.

    Args:
        rows: from the top; values must not be negative.
        axis: label of the axis, with unit.
        title: description for screen readers.
        level: value marked by a vertical line, and its label.
        width: of the drawing; the page scales it to its own width.
    """
    left = min(max((len(row.name) for row in rows), default=0) * _LETTER + 14.0, 0.45 * width)
    longest = max([*(max(row.value, row.tick or 0.0) for row in rows), level[0] if level else 0.0, 1e-300])
    bottom = _TOP + _ROW * len(rows)

    def at(value: float) -> float:
        return left + value / longest * (width - _RIGHT - left)

    parts: list[Html] = []
    for value in ticks(0.0, longest):
        x = f"{at(value):.1f}"
        parts.append(tag("line", x1=x, x2=x, y1=_TOP, y2=f"{bottom:g}", stroke=GRID))
        parts.append(text(label(value), x, bottom + 16.0, anchor="middle"))
    for number, row in enumerate(rows):
        y = _TOP + _ROW * number
        length = max(at(row.value) - left, 1.0)
        parts.append(
            tag(
                "rect", x=f"{left:.1f}", y=f"{y + 5:g}", width=f"{length:.1f}", height=f"{_ROW - 10:g}",
                fill="#a9c5ea" if row.pale else SECOND if row.strong else ACCENT,
            )
        )  # fmt: skip
        colour = SECOND if row.strong else INK
        parts.append(text(row.name, left - 8.0, y + 17.5, anchor="end", colour=colour))
        furthest = row.value
        if row.tick is not None:
            furthest = max(furthest, row.tick)
            x = f"{at(row.tick):.1f}"
            parts.append(
                tag("line", x1=x, x2=x, y1=f"{y + 2:g}", y2=f"{y + _ROW - 2:g}", stroke=INK, stroke_width=2)
            )
        parts.append(text(row.shown, at(furthest) + 7.0, y + 17.5, colour=colour))
    parts.append(tag("line", x1=f"{left:.1f}", x2=f"{left:.1f}", y1=_TOP, y2=f"{bottom:g}", stroke=EDGE))
    if level is not None:
        x = f"{at(level[0]):.1f}"
        parts.append(
            tag(
                "line", x1=x, x2=x, y1=f"{_TOP - 4:g}", y2=f"{bottom:g}", stroke=SECOND,
                stroke_dasharray="5 3", stroke_width=1.5,
            )
        )  # fmt: skip
        parts.append(text(level[1], x, _TOP - 8.0, colour=SECOND))
    parts.append(text(axis, 0.5 * (left + width - _RIGHT), bottom + 34.0, anchor="middle", colour=SOFT))
    return tag(
        "svg",
        tag("title", title),
        *parts,
        viewBox=f"0 0 {width:g} {bottom + _BOTTOM:g}",
        role="img",
        xmlns="http://www.w3.org/2000/svg",
    )
