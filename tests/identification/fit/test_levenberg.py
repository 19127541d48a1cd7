"""The bounded minimiser against certified problems, scipy's solver and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from mckibben.identification.fit.levenberg import minimise


def linear(seed: int, rows: int = 30, numbers: int = 6):
    draw = np.random.default_rng(seed)
    matrix = draw.normal(size=(rows, numbers)) * np.array([1.0, 1e3, 1e-4, 1.0, 10.0, 1e5])
    return matrix, draw.normal(size=rows)


@pytest.mark.parametrize("seed", range(12))
def test_a_linear_problem_within_bounds_ends_where_scipys_active_set_does(seed):
    matrix, right = linear(seed)
    size = 1.0 / np.linalg.norm(matrix, axis=0)
    low, high = -0.3 * size, 0.5 * size
    start = np.where(np.arange(6) % 2, low, high)  # on the bounds
    found = minimise(
        lambda x: matrix @ x - right, lambda x: matrix, start, low, high, tolerance=1e-14, evaluations=100
    )
    other = lsq_linear(matrix, right, bounds=(low, high), method="bvls", tol=1e-14)
    assert found.squares == pytest.approx(2.0 * other.cost, rel=1e-9)
    np.testing.assert_allclose(found.numbers * 1.0 / size, other.x / size, atol=1e-5)


def test_a_start_on_a_bound_that_pushes_back_does_not_hold_the_others():
    x = np.linspace(0.0, 1.0, 50)

    def residual(b):  # the second number wants to be negative, the others are far away
        return b[0] * np.exp(-b[2] * x) + b[1] * x - (2.0 * np.exp(-5.0 * x) - 0.1 * x)

    def jacobian(b):
        decay = np.exp(-b[2] * x)
        return np.column_stack([decay, x, -b[0] * x * decay])

    found = minimise(
        residual,
        jacobian,
        np.array([1.0, 0.0, 1.0]),
        np.zeros(3),
        np.array([10.0, 1.0, 50.0]),
        tolerance=1e-12,
        evaluations=100,
    )
    assert found.numbers[1] == 0.0
    slope = jacobian(found.numbers).T @ residual(found.numbers)
    assert slope[1] > 0.0  # Karush-Kuhn-Tucker: it would fall only outside
    np.testing.assert_allclose(slope[[0, 2]], 0.0, atol=1e-6)


def test_a_bound_is_left_again():
    matrix = np.array([[1.0, 0.999], [0.0, 0.05], [0.0, 0.0]])
    right = np.array([1.0, 0.05, 0.0])  # solved by (0.001, 1)
    found = minimise(
        lambda x: matrix @ x - right,
        lambda x: matrix,
        np.array([0.0, 0.0]),
        np.zeros(2),
        np.ones(2),
        tolerance=1e-15,
        evaluations=200,
    )
    np.testing.assert_allclose(found.numbers, [0.001, 1.0], atol=1e-6)


def test_rosenbrocks_valley_is_followed_to_its_end():
    found = minimise(
        lambda x: np.array([10.0 * (x[1] - x[0] ** 2), 1.0 - x[0]]),
        lambda x: np.array([[-20.0 * x[0], 10.0], [-1.0, 0.0]]),
        np.array([-1.2, 1.0]),
        np.full(2, -5.0),
        np.full(2, 5.0),
        tolerance=1e-14,
        evaluations=200,
    )
    np.testing.assert_allclose(found.numbers, 1.0, atol=1e-6)


def test_a_number_that_changes_nothing_stays_and_evaluations_are_counted():
    calls = []

    def residual(x):
        calls.append(1)
        return np.array([np.exp(x[0]) - 3.0, 0.0])

    found = minimise(
        residual,
        lambda x: np.array([[np.exp(x[0]), 0.0], [0.0, 0.0]]),
        np.array([0.0, 0.25]),
        np.full(2, -5.0),
        np.full(2, 5.0),
        tolerance=1e-15,
        evaluations=20,
    )
    assert found.numbers[1] == pytest.approx(0.25)
    assert found.numbers[0] == pytest.approx(np.log(3.0), rel=1e-6)
    assert len(calls) <= 20


def test_secants_reach_the_same_minimum_with_fewer_derivatives():
    x = np.linspace(0.0, 1.0, 60)
    data = 2.0 * np.exp(-5.0 * x) + 0.3 * np.sin(7.0 * x + 0.4)
    asked = []

    def residual(b):
        return b[0] * np.exp(-b[1] * x) + b[2] * np.sin(b[3] * x + b[4]) - data

    def jacobian(b):
        asked.append(b)
        decay, angle = np.exp(-b[1] * x), b[3] * x + b[4]
        wave = b[2] * np.cos(angle)
        return np.column_stack([decay, -b[0] * x * decay, np.sin(angle), x * wave, wave])

    start, low, high = np.array([1.0, 3.0, 0.2, 6.0, 0.0]), np.zeros(5), np.full(5, 20.0)
    counts = []
    for secants in (0, 2):
        asked.clear()
        found = minimise(
            residual, jacobian, start, low, high, tolerance=1e-12, evaluations=200, secants=secants
        )
        counts.append(len(asked))
        np.testing.assert_allclose(found.numbers, [2.0, 5.0, 0.3, 7.0, 0.4], rtol=1e-5)
        # The derivatives at the end are exact whatever the steps were.
        np.testing.assert_allclose(found.jacobian, jacobian(found.numbers), rtol=1e-12)
    assert counts[1] < counts[0]
