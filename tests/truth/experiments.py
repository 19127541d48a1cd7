"""Test protocols: how pressure and length run in time for each kind of measurement."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from tests.truth.composition import Record, Truth
from tests.truth.muscle import ROOM, Array

FINE = 10  # fine rows per written row
_PAUSE = 3.0  # s between two loops


class RecordBuilder:
    """Rows of a record as they are collected."""

    def __init__(self) -> None:
        self.columns: dict[str, list[Array]] = {
            n: [] for n in ("time", "pressure", "length", "group", "kept", "temperature")
        }
        self.now = 0.0
        self.loops = 0

    def add(self, step: float, pressure: Array, length: Array, *, kept: bool, phase: int = 0) -> None:
        rows = len(length)
        time = self.now + step * np.arange(1, rows + 1)
        self.now = float(time[-1])
        marked = np.zeros(rows, bool)
        if kept:
            marked[phase::FINE] = True
        full = np.ones(rows)
        for name, values in (
            ("time", time),
            ("pressure", pressure * full),
            ("length", length),
            ("group", self.loops * full),
            ("kept", marked),
            ("temperature", ROOM * full),
        ):
            self.columns[name].append(np.asarray(values, dtype=float))

    def last(self, name: str) -> float:
        return float(self.columns[name][-1][-1])

    def pause(self, pressure: float, length: float, seconds: float = _PAUSE) -> None:
        """Go over to the next loop, unseen."""
        if not self.columns["time"]:
            self.add(0.02, np.linspace(0.0, pressure, 60), np.full(60, length), kept=False)
            return
        share = np.linspace(0.0, 1.0, 120)
        p, x = self.last("pressure"), self.last("length")
        self.add(
            seconds / 120,
            p + share * (pressure - p),
            x + np.minimum(2 * share, 1.0) * (length - x),
            kept=False,
        )

    def record(self) -> Record:
        joined = {name: np.concatenate(parts) for name, parts in self.columns.items()}
        return Record(
            joined["time"],
            joined["pressure"],
            joined["length"],
            joined["group"].astype(int),
            joined["kept"].astype(bool),
            joined["temperature"],
        )


def _run(corners: Sequence[float], speed: float, rows: int) -> tuple[float, Array]:
    """A path through corners at constant speed, its corners rounded over one row; step and values."""
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(corners)))])
    count = rows * FINE
    along = np.linspace(0.0, way[-1], count)
    path = np.interp(along, way, corners)
    padded = np.concatenate([np.full(FINE, path[0]), path, np.full(FINE, path[-1])])
    smooth = np.convolve(padded, np.ones(FINE) / FINE, mode="same")[FINE:-FINE]
    return float(way[-1] / speed / count), smooth


def isobaric(
    truth: Truth,
    *,
    levels: Sequence[float],
    low: float = 0.005,
    high: float = 0.2,
    speeds: Sequence[float] = (0.004,),
    turns: Sequence[float] = (1.0, 0.0),
    rows: int = 90,
    droop: float = 0.005,
) -> Record:
    """Force over length at held pressures.

    Args:
        truth: the muscle, which says how far each pressure can pull it.
        levels: gauge pressures [Pa].
        low, high: contractions between which the loops run.
        speeds: of the machine [m/s]; every level runs at every speed.
        turns: corners of one loop as shares of the way from low to high, after starting at 0; nested loops
            come back to a corner they passed.
        rows: written rows per loop.
        droop: share by which the regulator lets the pressure rise and fall with the muscle's volume.
    """
    path = RecordBuilder()
    rest = truth.muscle.nominal
    for level in levels:
        reach = min(high, truth.longest_contraction(level))
        for speed in speeds:
            corners = rest * (1.0 - (low + (reach - low) * np.array([0.0, *turns])))
            path.pause(level * (1.0 + 0.5 * droop), float(corners[0]))
            step, length = _run(list(corners), speed, rows)
            share = (corners[0] - length) / max(corners[0] - rest * (1 - reach), 1e-9)
            path.add(step, level * (1.0 + droop * (0.5 - share)), length, kept=True)
            path.loops += 1
    return path.record()


def held(
    truth: Truth,
    *,
    levels: Sequence[float],
    stops: Sequence[float],
    speed: float,
    hold: float,
    rows: int = 60,
) -> Record:
    """Moves at held pressure with rests in between, during which force relaxes."""
    path = RecordBuilder()
    rest = truth.muscle.nominal
    for level in levels:
        reach = min(max(stops), truth.longest_contraction(level))
        corners = rest * (1.0 - np.minimum(stops, reach))
        path.pause(level, float(corners[0]), seconds=30.0)
        for begin, end in pairwise(corners):
            step, length = _run([begin, end], speed, rows // 3)
            path.add(step, np.full(len(length), level), length, kept=True)
            path.add(hold / (rows * FINE), np.full(rows * FINE, level), np.full(rows * FINE, end), kept=True)
        path.loops += 1
    return path.record()


def isometric(
    truth: Truth,
    *,
    contractions: Sequence[float],
    high: float = 6e5,
    rates: Sequence[float] = (5e4,),
    turns: Sequence[float] = (1.0, 0.0),
    rows: int = 90,
    steps: float = 0.0,
) -> Record:
    """Force over pressure at held lengths; with ``steps`` the pressure jumps with that time constant [s]."""
    path = RecordBuilder()
    for contraction in contractions:
        length = truth.muscle.nominal * (1.0 - contraction)
        low = max(3e4, truth.least_pressure(length))
        for rate in rates:
            corners = low + (high - low) * np.array([0.0, *turns])
            path.pause(low, length)
            step, pressure = _run(list(corners), rate, rows)
            if steps:
                step, pressure = _steps(corners, steps, rows)
            path.add(step, pressure, np.full(len(pressure), length), kept=True)
            path.loops += 1
    return path.record()


def _steps(corners: Array, time: float, rows: int) -> tuple[float, Array]:
    """Exponential steps from corner to corner, each lasting eight time constants."""
    each = rows * FINE // (len(corners) - 1)
    step = 8.0 * time / each
    along = step * np.arange(1, each + 1)
    parts = [end + (begin - end) * np.exp(-along / time) for begin, end in pairwise(corners)]
    return step, np.concatenate(parts)


def pressure_cycles(
    *, low: float, high: float, loads: Sequence[float], rows: int, seconds: float = 60.0
) -> Record:
    """Pressure up and down under held loads; the length follows and is filled in by the bench."""
    path = RecordBuilder()
    carried = []
    for load in loads:
        half = np.linspace(low, high, rows * FINE // 2)
        pressure = np.concatenate([half, half[::-1]])
        path.pause(low, 1.0)
        path.add(seconds / len(pressure), pressure, np.ones(len(pressure)), kept=True)
        path.loops += 1
        carried.append(load)
    record = path.record()
    record.load = np.array(carried)[np.minimum(record.group, len(carried) - 1)]
    return record


def scattered(
    truth: Truth,
    rng: np.random.Generator,
    *,
    levels: Sequence[float],
    contractions: Sequence[float],
    scatter: bool,
) -> Record:
    """A static map: a grid of pressures and lengths, or that many scattered points, without order in time."""
    if scatter:
        count = len(levels) * len(contractions)
        pressure = rng.uniform(min(levels), max(levels), count)
        contraction = rng.uniform(min(contractions), max(contractions), count)
    else:
        grid = np.meshgrid(levels, contractions, indexing="ij")
        pressure, contraction = (np.asarray(axis).ravel() for axis in grid)
    length = truth.muscle.nominal * (1.0 - contraction)
    room = np.full(len(length), ROOM)
    pulling = truth.force(pressure, length, room) > 0.02 * truth.muscle.blocked
    pressure, length = pressure[pulling], length[pulling]
    rows = len(length)
    return Record(
        np.arange(rows, dtype=float),
        pressure,
        length,
        np.zeros(rows, int),
        np.ones(rows, bool),
        np.full(rows, ROOM),
    )
