"""The atlas of effects: a picture for exactly the kinds an effect names, and what the pictures show."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mckibben.identification.diagnose.atlas import SignaturePicture, pictures, stand_ins
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import KINDS, Effect
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()
EFFECTS = list(CATALOGUE.values())
MUSCLE = Muscle(0.3, 0.0218, math.radians(26.5), 0.0018, 0.020)
PRESSURE = 6e5
SCALES = {"N": 1500.0, "m": 0.3, "Pa": PRESSURE, "N*m": 75.0}  # blocked force, rest length, pressure
LEAST = 1e-8  # of the scale: what memory and the solver of a length leave
# A delay of the readings shows only in what is read over time; the prediction of lengths has no readings.
HIDDEN = {"sensor_lag": {"isotonic"}, "time_skew": {"isotonic"}}


def base_of(effect: Effect) -> FitModel:
    base = FitModel(MUSCLE)
    for name in stand_ins(effect, CATALOGUE, {}):
        base = base.adding(CATALOGUE[name])
    return base


def drawn(effect_id: str, kind: str, **values: float) -> SignaturePicture:
    effect = CATALOGUE[effect_id]
    found = pictures(base_of(effect), effect, values, pressure=PRESSURE)
    return next(picture for picture in found if picture.kind == kind)


@pytest.mark.parametrize("effect", EFFECTS, ids=[effect.id for effect in EFFECTS])
def test_a_picture_differs_from_zero_exactly_in_the_kinds_that_the_effect_names(effect: Effect) -> None:
    # What acts on a muscle acts at a joint as well; its pictures are those of the muscle alone.
    kinds = frozenset(KINDS) - ({"transient", "joint"} - effect.kinds)
    found = {p.kind: p for p in pictures(base_of(effect), effect, pressure=PRESSURE, kinds=kinds)}
    assert effect.kinds - set(found) == HIDDEN.get(effect.id, set())
    for kind, picture in found.items():
        shown = picture.rms > LEAST * SCALES[picture.unit]
        assert shown is (kind in effect.kinds), f"{kind}: {picture.rms} {picture.unit}"
        for curve in picture.curves:
            assert np.all(np.isfinite(curve.x))
            assert np.all(np.isfinite(curve.y))


def test_coulomb_friction_is_a_loop_of_twice_its_force() -> None:
    picture = drawn("coulomb_friction", "isobaric", force=12.0)
    assert len(picture.curves) == 3
    for curve in picture.curves:
        way = np.sign(np.gradient(curve.x))
        moving = np.abs(np.gradient(curve.x)) > 1e-6
        # The muscle pulls harder while it lengthens.
        np.testing.assert_allclose(curve.y[moving], -12.0 * way[moving], atol=1e-9)


def test_a_zero_error_of_the_force_sensor_is_itself_everywhere() -> None:
    for kind in ("isobaric", "isometric", "static"):
        picture = drawn("force_offset", kind, offset=-7.5)
        assert all(np.allclose(curve.y, -7.5) for curve in picture.curves)
        assert picture.rms == pytest.approx(7.5)


def test_bad_questions_are_refused() -> None:
    with pytest.raises(InputError, match="positive pressure"):
        pictures(FitModel(MUSCLE), EFFECTS[0], pressure=0.0)


def test_the_weight_of_a_link_is_a_cosine_of_the_angle() -> None:
    """Level at the angle 0, it turns the joint by its moment there, the same at each pressure."""
    picture = drawn("link_weight", "joint", moment=2.0)
    assert (picture.quantity, picture.unit, picture.x, picture.x_unit) == ("torque", "N*m", "angle", "rad")
    assert len(picture.curves) == 3
    for curve in picture.curves:
        assert np.ptp(curve.x) == pytest.approx(1.0)
        np.testing.assert_allclose(curve.y, -2.0 * np.cos(curve.x), rtol=1e-9)
