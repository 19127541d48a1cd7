"""Drawings above each other that share an x axis, for several quantities over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mckibben.report.chart import chart
from mckibben.report.html import Html, html
from mckibben.report.marks import Axis, Mark

_FOOT = 36.0  # height of the numbers and title of the x axis


@dataclass(frozen=True)
class Panel:
    """One of the drawings."""

    axis: Axis
    marks: Sequence[Mark]
    title: str


def stack(
    x: Axis, panels: Sequence[Panel], *, height: float = 84.0, left: float = 84.0, room: float = 150.0
) -> Html:
    """The drawings, with numbers on the x axis of the lowest one.

    Args:
        x: the common axis; its ``ends`` must be given.
        panels: from the top.
        height: of each.
        left: where the axes begin.
        room: width of the legends.
    """
    parts: list[Html] = []
    for number, panel in enumerate(panels):
        last = number == len(panels) - 1
        parts.append(
            chart(
                replace(x, bare=not last),
                panel.axis,
                panel.marks,
                title=panel.title,
                height=height + (_FOOT if last else 0.0),
                left=left,
                legend=True,
                room=room,
            )
        )
    return html(parts)
