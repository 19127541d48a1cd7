"""What is seen in a residual, and the sentence of a candidate."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.reason import ResidualTraits, traits_of, why
from tests.identification.synthetic import CATALOGUE

ROWS = 4000
RANDOM = np.random.default_rng(8)
PRESSURE = RANDOM.uniform(1e5, 8e5, ROWS)
DIRECTION = RANDOM.choice([-1.0, 1.0], ROWS)
NOISE = RANDOM.normal(0.0, 1.0, ROWS)
VARIABLES = {"pressure": PRESSURE, "direction": DIRECTION}


def test_a_residual_that_changes_sign_with_the_motion_is_odd():
    assert traits_of(7.0 * DIRECTION, VARIABLES).odd == pytest.approx(1.0, abs=1e-9)
    # As much variance in noise as in the odd part.
    assert traits_of(DIRECTION + NOISE, VARIABLES).odd == pytest.approx(0.5, abs=0.03)
    assert traits_of(NOISE, VARIABLES).odd == pytest.approx(0.0, abs=0.01)
    assert traits_of(np.full(ROWS, 5.0), VARIABLES).odd == pytest.approx(0.0, abs=1e-12)


def test_parity_takes_both_directions():
    assert traits_of(DIRECTION, {"pressure": PRESSURE}).odd is None
    assert traits_of(DIRECTION, {"direction": np.abs(DIRECTION)}).odd is None
    held = np.where(DIRECTION > 0, 0.0, -1.0)
    assert traits_of(DIRECTION, {"direction": held}).odd is None


@pytest.mark.parametrize("power", [0.0, 1.0, 2.0])
def test_growth_with_pressure_is_its_power(power):
    residual = 3.0 * (PRESSURE / 1e5) ** power * DIRECTION
    assert traits_of(residual, VARIABLES).pressure_power == pytest.approx(power, abs=0.1)


def test_growth_with_pressure_takes_a_range_of_it():
    narrow = {"pressure": 5e5 + 0.2 * PRESSURE}
    assert traits_of(NOISE, narrow).pressure_power is None
    assert traits_of(NOISE, {}).pressure_power is None
    two = {"pressure": np.where(DIRECTION > 0, 1e5, 6e5)}
    assert traits_of(NOISE, two).pressure_power is None


def test_a_residual_of_zero_has_no_features():
    assert traits_of(np.zeros(ROWS), VARIABLES) == ResidualTraits(None, None)


def test_a_sentence_names_what_agrees_and_what_does_not():
    odd = ResidualTraits(odd=0.8, pressure_power=1.0)
    text = why(CATALOGUE["pressure_friction"], odd, gain=0.42)
    assert text.startswith(CATALOGUE["pressure_friction"].title)
    assert "changes sign with the direction of motion" in text
    assert "grows about in proportion to pressure" in text
    assert "speaks against" not in text
    assert text.endswith("It lowers the error by 42 %.")
    text = why(CATALOGUE["prestress"], odd, gain=0.001)
    assert text.count("speaks against it") == 1
    assert text.endswith("It does not lower the error.")
    mixed = why(CATALOGUE["coulomb_friction"], odd, gain=0.1)
    assert "as it would; but grows about in proportion to pressure, which speaks against it" in mixed


@pytest.mark.parametrize("name", sorted(CATALOGUE))
def test_every_effect_has_a_sentence(name):
    for found in (
        ResidualTraits(None, None),
        ResidualTraits(0.0, 0.0),
        ResidualTraits(0.9, 2.2),
    ):
        text = why(CATALOGUE[name], found, gain=0.5)
        assert text.startswith(CATALOGUE[name].title)
        assert text.endswith(".")
        assert "None" not in text
        assert ".." not in text
