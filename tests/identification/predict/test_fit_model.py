"""A model with numbers: names, replacements, what a fit may change."""

from __future__ import annotations

from math import radians

import pytest

from mckibben.identification.predict.fit_model import LOAD, FitModel, Free, free_geometry, free_numbers
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import NEUTRAL_ANGLE
from tests.identification.synthetic import CATALOGUE, MUSCLE


def fit_model(*ids: str) -> FitModel:
    chosen = tuple(CATALOGUE[name] for name in ids)
    return FitModel(MUSCLE, chosen, {e.id: e.defaults for e in chosen})


def test_numbers_by_their_names():
    model = fit_model("prestress", "dahl")
    names = ["prestress.force", "dahl.break_strain", "braid_angle", LOAD]
    other = model.with_numbers(names, [50.0, 0.01, 0.4, 120.0])
    assert [other.number(name) for name in names] == [50.0, 0.01, 0.4, 120.0]
    assert other.number("dahl.force") == model.number("dahl.force")
    assert other.muscle.nominal_length == MUSCLE.nominal_length
    # The model before is as it was.
    assert model.number("prestress.force") == CATALOGUE["prestress"].defaults["force"]
    assert model.muscle is MUSCLE
    assert model.load == 0.0


def test_effects_come_and_go():
    model = fit_model("prestress")
    wider = model.adding(CATALOGUE["dahl"], {"force": 3.0})
    assert wider.ids == ("prestress", "dahl")
    assert wider.values["dahl"] == {**CATALOGUE["dahl"].defaults, "force": 3.0}
    assert wider.without("dahl") == model
    assert model.ids == ("prestress",)


def test_a_fit_changes_what_is_declared_freed_or_geometry():
    model = fit_model("bladder_elasticity", "prestress")
    names = [p.name for p in free_numbers(model)]
    assert names == ["bladder_elasticity.shear_modulus", "prestress.force"]
    geometry = free_geometry(MUSCLE, ["braid_angle"], {})
    load = Free(LOAD, 10.0, 0.0, 500.0, "N")
    moved = model.with_numbers(["braid_angle", LOAD], [0.45, 77.0])
    wider = free_numbers(moved, geometry, ["bladder_elasticity.mooney_constant"], load=load)
    assert [p.name for p in wider] == [
        "bladder_elasticity.shear_modulus", "bladder_elasticity.mooney_constant", "prestress.force",
        "braid_angle", LOAD,
    ]  # fmt: skip
    # Starts are the model's own numbers, bounds those around the geometry as given.
    assert wider[3].start == 0.45
    assert (wider[3].lower, wider[3].upper) == (geometry[0].lower, geometry[0].upper)
    assert (wider[4].start, wider[4].upper) == (77.0, 500.0)


@pytest.mark.parametrize(
    ("name", "tolerance", "low", "high"),
    [
        ("braid_angle", {}, MUSCLE.braid_angle - 0.06, MUSCLE.braid_angle + 0.06),
        ("nominal_length", {}, 0.294, 0.306),
        ("braid_diameter", {}, 0.9 * 0.0218, 1.1 * 0.0218),
        ("nominal_length", {"nominal_length": 0.004}, 0.296, 0.304),
        ("braid_angle", {"braid_angle": radians(1.0)}, radians(25.5), radians(27.5)),
    ],
)
def test_geometry_goes_as_far_as_its_tolerance(name, tolerance, low, high):
    (free,) = free_geometry(MUSCLE, [name, name], tolerance)
    assert free.start == getattr(MUSCLE, name)
    assert (free.lower, free.upper) == (pytest.approx(low), pytest.approx(high))


def test_no_angle_beyond_the_neutral_one():
    steep = MUSCLE._replace(braid_angle=NEUTRAL_ANGLE - 0.01)
    assert free_geometry(steep, ["braid_angle"], {})[0].upper < NEUTRAL_ANGLE


def test_geometry_that_cannot_be_freed():
    with pytest.raises(InputError) as error:
        free_geometry(MUSCLE, ["turns"], {})
    assert error.value.field == "free"
    with pytest.raises(InputError, match="not known") as error:
        free_geometry(MUSCLE._replace(inside_diameter=0.0), ["inside_diameter"], {})
    assert error.value.field == "muscle.inside_diameter"
