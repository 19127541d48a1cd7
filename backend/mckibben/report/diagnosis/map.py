"""The map of the residual: measured levels where the file has them, else equal ranges."""

from __future__ import annotations

import math

from mckibben.application.compare.compare import ComparisonResult
from mckibben.facts.comparison import RESIDUAL, TIMES_NOISE, error_scale
from mckibben.report.diagnosis.levels import LevelMap, level_map
from mckibben.report.document import figure_of
from mckibben.report.figures import Scale, plain, variable
from mckibben.report.heat import Shade, heat
from mckibben.report.html import Html
from mckibben.report.marks import Axis

_MEAN = RESIDUAL["mean"].label

_STEPS = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)  # ends of the scale, as on the page
_LINEAR = 2.0  # standard deviations
_ROUNDING = 1e-9


def residual_map(answer: ComparisonResult, first: ComparisonResult) -> Html | None:
    """The drawing with its caption; ``first``: the first model of the case, which fixes the colours."""
    scale = error_scale(answer.unit)
    levels = level_map(answer.series, answer.noise_floor)
    return _of_ranges(answer, scale) if levels is None else _of_levels(answer, first, levels, scale)


def _of_levels(answer: ComparisonResult, first: ComparisonResult, levels: LevelMap, scale: Scale) -> Html:
    across, x_scale = variable(levels.x)
    _, y_scale = variable("pressure")
    names, values = [], []
    for row in levels.rows:
        level = plain(y_scale.of(row.level), 3, exact=True)
        if levels.split:
            names += [f"{level} □", f"{level} ●"]
            values += [scale.all(row.shortening), scale.all(row.lengthening)]
        else:
            names.append(level)
            values.append(scale.all(row.mean))
    sigma = None if first.noise_floor is None else scale.of(first.noise_floor)
    begun = level_map(first.series, first.noise_floor) or levels
    most = _rounded_up(max(scale.of(begun.largest), _LINEAR * (sigma or 0.0), 1e-12))
    drawing = heat(
        Axis(across.capitalize(), x_scale.unit), Axis("Pressure", y_scale.unit),
        x_scale.all(levels.x_edges), names, values,
        title=f"{_MEAN} over {across} at each pressure level", shade=Shade(most, sigma),
    )  # fmt: skip
    ways = "; ● lengthening, □ shortening" if levels.split else ""
    dots = "" if sigma is None else ", a dot: none beside the noise"
    return figure_of(
        drawing,
        f"{_MEAN} in {scale.unit} at each measured level{ways}; red: measured above modelled{dots}. "
        f"Full colour at {plain(most, 3, exact=True)} {scale.unit}, fixed by the first model.",
    )


def _of_ranges(answer: ComparisonResult, scale: Scale) -> Html | None:
    heat_map = answer.heat_map
    if heat_map is None:
        return None
    (across, x_scale), (up, y_scale) = variable(heat_map.x), variable(heat_map.y)
    drawing = heat(
        Axis(across.capitalize(), x_scale.unit), Axis(up.capitalize(), y_scale.unit),
        x_scale.all(heat_map.x_edges), y_scale.all(heat_map.y_edges),
        [scale.all(row) for row in heat_map.mean],
        title=f"{_MEAN} over {across} and {up}",
    )  # fmt: skip
    unit = f" in {scale.unit}" if scale.unit else ""
    if scale == TIMES_NOISE:
        unit = " as a multiple of the noise"
    return figure_of(drawing, f"{_MEAN}{unit} over {across} and {up}; red: measured above modelled.")


def _rounded_up(value: float) -> float:
    """To the next round number."""
    power = 10.0 ** math.floor(math.log10(value))
    return (
        next(step for step in _STEPS if step * power >= value * (1.0 - _ROUNDING) or step == _STEPS[-1])
        * power
    )
