"""A simulated design: whether it fulfils the task, its margin to each limit, and its cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, log
from typing import NamedTuple

import numpy as np

from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design, alike_designs
from mckibben.sizing.prepared import Figures
from mckibben.sizing.side_by_side import Case
from mckibben.sizing.spread import weak
from mckibben.sizing.statics import AMPLE, HAIR, LimitName, Rest, at_rest, margins
from mckibben.sizing.task import Task

_SOFT = ("force", "stiffness", "time", "time_down", "cycle_time")
# Margin to each limit of `_SOFT`, so that manufacturing tolerances do not break it.
_KEPT = 0.08
# Cost of a margin below that (1 = a factor e in air), and of a violated limit.
_NEAR, _BROKEN = 1.0, 30.0
# Share by which a weak specimen may be late for the same cost.
_WEAK = 0.08


class AtRest(NamedTuple):
    """Statics of a design, and its margin to each limit at rest."""

    rest: Rest
    margins: dict[LimitName, float]


@dataclass(frozen=True, eq=False)
class Trial:
    """A design, its statics (arrays of one entry), the figures of a run, and its margins by limit.

    Attributes:
        weak: figures of a run of a weak specimen; None if none was run.
    """

    design: Design
    rest: Rest
    figures: Figures
    margins: dict[LimitName, float]
    task: Task
    weak: Figures | None = None

    @property
    def binding(self) -> LimitName:
        """The limit with the least margin."""
        return min(self.margins, key=lambda name: self.margins[name])

    @property
    def time(self) -> float:
        """Time of the stroke [s], of a trial that keeps its limits.

        Raises:
            LookupError: the load does not arrive.
        """
        if self.figures.time is None:
            raise LookupError("the load does not arrive")
        return self.figures.time

    @property
    def keeps_limits(self) -> bool:
        """Whether every limit is kept."""
        return self.figures.time is not None and self.figures.holds and min(self.margins.values()) >= -HAIR

    @property
    def air(self) -> float:
        """Air of all muscles in a cycle, at ANR [m^3]."""
        return self.figures.air

    @property
    def force_reserve(self) -> float:
        """Least share by which the static force exceeds the load."""
        return float(self.rest.capacity[0]) - 1.0

    def excess(self) -> float:
        """Largest ratio of a time taken to the time required; infinite when an end is not reached."""
        ratios = times_over(self.figures, self.task).values()
        return max(ratios, default=0.0 if self.figures.time is not None else inf)

    def worth(self) -> float:
        """The figure the task ranks by, less is better; a logarithm, so that ratios count."""
        task = self.task
        length = self.design.length + task.limits.end_fittings
        match task.rank_by:
            case "air":
                return log(max(self.air, 1e-12))
            case "length":
                return log(length)
            case "time":
                return log(max(self.figures.time or inf, 1e-6))
            case "reserve":
                return -self.force_reserve
            case "probability":
                soft = [self.margins[name] for name in _SOFT if name in self.margins]
                return -min([*soft, 0.5])
            case _:
                return log(max(self.air, 1e-12)) + 0.5 * log(length * self.design.group.muscles)

    def cost(self) -> float:
        """Worth plus penalties for small margins and violated limits."""
        total = self.worth() if self.figures.time is not None else 10.0
        for name, margin in self.margins.items():
            if margin < 0.0:
                total += _NEAR + _BROKEN * min(-margin, 10.0)
            elif name in _SOFT and self.task.robust:
                total += _NEAR * (max(0.0, _KEPT - margin) / _KEPT) ** 2
        if self.weak is not None:
            late = max(times_over(self.weak, self.task).values(), default=1.0)
            if not late < 2.0:  # not within the simulated time; the missing stroke gives the cost a slope
                late = 3.0 - min(self.weak.reached / self.design.group.duty.stroke, 1.0)
            total += _NEAR * (max(late - 1.0, 0.0) / _WEAK) ** 2
            total += 0.0 if self.weak.holds else _NEAR / _WEAK
        return total if self.figures.holds else total + _BROKEN


def trial_of(design: Design, bench: Bench, known: AtRest | None = None) -> Trial:
    """Run a design; ``known`` are its statics, if known already."""
    return judged(design, bench.run(design), bench.task, known)


def hard_trials_of(designs: Sequence[Design], bench: Bench) -> list[Trial]:
    """Run designs, and a weak specimen of each where specimens count."""
    task = bench.task
    prepared = [bench.prepared(design) for design in designs]
    cases = [Case(item, item.parameters, item.inputs) for item in prepared]
    if task.robust:
        deviating = zip(prepared, weak(designs, task), strict=True)
        cases += [Case(item, *item.specimen(*deviations)) for item, deviations in deviating]
    figures = bench.run_cases(cases)
    trials = [
        judged(design, mine, task, known)
        for design, mine, known in zip(designs, figures, rests_of(designs, task), strict=False)
    ]
    poor = figures[len(designs) :] or [None] * len(designs)
    return [replace(trial, weak=weakest) for trial, weakest in zip(trials, poor, strict=True)]


def rests_of(designs: Sequence[Design], task: Task) -> list[AtRest]:
    """The statics of designs, those of the same muscle and duty together."""
    found: dict[int, AtRest] = {}
    for alike in alike_designs(designs):
        group = designs[alike[0]].group
        arrays = [(d.length, d.pressure, float(d.group.parallel)) for d in (designs[i] for i in alike)]
        rest = at_rest(group.muscle, group.duty, task, *np.array(arrays).T.copy())
        limits = margins(rest, group.muscle, task)
        found |= {index: at_rest_of(rest, limits, row) for row, index in enumerate(alike)}
    return [found[index] for index in range(len(designs))]


def at_rest_of(rest: Rest, limits: Mapping[LimitName, np.ndarray], index: int) -> AtRest:
    """The statics of one of the designs."""
    return AtRest(rest.only(index), {name: float(margin[index]) for name, margin in limits.items()})


def judged(design: Design, figures: Figures, task: Task, known: AtRest | None = None) -> Trial:
    """A design with the figures of its run and its margins; ``known`` are its statics, if known already."""
    group = design.group
    rest, at_rest_margins = known or rests_of([design], task)[0]
    all_margins = dict(at_rest_margins)
    for name, ratio in times_over(figures, task).items():
        all_margins[name] = 1.0 / ratio - 1.0
    most = group.muscle.limits.max_force
    if most is not None and figures.peak_force > 0.0:
        all_margins["force_limit"] = min(all_margins["force_limit"], most / figures.peak_force - 1.0)
    kept = {name: value for name, value in all_margins.items() if value < AMPLE}
    return Trial(design, rest, figures, kept, task)


def times_over(figures: Figures, task: Task) -> dict[LimitName, float]:
    """Times taken as shares of the times required; infinite where an end is not reached."""
    up, down = figures.time, figures.time_down
    ratios: dict[LimitName, float] = {}
    if task.time is not None:
        ratios["time"] = inf if up is None else up / task.time
    if task.time_down is not None:
        ratios["time_down"] = inf if down is None else down / task.time_down
    if task.cycle_time is not None:
        ratios["cycle_time"] = inf if up is None or down is None else (up + down) / task.cycle_time
    return ratios
