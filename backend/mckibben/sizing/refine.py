"""Optimises the continuous variables of designs: nominal length and pressure."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence

import numpy as np

from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.statics import contraction_limit
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial, hard_trials_of

_RUNS = 32
_FIRST_STEP = (0.12, 0.2)  # of the logarithms of length and pressure
_CLOSE = 1e-3  # of the logarithms, and of the cost

Rounds = Generator[list[np.ndarray], list[float], None]


def refined(trials: Sequence[Trial], bench: Bench, share: tuple[float, float]) -> Iterator[list[Trial]]:
    """The best designs so far near each trial, after each round; all searches go on side by side.

    The simplex method finds them; the last ones are the best near each trial.

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
        done = max(len(search.tried) for search in active) / (_RUNS + 1)
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
        steps = np.where(begin + _FIRST_STEP > self._high, -1.0, 1.0) * _FIRST_STEP
        simplex = begin + np.array([[0.0, 0.0], [steps[0], 0.0], [0.0, steps[1]]])
        self._rounds = simplex_search(simplex, most=_RUNS, near=_CLOSE, alike=_CLOSE)
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


def simplex_search(simplex: np.ndarray, *, most: int, near: float, alike: float) -> Rounds:
    """Rounds of points whose costs are wanted; send them back in the same order.

    Args:
        simplex: the first points, shape (variables + 1, variables).
        most: number of points after which the search ends.
        near, alike: it also ends when all points are this near to the best one, and their costs this alike.
    """
    points = np.array(simplex, dtype=float)
    first = list(points[:most])
    costs = np.full(len(points), np.inf)
    costs[: len(first)] = yield first
    left = most - len(first)
    while left > 0:
        order = np.argsort(costs, kind="stable")
        points, costs = points[order], costs[order]
        if np.max(np.abs(points[1:] - points[0])) <= near and np.max(np.abs(costs[1:] - costs[0])) <= alike:
            return
        middle = points[:-1].mean(axis=0)
        away = middle - points[-1]
        reflected = middle + away
        (cost,) = yield [reflected]
        left -= 1
        if cost < costs[0]:
            best, least = reflected, cost
            if left > 0:
                expanded = middle + 2.0 * away
                (cost,) = yield [expanded]
                left -= 1
                if cost < least:
                    best, least = expanded, cost
            points[-1], costs[-1] = best, least
            continue
        if cost < costs[-2]:
            points[-1], costs[-1] = reflected, cost
            continue
        if left == 0:
            return
        outside = cost < costs[-1]
        limit = cost if outside else costs[-1]
        contracted = middle + (0.5 if outside else -0.5) * away
        (cost,) = yield [contracted]
        left -= 1
        if cost <= limit if outside else cost < limit:
            points[-1], costs[-1] = contracted, cost
            continue
        points[1:] = points[0] + 0.5 * (points[1:] - points[0])
        chosen = list(points[1 : 1 + left])
        if not chosen:
            return
        costs[1 : 1 + len(chosen)] = yield chosen
        left -= len(chosen)
