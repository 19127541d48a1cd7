"""The elimination lists solve what numpy solves, and do no more than the structure asks for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mckibben.simulation.integrate.elimination import Plan, plan_of


def solved(plan: Plan, values: np.ndarray, diagonal: float, right: np.ndarray) -> np.ndarray:
    """(diagonal - J) x = right by the lists, in plain Python."""
    a = np.zeros(plan.size)
    a[plan.places] = -values
    a[plan.diagonal] += diagonal
    a[-1] = 1.0
    for pivot, first, last, start, stop in plan.pivots:
        a[pivot] = 1.0 / a[pivot]
        a[plan.lower[first:last]] *= a[pivot]
        for target, below, beside in plan.updates[start:stop]:
            a[target] -= a[below] * a[beside]
    x = right.copy()
    for state, first, last, factor in plan.rows:
        for position, other in plan.terms[first:last]:
            x[state] -= a[position] * x[other]
        x[state] *= a[factor]
    return x


def matrix_of(size: int, entries: list[tuple[int, int]], values: np.ndarray) -> np.ndarray:
    matrix = np.zeros((size, size))
    for (row, column), value in zip(entries, values, strict=True):
        matrix[row, column] = value
    return matrix


@given(st.integers(1, 12), st.integers(0, 2**32 - 1), st.floats(0.0, 1.0))
def test_any_pattern_is_solved_like_numpy_does(size, seed, density):
    random = np.random.default_rng(seed)
    entries = [(i, j) for i in range(size) for j in range(size) if random.random() < density]
    random.shuffle(entries)
    values = random.normal(size=len(entries))
    right = random.normal(size=size)
    diagonal = 2.0 * size  # dominates, so that no pivoting is needed
    expected = np.linalg.solve(diagonal * np.eye(size) - matrix_of(size, entries, values), right)
    assert solved(plan_of(size, entries), values, diagonal, right) == pytest.approx(expected, rel=1e-9)


def test_a_state_that_is_known_is_left_alone():
    entries = [(0, 0), (0, 2), (2, 0)]
    plan = plan_of(3, entries, without=1)
    values, right = np.array([1.0, 2.0, 3.0]), np.array([1.0, 7.0, 1.0])
    x = solved(plan, values, 10.0, right)
    expected = np.linalg.solve(np.array([[9.0, -2.0], [-3.0, 10.0]]), [1.0, 1.0])
    assert x == pytest.approx([expected[0], 7.0, expected[1]])
    assert 1 not in plan.rows[:, 0]


def test_a_chain_needs_no_elimination():
    # A valve drives a muscle, which drives an integral: each block is one state.
    plan = plan_of(3, [(1, 0), (2, 1), (0, 0), (1, 1)])
    assert len(plan.updates) == len(plan.lower) == 0
    assert list(plan.rows[:, 0]) == [0, 1, 2]
    assert len(plan.terms) == 2


def test_arms_around_a_centre_make_no_fill():
    # Creep and friction hang on the speed alone: eliminated first, they only change its diagonal entry.
    arms = range(1, 6)
    entries = [
        (0, 0),
        *((arm, 0) for arm in arms),
        *((0, arm) for arm in arms),
        *((arm, arm) for arm in arms),
    ]
    plan = plan_of(6, entries)
    assert len(plan.updates) == len(arms)
    assert plan.size == len(entries) + 1
