"""Errors of readings: the same minimum as least squares with prior rows, white at the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.fitted_model import refitted
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry
from mckibben.identification.predict.reading_errors import ReadingError, absorbed_errors, reading_weights
from tests.identification.synthetic import MUSCLE, force_map

RANDOM = np.random.default_rng(7)
ROWS, GROUPS = 60, 4
NOISE = 0.7


def errors_of(sigma: float = 1.3) -> list[ReadingError]:
    """One error for each of four groups of fifteen rows."""
    return [
        ReadingError("length", str(group), sigma, "m", np.arange(ROWS) % GROUPS == group)
        for group in range(GROUPS)
    ]


def columns_of(errors: list[ReadingError]) -> np.ndarray:
    """A slope of each row by the error of its group."""
    slope = 1.0 + RANDOM.random(ROWS)
    return np.column_stack([np.where(error.rows, slope, 0.0) for error in errors])


def test_the_minimum_is_that_of_least_squares_with_prior_rows() -> None:
    """Parameters and errors fitted jointly, each error with a row e/sigma, against the weighted residual."""
    errors = errors_of()
    columns, jacobian = columns_of(errors), RANDOM.normal(size=(ROWS, 2))
    measured = RANDOM.normal(size=ROWS) * 3.0
    # Jointly: unknowns (2 parameters, 4 errors); rows over the noise, then one prior row per error.
    joint = np.zeros((ROWS + GROUPS, 2 + GROUPS))
    joint[:ROWS] = np.hstack([jacobian, columns]) / NOISE
    joint[ROWS:, 2:] = np.diag([1.0 / error.sigma for error in errors])
    right = np.concatenate([measured / NOISE, np.zeros(GROUPS)])
    solution = np.linalg.lstsq(joint, right, rcond=None)[0]
    minimum = float(np.sum((right - joint @ solution) ** 2))
    covariance = np.linalg.inv(joint.T @ joint)

    weights = reading_weights(errors, columns, noise=NOISE, floor=0.0)
    assert weights is not None
    own = np.linalg.lstsq(weights(jacobian), weights(measured), rcond=None)[0]
    left = weights(measured) - weights(jacobian) @ own
    assert own == pytest.approx(solution[:2])
    assert float(left @ left) / NOISE**2 == pytest.approx(minimum)
    found = absorbed_errors(errors, columns, measured - jacobian @ own, noise=NOISE, floor=0.0)
    assert [each.value for each in found] == pytest.approx(solution[2:])
    # Without the uncertainty of the parameters the deviation is a little smaller than the joint one.
    joint_deviations = np.sqrt(np.diag(covariance))[2:]
    assert all(
        each.stderr <= deviation * (1.0 + 1e-9)
        for each, deviation in zip(found, joint_deviations, strict=True)
    )


def test_deviations_share_no_common_error() -> None:
    """Least squares over errors that sum to zero, eliminated through a basis of such errors."""
    errors = [replace(error, deviation=True) for error in errors_of()]
    columns, measured = columns_of(errors), RANDOM.normal(size=ROWS) * 3.0
    # A basis of four numbers that sum to zero; the prior e/sigma stays that of the four errors.
    basis = np.linalg.qr(np.column_stack([np.ones(GROUPS), np.eye(GROUPS)[:, 1:]]))[0][:, 1:]
    matrix = np.vstack([columns @ basis / NOISE, basis / errors[0].sigma])
    right = np.concatenate([measured / NOISE, np.zeros(GROUPS)])
    own, *_ = np.linalg.lstsq(matrix, right, rcond=None)
    minimum = float(np.sum((right - matrix @ own) ** 2))
    weights = reading_weights(errors, columns, noise=NOISE, floor=0.0)
    assert weights is not None
    left = weights(measured)
    assert float(left @ left) / NOISE**2 == pytest.approx(minimum)
    found = absorbed_errors(errors, columns, measured, noise=NOISE, floor=0.0)
    assert [each.value for each in found] == pytest.approx(basis @ own)
    assert sum(each.value for each in found) == pytest.approx(0.0, abs=1e-12)


def test_the_weighted_residual_is_white_at_the_truth() -> None:
    """Covariance W (s^2 I + N Sigma N^T) W = s^2 I, by matrix algebra."""
    errors = errors_of()
    columns = columns_of(errors)
    weights = reading_weights(errors, columns, noise=NOISE, floor=0.0)
    assert weights is not None
    matrix = weights(np.eye(ROWS))
    covariance = NOISE**2 * np.eye(ROWS) + columns @ np.diag([e.sigma**2 for e in errors]) @ columns.T
    assert matrix @ covariance @ matrix == pytest.approx(NOISE**2 * np.eye(ROWS), abs=1e-9)


def test_what_other_sensors_may_be_wrong_by_does_not_average_out() -> None:
    """A hundred rows with a common error of a tell no more of e than one row with that error."""
    rows, slope, floor, sigma = 100, 5.0, 2.0, 1.0
    error = ReadingError("length", "", sigma, "m", np.ones(rows, bool))
    columns = np.full((rows, 1), slope)
    (found,) = absorbed_errors([error], columns, np.full(rows, slope * 0.8), noise=1e-9, floor=floor)
    precision = slope**2 / floor**2 + 1.0 / sigma**2
    assert found.stderr == pytest.approx(precision**-0.5)
    assert found.value == pytest.approx(0.8 * (slope**2 / floor**2) / precision)
    assert found.rms == pytest.approx(slope * found.value)


def test_errors_that_change_nothing_need_no_weights() -> None:
    errors = errors_of()
    assert reading_weights(errors, np.zeros((ROWS, GROUPS)), noise=1.0, floor=0.0) is None
    assert absorbed_errors([], np.empty((ROWS, 0)), np.ones(ROWS), noise=1.0, floor=0.0) == []


def test_the_slope_by_a_reading_is_the_derivative_of_the_prediction() -> None:
    predictor = predictor_of(force_map(), MUSCLE)
    model = FitModel(MUSCLE)
    # The ideal force P A0 [a (1-k)^2 - b] by the length: P dA/dL, from the thread length and the turns.
    braid = MUSCLE.braid
    length, pressure = predictor.inputs["length"], predictor.inputs["pressure"]
    area = (3.0 * length**2 - float(braid.thread_length) ** 2) / (4.0 * np.pi * float(braid.turns) ** 2)
    by_length = pressure * 6.0 * length / (4.0 * np.pi * float(braid.turns) ** 2)
    pulling = area > 0.01 * np.max(area)
    assert predictor.input_slope(model, "length")[pulling] == pytest.approx(by_length[pulling], rel=1e-4)
    assert predictor.input_slope(model, "pressure")[pulling] == pytest.approx(area[pulling], rel=1e-4)
    assert not np.any(predictor.input_slope(model, "diameter"))


def test_without_accuracy_nothing_changes() -> None:
    predictor = predictor_of(force_map(), MUSCLE)
    assert predictor.allowing(FitModel(MUSCLE), 1.0) is predictor
    assert predictor.weighted(predictor.measured) == pytest.approx(predictor.measured / predictor.scale)
    geometry = free_geometry(MUSCLE, ["braid_angle"], {})
    assert refitted(predictor, FitModel(MUSCLE), geometry).rmse < 1e-6 * np.max(predictor.measured)
