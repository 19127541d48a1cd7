"""The pattern search in rounds: minima of known place, along edges too, and its number of points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from mckibben.sizing.refine import pattern_search


def bowl(x: np.ndarray) -> float:
    return (x[0] - 0.31) ** 2 + 3.0 * (x[1] + 0.42) ** 2


def walled(x: np.ndarray) -> float:
    """Less x + y is better; beyond the edge x y = 1/4 the cost jumps. The least is 1, at (0.5, 0.5)."""
    return float(x[0] + x[1] if x[0] * x[1] >= 0.25 else 30.0)


def searched(
    function: Callable[[np.ndarray], float], begin: list[float], most: int = 400
) -> tuple[list[np.ndarray], float]:
    """All points, and the least cost."""
    points: list[np.ndarray] = []
    rounds = pattern_search(np.array(begin), np.array([0.12, 0.2]), most=most, near=1e-3)
    try:
        wanted = next(rounds)
        while True:
            points += wanted
            wanted = rounds.send([function(x) for x in wanted])
    except StopIteration:
        return points, min(function(x) for x in points)


@pytest.mark.parametrize("begin", [[0.0, 0.0], [1.0, 1.0], [-0.7, 0.4]])
def test_a_minimum_is_found(begin: list[float]) -> None:
    points, least = searched(bowl, begin)
    assert least < 1e-5
    assert np.min(np.hypot(*(np.array(points) - [0.31, -0.42]).T)) < 2e-3


@pytest.mark.parametrize("begin", [[0.9, 0.6], [0.4, 1.1], [1.5, 1.5]])
def test_the_least_is_found_along_an_edge_of_what_is_allowed(begin: list[float]) -> None:
    assert searched(walled, begin)[1] == pytest.approx(1.0, abs=3e-3)


def test_it_ends_after_so_many_points() -> None:
    for most in (1, 8, 9, 33):
        assert len(searched(bowl, [5.0, 5.0], most)[0]) <= most
