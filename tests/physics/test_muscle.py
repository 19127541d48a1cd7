"""A muscle at rest: typical values where something is not stated."""

from __future__ import annotations

from math import radians

import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, Muscle

BARE = Muscle(0.3, 0.02, radians(25.0))


def test_a_wall_that_is_not_stated_is_typical_and_leaves_a_bore() -> None:
    assert BARE.assuming(["wall_thickness"]).wall_thickness == 1.5e-3
    thin = BARE._replace(braid_diameter=4e-3)
    assert thin.assuming(["wall_thickness"]).checked().wall_thickness == pytest.approx(0.6e-3)
    stated = BARE._replace(wall_thickness=0.7e-3)
    assert stated.assuming(["wall_thickness"]) == stated
    assert BARE.assuming([]) == BARE


@pytest.mark.parametrize("effect", [e for e in default_catalogue().values() if e.needs], ids=lambda e: e.id)
def test_only_the_product_of_an_assumed_field_and_the_modulus_acts(effect) -> None:
    """What is said of an assumed field: with half of it and twice every modulus nothing changes."""
    assert set(effect.needs) <= set(GEOMETRY)
    muscle = BARE.assuming(effect.needs)
    other = muscle._replace(**{name: 0.5 * getattr(muscle, name) for name in effect.needs})
    doubled = {p.name: p.default * (2.0 if p.unit == "Pa" else 1.0) for p in effect.parameters}
    for length in (0.29, 0.26, 0.23):
        force, same = (
            Model((effect,))
            .evaluate(
                muscle=of,
                length=length,
                pressure=3e5,
                values={effect.id: values},
                velocity=0.0,
                direction=0.0,
            )
            .force
            for of, values in ((muscle, effect.defaults), (other, doubled))
        )
        ideal = (
            Model(())
            .evaluate(muscle=muscle, length=length, pressure=3e5, values={}, velocity=0.0, direction=0.0)
            .force
        )
        assert same == pytest.approx(force, rel=1e-12)
        assert force != ideal
