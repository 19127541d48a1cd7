"""The fit against NIST's certified nonlinear regressions, and its honesty about what it cannot tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.least_squares import fit_report, least_squares_fit
from mckibben.identification.predict.fit_model import Free

# NIST StRD Misra1a: y = b1 (1 - exp(-b2 x)), certified values and standard deviations.
MISRA_Y = [10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78]
MISRA_X = [77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0]
MISRA = {
    "b1": (2.3894212918e02, 2.7070075241e00),
    "b2": (5.5015643181e-04, 7.2668688436e-06),
}


def slopes(residual):
    """Central differences of a residual."""

    def jacobian(b):
        steps = 1e-6 * np.maximum(np.abs(b), 1e-6)
        return np.column_stack([
            (residual(b + step) - residual(b - step)) / (2.0 * step.sum()) for step in np.diag(steps)
        ])  # fmt: skip

    return jacobian


def fitted(residual, choice, **options):
    """A fit whose derivatives are differences."""
    return reported(residual, slopes(residual), choice, **options)


def reported(residual, jacobian, choice, **options):
    """What a fit determines."""
    minimum = least_squares_fit(residual, jacobian, choice, **options)
    return fit_report(minimum.numbers, minimum.jacobian, minimum.residuals, choice)


def free(name: str, start: float, lower: float, upper: float) -> Free:
    return Free(name, start, lower, upper, "1")


@pytest.mark.parametrize("start", [(500.0, 1e-4), (250.0, 5e-4)])
@pytest.mark.parametrize("exact", [True, False])
def test_certified_values_and_standard_errors(start, exact):
    x, y = np.array(MISRA_X), np.array(MISRA_Y)

    def residual(b):
        return b[0] * (1 - np.exp(-b[1] * x)) - y

    def jacobian(b):
        return np.column_stack([1 - np.exp(-b[1] * x), b[0] * x * np.exp(-b[1] * x)])

    choice = [free("b1", start[0], 1.0, 1000.0), free("b2", start[1], 1e-6, 1e-2)]
    result = reported(residual, jacobian if exact else slopes(residual), choice)
    for parameter in result.parameters:
        value, stderr = MISRA[parameter.name]
        assert parameter.value == pytest.approx(value, rel=1e-6)
        assert parameter.stderr == pytest.approx(stderr, rel=1e-4)
    assert result.correlations[0][:2] == ("b1", "b2")
    assert abs(result.correlations[0][2]) > 0.99


def test_parameter_at_its_bound_has_no_error_and_is_named():
    x = np.linspace(0, 1, 20)
    result = fitted(
        lambda b: b[0] * x + b[1] - (3 * x + 1), [free("slope", 1, 0, 2), free("offset", 0, -5, 5)]
    )
    slope = result.parameters[0]
    assert slope.at_bound
    assert slope.stderr is None
    assert any("slope" in message for message in result.messages)


def test_twins_are_said_not_to_be_told_apart():
    x = np.linspace(0, 1, 20)
    noise = np.random.default_rng(1).normal(0, 0.01, 20)
    result = fitted(lambda b: (b[0] + b[1]) * x - (1.3 * x + noise), [free("a", 1, 0, 5), free("b", 1, 0, 5)])
    assert all(parameter.stderr is None for parameter in result.parameters)
    assert any("cannot separate a, b" in message for message in result.messages)


def test_parameter_that_does_nothing_is_named():
    x = np.linspace(0, 1, 20)
    noise = np.random.default_rng(1).normal(0, 0.01, 20)
    for start in (1, 0):  # also at the bound where it is off
        result = fitted(
            lambda b: b[0] * x + 0 * b[1] - (1.3 * x + noise),
            [free("a", 1, 0, 5), replace(free("idle", start, 0, 5), off=0.0)],
        )
        assert result.parameters[0].stderr is not None
        assert result.parameters[1].stderr is None
        assert not result.parameters[1].at_bound
        assert result.messages == ("idle has no effect on the predicted values",)


def test_a_law_that_is_flat_at_the_bound_where_the_data_drive_it_is_at_its_bound():
    """A softness of 0, say: the slope there is 0, and that is no parameter without effect."""
    slopes_there = np.column_stack([np.linspace(0, 1, 20), np.zeros(20)])
    ended = [free("a", 1.3, 0, 5), free("flat", 0.0, 0, 5)]
    result = fit_report(np.array([1.3, 0.0]), slopes_there, np.full(20, 0.1), ended)
    assert [parameter.at_bound for parameter in result.parameters] == [False, True]
    assert result.messages == ("flat ends at its bound",)


def test_more_parameters_than_values_is_said():
    result = fitted(lambda b: np.array([b[0] + b[1] - 3.0]), [free("a", 1, 0, 5), free("b", 1, 0, 5)])
    assert any("cannot determine 2 parameters" in message for message in result.messages)


def test_random_starts_find_the_deeper_of_two_minima_and_repeat():
    def residual(b):
        return np.array([(b[0] - 8.0) * (b[0] - 1.0), 0.3 * (b[0] - 8.0)])

    runs = [fitted(residual, [free("b", 0.5, 0.0, 10.0)], starts=6) for _ in range(2)]
    assert runs[0].numbers == runs[1].numbers
    assert runs[0].numbers[0] == pytest.approx(8.0, abs=1e-6)
