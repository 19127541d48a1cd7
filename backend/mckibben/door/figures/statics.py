"""Figures of curves, measurements and comparisons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.curves.curves import CurvesResult
from mckibben.door.figures.style import ACCENT, SECOND, add_line, add_points, blank, colours, name_axes
from mckibben.measurement.measurement import Measurement
from mckibben.report.figures import variable

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


def axis_title(channel: str) -> str:
    """Title of an axis with its unit: "Force (N)"."""
    name, scale = variable(channel)
    words = name[:1].upper() + name[1:]
    return f"{words} ({scale.unit})" if scale.unit else words


def curves_figure(result: CurvesResult, title: str) -> Figure:
    """Force over contraction, one curve per pressure."""
    figure = blank(title)
    order = np.argsort(np.argsort(result.pressure))
    shades = colours(len(result.pressure))
    for index, pressure in enumerate(result.pressure):
        add_line(
            figure, 100.0 * result.contraction, result.force[index], f"{pressure / 1e5:g} bar",
            colour=shades[int(order[index])],
        )  # fmt: skip
    name_axes(figure, axis_title("contraction"), [axis_title("force")])
    return figure


def comparison_figure(result: ComparisonResult, title: str) -> Figure:
    """Measured points and the model, and below them the residual; over time where the data have it."""
    series = [one for one in result.series if one.use == "fit"]
    channels = list(dict.fromkeys(one.channel for one in series))
    timed = result.kind == "transient" and all(one.time is not None for one in series)
    figure = blank(title, rows=2 * len(channels))
    titles = []
    for number, channel in enumerate(channels):
        own = [one for one in series if one.channel == channel]
        scale = variable(channel)[1]
        row = 2 * number + 1
        for one, colour in zip(own, colours(len(own)), strict=True):
            at = one.time if timed and one.time is not None else 100.0 * one.contraction
            if not timed and result.predicted == "diameter" and not np.any(np.isfinite(at)):
                at = one.x_pressure / 1e5
            shade = ACCENT if len(own) == 1 else colour
            order = np.arange(len(at)) if one.time is not None else np.argsort(at, kind="stable")
            add_points(
                figure, at, scale.all(one.measured), one.label, colour=shade, row=row, legend=not number
            )
            model = SECOND if len(own) == 1 else shade
            add_line(
                figure, at[order], np.array(scale.all(one.predicted))[order], f"{one.label}, model",
                colour=model, row=row, legend=len(own) == 1 and not number,
            )  # fmt: skip
            add_points(
                figure, at, scale.all(one.residual), one.label, colour=shade, row=row + 1, legend=False
            )
        titles += [axis_title(channel), f"Error ({scale.unit})" if scale.unit else "Error"]
    name_axes(figure, axis_title("time" if timed else "contraction"), titles)
    return figure


def measurement_figure(measurement: Measurement, title: str) -> Figure:
    """Every channel over time; without time, force (or the stroke) over the stroke or pressure."""
    columns = measurement.columns
    if "time" in columns:
        shown = [name for name in columns if name not in ("time", "group", "direction")]
        figure = blank(title, rows=len(shown))
        seconds = columns["time"]
        for row, name in enumerate(shown, 1):
            add_line(figure, seconds, variable(name)[1].all(columns[name]), name, row=row, legend=False)
        name_axes(figure, axis_title("time"), [axis_title(name) for name in shown])
        return figure
    channels = [name for name in columns if name not in ("group", "direction", "temperature")]
    y = next(
        (name for name in ("force", "diameter", "displacement", "length") if name in channels), channels[-1]
    )
    strokes = ("contraction", "displacement", "length", "pressure")
    x = next((name for name in strokes if name in channels and name != y), channels[0])
    figure = blank(title)
    groups = np.unique(columns["group"])
    for group, colour in zip(groups, colours(len(groups)), strict=True):
        rows = columns["group"] == group
        label = f"group {group}"
        if "pressure" in columns and x != "pressure":
            label = f"{np.mean(columns['pressure'][rows]) / 1e5:.3g} bar"
        add_points(
            figure, variable(x)[1].all(columns[x][rows]), variable(y)[1].all(columns[y][rows]), label,
            colour=colour,
        )  # fmt: skip
    name_axes(figure, axis_title(x), [axis_title(y)])
    return figure
