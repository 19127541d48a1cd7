"""What a status means: noise of a laboratory is no unknown effect, and a structure is."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import diagnose
from mckibben.identification.diagnose.judgement import left_repetition
from mckibben.identification.diagnose.verdict import unexplained_share
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.reading import read_measurement
from tests.identification.synthetic import CATALOGUE, MUSCLE, truth

SIGMA = 2.0


def correlated(random: np.random.Generator, count: int) -> np.ndarray:
    """An autoregressive process with a coefficient of 0.85."""
    noise, last = np.empty(count), 0.0
    for row, new in enumerate(random.standard_normal(count)):
        last = 0.85 * last + np.sqrt(1.0 - 0.85**2) * new
        noise[row] = last
    return noise


def spiky(random: np.random.Generator, count: int) -> np.ndarray:
    spikes = np.where(random.random(count) < 0.02, 15.0 * random.standard_normal(count), 0.0)
    return random.standard_normal(count) + spikes


def diagnosed(noise: Callable[[np.random.Generator, int], np.ndarray], seed: int, ripple: float = 0.0):
    """The ideal muscle at five pressures with a noise, and a ripple over the contraction."""
    shares = np.concatenate([np.linspace(0.0, 0.18, 40), np.linspace(0.18, 0.0, 40)])
    places = [(pressure, share) for pressure in (2e5, 3e5, 4e5, 5e5, 6e5) for share in shares]
    drawn = SIGMA * noise(np.random.default_rng(seed), len(places))
    rows = ["# kind: isobaric", "time_s,pressure_bar,length_mm,force_N"]
    for row, (pressure, share) in enumerate(places):
        length = 0.3 * (1.0 - share)
        force = float(truth(pressure, length)) + drawn[row] + ripple * np.sin(150.0 * share)
        rows.append(f"{0.1 * row:.1f},{pressure / 1e5:g},{1e3 * length:.4f},{force:.4f}")
    measurement = read_measurement("\n".join(rows).encode(), "sweeps.csv")
    return diagnose(predictor_of(measurement, MUSCLE), FitModel(MUSCLE), catalogue=CATALOGUE)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("noise", [correlated, spiky])
def test_noise_of_another_kind_is_no_unknown_effect(noise, seed: int) -> None:
    found = diagnosed(noise, seed)
    assert found.status == "adequate"
    assert found.added == ()
    low, high = found.noise_interval
    assert low <= 1.15 * found.best.rmse <= 1.3 * high


def test_a_structure_is_one_and_has_no_interval_of_noise() -> None:
    found = diagnosed(lambda random, count: random.standard_normal(count), 0, ripple=12.0)
    assert found.status == "unknown_effect"
    assert found.judgement.predictable > 0.3
    assert found.noise_interval is None
    # Four periods of 2 pi/150 of the contraction, in all sweeps.
    assert found.repetition is not None
    assert (found.repetition.over, found.repetition.grows) == ("length", False)
    assert found.repetition.period == pytest.approx(0.3 * 2.0 * np.pi / 150.0, rel=0.02)
    assert found.repetition.amplitude == pytest.approx(12.0, rel=0.1)


def test_only_the_channel_with_the_largest_rest_is_looked_at_and_only_its_rows() -> None:
    place = np.tile(np.linspace(0.26, 0.20, 120), 5)
    wave, noise = np.sin(2.0 * np.pi * place / 5e-3), np.random.default_rng(0).standard_normal(1200)
    sweeps = np.split(np.arange(1200), 10)
    for first, second, found in ((3.0, 0.0, True), (0.0, 0.5, False)):
        left = np.concatenate([first * wave, second * wave]) + np.repeat([0.1, 1.0], 600) * noise
        subject = SimpleNamespace(
            channels=[SimpleNamespace(rows=slice(0, 600)), SimpleNamespace(rows=slice(600, 1200))],
            sweeps=sweeps, inputs={"length": np.tile(place, 2)}, records=np.zeros(1200, int),
        )  # fmt: skip
        assert (left_repetition(subject, left) is not None) is found  # type: ignore[arg-type]


def test_what_is_left_of_an_unknown_effect_is_all_above_the_noise() -> None:
    found = diagnosed(lambda random, count: random.standard_normal(count), 0, ripple=12.0)
    left = unexplained_share(found.status, found.best, found.noise, found.judgement)
    assert found.noise is not None
    assert left >= 0.95 * (1.0 - (found.noise / found.best.rmse) ** 2)
    assert left > 0.8
