"""The rows between which a muscle that carries a load is followed: many enough, and no more.

A logger reads far more often than a slow motion changes. Between kept rows the smooth parts of pressure, load
and measured length are lines within small shares of their ranges; turns and beginnings are kept. The length
at the rows between is that of the line.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.input_noise import without_input_noise

_LINE = {"pressure": 2e-3, "load": 5e-3, "length": 1e-3}  # largest distance from a line, share of the range
_MOST_BETWEEN = 8  # rows from one that is kept to the next
_FEW = 200  # rows; of fewer all are kept


class Path(NamedTuple):
    """Rows that are followed, and how the others lie between them.

    Attributes:
        rows: that are followed, shape (followed,).
        before: of each row the number of the followed one before it or at it, shape (rows,).
        share: of the way from there to the next one, shape (rows,).
    """

    rows: np.ndarray
    before: np.ndarray
    share: np.ndarray

    def everywhere(self, values: np.ndarray) -> np.ndarray:
        """Values at all rows, shape (..., rows), of those at the followed rows."""
        after = np.minimum(self.before + 1, len(self.rows) - 1)
        return (1.0 - self.share) * values[..., self.before] + self.share * values[..., after]


def path_of(task: ComparableRows, begins: Collection[int] = ()) -> Path:
    """The path through rows of predicted lengths.

    Args:
        task: the rows; their pressure is the smooth part of it.
        begins: rows at which something begins anew.
    """
    count = len(task.measured)
    new = np.concatenate([[True], np.diff(task.records) != 0])
    if count < _FEW or task.time is None:
        rows = np.arange(count)
    else:
        ends = {*np.flatnonzero(new).tolist(), *(np.flatnonzero(new)[1:] - 1).tolist(), *begins, count - 1}
        courses = [_scaled(task, name) for name in _LINE if np.ptp(task.state[name]) > 0.0]
        rows = np.array(_kept(task.time, courses, ends, _turns(task.state["pressure"])))
    clock = np.arange(count, dtype=float) if task.time is None else task.time
    before = np.searchsorted(rows, np.arange(count), side="right") - 1
    after = np.minimum(before + 1, len(rows) - 1)
    width = clock[rows[after]] - clock[rows[before]]
    inside = (np.arange(count) > rows[before]) & (width > 0.0)
    share = np.where(inside, (clock - clock[rows[before]]) / np.where(inside, width, 1.0), 0.0)
    return Path(rows, before, share)


def _scaled(task: ComparableRows, name: str) -> np.ndarray:
    """The course of a quantity, in units of the largest distance from a line."""
    values = np.array(task.state[name], dtype=float)
    assert task.time is not None  # noqa: S101 - asked by the caller
    for label in np.unique(task.records):
        rows = task.records == label
        values[rows] = without_input_noise(task.time[rows], values[rows])
    return values / (_LINE[name] * float(np.ptp(task.state[name])))


def _turns(pressure: np.ndarray) -> np.ndarray:
    """Mask of the rows at which the pressure turns round, by more than a line may be off."""
    turns = np.zeros(len(pressure), bool)
    least, extreme, way = _LINE["pressure"] * float(np.ptp(pressure)), 0, 0.0
    for row in range(1, len(pressure)):
        back = pressure[row] - pressure[extreme]
        if way == 0.0 and abs(back) > least:
            way, extreme = float(np.sign(back)), row
        elif way * back > 0.0:
            extreme = row
        elif way != 0.0 and abs(back) > least:
            turns[extreme] = True
            way, extreme = -way, row
    return turns


def _kept(time: np.ndarray, courses: list[np.ndarray], ends: set[int], turns: np.ndarray) -> list[int]:
    """The rows that are kept: from each as far as all courses are lines, up to the next end or turn."""
    stops = sorted(ends | set(np.flatnonzero(turns).tolist()))
    kept: list[int] = []
    first = 0
    while first < len(time) - 1:
        kept.append(first)
        stop = next(s for s in stops[np.searchsorted(stops, first, side="right") :])
        last = first + 1
        while last < min(stop, first + _MOST_BETWEEN) and _is_line(time, courses, first, last + 1):
            last += 1
        first = last
    return [*kept, len(time) - 1]


def _is_line(time: np.ndarray, courses: list[np.ndarray], first: int, last: int) -> bool:
    inner = slice(first + 1, last)
    share = (time[inner] - time[first]) / (time[last] - time[first])
    return all(
        np.max(np.abs((1.0 - share) * course[first] + share * course[last] - course[inner])) <= 1.0
        for course in courses
    )
