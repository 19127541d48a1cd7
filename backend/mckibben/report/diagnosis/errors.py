"""How large the error of a model is, and where it occurs: as table, sentences and map.

The map of the residual has the measured pressure levels where the file has them, else equal ranges, over
parts of the contraction, as that of the page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.residual_map import MapRow, ResidualMap
from mckibben.facts.comparison import CHECK, COMPARISON, RESIDUAL, TIMES_NOISE, WINDOWS, error_scale
from mckibben.facts.figure import Figure
from mckibben.report.document import Head, bullets, figure_of, paragraph, table
from mckibben.report.figures import Scale, figure, percent, plain, variable
from mckibben.report.heat import Shade, heat
from mckibben.report.html import Child, Html, html
from mckibben.report.marks import Axis

_MOST_SENTENCES, _LEAST_SHARE = 3, 0.05  # variables named in sentences: how many, from which share on
_ROUNDING = 1e-7  # share of the error below which a mean is rounding

_MEAN = RESIDUAL["mean"].label

_STEPS = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)  # ends of the scale, as on the page
_LINEAR = 2.0  # standard deviations
_STEP_ROUNDING = 1e-9


def error_table(columns: Sequence[tuple[str, ComparisonResult]]) -> Html:
    """Error figures of one or more comparisons side by side."""
    first = columns[0][1]
    unit = error_scale(first.unit)
    answers = [answer for _, answer in columns]

    def row(each: Figure, values: Iterable[float | None], scale: Scale, of: str = "") -> list[Child]:
        return [
            f"{each.label}{of}",
            *(figure(value, each.scale if each.unit else scale, 3) for value in values),
        ]

    def of_all(name: str, of: str = "") -> list[Child]:
        return row(COMPARISON[name], [getattr(answer, name) for answer in answers], unit, of)

    rows = [of_all("rmse_beyond_accuracy"), of_all("rmse"), of_all("nrmse_percent")]
    if any(answer.stroke_percent is not None for answer in answers):
        rows.append(of_all("stroke_percent"))
    rows += [
        of_all("holdout_rmse"),
        row(COMPARISON["residual_mean"], [_mean(answer) for answer in answers], unit),
        of_all("noise_floor", f" ({first.noise_how})"),
        of_all("over_noise"),
        of_all("fit_percent"),
        [COMPARISON["rows_used"].label, *(_rows(answer) for answer in answers)],
        ["Verdict", *("–" if answer.verdict is None else answer.verdict.title for answer in answers)],
    ]
    for name in first.channels:
        words, scale = variable(name)
        for each in (COMPARISON["rmse"], COMPARISON["stroke_percent"], COMPARISON["noise_floor"]):
            values = [getattr(answer.channels[name], each.name) for answer in answers]
            if any(value is not None for value in values):
                rows.append(row(each, values, scale, f", {words}"))
    windows = [answer.windows for answer in answers]
    if any(windows):
        rows += [
            row(WINDOWS[name], [None if each is None else getattr(each, name) for each in windows], unit)
            for name in ("rmse", "perfect", "length")
        ]
    checks = [answer.validation for answer in answers]
    if any(checks):
        rows += [
            row(
                each,
                [None if check is None else getattr(check, each.name) for check in checks],
                unit,
            )
            for each in (CHECK["rmse"], CHECK["nrmse_percent"])
        ]
    names = [Head("", False), *(Head(name, number=True) for name, _ in columns)]
    parts: list[Child] = [table(names, rows, caption=f"Error of the predicted {words_of(first.predicted)}.")]
    if first.windows is not None:
        parts.append(paragraph(f"{first.windows.sentence}.", note=True))
    if first.rows_used < first.rows:
        reasons = "; ".join(f"{number} {reason}" for reason, number in first.excluded.items())
        parts.append(paragraph(f"Rows left out: {reasons}.", note=True))
    return html(parts)


def _mean(answer: ComparisonResult) -> float | None:
    """Mean of the residual; 0 where only the rounding of the computer keeps it from being 0."""
    mean = answer.residual_mean
    return 0.0 if mean is not None and abs(mean) < _ROUNDING * answer.rmse else mean


def _rows(answer: ComparisonResult) -> str:
    used, rows = answer.rows_used, answer.rows
    return str(rows) if used == rows else f"{used} of {rows}"


def words_of(predicted: str) -> str:
    """The predicted channels in words."""
    return " and ".join(variable(name.strip())[0] for name in predicted.split(","))


def where_it_fails(answer: ComparisonResult, first: ComparisonResult) -> Html:
    """The residual over each variable: sentences, a table, and a map over two variables.

    Args:
        answer: the comparison.
        first: the first model of the case, which fixes the colours of the map.
    """
    scale = error_scale(answer.unit)
    rows = [
        [
            variable(profile.over)[0],
            percent(profile.share_explained),
            profile.worst,
            figure(profile.rmse, scale, 3),
        ]
        for profile in answer.where
    ]
    columns = [
        Head("Variable"), Head(RESIDUAL["share_explained"].label, number=True),
        Head("Worst range"), Head(RESIDUAL["rmse"].label, number=True),
    ]  # fmt: skip
    words: list[Child] = [
        html(
            f"{profile.worst}: ", figure(profile.rmse, scale, 3), " rms; this variable alone predicts ",
            percent(profile.share_explained), " of the squared error.",
        )
        for profile in answer.where[:_MOST_SENTENCES]
        if profile.share_explained > _LEAST_SHARE
    ]  # fmt: skip
    parts: list[Child] = [bullets([*words, f"{answer.sentences[-1].removesuffix('.')}."])]
    drawn = residual_drawing(answer, first)
    if drawn is not None:
        parts.append(drawn)
    if rows:  # below the map: a table may continue on the next page, a map may not
        parts.append(table(columns, rows))
    mean = answer.mean_loop
    if mean is not None:
        parts.append(
            paragraph(
                RESIDUAL["area"].label, " of the residual, mean of ", str(len(answer.loops)), ": ",
                figure(mean.area, RESIDUAL["area"].scale, 3), ", ", RESIDUAL["friction"].words, " ",
                figure(mean.friction, RESIDUAL["friction"].scale, 3),
                ". Positive: the muscle dissipates more than the model.",
            )
        )  # fmt: skip
    return html(parts)


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
        next(step for step in _STEPS if step * power >= value * (1.0 - _STEP_ROUNDING) or step == _STEPS[-1])
        * power
    )
