"""Machine code on rows of lanes: every kind of expression, and exp, log and pow over their whole range."""

from __future__ import annotations

import math

import numpy as np
import pytest
import symengine as se

from mckibben.simulation.integrate.lane_code import lane_code
from mckibben.simulation.integrate.machine_code import machine_code
from tests.simulation.integrate.test_machine_code import EXPRESSIONS, X, Y

WIDTHS = (2, 4, 8)
RANDOM = np.random.default_rng(3)
INFINITE = math.inf


def evaluated(expression, x, y, lanes):
    """An expression at many points, through rows of lanes."""
    function = lane_code({"f": ([X, Y], [expression])}, lanes=lanes)["f"]
    rows = zip(np.reshape(x, (-1, lanes)), np.reshape(y, (-1, lanes)), strict=True)
    return np.concatenate([function(np.array(row))[0] for row in rows])


@pytest.mark.parametrize("lanes", WIDTHS)
def test_every_lane_has_its_own_value(lanes):
    x, y = RANDOM.uniform(0.3, 3.1, 16), RANDOM.uniform(0.4, 2.6, 16)
    functions = lane_code(
        {"f": ([X, Y], [expression for expression, _ in EXPRESSIONS.values()])}, lanes=lanes
    )
    found = np.hstack([functions["f"](np.array([x, y])[:, i : i + lanes]) for i in range(0, 16, lanes)])
    for row, (name, (_, plain)) in zip(found, EXPRESSIONS.items(), strict=True):
        expected = [plain(a, b) for a, b in zip(x.tolist(), y.tolist(), strict=True)]
        assert row == pytest.approx(expected, rel=1e-13), name


@pytest.mark.parametrize("lanes", WIDTHS)
def test_exp_and_log_to_a_few_units_in_the_last_place(lanes):
    x = np.concatenate([RANDOM.uniform(-708.0, 709.0, 4000), RANDOM.uniform(-1e-3, 1e-3, 96)])
    exact = np.exp(x.astype(np.longdouble))
    assert np.max(np.abs(evaluated(se.exp(X), x, x, lanes) / exact - 1)) < 3e-15
    y = np.concatenate([np.exp(RANDOM.uniform(-740.0, 709.0, 4000)), 1.0 + RANDOM.uniform(-1e-3, 1e-3, 96)])
    exact = np.log(y.astype(np.longdouble))
    assert np.max(np.abs(evaluated(se.log(Y), y, y, lanes) / exact - 1)) < 3e-15


@pytest.mark.parametrize("lanes", WIDTHS)
def test_pow_loses_no_more_than_its_exponent_takes(lanes):
    x, y = np.exp(RANDOM.uniform(-20.0, 20.0, 4000)), RANDOM.uniform(-20.0, 20.0, 4000)
    exact = x.astype(np.longdouble) ** y
    size = np.abs(y * np.log(x))
    assert np.all(np.abs(evaluated(X**Y, x, y, lanes) / exact - 1) < 3e-15 + 3e-16 * size)


@pytest.mark.parametrize("lanes", [1, *WIDTHS])
@pytest.mark.parametrize("used", [(), (1,), (0, 1)])
def test_powers_with_an_exponent_of_0_are_1_whatever_they_are_of(lanes, used):
    """Constants of a run are exponents of effects, one for each lane; where all are 0 none is computed."""
    a, b = se.Symbol("c_0"), se.Symbol("c_1")
    logarithms = a * se.log(X) + b * se.log(1 + X**2)
    expressions = [X**a, se.exp(logarithms), a * X ** (a - 1), se.exp(logarithms) * X + X**a, se.exp(X * a)]
    x = np.linspace(0.5, 3.0, lanes)
    constants = np.zeros((2, lanes))
    for number in used:
        constants[number, -1] = 0.7 + number  # in one of the lanes
    if not used:
        x[0] = 0.0  # of which there is no logarithm
    code = {"f": ([X, a, b], expressions)}
    given = np.vstack([x, constants])
    if lanes == 1:
        found = machine_code(code)["f"](given[:, 0])[:, None]
    else:
        found = lane_code(code, lanes=lanes)["f"](given)
    p, q = constants
    power = x**p * (1.0 + x**2) ** q
    derived = np.divide(p * x**p, x, out=np.zeros(lanes), where=p != 0.0)
    expected = [x**p, power, derived, power * x + x**p, np.exp(x * p)]
    assert found == pytest.approx(np.array(expected), rel=1e-13)


QUOTIENTS = [X / Y, se.sqrt(se.Abs(X)), Y / X, se.sqrt(se.Abs(Y)), 1 / X]
BOTH_ORDERS = (QUOTIENTS, QUOTIENTS[1:] + QUOTIENTS[:1])


def quotients(x, y, lanes, expressions):
    function = lane_code({"f": ([X, Y], expressions)}, lanes=lanes)["f"]
    rows = np.array([x, y])
    found = np.hstack([function(rows[:, i : i + lanes]) for i in range(0, len(x), lanes)])
    with np.errstate(all="ignore"):
        plain = [x / y, np.sqrt(np.abs(x)), y / x, np.sqrt(np.abs(y)), 1 / x]
    return zip(found, [plain[QUOTIENTS.index(expression)] for expression in expressions], strict=True)


@pytest.mark.parametrize("expressions", BOTH_ORDERS)
@pytest.mark.parametrize("lanes", WIDTHS)
def test_quotients_and_roots_to_the_last_places(lanes, expressions):
    x, y = np.exp(RANDOM.uniform(-340.0, 340.0, (2, 4000))) * RANDOM.choice([-1.0, 1.0], (2, 4000))
    for found, exact in quotients(x, y, lanes, expressions):
        assert np.max(np.abs(found / exact - 1)) < 7e-16


@pytest.mark.parametrize("expressions", BOTH_ORDERS)
@pytest.mark.parametrize("lanes", WIDTHS)
def test_quotients_and_roots_of_zero_and_infinity(lanes, expressions):
    x = np.array([0.0, 0.0, 1.0, -1.0, 1.0, INFINITE, INFINITE, math.nan])
    y = np.array([0.0, 1.0, 0.0, 0.0, INFINITE, 1.0, -2.0, 1.0])
    for found, exact in quotients(x, y, lanes, expressions):
        np.testing.assert_allclose(found, exact, rtol=5e-16)


@pytest.mark.parametrize("first", [True, False])
@pytest.mark.parametrize("lanes", WIDTHS)
def test_roots_of_negative_and_subnormal_numbers(lanes, first):
    order = [se.sqrt(X), se.sqrt(Y)] if first else [se.sqrt(Y), se.sqrt(X)]
    function = lane_code({"f": ([X, Y], order)}, lanes=lanes)["f"]
    x = [-1.0, 5e-324, -INFINITE, -0.0, 2e-310, 4.0, 0.0, -5e-324]
    found = np.hstack([function(np.array([x, x])[:, i : i + lanes]) for i in range(0, 8, lanes)])
    with np.errstate(all="ignore"):
        np.testing.assert_allclose(found, [np.sqrt(x)] * 2, rtol=5e-16)


SPECIAL = {
    "exp": (
        se.exp(X),
        [0.0, INFINITE, -INFINITE, math.nan, 710.0, -746.0, -745.0, 1.0],
        [1.0, INFINITE, 0.0, math.nan, INFINITE, 0.0, 5e-324, math.e],
    ),
    "log": (
        se.log(X),
        [1.0, 0.0, -1.0, INFINITE, -INFINITE, math.nan, 5e-324, math.e],
        [0.0, -INFINITE, math.nan, INFINITE, math.nan, math.nan, math.log(5e-324), 1.0],
    ),
}


@pytest.mark.parametrize("name", SPECIAL)
@pytest.mark.parametrize("lanes", WIDTHS)
def test_special_values(name, lanes):
    expression, x, expected = SPECIAL[name]
    assert evaluated(expression, x, x, lanes) == pytest.approx(expected, rel=1e-15, nan_ok=True)


@pytest.mark.parametrize("lanes", WIDTHS)
def test_special_powers_are_those_of_the_c_library(lanes):
    pairs = [(x, y) for x in (-2.0, 0.0, 0.5, 1.0, INFINITE) for y in (-3.0, -0.5, 0.0, 0.5, 2.0, 3.0)]
    x, y = np.array([*pairs, (1.0, 1.0), (1.0, 1.0)]).T
    with np.errstate(all="ignore"):
        expected = np.abs(x) ** y * np.where((x < 0) & (y % 2 == 1), -1.0, 1.0)
        expected[(x < 0) & (y % 1 != 0)] = np.nan
    assert evaluated(X**Y, x, y, lanes) == pytest.approx(expected, rel=1e-14, nan_ok=True)


def test_rows_of_another_shape_are_refused():
    function = lane_code({"f": ([X, Y], [X * Y])}, lanes=4)["f"]
    with pytest.raises(ValueError, match=r"\(2, 4\)"):
        function(np.zeros((2, 8)))
