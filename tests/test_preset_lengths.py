"""The muscle presets over their length: the relative change of published data; the level is of the maps."""

from __future__ import annotations

from math import atan

import numpy as np
import pytest

from mckibben.application.curves.curves import CurvesQuestion, curves
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from tests.shipped import shipped_studio

BAR = 1e5
# Hunt 2017: length of a 10 mm muscle [mm], free contraction at 620 kPa.
HUNT = ((153.1, 0.1491), (182.8, 0.1618), (189.4, 0.1633), (195.0, 0.1680), (272.7, 0.1692), (280.9, 0.1750))
LENGTHS = (0.1, 0.15, 0.2, 0.3, 0.5, 0.8)


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def figures(studio: Studio, name: str, length: float, pressure: float = 6.2 * BAR) -> tuple[float, float]:
    """Blocked force [N] and free contraction of a preset of this length [m]."""
    start = studio.start_model(StatedMuscle(preset=name, nominal_length=length), None)
    found = curves(CurvesQuestion(start, pressures=(pressure,)), studio).characteristics[0]
    return found.blocked_force, found.free_contraction


def bolen(size: int, length: float) -> float:
    """Blocked force at 620 kPa [N], fitted by Bolen & Hunt: p a1 atan(a2 (L0 - 7.5 mm) p)."""
    factor, slope = {10: (0.4895, 0.03068), 20: (1.4877, 0.0248)}[size]
    return 620.0 * factor * atan(slope * (length - 0.0075) * 620.0)


def test_the_free_contraction_grows_with_the_length_as_hunt_measured(studio: Studio) -> None:
    ours = np.array([figures(studio, "DMSP-10", length * 1e-3)[1] for length, _ in HUNT])
    theirs = np.array([contraction for _, contraction in HUNT])
    assert ours[-1] / ours[0] == pytest.approx(theirs[-1] / theirs[0], rel=0.03)
    ratio = ours / theirs  # the level is free: the sources disagree in it
    ratio /= np.sqrt(ratio.min() * ratio.max())
    assert np.all(np.abs(ratio - 1.0) < 0.03)


@pytest.mark.parametrize(("size", "reference"), [(10, 0.25), (20, 0.3)])
def test_the_blocked_force_grows_with_the_length_as_bolen_fitted(
    studio: Studio, size: int, reference: float
) -> None:
    level = figures(studio, f"DMSP-{size}", reference)[0] / bolen(size, reference)
    for length in LENGTHS:
        ours = figures(studio, f"DMSP-{size}", length)[0]
        assert ours / bolen(size, length) == pytest.approx(level, rel=0.03), length


@pytest.mark.parametrize("name", ["DMSP-5", "DMSP-10", "DMSP-20", "DMSP-40", "MAS-20"])
def test_a_short_muscle_contracts_less_than_a_long_one(studio: Studio, name: str) -> None:
    preset = studio.library.muscle(name)
    assert preset.limits.min_nominal_length is not None
    shortest = preset.limits.min_nominal_length.si("m")
    found = [figures(studio, name, length, 6.0 * BAR) for length in (shortest, 0.3, 0.8)]
    assert np.all(np.diff(np.array(found), axis=0) > 0.0)
    assert found[0][1] > 0.02
    assert found[1][1] - found[0][1] > 0.01


@pytest.mark.parametrize("name", ["DMSP-5", "DMSP-10", "DMSP-20", "DMSP-40"])
def test_at_the_length_of_the_sample_the_model_is_the_fitted_one(studio: Studio, name: str) -> None:
    """So the errors on the maker's curves and on the measured maps are those without the effect."""
    length = studio.facts(name).muscle.nominal_length
    effects = dict(studio.facts(name).effects)
    pressures = (2 * BAR, 4 * BAR, 6 * BAR)
    with_ends = curves(
        CurvesQuestion(studio.start_model(StatedMuscle(name, length), effects), pressures), studio
    )
    assert effects.pop("lost_stroke")["reference_length"] == length
    without = curves(
        CurvesQuestion(studio.start_model(StatedMuscle(name, length), effects), pressures), studio
    )
    np.testing.assert_allclose(with_ends.force, without.force, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(with_ends.diameter, without.diameter, rtol=1e-12)
