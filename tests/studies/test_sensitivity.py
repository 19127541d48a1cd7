"""Sensitivities of functions whose indices are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.simulation.outcome import Watch
from mckibben.studies.run import in_threads, run_plan
from mckibben.studies.sensitivity import morris_plan, sobol_plan
from mckibben.studies.table import COMPLETED, Row
from mckibben.studies.variable import Variable, normal
from tests.studies.subjects import Y, ranged, rows_of, table_of

A, B = 7.0, 0.1


def ishigami(points: np.ndarray) -> np.ndarray:
    """Ishigami and Homma (1990): sin x1 + a sin^2 x2 + b x3^4 sin x1."""
    x1, x2, x3 = points.T
    return (np.sin(x1) + A * np.sin(x2) ** 2 + B * x3**4 * np.sin(x1))[:, None]


def ishigami_indices() -> tuple[list[float], list[float]]:
    """First-order and total indices, from the variances in closed form."""
    p4, p8 = np.pi**4, np.pi**8
    v1 = 0.5 * (1.0 + B * p4 / 5.0) ** 2
    v2, v13 = A**2 / 8.0, B**2 * p8 * (1.0 / 18.0 - 1.0 / 50.0)
    whole = v1 + v2 + v13
    return [v1 / whole, v2 / whole, 0.0], [(v1 + v13) / whole, v2 / whole, v13 / whole]


def test_sobol_indices_of_ishigamis_function():
    plan = sobol_plan([ranged(f"x{i}", -np.pi, np.pi) for i in (1, 2, 3)], 4096, seed=3)
    assert plan.runs == 4096 * 5
    (found,) = plan.sensitivity(table_of(plan, ishigami), 0.95)
    first, total = ishigami_indices()
    assert [item.first for item in found.influences] == pytest.approx(first, abs=0.03)
    assert [item.total for item in found.influences] == pytest.approx(total, abs=0.03)
    assert found.blocks == plan.blocks == 4096
    for item, exact in zip(found.influences, total, strict=True):
        assert abs((item.total or np.nan) - exact) < 2.0 * (item.total_error or np.nan)


def test_sobol_indices_weight_normal_quantities_by_their_variance():
    """Of a sum the indices are the shares of the variances."""
    deviations = (1.0, 2.0, 3.0)
    variables = [
        Variable(f"x{s}", f"x{s}", "1", quantile=normal(mean=5.0, deviation=s), tolerance=True)
        for s in deviations
    ]
    plan = sobol_plan(variables, 1024, seed=1)
    (found,) = plan.sensitivity(table_of(plan, lambda x: x.sum(axis=1, keepdims=True)), 0.95)
    shares = [s**2 / 14.0 for s in deviations]
    assert [item.first for item in found.influences] == pytest.approx(shares, abs=0.03)
    assert [item.total for item in found.influences] == pytest.approx(shares, abs=0.03)


def test_elementary_effects_of_a_linear_function_are_its_slopes_over_the_range():
    plan = morris_plan([ranged("x", 0.0, 2.0), ranged("y", -1.0, 1.0), ranged("z", 0.0, 1.0)], 12, 4, seed=1)
    (found,) = plan.sensitivity(table_of(plan, lambda p: (3.0 * p[:, 0] - p[:, 1])[:, None]), 0.95)
    assert [item.mean for item in found.influences] == pytest.approx([6.0, -2.0, 0.0], abs=1e-9)
    assert [item.mean_size for item in found.influences] == pytest.approx([6.0, 2.0, 0.0], abs=1e-9)
    assert [item.deviation for item in found.influences] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_blocks_with_a_failed_run_are_left_out_and_counted():
    plan = sobol_plan([ranged(f"x{i}", -np.pi, np.pi) for i in (1, 2, 3)], 1024, seed=3)
    whole = rows_of(ishigami)

    def some_fail(points: np.ndarray) -> list[Row]:
        failed = points[:, 0] > 3.1
        return [
            Row("diverged", (123.0,), "left") if bad else row
            for bad, row in zip(failed, whole(points), strict=True)
        ]

    table, _ = run_plan(plan, Y, in_threads(some_fail), Watch(), chunk=512)
    (found,) = plan.sensitivity(table, 0.95)
    blocks = np.array([outcome == COMPLETED for outcome in table.outcomes]).reshape(-1, 5).all(axis=1)
    assert plan.blocks == 1024
    assert 0 < found.blocks == blocks.sum() < 1024
    assert found.influences[1].first == pytest.approx(ishigami_indices()[0][1], abs=0.06)


def test_a_constant_figure_has_no_indices():
    plan = sobol_plan([ranged("x", 0.0, 1.0), ranged("y", 0.0, 1.0)], 16, seed=1)
    (found,) = plan.sensitivity(table_of(plan, lambda p: np.ones((len(p), 1))), 0.95)
    assert found.influences == ()
    assert found.blocks == 16
