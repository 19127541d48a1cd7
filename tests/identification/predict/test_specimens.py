"""Several specimens as one set of data: each with its own muscle, derivatives in proportion."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry
from mckibben.identification.predict.specimens import (
    SpecimenData,
    SpecimensPredictor,
    own_muscle,
    zero_errors,
)
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from tests.identification.synthetic import MUSCLE, cycles, force_map

SHORT = MUSCLE._replace(nominal_length=0.97 * MUSCLE.nominal_length)
THIN = MUSCLE._replace(braid_diameter=0.5 * MUSCLE.braid_diameter)


def data(name: str, muscle: Muscle) -> SpecimenData:
    """A force map that belongs to a muscle."""
    return SpecimenData(name, predictor_of(force_map(), muscle), muscle)


def both() -> SpecimensPredictor:
    """A short specimen and a thin one."""
    return SpecimensPredictor([data("a", SHORT), data("b", THIN)], reference=MUSCLE)


def test_each_is_predicted_with_its_own_muscle() -> None:
    predictor = both()
    predicted = predictor.predict(FitModel(MUSCLE))
    for number, muscle in enumerate((SHORT, THIN)):
        alone = data("", muscle).predictor
        rows = predictor.specimen == number
        assert predicted[rows] == pytest.approx(alone.predict(FitModel(muscle)))
        assert predictor.measured[rows] == pytest.approx(alone.measured)
        assert predictor.rest_length(FitModel(MUSCLE))[rows] == pytest.approx(muscle.nominal_length)
    assert predictor.several_lengths
    assert predictor.rows_used == len(predictor.measured)


def test_groups_and_sweeps_stay_apart() -> None:
    predictor = both()
    first, second = (set(predictor.groups[predictor.specimen == number]) for number in (0, 1))
    assert not first & second
    for sweep in predictor.sweeps:
        assert len(set(predictor.specimen[sweep])) == 1
    assert sum(map(len, predictor.sweeps)) == len(predictor.measured)


@pytest.mark.parametrize("name", ["nominal_length", "braid_diameter", "braid_angle"])
def test_a_dimension_acts_in_proportion(name: str) -> None:
    """The derivative against a difference of predictions with the changed reference."""
    predictor, model = both(), FitModel(MUSCLE)
    geometry = free_geometry(MUSCLE, [name], {})
    predicted, gradient = predictor.linearised(model, geometry)
    here = float(getattr(MUSCLE, name))
    ends = [
        predictor.predict(model.with_numbers([name], [here * (1.0 + step)]), clipped=False)
        for step in (-1e-5, 1e-5)
    ]
    difference = (ends[1] - ends[0]) / (2e-5 * here)
    assert gradient[:, 0] == pytest.approx(difference, rel=1e-3, abs=1e-3 * np.max(np.abs(difference)))
    assert predicted == pytest.approx(predictor.predict(model, clipped=False))


def test_own_muscle_keeps_its_ratio() -> None:
    changed = MUSCLE._replace(braid_angle=1.1 * MUSCLE.braid_angle)
    own = own_muscle(changed, reference=MUSCLE, own=SHORT)
    assert own.braid_angle == pytest.approx(1.1 * SHORT.braid_angle)
    assert own.nominal_length == SHORT.nominal_length


def test_each_specimen_has_errors_of_its_own() -> None:
    pair = [zero_errors(data(name, muscle), {"force": 2.0, "pressure": 1e3, "diameter": 1.0})
            for name, muscle in (("a", SHORT), ("b", THIN))]  # fmt: skip
    predictor = SpecimensPredictor(pair, reference=MUSCLE)
    assert [(error.of, error.channel) for error in predictor.reading_errors] == [
        ("a", "force"), ("a", "pressure"), ("b", "force"), ("b", "pressure"),
    ]  # fmt: skip
    columns = predictor.error_columns(FitModel(MUSCLE))
    assert np.array_equal(columns[:, 0] != 0.0, predictor.specimen == 0)
    assert set(columns[:, 0]) == {0.0, 1.0}


def test_forces_of_different_kinds_are_one_static_question() -> None:
    other = SpecimenData("c", predictor_of(cycles(), MUSCLE), MUSCLE)
    both = SpecimensPredictor([other, data("a", SHORT)], reference=MUSCLE)
    assert (both.kind, both.predicted) == ("static", "force")
    assert len(both.measured) == sum(len(part.predictor.measured) for part in (other, data("a", SHORT)))


def test_forces_and_lengths_are_refused() -> None:
    force = data("a", SHORT)
    length = replace(force, predictor=copy(force.predictor))
    length.predictor.kind = "isotonic"
    with pytest.raises(InputError, match="isotonic"):
        SpecimensPredictor([force, length], reference=MUSCLE)
