"""Each specimen predicted by the model fitted to the others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from mckibben.identification.diagnose.left_out import left_out_specimens
from mckibben.identification.fit.fitted_model import refitted
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.identification.predict.specimens import SpecimenData, SpecimensPredictor
from mckibben.measurement.reading import read_measurement
from tests.identification.synthetic import CATALOGUE, MUSCLE, truth

PRESSURES = (1e5, 2e5, 3e5, 4e5, 5e5)


def force_map(**hidden: float) -> SpecimenData:
    """A map of the muscle with hidden terms and no noise, named after them."""
    rows = [
        f"{pressure / 1e5},{length * 1e3},{float(truth(pressure, length, **hidden)):.6f}"
        for pressure in PRESSURES
        for length in 0.3 * (1.0 - np.linspace(0.0, 0.15, 8))
    ]
    text = "\n".join(["# kind: static", "pressure_bar,length_mm,force_N", *rows])
    measurement = read_measurement(text.encode(), "map.csv")
    return SpecimenData(str(hidden), predictor_of(measurement, MUSCLE), MUSCLE)


def predictor_with(specimens: Sequence[SpecimenData], effect: str) -> tuple[SpecimensPredictor, FitModel]:
    model = FitModel(MUSCLE).adding(CATALOGUE[effect])
    return SpecimensPredictor(specimens, reference=MUSCLE), model


def test_the_error_is_that_of_the_others_mean() -> None:
    """Three constant forces: the fit to two of them is their mean, by arithmetic."""
    forces = (4.0, 10.0, 31.0)
    predictor, model = predictor_with([force_map(prestress=force) for force in forces], "prestress")
    fitted = refitted(predictor, model, free_numbers(model))
    found = left_out_specimens(predictor, fitted)
    for each, data, own in zip(found, predictor.specimens, forces, strict=True):
        mean = (sum(forces) - own) / 2.0
        assert each.name == data.name
        # The prior of the constant pulls its fit towards 0 by less than a hundredth.
        assert each.rmse == pytest.approx(abs(own - mean), rel=0.02)
        assert each.share == pytest.approx(each.rmse / np.max(np.abs(data.predictor.measured)))


def test_a_nonlinear_constant_is_fitted_again() -> None:
    """An ideal muscle whose effectiveness and prestress differ: against a fit of the other specimen alone."""
    pair = [force_map(c10=1e5), force_map(c10=4e5, prestress=-20.0)]
    predictor, model = predictor_with(pair, "contraction_factor")
    fitted = refitted(predictor, model, free_numbers(model))
    found = left_out_specimens(predictor, fitted)
    for each, own, other in zip(found, pair, pair[::-1], strict=True):
        alone = refitted(other.predictor, model, free_numbers(model))
        error = own.predictor.residual(alone.fit_model)
        assert each.rmse == pytest.approx(float(np.sqrt(np.mean(error**2))), rel=0.03)


def test_without_free_numbers_nothing_is_fitted() -> None:
    predictor = SpecimensPredictor([force_map(prestress=3.0), force_map()], reference=MUSCLE)
    found = left_out_specimens(predictor, refitted(predictor, FitModel(MUSCLE), ()))
    assert [each.rmse for each in found] == pytest.approx([3.0, 0.0], abs=1e-5)
