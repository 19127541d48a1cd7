"""What the search expects of an effect before it fits it."""

from __future__ import annotations

import pytest

from mckibben.identification.fit.effort import diagnosis_effort
from mckibben.identification.fit.fitter import Fitter, at_places, pace_of
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from tests.identification.synthetic import CATALOGUE, MUSCLE, force_map


@pytest.mark.parametrize("noise", [None, 2.0])
def test_what_changes_nothing_promises_nothing(noise: float | None) -> None:
    """Friction without a direction and temperature without a reading change the last digits at most."""
    predictor = predictor_of(force_map(noise=2.0, c10=0.4e6, prestress=40.0), MUSCLE)
    candidates = tuple(effect for effect in CATALOGUE.values() if not predictor.why_hidden(effect))
    start = FitModel(MUSCLE)
    fitter = Fitter(
        predictor=predictor.prepared(start, candidates), geometry=(), candidates=candidates, noise=noise,
        load=None, effort=diagnosis_effort(simulated=False),
    )  # fmt: skip
    root = fitter.fit(start)
    # Beside a wall of rubber, where most of the residual is explained.
    for model in (root, fitter.adding(root, CATALOGUE["bladder_elasticity"])):
        gains = fitter.gains(model, [e for e in candidates if e.id not in model.fit_model.ids])
        inert = [gains[name] for name in ("coulomb_friction", "contact_friction", "temperature")]
        assert inert == [0.0, 0.0, 0.0]
        assert {"prestress", "linear_elasticity"} <= {effect for effect, gain in gains.items() if gain > 0.0}


@pytest.mark.parametrize("effect", ["creep", "pressure_creep"])
def test_a_creep_is_tried_at_times_from_seconds_to_hours(effect: str) -> None:
    """Its arms are spread about the time of the middle one: holds last from seconds to hours."""
    place = pace_of(CATALOGUE[effect])
    assert place is not None
    models = at_places(FitModel(MUSCLE), CATALOGUE[effect], place)
    assert [model.values[effect]["time"] for model in models.values()] == pytest.approx([3.0, 30.0, 300.0])


@pytest.mark.parametrize("effect", ["dahl", "sensor_lag", "effectiveness"])
def test_what_does_not_creep_has_no_pace(effect: str) -> None:
    assert pace_of(CATALOGUE[effect]) is None
