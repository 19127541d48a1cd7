"""The operations on numbers, arrays and symbols."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import symengine as se
from hypothesis import given
from hypothesis import strategies as st

from mckibben.physics import ops

X = se.Symbol("x")
finite = st.floats(-1e6, 1e6)


def evaluate(expression: object, x: float) -> float:
    """The expression at x, through the machine-code back end that the simulation uses."""
    return float(se.Lambdify([X], [se.sympify(expression)], backend="llvm")(np.array([x]))[0])


@pytest.mark.parametrize("name", ["exp", "log", "sqrt", "sin", "cos", "tan", "arccos", "arcsin", "absolute"])
@pytest.mark.parametrize("x", [0.2, 0.5, 0.9])
def test_functions_agree_on_numbers_arrays_and_symbols(name: str, x: float) -> None:
    function = getattr(ops, name)
    reference = {"arccos": math.acos, "arcsin": math.asin, "absolute": abs}.get(name) or getattr(math, name)
    assert float(function(x)) == pytest.approx(reference(x), rel=1e-15)
    assert function(np.array([x, x])) == pytest.approx([reference(x)] * 2, rel=1e-15)
    assert evaluate(function(X), x) == pytest.approx(reference(x), rel=1e-14)


@given(finite, finite)
def test_maximum_and_minimum(a: float, b: float) -> None:
    assert ops.maximum(a, b) == max(a, b)
    assert ops.minimum(a, b) == min(a, b)


@pytest.mark.parametrize(
    ("function", "reference"),
    [
        (lambda x: ops.maximum(x, 0.25), lambda x: max(x, 0.25)),
        (lambda x: ops.minimum(0.25, x), lambda x: min(x, 0.25)),
        (ops.positive_part, lambda x: max(x, 0.0)),
        (ops.absolute, abs),
        (lambda x: ops.where(ops.greater(x, 0.25), x**2, -x), lambda x: x**2 if x > 0.25 else -x),
        (lambda x: ops.maximum(ops.minimum(x, 0.5), -0.5) ** 2, lambda x: max(min(x, 0.5), -0.5) ** 2),
    ],
)
def test_piecewise_agrees_on_both_sides_of_its_kink(
    function: Callable[[ops.Value], ops.Value], reference: Callable[[float], float]
) -> None:
    points = [-1.0, -0.5, -0.2, 0.0, 0.2, 0.25, 0.5, 1.0]
    expected = [reference(x) for x in points]
    assert function(np.array(points)) == pytest.approx(expected, abs=1e-15)
    assert [float(function(x)) for x in points] == pytest.approx(expected, abs=1e-15)
    symbolic = function(X)
    assert [evaluate(symbolic, x) for x in points] == pytest.approx(expected, abs=1e-15)
    slope = symbolic.diff(X)
    for x in (-1.0, -0.2, 0.1, 0.7):
        by_hand = (reference(x + 1e-6) - reference(x - 1e-6)) / 2e-6
        assert evaluate(slope, x) == pytest.approx(by_hand, abs=1e-9)
        assert float(ops.derivative(function, x)) == pytest.approx(by_hand, abs=1e-9)


def test_where_with_a_plain_condition_and_a_symbol() -> None:
    assert ops.where(True, X, 0.0) is X
    assert ops.where(np.bool_(False), X, 3.0) == 3.0


def test_where_on_numbers_is_what_numpy_gives_and_divides_like_it() -> None:
    for a, b in ((1.5, -2.0), (-0.0, 0.0), (math.nan, 1.0), (np.float64(3.0), 2.0)):
        found = ops.where(ops.greater(a, b), a, b)
        assert np.array_equal(found, np.where(a > b, a, b), equal_nan=True)
        assert isinstance(found, np.float64)
    with np.errstate(divide="ignore"):
        assert 1.0 / ops.positive_part(-1.0) == -math.inf  # a float of Python would raise; 0 * -1 is -0


def test_is_symbolic() -> None:
    assert ops.is_symbolic(X)
    assert ops.is_symbolic(se.Integer(1))
    assert not ops.is_symbolic(1.0)
    assert not ops.is_symbolic(np.ones(2))


def _mixture(x: ops.Value) -> ops.Value:
    return ops.exp(-x) * ops.sin(3.0 * x) + ops.sqrt(1.0 + x**2) / ops.cos(0.3 * x) + ops.log(2.0 + x)


def _mixture_slope(x: float) -> float:
    return (
        math.exp(-x) * (3.0 * math.cos(3.0 * x) - math.sin(3.0 * x))
        + x / math.sqrt(1.0 + x**2) / math.cos(0.3 * x)
        + math.sqrt(1.0 + x**2) * 0.3 * math.sin(0.3 * x) / math.cos(0.3 * x) ** 2
        + 1.0 / (2.0 + x)
    )


def test_derivative_is_exact_on_numbers_arrays_and_symbols() -> None:
    points = np.linspace(-0.9, 0.9, 7)
    expected = [_mixture_slope(x) for x in points]
    assert ops.derivative(_mixture, points) == pytest.approx(expected, rel=1e-14, abs=1e-14)
    assert float(ops.derivative(_mixture, 0.3)) == pytest.approx(_mixture_slope(0.3), rel=1e-14)
    symbolic = ops.derivative(_mixture, X)
    assert [evaluate(symbolic, x) for x in points] == pytest.approx(expected, rel=1e-13, abs=1e-13)


def test_derivative_at_an_expression_is_by_the_argument_not_by_its_symbols() -> None:
    """d/du u^3 at u = 2 x is 3 (2 x)^2 = 12 x^2, without the inner factor 2."""
    assert evaluate(ops.derivative(lambda u: u**3, 2.0 * X), 0.5) == pytest.approx(3.0, rel=1e-14)


def test_derivative_keeps_other_symbols() -> None:
    expression = ops.derivative(lambda u: X * u**2, se.Symbol("y"))
    assert expression == 2 * X * se.Symbol("y")


def test_derivative_of_a_constant() -> None:
    """A constant function has slope 0 on numbers and on symbols."""
    assert ops.derivative(lambda x: 0.0 * x + 7.0, np.array([1.0, 2.0])) == pytest.approx([0.0, 0.0])
    assert ops.derivative(lambda x: 7.0 + 0 * x, X) == 0


def test_derivative_is_elementwise() -> None:
    points = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert ops.derivative(lambda x: x**2, points) == pytest.approx(2.0 * points)


def test_a_derivative_does_not_show_how_many_were_taken_before() -> None:
    """The order of terms, and with it the last digits of a run, follows from the names of symbols."""

    def seen() -> list[str]:
        names: list[str] = []

        def outer(x: ops.Value) -> ops.Value:
            names.append(str(x))
            inner = ops.derivative(lambda u: (names.append(str(u)), u**2 * x)[1], x + 1.0)
            return inner * x

        # d/dx 2 (x + 1) x^2 = 6 x^2 + 4 x: the inner symbol is not taken for the outer one
        assert evaluate(ops.derivative(outer, X), 0.5) == pytest.approx(3.5, rel=1e-14)
        return names

    first = seen()
    assert len(set(first)) == 2
    assert seen() == first
