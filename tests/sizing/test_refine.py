"""The simplex search in rounds against scipy's, point by point."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import minimize, rosen

from mckibben.sizing.refine import simplex_search


def bent(x: np.ndarray) -> float:
    """A valley with a kink, as a limit makes it."""
    return abs(x[0] - 0.3) + 2.0 * max(0.0, x[1] - 0.1) + (x[1] + x[0]) ** 2


def wavy(x: np.ndarray) -> float:
    """Many small minima: contractions and shrinking."""
    return float(np.sum(x**2) + 0.3 * np.sum(np.sin(25.0 * x)))


@pytest.mark.parametrize("function", [rosen, bent, wavy])
@pytest.mark.parametrize("most", [2, 4, 7, 32, 33, 34, 35, 400])
def test_the_points_are_those_of_scipy(function: Callable[[np.ndarray], float], most: int) -> None:
    simplex = np.array([[-1.2, 1.0], [-0.9, 1.1], [-1.25, 0.6]])
    theirs: list[np.ndarray] = []

    def cost(x: np.ndarray) -> float:
        theirs.append(x.copy())
        return function(x)

    options = {"maxfev": most, "initial_simplex": simplex, "xatol": 1e-3, "fatol": 1e-3}
    minimize(cost, simplex[0], method="Nelder-Mead", options=options)
    ours: list[np.ndarray] = []
    rounds = simplex_search(simplex, most=most, near=1e-3, alike=1e-3)
    try:
        wanted = next(rounds)
        while True:
            ours += wanted
            wanted = rounds.send([function(x) for x in wanted])
    except StopIteration:
        pass
    assert len(ours) == len(theirs) <= most
    assert np.allclose(ours, theirs, rtol=0.0, atol=1e-12)
