"""Of models that fit alike, the one that predicts the ends of the data without having seen them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np

from mckibben.identification.diagnose.extremes import ends_of, reaching_farthest
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.muscle import Muscle

PRESSURE = np.linspace(1e5, 6e5, 60)
NOISE = np.random.default_rng(5).normal(size=60)
FOLDS = (np.arange(60) // 10,)
PREDICTOR = cast(Predictor, SimpleNamespace(inputs={"pressure": PRESSURE, "length": np.full(60, 0.3)}))


def fitted(column: np.ndarray, residual: np.ndarray = NOISE) -> FittedModel:
    free = (Free("effect.size", 4.0, 0.0, 10.0, "N", off=0.0),)
    return FittedModel(FitModel(Muscle(0.3, 0.02, 0.45)), free, frozenset(), residual, column[:, None], FOLDS)


def chosen(best: FittedModel, *others: FittedModel) -> FittedModel:
    return reaching_farthest(best, [best, *others], PREDICTOR, rows=60.0, noise=1.0, start=())


def test_ends_are_those_of_the_inputs_that_vary() -> None:
    low, high = ends_of(PREDICTOR)
    assert np.flatnonzero(low).tolist() == list(range(9))
    assert np.flatnonzero(high).tolist() == list(range(51, 60))


def test_what_acts_at_one_end_alone_yields_to_what_the_rest_foretells() -> None:
    """Without the highest pressures nothing is known of the one, whose 4 N are missed there."""
    at_the_end, everywhere = fitted(np.where(PRESSURE > 5.2e5, 1.0, 0.0)), fitted(PRESSURE / 6e5)
    assert at_the_end.square_without(PRESSURE > 5.2e5) > 10.0
    assert everywhere.square_without(PRESSURE > 5.2e5) < 2.0
    assert chosen(at_the_end, everywhere) is everywhere
    assert chosen(everywhere, at_the_end) is everywhere


def test_a_model_that_fits_worse_is_not_chosen_for_its_ends() -> None:
    at_the_end = fitted(np.where(PRESSURE > 5.2e5, 1.0, 0.0))
    assert chosen(at_the_end, fitted(PRESSURE / 6e5, 1.2 * NOISE)) is at_the_end
