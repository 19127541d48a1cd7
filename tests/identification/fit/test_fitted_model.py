"""A fitted model: errors on what was left out against refits, bounds, standard errors of textbooks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.fitted_model import FittedModel, counts, refitted
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, Free, free_geometry, free_numbers
from tests.identification.synthetic import CATALOGUE, MUSCLE, force_map, linear_node

ROWS = 90
RANDOM = np.random.default_rng(11)
X = RANDOM.uniform(0.0, 1.0, ROWS)
DESIGN = np.column_stack([np.ones(ROWS), X, X**2])
MEASURED = DESIGN @ [2.0, -1.0, 3.0] + RANDOM.normal(0.0, 0.2, ROWS)
#: Folds of unequal size, and another way of folding.
FOLDS = (np.repeat([0, 1, 2, 3], [10, 20, 30, 30]), np.minimum((X * 5).astype(int), 4))


def left_out(design: np.ndarray, measured: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """Mean square of each fold under a fit of the others."""
    found = []
    for label in np.unique(labels):
        out = labels == label
        numbers = np.linalg.lstsq(design[~out], measured[~out], rcond=None)[0]
        found.append(float(np.mean((measured[out] - design[out] @ numbers) ** 2)))
    return np.array(found)


def test_left_out_folds_are_those_of_refits_for_a_linear_model():
    fitted_model = linear_node(MEASURED, DESIGN, FOLDS)
    for labels, squares in zip(FOLDS, fitted_model.fold_squares, strict=True):
        assert squares == pytest.approx(left_out(DESIGN, MEASURED, labels), rel=1e-8)
    first = FOLDS[0]
    whole = np.average(left_out(DESIGN, MEASURED, first), weights=np.unique(first, return_counts=True)[1])
    assert fitted_model.holdout_rmse == pytest.approx(np.sqrt(whole), rel=1e-8)
    assert fitted_model.holdout_rmse > fitted_model.rmse


def test_units_of_the_numbers_do_not_matter():
    small = linear_node(MEASURED, DESIGN, FOLDS)
    factors = np.array([1e-7, 1.0, 1e6])
    large = linear_node(MEASURED, DESIGN * factors, FOLDS, [(-1e3 / f, 1e3 / f) for f in factors])
    assert large.fold_squares[0] == pytest.approx(small.fold_squares[0], rel=1e-8)


def test_leave_one_out_is_the_press_statistic():
    """Allen's PRESS: the residual over one minus its leverage."""
    fitted_model = linear_node(MEASURED, DESIGN, [np.arange(ROWS)])
    hat = DESIGN @ np.linalg.inv(DESIGN.T @ DESIGN) @ DESIGN.T
    press = fitted_model.residual / (1.0 - np.diag(hat))
    assert fitted_model.fold_squares[0] == pytest.approx(press**2, rel=1e-8)


def test_without_numbers_what_is_left_out_is_the_residual():
    fitted_model = linear_node(MEASURED, np.empty((ROWS, 0)), FOLDS)
    expected = [np.mean(MEASURED[FOLDS[0] == label] ** 2) for label in range(4)]
    assert fitted_model.fold_squares[0] == pytest.approx(expected)
    assert fitted_model.holdout_rmse == pytest.approx(np.sqrt(np.mean(MEASURED**2)))
    assert fitted_model.implausible == 0
    assert fitted_model.standard_errors == []


def test_numbers_stay_within_their_bounds_when_a_fold_is_left_out():
    """An outlier pulls the mean; without it the mean could go no lower than its bound."""
    measured = np.array([1.0, 1.0, 1.0, 1.0, 9.0, 9.0])
    labels = np.array([0, 0, 1, 1, 2, 2])
    fitted_model = linear_node(measured, np.ones((6, 1)), [labels], [(3.0, 20.0)])
    assert fitted_model.free[0].start == pytest.approx(11.0 / 3.0)
    assert fitted_model.fold_squares[0][2] == pytest.approx((9.0 - 3.0) ** 2)  # not (9 - 1)^2
    assert fitted_model.fold_squares[0][0] == pytest.approx((1.0 - 5.0) ** 2)


def test_a_number_that_one_fold_alone_knows_is_off_without_it():
    """Only fold 2 sees the second number: nobody would know of it, so the fold is predicted without."""
    labels = np.repeat([0, 1, 2], 20)
    seen = np.where(labels == 2, 1.0, 0.0)
    measured = 1.0 + 4.0 * seen + RANDOM.normal(0.0, 0.01, 60)
    fitted_model = linear_node(measured, np.column_stack([np.ones(60), seen]), [labels], [(-10, 10)] * 2)
    free = (fitted_model.free[0], replace(fitted_model.free[1], lower=0.0, upper=100.0, off=0.0))
    fitted_model = replace(fitted_model, free=free)
    assert np.sqrt(fitted_model.fold_squares[0][2]) == pytest.approx(4.0, rel=1e-2)
    assert np.sqrt(fitted_model.fold_squares[0][0]) < 0.02


def test_a_scale_moves_by_its_logarithm_when_a_fold_is_left_out():
    """Fold 1 knows a little of a time and pulls it up: by its logarithm to the bound it goes 4.6 times, along
    the slope it would go a hundred times as far as the slope holds.
    """
    slopes = np.array([1.0, 1.0, 0.01, 0.01])
    residual = np.array([-0.05, -0.05, 5.0, 5.0])  # at the minimum: no slope of the whole
    time = Free("time", 1.0, 0.01, 100.0, "s")
    fold = [np.array([0, 0, 1, 1])]
    fitted_model = replace(linear_node(residual, slopes[:, None], fold), free=(time,), residual=residual)
    left_out = np.sqrt(fitted_model.fold_squares[0][0])
    assert left_out == pytest.approx(0.05 + np.log(100.0))
    downwards = replace(fitted_model, residual=-residual)  # no farther than the bound along the slope
    assert np.sqrt(downwards.fold_squares[0][0]) == pytest.approx(0.05 + 0.99)
    narrow = replace(fitted_model, free=(replace(time, lower=0.5, upper=10.0),))
    assert np.sqrt(narrow.fold_squares[0][0]) == pytest.approx(0.05 + 9.0)


def test_standard_errors_are_those_of_the_textbook():
    fitted_model = linear_node(MEASURED, DESIGN, FOLDS)
    variance = fitted_model.residual @ fitted_model.residual / (ROWS - 3)
    expected = np.sqrt(variance * np.diag(np.linalg.inv(DESIGN.T @ DESIGN)))
    assert fitted_model.standard_errors == pytest.approx(expected.tolist(), rel=1e-6)
    # In other units, as the moduli and lengths of a model are: 1e9 of one for 1e-9 of another.
    units = np.array([1e-9, 1.0, 1e9])
    free = tuple(
        replace(p, start=p.start / unit, lower=p.lower / unit, upper=p.upper / unit)
        for p, unit in zip(fitted_model.free, units, strict=True)
    )
    other = replace(fitted_model, free=free, jacobian=fitted_model.jacobian * units)
    assert np.array(other.standard_errors) * units == pytest.approx(expected, rel=1e-6)


def with_free(fitted_model: FittedModel, *changes: dict) -> FittedModel:
    return replace(
        fitted_model, free=tuple(replace(p, **c) for p, c in zip(fitted_model.free, changes, strict=True))
    )


def test_numbers_at_bounds_and_numbers_that_do_nothing():
    fitted_model = linear_node(MEASURED, DESIGN, FOLDS)
    starts = [p.start for p in fitted_model.free]
    plain: list[dict] = [{}, {}, {}]
    assert not fitted_model.at_bound.any()
    assert fitted_model.implausible == 0
    bounded = with_free(fitted_model, {"lower": starts[0]}, *plain[1:])
    assert bounded.at_bound.tolist() == [True, False, False]
    assert bounded.inner.tolist() == [1, 2]
    assert bounded.implausible == 1
    # Where it does nothing is no bound of what is plausible.
    off = with_free(fitted_model, {"lower": starts[0], "off": starts[0]}, *plain[1:])
    assert off.idle.tolist() == [True, False, False]
    assert not off.at_bound.any()
    assert off.implausible == 0


def test_numbers_that_stand_in_for_each_other_are_implausible():
    twin = np.column_stack([DESIGN, DESIGN[:, 1] * (1.0 + 1e-4 * RANDOM.normal(size=ROWS))])
    fitted_model = linear_node(MEASURED, twin, FOLDS)
    assert fitted_model.implausible == 1
    assert fitted_model.standard_errors == [None] * 4


def test_numbers_that_the_data_do_not_see_take_no_part():
    blind = np.column_stack([DESIGN, np.zeros(ROWS)])
    fitted_model = linear_node(MEASURED, blind, FOLDS)
    assert fitted_model.inner.tolist() == [0, 1, 2]
    assert fitted_model.fold_squares[0] == pytest.approx(left_out(DESIGN, MEASURED, FOLDS[0]), rel=1e-8)


def test_counts_are_in_the_order_of_the_labels():
    assert counts(np.array([3, 1, 3, 7, 3, 1])).tolist() == [2, 3, 1]


def test_a_fit_of_a_subject_finds_what_was_hidden():
    predictor = predictor_of(force_map(c10=0.5e6, prestress=40.0, angle=26.0), MUSCLE)
    chosen = tuple(CATALOGUE[name] for name in ("bladder_elasticity", "prestress"))
    start = FitModel(MUSCLE, chosen, {e.id: e.defaults for e in chosen})
    geometry = free_geometry(MUSCLE, ["braid_angle"], {})
    fitted_model = refitted(predictor, start, free_numbers(start, geometry), freed=["prestress.force"])
    assert fitted_model.rmse < 1e-3
    assert fitted_model.fit_model.values["bladder_elasticity"]["shear_modulus"] == pytest.approx(
        0.5e6, rel=1e-4
    )
    assert fitted_model.fit_model.values["prestress"]["force"] == pytest.approx(40.0, rel=1e-4)
    assert np.degrees(fitted_model.fit_model.muscle.braid_angle) == pytest.approx(26.0, abs=1e-4)
    assert [p.start for p in fitted_model.free] == [
        fitted_model.fit_model.number(p.name) for p in fitted_model.free
    ]
    assert fitted_model.key == (
        frozenset({"bladder_elasticity", "prestress"}),
        frozenset({"prestress.force"}),
    )
    assert start.values["prestress"]["force"] == 110.0  # the start model is as it was


def test_nothing_free_is_the_model_as_it_is():
    predictor = predictor_of(force_map(prestress=40.0), MUSCLE)
    fitted_model = refitted(predictor, FitModel(MUSCLE), ())
    assert fitted_model.residual == pytest.approx(np.full(60, -40.0), abs=1e-7)
    assert fitted_model.rmse == pytest.approx(40.0)
    assert fitted_model.free == ()


def test_a_magnitude_that_matters_is_a_hundredth_of_the_range():
    assert Free("x.b", 1.0, -50.0, 50.0, "N").typical == 1.0


def test_numbers_that_the_data_cannot_separate_have_no_standard_error():
    """A third column is the sum of two others, to rounding; a number that does nothing is none of them."""
    design = np.column_stack([DESIGN[:, :2], DESIGN[:, 0] + DESIGN[:, 1]])
    node = linear_node(MEASURED, design, FOLDS)
    assert node.standard_errors_under(()) == [None, None, None]
    assert all(error is not None for error in linear_node(MEASURED, DESIGN, FOLDS).standard_errors_under(()))


def test_a_number_beyond_what_muscles_were_found_to_have_is_implausible():
    fitted_model = linear_node(MEASURED, DESIGN, FOLDS)
    start = fitted_model.free[0].start
    for measured, implausible in (
        ((start - 1.0, start + 1.0), 0),
        ((start - 1.0, start - 0.005), 0),  # a hundredth of the range beside it is still within
        ((start + 0.1, start + 1.0), 1),
        (None, 0),
    ):
        assert with_free(fitted_model, {"measured": measured}, {}, {}).implausible == implausible
