"""The map of the residual: measured levels where the file has them, else equal ranges."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.residual_map import MapRow, ResidualMap
from mckibben.facts.comparison import RESIDUAL, TIMES_NOISE, error_scale
from mckibben.report.document import figure_of
from mckibben.report.figures import Scale, plain, variable
from mckibben.report.heat import Shade, heat
from mckibben.report.html import Html
from mckibben.report.marks import Axis

_MEAN = RESIDUAL["mean"].label

_STEPS = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)  # ends of the scale, as on the page
_LINEAR = 2.0  # standard deviations
_ROUNDING = 1e-9


def residual_drawing(answer: ComparisonResult, first: ComparisonResult) -> Html | None:
    """The drawing with its caption; ``first``: the first model of the case, which fixes the colours."""
    chart = answer.heat_map
    if chart is None or any(row.channel is not None for row in chart.rows):
        return None
    scale = TIMES_NOISE if chart.scaled else error_scale(answer.unit)
    rows = chart.rows[::-1]
    if rows[0].level is not None:
        return _of_levels(chart, rows, first, scale)
    (across, x_scale), (up, y_scale) = variable(chart.x), variable(chart.y)
    drawing = heat(
        Axis(across.capitalize(), x_scale.unit), Axis(up.capitalize(), y_scale.unit),
        x_scale.all(chart.edges), y_scale.all([rows[0].low, *(row.high for row in rows)]),
        [_values(row, "mean", scale) for row in rows],
        title=f"{_MEAN} over {across} and {up}",
    )  # fmt: skip
    unit = f" in {scale.unit}" if scale.unit else ""
    if scale == TIMES_NOISE:
        unit = " as a multiple of the noise"
    return figure_of(drawing, f"{_MEAN}{unit} over {across} and {up}; red: measured above modelled.")


def _values(row: MapRow, name: str, scale: Scale) -> list[float]:
    return scale.all([None if cell is None else getattr(cell, name) for cell in row.cells])


def _of_levels(chart: ResidualMap, rows: Sequence[MapRow], first: ComparisonResult, scale: Scale) -> Html:
    across, x_scale = variable(chart.x)
    _, y_scale = variable(chart.y)
    names, values = [], []
    for row in rows:
        level = plain(y_scale.of(row.level or 0.0), 3, exact=True)
        if chart.split:
            names += [f"{level} □", f"{level} ●"]
            values += [_values(row, "shortening", scale), _values(row, "lengthening", scale)]
        else:
            names.append(level)
            values.append(_values(row, "mean", scale))
    sigma = None if first.noise_floor is None else scale.of(first.noise_floor)
    begun = first.heat_map or chart
    most = _rounded_up(max(scale.of(begun.largest), _LINEAR * (sigma or 0.0), 1e-12))
    drawing = heat(
        Axis(across.capitalize(), x_scale.unit), Axis("Pressure", y_scale.unit),
        x_scale.all(chart.edges), names, values,
        title=f"{_MEAN} over {across} at each pressure level", shade=Shade(most, sigma),
    )  # fmt: skip
    ways = "; ● lengthening, □ shortening" if chart.split else ""
    dots = "" if sigma is None else ", a dot: none beside the noise"
    return figure_of(
        drawing,
        f"{_MEAN} in {scale.unit} at each measured level{ways}; red: measured above modelled{dots}. "
        f"Full colour at {plain(most, 3, exact=True)} {scale.unit}, fixed by the first model.",
    )


def _rounded_up(value: float) -> float:
    """To the next round number."""
    power = 10.0 ** math.floor(math.log10(value))
    return (
        next(step for step in _STEPS if step * power >= value * (1.0 - _ROUNDING) or step == _STEPS[-1])
        * power
    )
