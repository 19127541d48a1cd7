"""Piecewise cubics against scipy's, with their derivatives and integrals."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, PchipInterpolator

from mckibben.physics.pieces import monotone, spline

ROWS = {
    2: ([0.0, 0.7], [1.0, 3.0]),
    3: ([-1.0, 0.2, 1.5], [2.0, 2.5, 0.1]),
    6: ([-1.2, -0.7, -0.1, 0.3, 1.1, 1.4], [0.01, 0.03, 0.028, 0.04, 0.04, 0.02]),
}


@pytest.mark.parametrize("rows", ROWS)
@pytest.mark.parametrize(("own", "theirs"), [(monotone, PchipInterpolator), (spline, CubicSpline)])
def test_values_slopes_and_integrals(rows: int, own: object, theirs: object) -> None:
    x, y = (np.array(values) for values in ROWS[rows])
    mine, other = own(x=x, y=y), theirs(x, y)  # type: ignore[operator]
    at = np.linspace(x[0], x[-1], 41)
    assert mine(at) == pytest.approx(other(at), abs=1e-13)
    assert mine.derivative()(at) == pytest.approx(other.derivative()(at), abs=1e-12)
    assert mine.derivative().derivative()(at[1:-1]) == pytest.approx(other.derivative(2)(at[1:-1]), abs=1e-11)
    assert mine.integral()(at) == pytest.approx(other.antiderivative()(at), abs=1e-13)
    assert float(mine(float(at[7]))) == pytest.approx(float(other(at[7])))
