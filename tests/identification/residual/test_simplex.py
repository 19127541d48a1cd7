"""The search by a simplex: known minima, and the steps of another implementation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from scipy.optimize import minimize

from mckibben.identification.residual.simplex import lowest

CORNERS = [[-1.2, 1.0], [-0.9, 1.0], [-1.2, 1.2]]


def valley(place: Sequence[float]) -> float:
    """Rosenbrock's, 0 at (1, 1)."""
    x, y = place
    return (1.0 - x) ** 2 + 100.0 * (y - x * x) ** 2


def test_the_end_of_a_curved_valley_is_found() -> None:
    assert lowest(valley, CORNERS, 400) == pytest.approx([1.0, 1.0], abs=1e-3)


@pytest.mark.parametrize("most", [20, 45, 80])
def test_it_goes_the_way_of_the_published_method(most: int) -> None:
    options = {"maxfev": most, "initial_simplex": np.array(CORNERS)}
    other = minimize(valley, CORNERS[0], method="Nelder-Mead", options=options)
    assert lowest(valley, CORNERS, most) == pytest.approx(other.x.tolist(), rel=1e-9)


def test_a_place_without_a_value_is_left() -> None:
    def half(place: Sequence[float]) -> float:
        return abs(place[0] - 1.0) if place[0] > 0.0 else np.inf

    assert lowest(half, [[-0.5], [0.5]], 60) == pytest.approx([1.0], abs=1e-3)
