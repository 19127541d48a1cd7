"""Figure of a study: Pareto front, influences, or a histogram with percentiles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.study.study import StudyResult
from mckibben.door.figures.style import ACCENT, SECOND, SOFT, add_points, blank, name_axes

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

_BINS = 40


def study_figure(result: StudyResult, title: str) -> Figure:
    """What the method asks for: Pareto front, influences, or the distribution of the first figure."""
    if any(item.influences for item in result.sensitivity):
        return _influences(result, title)
    if len(result.front) > 1:
        return _front(result, title)
    return _histogram(result, title)


def _label(result: StudyResult, name: str) -> str:
    unit = next(column.unit for column in result.columns if column.name == name)
    return f"{name} ({unit})" if unit else name


def _front(result: StudyResult, title: str) -> Figure:
    """All runs over the two first figures, those of the front marked."""
    x, y = [column.name for column in result.columns if column.kind == "figure"][-2:]
    if len(result.goals) > 1:
        x, y = result.goals[:2]
    columns = [np.array(result.table[name], float) for name in (x, y)]
    on = np.isin(np.array(result.table["run"]), result.front)
    figure = blank(title)
    add_points(figure, columns[0][~on], columns[1][~on], "runs", colour=SOFT)
    add_points(figure, columns[0][on], columns[1][on], "Pareto front", colour=ACCENT)
    name_axes(figure, _label(result, x), [_label(result, y)])
    return figure


def _influences(result: StudyResult, title: str) -> Figure:
    """Bars of the first figure with influences, the largest on top."""
    from plotly.graph_objects import Bar

    item = next(item for item in result.sensitivity if item.influences)
    sobol = item.influences[0].total is not None
    names = (
        ("total", "total_error", "with interactions")
        if sobol
        else ("mean_size", "mean_size_error", "mean size")
    )
    shown = sorted(item.influences, key=lambda one: getattr(one, names[0]))
    figure = blank(f"{title}: {item.figure}")
    parts = [(*names, ACCENT), ("first", "first_error", "alone", SECOND)] if sobol else [(*names, ACCENT)]
    for value, error, name, colour in parts:
        figure.add_trace(
            Bar(
                x=[getattr(one, value) for one in shown],
                y=[one.quantity for one in shown],
                error_x={"array": [getattr(one, error) for one in shown], "color": SOFT},
                orientation="h",
                name=name,
                marker_color=colour,
            )
        )
    name_axes(figure, "Share of the variance" if sobol else "Elementary effect", [""])
    figure.update_yaxes(automargin=True)
    return figure


def _histogram(result: StudyResult, title: str) -> Figure:
    """The distribution of the first figure that varies, with its percentiles."""
    from plotly.graph_objects import Histogram

    known = [item for item in result.summary if item.count]
    figure = blank(title)
    if not known:
        return figure
    item = next((one for one in known if one.least != one.most), known[0])
    values = [
        value
        for value, outcome in zip(result.table[item.figure], result.table["outcome"], strict=True)
        if value is not None and outcome == "completed"
    ]
    figure.add_trace(Histogram(x=values, nbinsx=_BINS, name=item.figure, marker_color=ACCENT))
    for percent in ("5", "50", "95"):
        figure.add_vline(
            x=item.percentiles[percent].value, line={"color": SECOND, "dash": "dash"},
            annotation_text=f"{percent} %", annotation_font_color=SECOND,
        )  # fmt: skip
    name_axes(figure, _label(result, item.figure), ["Runs"])
    return figure
