"""Optimisation of functions whose optimum or Pareto front is known."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.simulation.outcome import Watch
from mckibben.studies.optimise import FigureGoal, FigureLimit, OptimisationPlan, front
from mckibben.studies.run import in_threads, run_plan
from mckibben.studies.table import COMPLETED, Figure, Row, StudyTable
from mckibben.studies.variable import Variable
from tests.studies.subjects import ranged, rows_of, table_of

TWO = (Figure("f", "1"), Figure("g", "1"))


def plan(variables: list[Variable], goals, limits=(), figures=TWO, population=24, generations=25):
    return OptimisationPlan(tuple(variables), figures, goals, limits, population, generations, 5)


def test_the_front_of_schaffers_problem():
    """f = x^2, g = (x - 2)^2: the front is sqrt(f) + sqrt(g) = 2, x from 0 to 2."""
    search = plan([ranged("x", -10.0, 10.0)], (FigureGoal("f"), FigureGoal("g")))
    table = table_of(search, lambda p: np.hstack([p**2, (p - 2.0) ** 2]), TWO)
    best = front(table, search.goals, ())
    f, g = table.values[best].T
    assert len(best) >= 20
    # A point just beside the ends is on the front of the runs if none is nearer.
    assert np.sqrt(f) + np.sqrt(g) == pytest.approx(2.0, abs=0.01)
    assert np.median(np.sqrt(f) + np.sqrt(g)) == pytest.approx(2.0, abs=1e-9)
    x = table.points[best, 0]
    assert x.min() < 0.1
    assert x.max() > 1.9
    assert np.diff(np.sort(x)).max() < 0.3


def test_the_front_of_binh_and_korn_keeps_its_limits():
    """Binh and Korn (1997): on the front x = y up to 3, then y = 3."""

    def function(p: np.ndarray) -> np.ndarray:
        x, y = p.T
        return np.column_stack(
            [
                4 * x**2 + 4 * y**2,
                (x - 5) ** 2 + (y - 5) ** 2,
                (x - 5) ** 2 + y**2,
                (x - 8) ** 2 + (y + 3) ** 2,
            ]
        )

    figures = (*TWO, Figure("c1", "1"), Figure("c2", "1"))
    limits = (FigureLimit("c1", at_most=25.0), FigureLimit("c2", at_least=7.7))
    search = plan(
        [ranged("x", 0.0, 5.0), ranged("y", 0.0, 3.0)], (FigureGoal("f"), FigureGoal("g")), limits, figures,
        population=40, generations=30,
    )  # fmt: skip
    table = table_of(search, function, figures)
    best = front(table, search.goals, limits)
    f, g, c1, c2 = table.values[best].T
    assert (c1 <= 25.0).all()
    assert (c2 >= 7.7).all()
    x = np.linspace(0.0, 5.0, 2001)
    exact_f, exact_g = 4 * x**2 + 4 * np.minimum(x, 3) ** 2, (x - 5) ** 2 + (np.minimum(x, 3) - 5) ** 2
    above = g - np.interp(f, exact_f, exact_g)
    assert above.min() > -1e-3
    assert np.median(above) < 0.3  # of values from 4 to 50


def test_one_goal_with_a_limit():
    """The largest x + y inside the unit circle is sqrt 2."""
    search = plan(
        [ranged("x", -2.0, 2.0), ranged("y", -2.0, 2.0)],
        (FigureGoal("f", maximise=True),),
        (FigureLimit("g", at_most=1.0),),
        population=20,
        generations=60,
    )
    table = table_of(search, lambda p: np.column_stack([p.sum(axis=1), (p**2).sum(axis=1)]), TWO)
    best = front(table, search.goals, search.limits)[0]
    assert table.values[best, 0] == pytest.approx(np.sqrt(2.0), rel=2e-3)
    assert table.values[best, 1] <= 1.0


def test_failed_runs_are_kept_in_the_table_and_avoided():
    search = plan([ranged("x", -10.0, 10.0)], (FigureGoal("f"),), generations=30)
    whole = rows_of(lambda p: np.hstack([p**2, p]))

    def half(points: np.ndarray) -> list[Row]:
        return [
            Row("diverged", (float("nan"),) * 2, "left") if x < 1.0 else row
            for (x,), row in zip(points, whole(points), strict=True)
        ]

    table, _ = run_plan(search, TWO, in_threads(half), Watch())
    assert len(table.runs) == search.runs
    assert set(table.outcomes) == {COMPLETED, "diverged"}
    best = front(table, search.goals, ())[0]
    assert table.points[best, 0] == pytest.approx(1.0, abs=0.01)


def test_the_front_leaves_out_dominated_failed_and_repeated_rows():
    values = np.array([[1.0, 5.0], [2.0, 4.0], [2.0, 6.0], [0.0, 0.0], [1.0, 5.0], [3.0, np.nan]])
    outcomes = (COMPLETED, COMPLETED, COMPLETED, "diverged", COMPLETED, COMPLETED)
    table = StudyTable((), TWO, np.arange(6), np.zeros((6, 0)), values, outcomes, ("",) * 6)
    assert front(table, (FigureGoal("f"), FigureGoal("g")), ()).tolist() == [0, 1]
    assert front(table, (FigureGoal("f"), FigureGoal("g", maximise=True)), ()).tolist() == [0, 2]
