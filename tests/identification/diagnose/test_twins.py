"""What counts as another explanation: no effect that only imitates, and none that differs in one file."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from mckibben.identification.diagnose.twins import (
    _difference,
    _imitates,
    _in_its_place,
    _with_own_law,
    alternatives,
)
from mckibben.identification.fit.effort import diagnosis_effort
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.specimens import SpecimenData, SpecimensPredictor
from tests.identification.synthetic import CATALOGUE, MUSCLE, Plain, csv, length_under, linear_node

X = np.linspace(-1.0, 1.0, 240)
NOISE = np.random.default_rng(3).normal(size=240)
FOLDS = [np.arange(240) // 40]


def fitted(measured: np.ndarray, *columns: np.ndarray) -> FittedModel:
    return linear_node(measured, np.column_stack(columns), FOLDS)


def fitter(measured: np.ndarray) -> Fitter:
    subject = Plain(measured, np.empty((240, 0)), FOLDS)
    return cast(Fitter, SimpleNamespace(predictor=subject, noise=1.0))


def test_a_general_law_that_fits_only_as_the_simple_one_imitates_it() -> None:
    """Readings 8 x: c x explains them, a x^3 does not, a x^3 + b x + d x^2 does with two constants more."""
    measured = 8.0 * X + NOISE
    simple, declared = fitted(measured, X), fitted(measured, X**3)
    general = fitted(measured, X**3, X, X**2)
    assert _imitates(fitter(measured), simple, general, declared)
    # As long as the data do not refute it as it is declared, it is another explanation.
    assert not _imitates(fitter(measured), simple, general, fitted(measured, np.sin(X)))
    # So is one without constants of its own, and one with as few of them.
    assert not _imitates(fitter(measured), simple, declared, declared)
    assert not _imitates(fitter(measured), general, simple, declared)


def test_a_law_whose_further_constants_are_needed_does_not_imitate() -> None:
    """Readings 8 x + 1.5 x^2: the general law is the better one, by its score."""
    measured = 8.0 * X + 1.5 * X**2 + NOISE
    simple, general = fitted(measured, X), fitted(measured, X**3, X, X**2)
    assert not _imitates(fitter(measured), simple, general, fitted(measured, X**3))


def test_a_law_that_is_the_likelier_cause_does_not_imitate() -> None:
    """Prior odds of bladder over spring: (0.9/0.1)/(0.2/0.8) = 36; one constant more costs the root of 240
    rows, 15, two of them 240."""
    measured = 8.0 * X + NOISE
    spring, bladder = (
        FitModel(MUSCLE, (CATALOGUE[name],), {name: CATALOGUE[name].defaults})
        for name in ("linear_elasticity", "bladder_elasticity")
    )
    simple = replace(fitted(measured, X), fit_model=spring)
    one, two = (
        replace(fitted(measured, X, *(X**power for power in powers)), fit_model=bladder)
        for powers in ((3,), (3, 2))
    )
    declared = fitted(measured, X**3)
    assert not _imitates(fitter(measured), simple, one, declared)
    assert _imitates(fitter(measured), simple, two, declared)
    # A priori alike, one constant more is enough.
    assert _imitates(fitter(measured), simple, replace(one, fit_model=spring), declared)


def test_two_models_are_the_same_only_where_they_are_in_each_measurement() -> None:
    """400 readings alike and 100 that differ by 1: rms 0.45 of all, and 1 of the second measurement."""
    parts = [Plain(np.ones(count), np.empty((count, 0)), [np.arange(count) // 20]) for count in (400, 100)]
    both = SpecimensPredictor(
        [SpecimenData(f"file {n}", part, MUSCLE) for n, part in enumerate(parts)], reference=MUSCLE
    )
    empty = np.empty((500, 0))
    one, two = (
        FittedModel(FitModel(MUSCLE), (), frozenset(), size * both.specimen, empty, both.folds)
        for size in (0.0, 1.0)
    )
    assert _difference(one, two, both) == pytest.approx(1.0)
    alone = Plain(np.ones(500), np.empty((500, 0)), [np.arange(500) // 20])
    assert _difference(one, two, alone) == pytest.approx(np.sqrt(0.2))


def test_two_effects_are_another_explanation_of_one_with_a_further_constant() -> None:
    """One load, a wall and a dead band of 0.3 bar: a factor with a threshold of its own fits them as well."""
    draw = np.random.default_rng(5)
    pressures = np.concatenate([np.linspace(1.5, 6.0, 60), np.linspace(6.0, 1.5, 60)])
    rows = [
        f"{p},{1e3 * (length_under(250.0, 1e5 * (p - 0.3), c10=0.15e6) + 1e-4 * draw.normal())}"
        for p in pressures
    ]
    predictor = predictor_of(
        csv(rows, "pressure_bar,length_mm", "kind: isotonic", "load_force: 250 N"), MUSCLE
    )
    names = ("effectiveness", "bladder_elasticity", "prestress", "linear_elasticity", "threshold_pressure")
    candidates, start = tuple(CATALOGUE[name] for name in names), FitModel(MUSCLE)
    fitter = Fitter(
        predictor=predictor.prepared(start, candidates), geometry=(), candidates=candidates, noise=1e-4,
        load=None, effort=diagnosis_effort(simulated=False),
    )  # fmt: skip
    best = fitter.fit(start.adding(CATALOGUE["effectiveness"]), frozenset({"effectiveness.threshold"}))
    others = alternatives(fitter, best, ["effectiveness"], 1e-4)
    pairs = [set(other.fitted_model.fit_model.ids) for other in others]
    for wall in ("prestress", "linear_elasticity"):
        assert {wall, "threshold_pressure"} in pairs
    assert all("effectiveness" not in pair for pair in pairs)
    alone = fitter.fit(start.adding(CATALOGUE["effectiveness"]))
    assert not any(
        len(o.fitted_model.fit_model.ids) > 1 for o in alternatives(fitter, alone, ["effectiveness"], 1e-4)
    )


@pytest.mark.parametrize(
    ("guess", "again", "found"),
    [
        (0.5, 0.1, 0.1),  # a start beside the best model's other numbers leads on
        (0.5, 0.9, 0.8),  # it is closer, and its fit ends no better
        (1.0, 0.1, 0.8),  # it is farther off than where the fit ended: there is nothing to gain
    ],
)
def test_an_exchange_begins_a_second_time_beside_what_the_other_effects_were(
    guess: float, again: float, found: float
) -> None:
    asked: list[frozenset[str]] = []

    def fit(fit_model: str, freed: frozenset[str], *, again: bool) -> SimpleNamespace:
        assert (fit_model, again) == ("guessed", True)
        asked.append(freed)
        return SimpleNamespace(rmse=after)

    after = again
    fits = SimpleNamespace(
        guessed=lambda kept, effect: SimpleNamespace(fit_model="guessed", rmse=guess), fit=fit
    )
    kept = SimpleNamespace(freed=frozenset({"dahl.exponent"}))
    exchange = SimpleNamespace(rmse=0.8, freed=frozenset({"dahl.force", "creep.time"}))
    ended = _in_its_place(
        cast(Fitter, fits), cast(FittedModel, kept), CATALOGUE["creep"], cast(FittedModel, exchange)
    )
    assert ended.rmse == found
    assert asked == ([frozenset({"dahl.exponent", "creep.time"})] if guess < 0.8 else [])


@pytest.mark.parametrize(
    ("holdouts", "implausible", "found"),
    [
        ((0.9, 0.8), 0, 0.8),  # the law that predicts left-out groups best
        ((1.1, 1.2), 0, 1.5),  # none predicts them better than the best model
        ((0.9, 0.8), 1, 1.5),  # only with values that are out of the question
    ],
)
def test_an_exchange_has_the_constants_with_which_it_predicts_better_than_the_best_model(
    holdouts: tuple[float, ...], implausible: int, found: float
) -> None:
    variants = [SimpleNamespace(holdout_rmse=each, implausible=implausible) for each in holdouts]
    best, exchange = (SimpleNamespace(holdout_rmse=each, implausible=0) for each in (1.0, 1.5))
    fits = SimpleNamespace(freeing=lambda model, effect: variants if model is exchange else [])
    other = _with_own_law(
        cast(Fitter, fits), cast(FittedModel, best), CATALOGUE["creep"], cast(FittedModel, exchange)
    )
    assert other.holdout_rmse == found
