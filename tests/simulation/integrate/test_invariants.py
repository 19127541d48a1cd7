"""What stays the same is taken out, and nothing changes by it."""

from __future__ import annotations

import math

import pytest
import symengine as se

from mckibben.simulation.integrate.invariants import Invariants

X, Y, A, B = se.symbols("x y a b")
EXPRESSIONS = [
    se.tan(A) * X + se.cos(A) / B * Y,
    (A + B + X) ** 2 * A * B,
    se.exp(-X / A) + A**B,
    se.Piecewise((A * X, X > A * B), (B, True)),
    se.Piecewise((X, A > B), (Y, True)),
    se.Piecewise((X, se.And(A > B, X > B**2)), (A + 1, True)),
    A * B + 1,
    A,
    X,
    se.Integer(4),
]


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
@pytest.mark.parametrize("point", [(0.3, 1.1, 0.4, 0.7), (2.0, -0.5, 1.3, 0.2)])
def test_the_value_stays(expression, point):
    invariants = Invariants([A, B])
    (rewritten,) = invariants.without([expression])
    numbers = dict(zip((X, Y, A, B), point, strict=True))
    fixed = {symbol: part.subs(numbers) for part, symbol in invariants.values.items()}
    assert rewritten.free_symbols <= {X, Y, *fixed}
    found = float(rewritten.subs({**fixed, X: point[0], Y: point[1]}))
    assert found == pytest.approx(float(expression.subs(numbers)), rel=1e-14)


def test_the_largest_constant_part_becomes_one_symbol():
    invariants = Invariants([A, B])
    rewritten = invariants.without([se.tan(A) * B * X, X + se.tan(A) * B])
    assert list(invariants.values) == [se.tan(A) * B]
    (symbol,) = invariants.values.values()
    assert rewritten == [symbol * X, X + symbol]


def test_plain_numbers_stay():
    invariants = Invariants([A])
    assert invariants.without([2 * X + math.pi]) == [2 * X + math.pi]
    assert invariants.values == {}
