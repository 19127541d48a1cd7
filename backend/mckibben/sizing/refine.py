"""Optimises the continuous variables of designs: nominal length and pressure."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence

import numpy as np

from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.statics import contraction_limit
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial, hard_trials_of

_RUNS = 385  # designs tried from each beginning: 32 rounds
_FIRST_STEP = (0.12, 0.2)  # of the logarithms of length and pressure
#: Of the logarithms: a length and a pressure are searched to this share.
CLOSE = 1e-3
_SHRINKS, _AROUND, _GOLDEN = 0.7, 12, np.pi * (3.0 - np.sqrt(5.0))

Rounds = Generator[list[np.ndarray], list[float], None]


def refined(trials: Sequence[Trial], bench: Bench, share: tuple[float, float]) -> Iterator[list[Trial]]:
    """The best designs so far near each trial, after each round; all searches go on side by side.

    A pattern of neighbours finds them; the last ones are the best near each trial.

    Args:
        trials: where to begin.
        bench: runs the designs of the task.
        share: progress before and after, as shares of the whole work.

    Raises:
        EndedError: the bench's watch ends the work.
    """
    searches = [_Search(trial, bench.task) for trial in trials]
    begun = hard_trials_of([trial.design for trial in trials], bench)
    for search, trial in zip(searches, begun, strict=True):
        search.tried.append(trial)
    active = list(searches)
    while active:
        done = max(len(search.tried) for search in active) / _RUNS
        bench.check_end(share[0] + (share[1] - share[0]) * min(done, 1.0))
        wanted = [(search, design) for search in active for design in search.wanted]
        found = iter(hard_trials_of([design for _, design in wanted], bench))
        for search in active:
            search.answer([next(found) for _ in search.wanted])
        active = [search for search in active if search.wanted]
        yield [search.best for search in searches]


class _Search:
    """The search from one trial.

    Attributes:
        wanted: designs whose trials are wanted next; empty at the end.
        tried: all trials so far.
    """

    def __init__(self, trial: Trial, task: Task) -> None:
        self._first, self._group = trial, trial.design.group
        self.tried: list[Trial] = []
        part, valve = self._group.muscle, self._group.valve
        limits = [p for p in (part.limits.max_pressure, valve.max_pressure) if p is not None]
        highest = min(task.available_pressure, *limits) if limits else task.available_pressure
        lengths = (
            max(part.shortest, self._group.duty.pull / contraction_limit(part, task)),
            min(part.longest, task.limits.max_length - task.limits.end_fittings),
        )
        lowest = min(max(0.1 * highest, valve.min_pressure or 0.0), highest)
        self._low = np.log([lengths[0], lowest])
        self._high = np.log([max(lengths), highest])
        begin = np.log([trial.design.length, trial.design.pressure])
        self._rounds = pattern_search(begin, np.array(_FIRST_STEP), most=_RUNS, near=CLOSE)
        self.wanted = self._designs(next(self._rounds))

    def _designs(self, points: list[np.ndarray]) -> list[Design]:
        sizes = np.exp(np.clip(points, self._low, self._high)).tolist()
        return [Design(self._group, length, pressure) for length, pressure in sizes]

    def answer(self, trials: list[Trial]) -> None:
        """Take the trials of the wanted designs."""
        self.tried += trials
        try:
            self.wanted = self._designs(self._rounds.send([trial.cost() for trial in trials]))
        except StopIteration:
            self.wanted = []

    @property
    def best(self) -> Trial:
        """The best trial that keeps the limits, or else the one the search began with."""
        good = [trial for trial in self.tried if trial.keeps_limits]
        return min(good, key=lambda trial: trial.cost()) if good else self._first


def pattern_search(begin: np.ndarray, steps: np.ndarray, *, most: int, near: float) -> Rounds:
    """Rounds of points whose costs are wanted; send them back in the same order.

    A round is twelve neighbours of the best point so far. The best of them is the next one; where none is
    better the pattern shrinks and turns by the golden angle. Costs may jump where a limit is violated: a
    simplex collapses there, while some turn of the pattern always leads along the edge.

    Args:
        begin: the first point, shape (2,).
        steps: first radius of the pattern along each axis.
        most: number of points after which the search ends.
        near: it also ends when the radii are this small.
    """
    best, step, turn = np.array(begin, dtype=float), np.array(steps, dtype=float), 0.0
    (least,) = yield [best]
    left = most - 1
    while left >= _AROUND and np.max(step) > near:
        angles = turn + np.arange(_AROUND) * (2.0 * np.pi / _AROUND)
        around = list(best + step * np.stack([np.cos(angles), np.sin(angles)], axis=1))
        costs = yield around
        left -= _AROUND
        lowest = int(np.argmin(costs))
        if costs[lowest] < least:
            best, least = around[lowest], costs[lowest]
        else:
            step, turn = _SHRINKS * step, turn + _GOLDEN
