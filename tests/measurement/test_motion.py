"""Rates against analytic signals: bias, and the claimed uncertainty by Monte Carlo."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import savgol_coeffs

from mckibben.measurement.derivative import noise_of, rates, rounding_step, running_mean
from mckibben.measurement.measurement import build
from mckibben.measurement.motion import directions, held_directions, motion_of
from mckibben.physics.errors import InputError

RUNS = 40
PERIOD = 4.0


def sine(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    w = 2.0 * np.pi / PERIOD
    return np.sin(w * t), w * np.cos(w * t)


def triangle(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    phase = (t / PERIOD) % 1.0
    rising = phase < 0.5
    return np.where(rising, 2.0 * phase, 2.0 - 2.0 * phase), np.where(rising, 2.0, -2.0) / PERIOD


def decay(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.exp(-t / 0.3), -np.exp(-t / 0.3) / 0.3


def sampled(rows: int, jitter: float, random: np.random.Generator) -> np.ndarray:
    t = np.linspace(0.0, 10.0, rows)
    return t + jitter * (t[1] - t[0]) * random.uniform(-0.5, 0.5, rows)


@pytest.mark.parametrize("signal", [sine, triangle, decay])
@pytest.mark.parametrize(
    ("rows", "jitter", "noise"), [(1000, 0.0, 1e-3), (400, 0.3, 1e-4), (400, 0.4, 1e-3), (400, 0.3, 1e-2)]
)
def test_claimed_uncertainty_is_the_scatter(signal: Callable, rows: int, jitter: float, noise: float) -> None:
    random = np.random.default_rng(5)
    t = sampled(rows, jitter, random)
    x, v = signal(t)
    found = [rates(t, x + noise * random.standard_normal(rows)) for _ in range(RUNS)]
    error = np.array([rate.value for rate in found]) - v
    claimed = np.sqrt(np.mean([rate.sigma**2 for rate in found], axis=0))
    actual = np.sqrt(np.mean(error**2, axis=0))
    # Away from the corners of a triangle, where there is no rate.
    clear = np.abs((t / (PERIOD / 2)) % 1.0 - 0.5) < 0.35 if signal is triangle else np.ones(rows, bool)
    assert np.median(actual[clear] / claimed[clear]) == pytest.approx(1.0, abs=0.2)
    assert np.quantile(actual[clear] / claimed[clear], 0.9) < 1.4
    assert np.median(np.abs(error.mean(axis=0))[clear] / claimed[clear]) < 0.8


def test_uniform_samples_give_the_savitzky_golay_filter() -> None:
    t = np.arange(200) * 0.01
    x = np.random.default_rng(1).standard_normal(200)
    rate = rates(t, x, noise=1.0)
    for row in (50, 100, 150):
        half = int(rate.half_width[row])
        weights = savgol_coeffs(2 * half + 1, 2, deriv=1, delta=0.01, use="dot")
        assert rate.value[row] == pytest.approx(weights @ x[row - half : row + half + 1])


def test_a_parabola_is_exact_whatever_the_sampling() -> None:
    random = np.random.default_rng(2)
    t = np.cumsum(random.uniform(0.001, 0.02, 500))
    rate = rates(t, 3.0 - 2.0 * t + 0.7 * t**2, noise=1e-9)
    np.testing.assert_allclose(rate.value, -2.0 + 1.4 * t, rtol=1e-6, atol=1e-6)


def test_no_fit_reaches_across_files_or_back_in_time() -> None:
    t = np.arange(100) * 0.01
    time = np.concatenate([t, t])
    values = np.concatenate([2.0 * t, 5.0 - 3.0 * t])
    rate = rates(time, values, noise=1e-9)
    np.testing.assert_allclose(rate.value, np.repeat([2.0, -3.0], 100), rtol=1e-9)
    rate = rates(np.arange(200) * 0.01, values, starts=(0, 100), noise=1e-9)
    np.testing.assert_allclose(rate.value, np.repeat([2.0, -3.0], 100), rtol=1e-9)


@pytest.mark.parametrize("time", [[0.0], [0.0, 1.0], [1.0, 1.0, 1.0, 1.0]])
def test_too_little_time_is_no_rate(time: list[float]) -> None:
    rate = rates(np.array(time), np.arange(len(time), dtype=float))
    assert np.isinf(rate.sigma).all()
    assert not rate.value.any()


def test_repeated_times_are_allowed() -> None:
    t = np.repeat(np.arange(50) * 0.01, 2)
    rate = rates(t, 4.0 * t, noise=1e-6)
    np.testing.assert_allclose(rate.value, 4.0, rtol=1e-9)


def test_noise_is_told_from_signal() -> None:
    random = np.random.default_rng(3)
    t = np.linspace(0.0, 1.0, 20_000)
    for sigma in (1e-6, 1e-3, 0.1):
        assert noise_of(np.sin(6 * t) + sigma * random.standard_normal(t.size)) == pytest.approx(
            sigma, rel=0.05
        )
    rounded = np.round(np.sin(6 * t), 2)
    assert rounding_step(rounded) == pytest.approx(0.01)
    assert noise_of(rounded) == pytest.approx(0.01 / np.sqrt(12.0), rel=0.05)
    assert rounding_step(np.sin(6 * t)) == 0.0


def test_running_mean_keeps_a_line_inside() -> None:
    line = np.arange(50.0)
    np.testing.assert_allclose(running_mean(line, 7)[3:-3], line[3:-3])
    np.testing.assert_array_equal(running_mean(line, 1), line)


def test_direction_is_told_where_it_is_significant() -> None:
    velocity = np.array([0.0, 1.5, 3.0, 1.5, 0.5, -1.5, -1.5, -3.0, 0.0, 1.5])
    np.testing.assert_array_equal(directions(velocity, np.ones(10)), [0, 1, 1, 1, 0, -1, -1, -1, 0, 0])


def measured(**more: np.ndarray):
    t = np.arange(1000) * 0.01
    x = 0.02 * (1.0 - np.cos(t))
    columns = {"time": t, "pressure": 1e5 * (1.0 + np.sin(t)), "displacement": x, **more}
    return build(columns, name="a.csv", id="0" * 64, kind="transient"), 0.02 * np.sin(t)


def test_a_stroke_is_differentiated_as_length() -> None:
    measurement, speed = measured()
    motion = motion_of(measurement, 0.3)
    assert not motion.measured
    np.testing.assert_allclose(motion.velocity, -speed, atol=2e-5)
    assert motion.direction[100] == -1
    assert motion.direction[500] == 1


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_measured_velocity_wins_and_its_sign_is_checked(sign: float) -> None:
    _, speed = measured()
    given = sign * speed * 1.001  # told from the derived one
    motion = motion_of(measured(velocity=given)[0], 0.3)
    assert motion.measured
    np.testing.assert_allclose(motion.velocity, -speed * 1.001)
    assert bool(motion.messages) == (sign > 0.0)


def test_rates_need_time_and_stroke() -> None:
    columns = {"pressure": np.arange(5.0), "length": np.arange(1.0, 6.0)}
    with pytest.raises(InputError, match="rates need a time column"):
        motion_of(build(columns, name="a.csv", id="0" * 64), 0.3)
    columns = {"time": np.arange(5.0), "pressure": np.arange(5.0)}
    with pytest.raises(InputError, match="rates need a stroke or a velocity"):
        motion_of(build(columns, name="a.csv", id="0" * 64), 0.3)


@pytest.mark.parametrize("held", [0.28, 4e5, 0.0])
def test_what_is_held_exactly_has_no_rate(held: float) -> None:
    rate = rates(np.linspace(0.0, 2.0, 81), np.full(81, held))
    assert not rate.value.any()


def test_a_muscle_at_rest_keeps_the_direction_of_its_last_motion() -> None:
    """Rest, contraction by 10, rest with a flicker of 0.1, extension by 5, then a new record at rest."""
    direction = np.array([0, -1, -1, 0, 1, 0, 1, 1, 0, 0], dtype=np.int8)
    length = np.array([100.0, 95.0, 90.0, 90.0, 90.1, 90.1, 93.0, 95.0, 95.0, 95.0])
    records = np.array([0, 0, 0, 0, 0, 0, 0, 0, 0, 1])
    kept = held_directions(direction, length, records, least=1.0)
    assert list(kept) == [0, -1, -1, -1, -1, -1, 1, 1, 1, 0]


def test_no_rows_have_no_direction() -> None:
    nothing = np.zeros(0, dtype=np.int8)
    assert len(held_directions(nothing, np.zeros(0), np.zeros(0, int), least=1.0)) == 0
