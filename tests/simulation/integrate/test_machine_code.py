"""Machine code of every kind of expression against the same mathematics in Python."""

from __future__ import annotations

import math

import numpy as np
import pytest
import symengine as se
from hypothesis import given
from hypothesis import strategies as st

from mckibben.simulation.integrate.machine_code import machine_code

X, Y = se.symbols("x y")
EXPRESSIONS = {
    "sum": (X + 2 * Y - 3, lambda x, y: x + 2 * y - 3),
    "quotients": (X / Y / 7 + Y**-3 / X**2, lambda x, y: x / y / 7 + y**-3 / x**2),
    "only below": (1 / (X * Y), lambda x, y: 1 / (x * y)),
    "whole powers": (X**2 + X**5 + X**-4 + X**31, lambda x, y: x**2 + x**5 + x**-4 + x**31),
    "large power": (X**40, lambda x, y: x**40),
    "roots": (se.sqrt(X) + Y**1.5 + X**-0.5, lambda x, y: math.sqrt(x) + y**1.5 + x**-0.5),
    "other powers": (X**0.2 + X**Y, lambda x, y: x**0.2 + x**y),
    "exponentials": (se.exp(-X) + se.log(Y), lambda x, y: math.exp(-x) + math.log(y)),
    "circular": (
        se.sin(X) + se.cos(Y) + se.tan(X / 2),
        lambda x, y: math.sin(x) + math.cos(y) + math.tan(x / 2),
    ),
    "inverse": (
        se.asin(X / 9) + se.acos(Y / 9) + se.atan(X),
        lambda x, y: math.asin(x / 9) + math.acos(y / 9) + math.atan(x),
    ),
    "hyperbolic": (
        se.sinh(X) + se.cosh(Y) + se.tanh(X),
        lambda x, y: math.sinh(x) + math.cosh(y) + math.tanh(x),
    ),
    "constants": (se.pi * X + se.E + se.Rational(1, 3), lambda x, y: math.pi * x + math.e + 1 / 3),
    "a constant alone": (se.Integer(5), lambda x, y: 5.0),
    "absolute": (se.Abs(X - Y), lambda x, y: abs(x - y)),
    "extremes": (se.Max(X, Y, 2) - se.Min(X, Y), lambda x, y: max(x, y, 2) - min(x, y)),
    "branches": (
        se.Piecewise((X, X < 1), (Y, X <= 2), (X * Y, True)),
        lambda x, y: x if x < 1 else y if x <= 2 else x * y,
    ),
    "conditions": (
        se.Piecewise((1, se.And(X > 1, se.Or(Y > 2, X > 3))), (2, se.Not(se.And(X > 1, Y > 1))), (3, True)),
        lambda x, y: 1 if x > 1 and (y > 2 or x > 3) else 2 if not (x > 1 and y > 1) else 3,
    ),
    "shared condition": (
        se.Piecewise((X, X > Y), (Y, True)) * se.Piecewise((1, X > Y), (-1, True)),
        lambda x, y: x if x > y else -y,
    ),
}


@pytest.mark.parametrize("level", [0, 1])
@pytest.mark.parametrize("name", EXPRESSIONS)
def test_an_expression_has_its_value(name, level):
    expression, plain = EXPRESSIONS[name]
    function = machine_code({"f": ([X, Y], [expression])}, level=level)["f"]
    for x in (0.3, 1.0, 1.7, 3.1):
        for y in (0.4, 1.7, 2.6):
            assert function(np.array([x, y]))[0] == pytest.approx(plain(x, y), rel=1e-13)


def test_all_expressions_at_once_and_arguments_in_their_order():
    functions = machine_code(
        {
            "forward": ([X, Y], [expression for expression, _ in EXPRESSIONS.values()]),
            "backward": ([Y, X], [expression for expression, _ in EXPRESSIONS.values()]),
        }
    )
    expected = [plain(0.6, 1.2) for _, plain in EXPRESSIONS.values()]
    assert functions["forward"](np.array([0.6, 1.2])) == pytest.approx(expected, rel=1e-13)
    assert functions["backward"](np.array([1.2, 0.6])) == pytest.approx(expected, rel=1e-13)
    assert functions["forward"].width == len(EXPRESSIONS)


@given(st.floats(-1e300, 1e300))
def test_numbers_keep_every_bit(value):
    assert machine_code({"f": ([X], [se.RealDouble(value) + 0 * X])})["f"](np.zeros(1))[0] == value


def test_a_branch_that_does_not_exist_there_does_no_harm():
    root = se.Piecewise((se.sqrt(X), X > 0), (0, True))
    assert machine_code({"f": ([X], [root, root.diff(X)])})["f"](np.array([-4.0])).tolist() == [0.0, 0.0]


def test_too_few_arguments_are_refused():
    function = machine_code({"f": ([X, Y], [X * Y])})["f"]
    with pytest.raises(ValueError, match="2 arguments"):
        function(np.zeros(1))


def test_what_has_no_machine_code_is_refused():
    with pytest.raises(NotImplementedError, match="erf"):
        machine_code({"f": ([X], [se.erf(X)])})
