"""Bars in the cells of a table, as SVG: errors, margins. Those of a column share one scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mckibben.report.html import Html, tag
from mckibben.report.marks import ACCENT, EDGE, INK, SECOND

_WIDE, _HIGH = 240.0, 15.0
_INSET = 2.0  # at both ends, so that no tick is cut in half


@dataclass(frozen=True)
class Bar:
    """A bar.

    Attributes:
        title: description for screen readers.
        value: length of the bar, not negative, in units of the column.
        tick: second value, marked by a black tick; None without one.
        pale: drawn pale, as a proposal.
        strong: highlighted, as the most important bar.
    """

    title: str
    value: float
    tick: float | None = None
    pale: bool = False
    strong: bool = False


def bars(rows: Sequence[Bar], *, level: float | None = None) -> list[Html]:
    """One drawing for each row; a table gives them the width of their column.

    Args:
        rows: from the top.
        level: value marked in every row by a vertical line.
    """
    longest = max(
        [*(max(row.value, row.tick or 0.0) for row in rows), 0.0 if level is None else level, 1e-300]
    )
    return [_bar(row, longest, level) for row in rows]


def _bar(row: Bar, longest: float, level: float | None) -> Html:
    def at(value: float) -> float:
        return _INSET + value / longest * (_WIDE - 2.0 * _INSET)

    def upright(value: float, colour: str, width: float, dash: str | None = None) -> Html:
        x = f"{at(value):.1f}"
        return tag(
            "line", x1=x, x2=x, y1=0, y2=_HIGH, stroke=colour, stroke_width=width, stroke_dasharray=dash
        )

    colour = "#a9c5ea" if row.pale else SECOND if row.strong else ACCENT
    length = max(at(row.value) - _INSET, 1.0)
    return tag(
        "svg",
        tag("title", row.title),
        upright(0.0, EDGE, 1.0),
        tag("rect", x=_INSET, y=2.5, width=f"{length:.1f}", height=_HIGH - 5.0, fill=colour),
        None if level is None else upright(level, SECOND, 1.5, "4 2"),
        None if row.tick is None else upright(row.tick, INK, 2.0),
        viewBox=f"0 0 {_WIDE:g} {_HIGH:g}",
        role="img",
        xmlns="http://www.w3.org/2000/svg",
    )
