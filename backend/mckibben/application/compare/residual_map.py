"""The residual by place: the map of page and report, and the rows of a chosen range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare.series import Array, KnownInputs, constant_level, inputs_of
from mckibben.facts.comparison import RESIDUAL
from mckibben.facts.result import Series, result_class
from mckibben.identification.fit.comparison import Comparison
from mckibben.identification.predict.predictor import PredictedChannel
from mckibben.identification.residual.profiles import variables_of

_PARTS = 8  # columns, and rows where there are no levels
_MOST_LEVELS = 14
_SAME_LEVEL = 0.01  # of the largest level; closer ones are one level
_CONSTANT = 1e-9  # share of its size by which a variable that varies changes
_BEYOND_CHANCE = 3.0  # standard deviations of a chi-squared sum from which the directions disagree
_WORTH = 0.5  # mean difference of the directions over the noise, below which it is not worth two rows
_WITHIN = 1.15  # error over noise up to which a row counts as noise, where it has many readings

#: Variables over which a range of rows can be chosen.
Over = Literal["contraction", "length", "pressure", "velocity", "direction", "time", "displacement"]


@result_class
class MapCell:
    """The residual in a cell; SI, or multiples of the noise."""

    FIGURES: ClassVar = RESIDUAL.name

    mean: float
    rms: float
    count: int
    lengthening: float | None
    """Mean of the rows that lengthen; None without any."""
    shortening: float | None
    """Mean of the rows that shorten; None without any."""


@result_class
class MapRow:
    """A row of the map."""

    low: float
    """Smallest value of the variable of the rows, SI; of a channel 0."""
    high: float
    """Largest value of the variable of the rows, SI; of a channel 0."""
    level: float | None
    """The measured level of the row, SI; None of a range and of a channel."""
    channel: str | None
    """The predicted channel of the row, where each has one."""
    within_noise: bool
    """Whether the RMS error of the row is the noise, but for chance."""
    cells: list[MapCell | None]
    """One for each column; None without rows."""


@result_class
class ResidualMap:
    """The residual over two variables, rows with the largest values first.

    Rows are the measured levels of the pressure where every curve has one, the predicted channels over the
    time where there are several, else equal ranges.
    """

    x: str
    """The variable of the columns."""
    y: str
    """The variable of the rows, or 'channel'."""
    edges: Series
    """Boundaries of the columns, SI; one more than columns."""
    rows: list[MapRow]
    """Its rows, that of the largest values first."""
    split: bool
    """Whether the directions of motion differ by more than chance: a mean over both hides friction."""
    scaled: bool
    """Whether the values are multiples of the noise of each channel."""

    @property
    def largest(self) -> float:
        """The largest magnitude of a mean, also of one direction."""
        cells = [cell for row in self.rows for cell in row.cells if cell is not None]
        means = [mean for cell in cells for mean in (cell.mean, cell.lengthening, cell.shortening)]
        return max((abs(mean) for mean in means if mean is not None), default=0.0)


@result_class
class RowsInside:
    """The residual of a channel in the chosen range."""

    FIGURES: ClassVar = RESIDUAL.name

    channel: str
    """The predicted channel."""
    rms: float | None
    mean: float | None
    count: int


@result_class
class ExplainedInside:
    """What an effect of the model explains of a channel in the chosen range."""

    FIGURES: ClassVar = RESIDUAL.name

    effect: str
    """Id of the effect."""
    channel: str
    """The predicted channel; of several those first in which the effect shows most over their noise."""
    explained_mean: float
    explained_rms: float


@dataclass(frozen=True, slots=True)
class _Sums:
    """Sums of the residual in each column, shape (columns,)."""

    count: Array
    total: Array
    squares: Array

    @property
    def mean(self) -> Array:
        with np.errstate(invalid="ignore", divide="ignore"):
            return self.total / self.count


def residual_map(comparison: Comparison) -> ResidualMap | None:
    """The map of all compared rows; None where nothing but one place was measured."""
    known = inputs_of(comparison)
    if len(comparison.predictor.channels) > 1:
        return _of_channels(comparison, known) or _of_ranges(comparison)
    levels = level_map(
        known, np.asarray(comparison.predictor.groups), comparison.residual, noise=comparison.noise
    )
    return levels or _of_ranges(comparison)


def rows_inside(comparison: Comparison, within: Mapping[Over, Sequence[float]]) -> list[RowsInside]:
    """The residual of each channel where all variables are within their ranges, ends with them.

    A row of which a variable is not known is outside.
    """
    found = []
    for channel, chosen in _chosen(comparison, within):
        residual = comparison.residual[chosen]
        some = len(residual) > 0
        found.append(
            RowsInside(
                channel=channel.name,
                rms=float(np.sqrt(np.mean(residual**2))) if some else None,
                mean=float(np.mean(residual)) if some else None,
                count=len(residual),
            )
        )
    return found


def explained_inside(comparison: Comparison, within: Mapping[Over, Sequence[float]]) -> list[ExplainedInside]:
    """What each effect of the model explains of each channel in a range, see `rows_inside`.

    A channel without rows there, and rows that the model without the effect does not reach, do not count.
    """
    predictor, model = comparison.predictor, comparison.fit_model
    whole = predictor.predict(model)
    chosen = _chosen(comparison, within)
    found = []
    for effect in model.effects:
        changes = whole - predictor.predict(model.without(effect.id))
        shares = []
        for channel, rows in chosen:
            change = changes[rows & np.isfinite(changes)]
            if len(change):
                rms = float(np.sqrt(np.mean(change**2)))
                share = ExplainedInside(effect.id, channel.name, float(np.mean(change)), rms)
                shares.append((rms / (channel.noise or 1.0), share))
        found += [share for _, share in sorted(shares, key=lambda one: -one[0])]
    return found


def _chosen(
    comparison: Comparison, within: Mapping[Over, Sequence[float]]
) -> list[tuple[PredictedChannel, NDArray[np.bool_]]]:
    """Each channel with a mask of its rows in a range."""
    known = inputs_of(comparison)
    inside = np.ones(len(comparison.residual), dtype=bool)
    for name, (low, high) in within.items():
        values = _column(comparison, known, name)
        slack = _CONSTANT * max(abs(low), abs(high))
        inside &= (
            np.zeros(len(inside), bool)
            if values is None
            else (values >= low - slack) & (values <= high + slack)
        )
    found = []
    for channel in comparison.predictor.channels:
        chosen = np.zeros(len(inside), bool)
        chosen[channel.rows] = inside[channel.rows]
        found.append((channel, chosen))
    return found


def _column(comparison: Comparison, known: KnownInputs, name: Over) -> Array | None:
    """Values of a variable; a stroke is known of the rows that predict it."""
    if name != "displacement":
        return getattr(known, name)
    values = np.full(len(comparison.residual), np.nan)
    for channel in comparison.predictor.channels:
        if channel.name == name:
            values[channel.rows] = comparison.predictor.measured[channel.rows]
    return values


def level_map(
    known: KnownInputs, groups: Array, residual: Array, *, noise: float | None
) -> ResidualMap | None:
    """Measured levels of the pressure over contraction or time.

    Args:
        known: pressure, contraction or time, and direction of each row.
        groups: number of the curve of each row.
        residual: of one channel.
        noise: standard deviation of one reading, None if not known.

    Returns:
        None where a curve has no constant pressure, or there are too many levels.
    """
    of_group = {label: constant_level(known.pressure[groups == label]) for label in np.unique(groups)}
    stated = [level for level in of_group.values() if level is not None]
    levels = _levels(stated)
    if len(stated) < len(of_group) or not 0 < len(levels) <= _MOST_LEVELS:
        return None
    x = next((name for name in ("contraction", "time") if _varies(getattr(known, name))), None)
    if x is None:
        return None
    at = getattr(known, x)
    edges = np.linspace(np.nanmin(at), np.nanmax(at), _PARTS + 1)
    rows, ways = [], []
    for level in reversed(levels):
        members = [
            label for label, one in of_group.items() if one is not None and _nearest(one, levels) == level
        ]
        mine = np.isin(groups, members) & np.isfinite(at)
        pressure = known.pressure[mine]
        sums = [_sums(at, residual, mine & chosen, edges) for chosen in _ways(known.direction)]
        ways.append(sums[1:])
        rows.append(
            _row(
                sums, noise, low=float(min(level, *pressure)), high=float(max(level, *pressure)), level=level
            )
        )
    return ResidualMap(x, "pressure", edges, rows, split=_disagree(ways, noise), scaled=False)


def _of_channels(comparison: Comparison, known: KnownInputs) -> ResidualMap | None:
    """Each predicted channel over the time, in units of its noise; None without a time."""
    if known.time is None or not _varies(known.time):
        return None
    edges = np.linspace(np.nanmin(known.time), np.nanmax(known.time), _PARTS + 1)
    rows = []
    for channel in comparison.predictor.channels:
        mine = np.zeros(len(comparison.residual), bool)
        mine[channel.rows] = True
        noise = comparison.channels[channel.name].noise_floor or 1.0
        sums = [
            _sums(known.time, comparison.residual / noise, mine & chosen, edges)
            for chosen in _ways(known.direction)
        ]
        rows.append(_row(sums, 1.0, channel=channel.name))
    return ResidualMap("time", "channel", edges, rows, split=False, scaled=True)


def _of_ranges(comparison: Comparison) -> ResidualMap | None:
    """Pressure and contraction, or the first two variables, in equal ranges; None with fewer than two."""
    predictor = comparison.predictor
    variables = variables_of(predictor, comparison.fit_model)
    across = [name for name in ("contraction", "displacement", "time", "load") if name in variables]
    up = [name for name in ("pressure", "velocity", "command") if name in variables]
    if not across or not up:
        return None
    at, beside = variables[across[0]], variables[up[0]]
    scaled, residual = len(predictor.channels) > 1, comparison.residual / predictor.scale
    edges, bounds = (np.linspace(np.min(values), np.max(values), _PARTS + 1) for values in (at, beside))
    place = np.clip(np.searchsorted(bounds, beside, side="right") - 1, 0, _PARTS - 1)
    ways = _ways(inputs_of(comparison).direction)
    noise = 1.0 if scaled else comparison.noise
    rows = [
        _row(
            [_sums(at, residual, (place == part) & chosen, edges) for chosen in ways],
            noise, low=float(bounds[part]), high=float(bounds[part + 1]),
        )
        for part in reversed(range(_PARTS))
    ]  # fmt: skip
    return ResidualMap(across[0], up[0], edges, rows, split=False, scaled=scaled)


def _levels(stated: Sequence[float]) -> list[float]:
    """Different ones of constant pressures, ascending."""
    found = sorted(stated)
    near = _SAME_LEVEL * abs(found[-1]) if found else 0.0
    return [*found[:1], *(after for before, after in pairwise(found) if after - before > near)]


def _nearest(pressure: float, levels: Sequence[float]) -> float:
    return min(levels, key=lambda level: abs(level - pressure))


def _varies(values: Array | None) -> bool:
    known = np.zeros(0) if values is None else values[np.isfinite(values)]
    size = float(np.max(np.abs(known), initial=0.0))
    return len(known) > 0 and float(np.ptp(known)) > _CONSTANT * max(size, 1e-12)


def _ways(direction: Array) -> list[NDArray[np.bool_]]:
    """All rows, those that lengthen, those that shorten."""
    return [np.ones(len(direction), bool), direction > 0.0, direction < 0.0]


def _sums(at: Array, residual: Array, chosen: NDArray[np.bool_], edges: Array) -> _Sums:
    """Sums over the chosen rows in equal columns."""
    rows = chosen & np.isfinite(at) & np.isfinite(residual)
    share = (at[rows] - edges[0]) / (edges[-1] - edges[0])
    place = np.clip((share * _PARTS).astype(int), 0, _PARTS - 1)
    weights = (None, residual[rows], residual[rows] ** 2)
    return _Sums(*(np.bincount(place, weight, _PARTS).astype(float) for weight in weights))


def _row(
    sums: Sequence[_Sums],
    noise: float | None,
    *,
    low: float = 0.0,
    high: float = 0.0,
    level: float | None = None,
    channel: str | None = None,
) -> MapRow:
    """A row by its sums over all rows, the lengthening and the shortening ones."""
    whole, up, down = sums

    def mean(part: _Sums, column: int) -> float | None:
        return float(part.mean[column]) if part.count[column] else None

    cells = [
        MapCell(
            mean=float(whole.mean[column]),
            rms=float(np.sqrt(whole.squares[column] / whole.count[column])),
            count=int(whole.count[column]),
            lengthening=mean(up, column),
            shortening=mean(down, column),
        )
        if whole.count[column]
        else None
        for column in range(_PARTS)
    ]
    count = float(np.sum(whole.count))
    quiet = False
    if noise and count:
        chance = 1.0 + 2.0 / np.sqrt(2.0 * count)  # two standard deviations of an RMS
        quiet = bool(np.sqrt(np.sum(whole.squares) / count) <= noise * max(_WITHIN, chance))
    return MapRow(low, high, level, channel, quiet, cells)


def _disagree(ways: Sequence[Sequence[_Sums]], sigma: float | None) -> bool:
    """Whether the means of both directions differ by more than their scatter allows."""
    up, down = (
        _Sums(*(np.concatenate([getattr(sums[i], part) for sums in ways]) for part in _Sums.__slots__))
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
