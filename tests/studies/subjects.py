"""Functions as subjects, and a study of them through the same code as any other."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from mckibben.simulation.outcome import Watch
from mckibben.studies.plan import Plan
from mckibben.studies.run import Workers, in_threads, run_plan
from mckibben.studies.table import COMPLETED, Evaluate, Figure, Row, StudyTable
from mckibben.studies.variable import Variable, uniform

Y = (Figure("y", "1"),)


def ranged(name: str, low: float, high: float) -> Variable:
    return Variable(name, name, "1", quantile=uniform(least=low, most=high), bounds=(low, high))


def rows_of(function: Callable[[np.ndarray], np.ndarray]) -> Evaluate:
    """Rows of a function from points, shape (n, variables), to figures, shape (n, figures)."""

    def evaluate(points: np.ndarray) -> Sequence[Row]:
        return [Row(COMPLETED, tuple(values)) for values in np.atleast_2d(function(points)).tolist()]

    return evaluate


def table_of(
    plan: Plan,
    function: Callable[[np.ndarray], np.ndarray],
    figures: tuple[Figure, ...] = Y,
    *,
    chunk: int = 4096,
    workers: Workers | None = None,
) -> StudyTable:
    table, _ = run_plan(plan, figures, workers or in_threads(rows_of(function)), Watch(), chunk=chunk)
    return table
