"""Tracking figures and verdicts on motions whose figures are known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mckibben.simulation.timing.swing import swing_of
from mckibben.simulation.timing.tracking import Followed, Tracking, _correlations, tracking

T = np.linspace(0.0, 4.0, 4001)
STEP = np.where(T < 1.0, 0.0, 0.02)
LATE = np.maximum(T - 1.0, 0.0)


def tracked(time: np.ndarray, reference: np.ndarray, position: np.ndarray, **more: Any) -> Tracking:
    given = {"command": 0.0 * time, "limits": (-1.0, 1.0), **more}
    return tracking(Followed(time=time, reference=reference, position=position, **given))


@pytest.mark.parametrize("lag", [0.0, 0.0123, 0.1])
@pytest.mark.parametrize("count", [401, 4001])
def test_lag_of_a_sine_in_spite_of_gain_and_offset(lag, count):
    t = np.linspace(0.0, 4.0, count)
    reference = 0.02 * np.sin(2.0 * np.pi * t)
    position = 0.002 + 0.015 * np.sin(2.0 * np.pi * (t - lag))
    found = tracked(t, reference, position)
    assert found.lag == pytest.approx(lag, abs=2e-4)
    assert found.steps == []
    complex_error = 0.02 - 0.015 * np.exp(-2j * np.pi * lag)
    assert found.rms == pytest.approx(np.hypot(0.002, abs(complex_error) / np.sqrt(2.0)), rel=1e-3)


def test_the_correlations_of_all_shifts_are_those_of_each():
    a, b = np.cumsum(np.random.default_rng(3).normal(size=(2, 300)), axis=1)
    found = _correlations(a, b, 76)
    each = [np.corrcoef(a[: 300 - k], b[k:])[0, 1] for k in range(76)]
    assert found == pytest.approx(each, abs=1e-12)
    assert not _correlations(np.zeros(20), b[:20], 6).any()


def test_a_short_period_does_not_make_a_later_lag():
    t = np.linspace(0.0, 4.0, 2001)
    reference, position = (np.sin(2.0 * np.pi * (t - shift) / 0.25) for shift in (0.0, 0.03))
    assert tracked(t, reference, position).lag == pytest.approx(0.03, abs=2e-4)


def test_overshoot_of_every_step():
    t = np.linspace(0.0, 4.0, 4001)
    reference = np.where(t < 1.0, 0.0, np.where(t < 2.5, 0.02, 0.01))
    position = reference.copy()
    position[(t > 1.2) & (t < 1.3)] = 0.023
    position[(t > 2.6) & (t < 2.7)] = 0.009
    first, second = tracked(t, reference, position).steps
    assert first.time == pytest.approx(1.0)
    assert (first.size, first.overshoot) == pytest.approx((0.02, 0.15))
    assert (second.size, second.overshoot) == pytest.approx((-0.01, 0.1))


def test_lag_of_a_step_behind_a_pure_dead_time():
    t = np.linspace(0.0, 4.0, 4001)
    found = tracked(t, np.where(t < 1.0, 0.0, 0.02), np.where(t < 1.2, 0.0, 0.02))
    assert found.lag == pytest.approx(0.2, abs=0.005)
    assert found.max == pytest.approx(0.02)


def test_lag_that_does_not_exist_says_why():
    t = np.linspace(0.0, 1.0, 101)
    assert "does not change" in tracked(t, 0 * t, t).notes["lag"]
    away = tracked(t, t**2, -t)
    assert away.lag is None
    assert "fits" in away.notes["lag"]
    with pytest.raises(ValueError, match="same length"):
        tracked(t, t[1:], t)


def test_a_first_order_answer_settles_in_its_closed_form():
    """1 - exp(-t/tau) is within 2 % after tau ln 50."""
    found = tracked(T, STEP, np.where(T < 1.0, 0.0, 0.02 * (1.0 - np.exp(-LATE / 0.2))))
    assert found.state == "settles"
    assert found.steps[0].settling_time == pytest.approx(0.2 * np.log(50.0), abs=1.1e-3)
    assert found.steps[0].steady_error == pytest.approx(0.0, abs=1e-6)
    assert found.advice is None


@pytest.mark.parametrize("damping", [0.05, 0.2, 0.4])
def test_a_second_order_answer_overshoots_by_its_closed_form(damping):
    """exp(-pi zeta/sqrt(1 - zeta^2)), swinging at w sqrt(1 - zeta^2)."""
    w = 2.0 * np.pi * 5.0
    free = w * np.sqrt(1.0 - damping**2)
    answer = 1.0 - np.exp(-damping * w * LATE) * (
        np.cos(free * LATE) + damping / np.sqrt(1.0 - damping**2) * np.sin(free * LATE)
    )
    found = tracked(T, STEP, np.where(T < 1.0, 0.0, 0.02 * answer))
    assert found.steps[0].overshoot == pytest.approx(np.exp(-np.pi * damping * w / free), rel=2e-3)
    assert found.state == "settles"


def swinging() -> np.ndarray:
    return np.where(T < 1.0, 0.0, 0.02 + 0.003 * np.sin(2.0 * np.pi * 3.7 * LATE))


def test_a_limit_cycle_swings_with_its_frequency_and_share_of_the_step():
    found = tracked(T, STEP, swinging())
    step = found.steps[0]
    assert found.state == step.state == "swings"
    assert step.settling_time is None
    assert step.swing_frequency == pytest.approx(3.7, rel=1e-4)
    assert step.swing_amplitude == pytest.approx(0.003, rel=1e-3)
    assert "15 % of the step" in found.verdict
    assert "3.7 Hz" in found.verdict
    growing = np.where(T < 1.0, 0.0, 0.02 + 0.001 * np.exp(0.5 * LATE) * np.sin(2.0 * np.pi * 3.7 * LATE))
    assert tracked(T, STEP, growing).state == "unstable"
    assert "friction" not in (found.advice or "")
    assert "hunts" in (tracked(T, STEP, swinging(), rubs=True).advice or "")


def test_what_rests_away_from_the_reference_says_why():
    short = np.where(T < 1.0, 0.0, 0.015 * (1.0 - np.exp(-LATE / 0.1)))
    beyond = np.where(T < 1.0, 0.0, 0.036 * (1.0 - np.exp(-LATE / 0.1)))
    vented, full = np.where(T < 1.5, 2e5, 0.0), np.where(T < 1.5, 2e5, 6e5)
    assert tracked(T, STEP, short).state == "beside"
    assert tracked(T, STEP, short, integrates=False).advice == "an integral gain"
    assert tracked(T, STEP, short, command=np.where(T < 1.2, 0.0, 1.0)).state == "saturates"
    assert tracked(T, STEP, short, pressure=full, full_pressure=6e5).state == "saturates"
    assert tracked(T, STEP, short, contact=T > 1.6).state == "on_stop"
    assert tracked(T, STEP, beyond, pressure=vented).state == "cannot_return"
    assert "16 mm beyond" in tracked(T, STEP, beyond, pressure=vented).verdict
    assert tracked(T, STEP, beyond, pressure=vented, pulled_back=True).state == "beside"
    assert tracked(T, STEP, np.where(T < 1.0, 0.0, 0.01 * LATE)).state == "moves"


def test_the_run_is_as_good_as_its_worst_step():
    reference = np.where(T < 1.0, 0.0, np.where(T < 2.5, 0.02, 0.01))
    position = np.where(T < 2.5, reference, 0.01 + 0.002 * np.sin(20.0 * np.pi * T))
    found = tracked(T, reference, position)
    assert [step.state for step in found.steps] == ["settles", "swings"]
    assert found.state == "swings"
    assert "in 1 of 2 steps" in found.verdict
    assert "after 2.5 s" in found.verdict


def test_a_first_level_away_from_the_load_is_a_step():
    found = tracked(T, np.full(len(T), 0.02), 0.02 * (1.0 - np.exp(-T / 0.2)))
    assert [(step.time, step.size, step.state) for step in found.steps] == [(0.0, 0.02, "settles")]


@pytest.mark.parametrize(("gain", "state"), [(0.98, "tracks"), (0.5, "deviates")])
def test_a_sine_is_tracked_or_not(gain, state):
    reference = 0.02 * np.sin(2.0 * np.pi * T)
    found = tracked(T, reference, gain * reference)
    assert found.state == state
    assert found.rms == pytest.approx((1.0 - gain) * 0.02 / np.sqrt(2.0), rel=1e-4)
    limited = tracked(T, reference, 0.5 * reference, command=np.ones(len(T)))
    assert limited.state == "saturates"


def test_a_swing_needs_two_even_periods():
    sine = np.sin(2.0 * np.pi * 3.0 * T)
    found = swing_of(T, 5.0 + sine)
    assert found is not None
    assert (found.frequency, found.amplitude, found.growth) == pytest.approx((3.0, 1.0, 1.0), rel=1e-3)
    dying = swing_of(T, np.exp(-0.3 * T) * sine)
    assert dying is not None
    assert dying.growth == pytest.approx(np.exp(-0.1), rel=5e-3)
    growing = swing_of(T, np.exp(0.3 * T) * sine)
    assert growing is not None
    assert growing.growth == pytest.approx(np.exp(0.1), rel=5e-2)
    assert swing_of(T, T) is None
    assert swing_of(T, np.sin(2.0 * np.pi * 0.4 * T)) is None
    assert swing_of(T, 0.0 * T) is None
    assert swing_of(T, np.random.default_rng(1).normal(size=len(T)) + T) is None
