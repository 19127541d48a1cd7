"""How large the error of a model is, and where it occurs: as table, sentences and map.

The map of the residual has the measured pressure levels where the file has them, else equal ranges, over
parts of the contraction, as that of the page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.series import Array, ComparedSeries
from mckibben.facts.comparison import CHECK, COMPARISON, RESIDUAL, TIMES_NOISE, error_scale
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

_COLUMNS = 8
_MOST_LEVELS = 14
_SAME_LEVEL = 0.01  # of the largest level; closer ones are one level
_CONSTANT = 1e-9  # share of its size by which a variable that varies changes
_BEYOND_CHANCE = 3.0  # standard deviations of a chi-squared sum from which the directions disagree
_WORTH = 0.5  # mean difference of the directions over the noise, below which it is not worth two rows


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
        [
            RESIDUAL["white"].label,
            *("yes" if answer.whiteness.white else "no, it has structure" for answer in answers),
        ],
    ]
    for name in first.channels:
        words, scale = variable(name)
        for each in (COMPARISON["rmse"], COMPARISON["stroke_percent"], COMPARISON["noise_floor"]):
            values = [getattr(answer.channels[name], each.name) for answer in answers]
            if any(value is not None for value in values):
                rows.append(row(each, values, scale, f", {words}"))
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
    parts: list[Child] = [bullets([*words, f"{answer.sentences[-1]}."])]
    drawn = residual_map(answer, first)
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
        next(step for step in _STEPS if step * power >= value * (1.0 - _STEP_ROUNDING) or step == _STEPS[-1])
        * power
    )


@dataclass(frozen=True)
class LevelRow:
    """Mean residual of one level, shape (columns,), NaN without rows.

    Attributes:
        level: pressure.
        mean, lengthening, shortening: of all rows, and of each direction of motion.
    """

    level: float
    mean: Array
    lengthening: Array
    shortening: Array


@dataclass(frozen=True)
class LevelMap:
    """Levels, the lowest first; SI.

    Attributes:
        x: name of the variable of the columns.
        x_edges: of the columns, one more than there are.
        rows: of the levels.
        split: the directions disagree by more than chance: a mean over both would hide friction.
    """

    x: str
    x_edges: Array
    rows: Sequence[LevelRow]
    split: bool

    @property
    def largest(self) -> float:
        """The largest mean of a cell or of one of its directions."""
        cells = [(row.mean, row.lengthening, row.shortening) for row in self.rows]
        return float(np.nanmax(np.abs(cells)))


@dataclass(frozen=True)
class _Tally:
    """Sums of one direction of a level, shape (columns,)."""

    count: Array
    total: Array
    squares: Array

    @property
    def mean(self) -> Array:
        with np.errstate(invalid="ignore", divide="ignore"):
            return self.total / self.count


def level_map(all_series: Sequence[ComparedSeries], noise: float | None) -> LevelMap | None:
    """The map of one channel; None where its series have no constant pressure or there are several channels.

    Args:
        all_series: of a comparison; those that are only checked are left out.
        noise: standard deviation of one reading, None if not known.
    """
    series = [one for one in all_series if one.use == "fit"]
    levels = _levels(series)
    if len({one.channel for one in series}) != 1 or not 0 < len(levels) <= _MOST_LEVELS:
        return None
    x = next((name for name in ("contraction", "time") if _varies(_column(series, name))), None)
    if x is None:
        return None
    values = _column(series, x)
    edges = np.linspace(np.nanmin(values), np.nanmax(values), _COLUMNS + 1)
    rows, ways = [], []
    for level in levels:
        mine = [s for s in series if s.pressure is not None and _nearest(s.pressure, levels) == level]
        tallies = [_tally(mine, x, edges, way) for way in (0, 1, -1)]
        ways.append((tallies[1], tallies[2]))
        rows.append(LevelRow(level, *(tally.mean for tally in tallies)))
    return LevelMap(x, edges, rows, _disagree(ways, noise))


def _levels(series: Sequence[ComparedSeries]) -> list[float]:
    """Different constant pressures; none if a series has no constant one."""
    found = sorted(one.pressure for one in series if one.pressure is not None)
    if len(found) < len(series):
        return []
    near = _SAME_LEVEL * abs(found[-1]) if found else 0.0
    return [*found[:1], *(after for before, after in pairwise(found) if after - before > near)]


def _nearest(pressure: float, levels: Sequence[float]) -> float:
    return min(levels, key=lambda level: abs(level - pressure))


def _column(series: Sequence[ComparedSeries], name: str) -> Array:
    columns = [getattr(one, name) for one in series]
    return np.concatenate([np.full(1, np.nan) if one is None else np.asarray(one, float) for one in columns])


def _varies(values: Array) -> bool:
    known = values[np.isfinite(values)]
    size = float(np.max(np.abs(known))) if len(known) else 0.0
    return len(known) > 0 and float(np.ptp(known)) > _CONSTANT * max(size, 1e-12)


def _tally(series: Sequence[ComparedSeries], x: str, edges: Array, way: int) -> _Tally:
    """Sums over the rows of a direction; 0: over all rows."""
    at, residual = _column(series, x), _column(series, "residual")
    chosen = np.isfinite(at) & np.isfinite(residual)
    if way:
        chosen &= np.sign(_column(series, "direction")) == way
    span = edges[-1] - edges[0]
    place = np.clip(((at[chosen] - edges[0]) / span * _COLUMNS).astype(int), 0, _COLUMNS - 1)
    weights = (None, residual[chosen], residual[chosen] ** 2)
    return _Tally(*(np.bincount(place, weight, _COLUMNS).astype(float) for weight in weights))


def _disagree(ways: Sequence[tuple[_Tally, _Tally]], sigma: float | None) -> bool:
    """Whether the means of both directions differ by more than their scatter allows."""
    up, down = (
        _Tally(
            *(np.concatenate([getattr(t[i], part) for t in ways]) for part in ("count", "total", "squares"))
        )
        for i in (0, 1)
    )
    both = (up.count > 1) & (down.count > 1)
    if not np.any(both):
        return False
    spread = sum(t.squares[both] - t.total[both] ** 2 / t.count[both] for t in (up, down))
    floor = max((sigma or 0.0) ** 2, 1e-30)
    variance = np.maximum(spread / (up.count[both] + down.count[both] - 2.0), floor)
    difference = up.mean[both] - down.mean[both]
    chi = float(np.sum(difference**2 / (variance * (1.0 / up.count[both] + 1.0 / down.count[both]))))
    cells = int(np.count_nonzero(both))
    gap = float(np.mean(np.abs(difference)))
    typical = float(np.mean(np.sqrt(variance))) if sigma is None else sigma
    return bool(chi > cells + _BEYOND_CHANCE * np.sqrt(2.0 * cells) and gap > _WORTH * typical)
