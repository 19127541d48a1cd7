"""The look of the studio's plots: colours of its light theme, fonts, axes with units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mckibben.report.chart import family

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

# The light theme of the page.
INK, SOFT, GRID, LINE = "#17212b", "#4d5b6a", "#e9edf1", "#c0c9d2"
ACCENT, SECOND, LOAD = "#1257b8", "#a3591a", "#b93815"
FONT = "Inter, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"


def colours(count: int) -> list[str]:
    """Colours of a family of curves, from light to dark."""
    return family(count)


def blank(title: str, *, rows: int = 1) -> Figure:
    """A figure without curves.

    Args:
        title: of the figure.
        rows: number of plots, one below the other, over the same x axis.
    """
    from plotly.graph_objects import Figure
    from plotly.subplots import make_subplots

    figure = (
        Figure() if rows == 1 else make_subplots(rows=rows, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    )
    figure.update_layout(
        template="none",
        title={"text": _plain(title), "x": 0.02, "font": {"size": 15}},
        font={"family": FONT, "size": 12, "color": INK},
        paper_bgcolor="#ffffff",
        plot_bgcolor="#ffffff",
        margin={"l": 62, "r": 20, "t": 48, "b": 48},
        width=800,
        height=480 if rows == 1 else 210 * rows + 90,
        legend={"font": {"size": 11}},
        hovermode="closest",
    )
    axis = {
        "gridcolor": GRID, "linecolor": LINE, "tickcolor": LINE, "ticks": "outside", "ticklen": 4,
        "showline": True, "zerolinecolor": LINE, "tickfont": {"color": SOFT}, "nticks": 7,
    }  # fmt: skip
    figure.update_xaxes(**axis)
    figure.update_yaxes(**axis)
    return figure


def name_axes(figure: Figure, x: str, y: Sequence[str]) -> None:
    """Titles of the axes, each with its unit; the x axis is that of the lowest plot."""
    font = {"size": 12, "color": SOFT}
    for row, title in enumerate(y, 1):
        place: dict[str, Any] = {} if len(y) == 1 else {"row": row, "col": 1}
        figure.update_yaxes(title={"text": title, "font": font, "standoff": 8}, **place)
    last: dict[str, Any] = {} if len(y) == 1 else {"row": len(y), "col": 1}
    figure.update_xaxes(title={"text": x, "font": font, "standoff": 8}, **last)


def add_line(
    figure: Figure, x: ArrayLike, y: ArrayLike, name: str, *, colour: str = ACCENT, dash: str | None = None,
    row: int = 1, legend: bool = True,
) -> None:  # fmt: skip
    """Add a curve to a plot of the figure."""
    from plotly.graph_objects import Scatter

    line = {"width": 2, "color": colour, "dash": dash}
    trace = Scatter(
        x=np.asarray(x), y=np.asarray(y), mode="lines", line=line, name=_plain(name), showlegend=legend
    )
    _add(figure, trace, row)


def add_points(
    figure: Figure, x: ArrayLike, y: ArrayLike, name: str, *, colour: str = ACCENT, row: int = 1,
    legend: bool = True,
) -> None:  # fmt: skip
    """Add points to a plot of the figure."""
    from plotly.graph_objects import Scatter

    marker = {"size": 5, "color": colour, "line": {"width": 1.4, "color": colour}}
    trace = Scatter(
        x=np.asarray(x), y=np.asarray(y), mode="markers", marker=marker, name=_plain(name), showlegend=legend
    )
    _add(figure, trace, row)


def _add(figure: Figure, trace: Any, row: int) -> None:
    if row == 1 and not figure._has_subplots():
        figure.add_trace(trace)
    else:
        figure.add_trace(trace, row=row, col=1)


def _plain(text: str) -> str:
    """A text in which Plotly finds no markup."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
