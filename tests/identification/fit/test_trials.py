"""Models that a fitter tries beside a fitted one."""

from __future__ import annotations

import pytest

from mckibben.identification.fit.trials import at_places, pace_of
from mckibben.identification.predict.fit_model import FitModel
from tests.identification.synthetic import CATALOGUE, MUSCLE


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
