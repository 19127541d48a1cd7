"""Figure of a study: Pareto front, influences, or a histogram with percentiles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.study.study import StudyResult
from mckibben.door.figures.style import ACCENT, SECOND, SOFT, add_points, blank, name_axes
from mckibben.facts.sizing import SIZING
from mckibben.facts.study import INFLUENCE, WATCHED
from mckibben.facts.units import Scale

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
    """A figure with its unit; a quantity by its path, in SI."""
    if name in WATCHED:
        label, unit = WATCHED[name].label, WATCHED[name].scale.unit
    else:
        label, unit = name, next(column.unit for column in result.columns if column.name == name) or ""
    return f"{label} ({unit})" if unit not in ("", "1") else label


def _values(result: StudyResult, name: str) -> list[float]:
    """A column in the unit of its label; NaN where a run lacks it."""
    values = [None if value is None else float(value) for value in result.table[name]]
    return WATCHED[name].scale.all(values) if name in WATCHED else Scale("").all(values)


def _front(result: StudyResult, title: str) -> Figure:
    """All runs over the two first figures, those of the front marked."""
    x, y = [column.name for column in result.columns if column.kind == "figure"][-2:]
    if len(result.goals) > 1:
        x, y = result.goals[:2]
    columns = [np.array(_values(result, name)) for name in (x, y)]
    on = np.isin(np.array(result.table["run"]), result.front)
    figure = blank(title)
    add_points(figure, columns[0][~on], columns[1][~on], "runs", colour=SOFT)
    add_points(figure, columns[0][on], columns[1][on], SIZING["front"].label, colour=ACCENT)
    name_axes(figure, _label(result, x), [_label(result, y)])
    return figure


def _influences(result: StudyResult, title: str) -> Figure:
    """Bars of the first figure with influences, the largest on top."""
    from plotly.graph_objects import Bar

    item = next(item for item in result.sensitivity if item.influences)
    sobol = item.influences[0].total is not None
    parts = [("total", ACCENT), ("first", SECOND)] if sobol else [("mean_size", ACCENT)]
    shown = sorted(item.influences, key=lambda one: getattr(one, parts[0][0]))
    figure = blank(f"{title}: {WATCHED[item.figure].label}")
    scale = INFLUENCE["total"].scale if sobol else WATCHED[item.figure].scale._replace(offset=0.0)
    for value, colour in parts:
        figure.add_trace(
            Bar(
                x=scale.all(getattr(one, value) for one in shown),
                y=[one.quantity for one in shown],
                error_x={"array": scale.all(getattr(one, f"{value}_error") for one in shown), "color": SOFT},
                orientation="h",
                name=INFLUENCE[value].words,
                marker_color=colour,
            )
        )
    effect = f"{INFLUENCE['mean_size'].label} ({scale.unit})"
    name_axes(figure, "Share of the variance" if sobol else effect, [""])
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
        for value, outcome in zip(_values(result, item.figure), result.table["outcome"], strict=True)
        if value == value and outcome == "completed"
    ]
    figure.add_trace(Histogram(x=values, nbinsx=_BINS, name=WATCHED[item.figure].label, marker_color=ACCENT))
    scale = WATCHED[item.figure].scale
    for percent in ("5", "50", "95"):
        figure.add_vline(
            x=scale.of(item.percentiles[percent].value), line={"color": SECOND, "dash": "dash"},
            annotation_text=f"{percent} %", annotation_font_color=SECOND,
        )  # fmt: skip
    name_axes(figure, _label(result, item.figure), ["Runs"])
    return figure
