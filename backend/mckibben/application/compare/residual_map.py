"""The residual by measured pressure level and part of the contraction, as the page's map shows it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mckibben.application.compare.series import Array, ComparedSeries

_COLUMNS = 8
_MOST_LEVELS = 14
_SAME_LEVEL = 0.01  # of the largest level; closer ones are one level
_CONSTANT = 1e-9  # share of its size by which a variable that varies changes
_BEYOND_CHANCE = 3.0  # standard deviations of a chi-squared sum from which the directions disagree
_WORTH = 0.5  # mean difference of the directions over the noise, below which it is not worth two rows


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
