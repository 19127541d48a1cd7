"""The noise floor of signals whose noise is known."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.noise import channel_noise, neighbour_noise
from mckibben.measurement.noise import noise_floor
from tests.identification.synthetic import Plain

ROWS = 20_000


def noise(sigma: float = 1.0, rows: int = ROWS, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(0.0, sigma, rows)


@pytest.mark.parametrize("sigma", [1e-6, 0.3, 4e4])
def test_white_noise_is_found_within_five_percent(sigma):
    assert noise_floor(noise(sigma), [np.arange(ROWS)]) == pytest.approx(sigma, rel=0.05)


def test_white_noise_of_a_few_hundred_rows():
    found = [noise_floor(noise(rows=300, seed=seed), [np.arange(300)]) or 0.0 for seed in range(40)]
    assert np.mean(found) == pytest.approx(1.0, rel=0.05)
    assert np.std(found) < 0.15


def test_a_smooth_signal_is_no_noise():
    t = np.linspace(0.0, 20.0, ROWS)
    smooth = 300.0 * np.sin(t) + 40.0 * t**2 + 100.0 * np.exp(-t)
    assert noise_floor(smooth + noise(0.5), [np.arange(ROWS)]) == pytest.approx(0.5, rel=0.05)
    bare = noise_floor(smooth, [np.arange(ROWS)])
    assert bare is not None
    assert bare < 1e-6


def test_third_differences_of_a_cubic_are_constant():
    """x^3 at steps h has third differences 6 h^3: sqrt(36 h^6/(20 * 0.4549)) and not more."""
    x = np.arange(100.0) * 0.1
    expected = 6 * 0.1**3 / np.sqrt(20 * 0.4549364231195724)
    assert noise_floor(x**3, [np.arange(100)]) == pytest.approx(expected, rel=1e-6)


def test_steps_and_outliers_do_not_count():
    values = noise(2.0)
    values[ROWS // 2 :] += 500.0
    values[::997] += 1e4
    assert noise_floor(values, [np.arange(ROWS)]) == pytest.approx(2.0, rel=0.05)


def test_sweeps_are_taken_one_by_one():
    offsets = np.repeat(1000.0 * np.arange(100), ROWS // 100)
    sweeps = np.split(np.arange(ROWS), 100)
    assert noise_floor(noise() + offsets, sweeps) == pytest.approx(1.0, rel=0.05)
    assert noise_floor(noise(), [np.arange(7), np.arange(7, 14)]) is None
    assert noise_floor(noise(), []) is None


def test_a_quantised_signal_has_the_noise_of_its_steps():
    """Noise larger than the step adds the step's own q^2/12 (Sheppard)."""
    step, sigma = 1.0, 1.5
    rounded = step * np.round((noise(sigma) + np.linspace(0.0, 50.0, ROWS)) / step)
    expected = np.sqrt(sigma**2 + step**2 / 12.0)
    assert noise_floor(rounded, [np.arange(ROWS)]) == pytest.approx(expected, rel=0.12)


def test_a_coarse_converter_is_not_free_of_noise():
    """Most differences are exactly zero; the others are single steps of the converter."""
    t = np.linspace(0.0, 2.0 * np.pi, ROWS)
    rounded = np.round(80.0 * np.sin(t) + noise(0.2))
    found = noise_floor(rounded, [np.arange(ROWS)])
    assert found is not None
    assert 0.02 < found < 1.0
    # Nothing but zeros is no noise at all.
    assert noise_floor(np.zeros(100), [np.arange(100)]) == 0.0


def test_channels_are_looked_at_alone():
    first, second = noise(0.1, 1000), noise(30.0, 1000, seed=1)
    values = np.concatenate([first, second])
    predictor = Plain(values, np.empty((2000, 0)), [np.arange(2000) // 400])
    predictor.sweeps = [np.arange(1000), np.arange(1000, 2000)]
    one, two = (
        predictor.channels[0].__class__(name, "N", rows, 1.0, 1.0)
        for name, rows in (("force", slice(0, 1000)), ("pressure", slice(1000, 2000)))
    )
    assert channel_noise(predictor, values, one)[0] == pytest.approx(0.1, rel=0.15)
    assert channel_noise(predictor, values, two)[0] == pytest.approx(30.0, rel=0.15)


def test_scattered_points_tell_the_noise_between_neighbours():
    draw = np.random.default_rng(5)
    places = draw.uniform(size=(600, 2)) * [6e5, 0.1] + [0.0, 0.2]
    smooth = 1e-4 * places[:, 0] + 800.0 * places[:, 1] + 3.0 * np.sin(places[:, 0] / 2e5)
    values = smooth + draw.normal(0.0, 2.0, 600)
    assert neighbour_noise(values, places) == pytest.approx(2.0, rel=0.15)


def test_repeats_tell_the_noise_whatever_lies_between_the_points():
    """Forty points far apart in value, each measured twelve times."""
    draw = np.random.default_rng(6)
    places = np.repeat(draw.uniform(size=(40, 2)), 12, axis=0)
    values = np.repeat(draw.normal(0.0, 500.0, 40), 12) + draw.normal(0.0, 2.0, 480)
    assert neighbour_noise(values, places) == pytest.approx(2.0, rel=0.15)


def test_directions_are_not_neighbours():
    draw = np.random.default_rng(7)
    place = np.sort(draw.uniform(size=400))
    direction = np.where(np.arange(400) % 2, 1.0, -1.0)
    values = 30.0 * direction + draw.normal(0.0, 1.0, 400)
    assert neighbour_noise(values, np.column_stack([place, direction])) == pytest.approx(1.0, rel=0.2)
    assert neighbour_noise(values, place[:, None]) > 10.0


def test_too_few_points_or_one_place_tell_nothing():
    assert neighbour_noise(np.ones(29), np.random.default_rng(0).uniform(size=(29, 2))) is None
    assert neighbour_noise(np.ones(50), np.ones((50, 2))) is None
