"""Sensors that clip or stick are found; held, rounded, resting and stepped signals are left alone."""

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from mckibben.measurement.measurement import Measurement, build
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.saturation import unusable_rows

DATA = Path(__file__).parents[3] / "shared" / "data"
ROWS = 4000
TIME = np.arange(ROWS) * 0.01
PHASE = (TIME / 10.0) % 1.0
TRIANGLE = np.where(PHASE < 0.5, 2 * PHASE, 2 - 2 * PHASE)
SINE = 0.5 - 0.5 * np.cos(2.0 * np.pi * PHASE)
SQUARE = ((np.arange(ROWS) // 500) % 2).astype(float)
STAIRS = (np.arange(ROWS) // 100 % 20) / 20.0
RAMP_AND_HOLD = np.clip(1.6 * TRIANGLE - 0.3, 0.0, 1.0)


class Sensors:
    """Readings with noise and rounding."""

    def __init__(self, noise: float, step: float) -> None:
        self.random = np.random.default_rng(1)
        self.noise, self.step = noise, step

    def __call__(self, true: np.ndarray, sigma: float, unit: float) -> np.ndarray:
        read = true + self.noise * sigma * self.random.standard_normal(len(true))
        return np.round(read / (self.step * unit)) * self.step * unit if self.step else read

    def pressure(self, true: np.ndarray) -> np.ndarray:
        return self(true, 50.0, 100.0)

    def stroke(self, true: np.ndarray) -> np.ndarray:
        return self(true, 1e-5, 1e-5)

    def force(self, true: np.ndarray) -> np.ndarray:
        return self(true, 1.0, 0.1)


def made(columns: dict, **more) -> Measurement:
    return build({"time": TIME, **columns}, name="a.csv", id="0" * 64, **more)


def isobaric(sensors: Sensors, stroke: np.ndarray, force: np.ndarray, pressure: float = 3e5) -> dict:
    return {
        "pressure": sensors.pressure(np.full(ROWS, pressure)),
        "length": sensors.stroke(0.3 - 0.05 * stroke),
        "force": force,
    }


def clipped_force(s: Sensors):
    true = 1500 * (1 - TRIANGLE) + 100
    return made(isobaric(s, TRIANGLE, np.minimum(s.force(true), 1300))), "force saturated", true > 1300


def clipped_smooth_force(s: Sensors):
    true = 1500 * (1 - SINE) + 100
    return made(isobaric(s, SINE, np.minimum(s.force(true), 1300))), "force saturated", true > 1300


def clipped_before_the_noise(s: Sensors):
    true = 1500 * (1 - TRIANGLE) + 100
    return made(isobaric(s, TRIANGLE, s.force(np.minimum(true, 1300)))), "force saturated", true > 1300


def clipped_below(s: Sensors):
    true = 1500 * (1 - TRIANGLE) - 300
    return made(isobaric(s, TRIANGLE, np.maximum(s.force(true), -3))), "force saturated", true < -3


def clipped_pressure(s: Sensors):
    pressure, force = 6e5 * TRIANGLE, s.force(1500 * TRIANGLE + 50)
    read = {"pressure": np.minimum(s.pressure(pressure), 5e5), "length": np.full(ROWS, 0.3), "force": force}
    return made(read), "pressure saturated", pressure > 5e5


def clipped_in_motion(s: Sensors):
    read = {"pressure": np.minimum(s.pressure(6e5 * SINE), 5e5), "displacement": s.stroke(0.05 * SINE)}
    return made(read, conditions={"load_mass": 3.0}), "pressure saturated", 6e5 * SINE > 5e5


def stuck_force(s: Sensors):
    force = s.force(1500 * (1 - TRIANGLE) + 100)
    force[700:800] = force[700]
    bad = np.zeros(ROWS, bool)
    bad[700:800] = True
    return made(isobaric(s, TRIANGLE, force)), "force stuck", bad


@pytest.mark.parametrize("noise", [0.0, 2.0])
@pytest.mark.parametrize("step", [0.0, 1.0])
@pytest.mark.parametrize(
    "case",
    [
        clipped_force,
        clipped_smooth_force,
        clipped_before_the_noise,
        clipped_below,
        clipped_pressure,
        clipped_in_motion,
        stuck_force,
    ],
)
def test_bad_sensors_are_found(case, noise, step):
    measurement, reason, bad = case(Sensors(noise, step))
    found = measurement.excluded_rows[reason]
    assert np.count_nonzero(found & ~bad) <= 0.02 * bad.sum() + 10, "healthy rows are excluded"
    assert np.count_nonzero(bad & ~found) <= 0.02 * bad.sum() + 10, "bad rows are missed"
    assert measurement.exclusions[reason] == np.count_nonzero(found & ~measurement.slack)
    assert not measurement.usable[found].any()
    assert any(reason in message for message in measurement.messages)


HEALTHY = {
    "sine": lambda s: made(isobaric(s, SINE, s.force(1500 * (1 - SINE) + 100))),
    "triangle": lambda s: made(isobaric(s, TRIANGLE, s.force(1500 * (1 - TRIANGLE) + 100))),
    "steps of a valve": lambda s: made(
        {
            "command": 2 * SQUARE - 1,
            "pressure": s.pressure(6e5 * lfilter([0.1], [1, -0.9], SQUARE)),
            "displacement": s.stroke(0.05 * lfilter([0.02], [1, -0.98], SQUARE)),
        }
    ),
    "held by a regulator": lambda s: made(
        {
            "pressure": s.pressure(6e5 * RAMP_AND_HOLD),
            "length": np.full(ROWS, 0.3),
            "force": s.force(9 + 1500 * RAMP_AND_HOLD + 20 * lfilter([0.005], [1, -0.995], RAMP_AND_HOLD)),
        }
    ),
    "on a stop": lambda s: made(
        {
            "pressure": s.pressure(6e5 * SINE),
            "displacement": s.stroke(np.clip(0.05 * (SINE * 1.4 - 0.2), 0.0, 0.04)),
        },
        conditions={"load_mass": 3.0},
    ),
    "levels of pressure": lambda s: made(
        {
            "pressure": s.pressure(np.repeat([1e5, 2e5, 4e5, 6e5], 1000)),
            "length": s.stroke(0.3 - 0.05 * TRIANGLE),
            "force": s.force(np.repeat([300.0, 600.0, 1200.0, 1800.0], 1000) * (1.01 - TRIANGLE)),
        }
    ),
    "set points": lambda s: made(
        {
            "pressure": s.pressure(6e5 * STAIRS),
            "length": np.full(ROWS, 0.3),
            "force": s.force(9 + 1500 * STAIRS),
        }
    ),
}


@pytest.mark.parametrize("noise", [0.0, 2.0])
@pytest.mark.parametrize("step", [0.0, 1.0, 50.0])
@pytest.mark.parametrize("case", HEALTHY)
def test_healthy_signals_are_left_alone(case, noise, step):
    assert dict(HEALTHY[case](Sensors(noise, step)).excluded_rows) == {}


@pytest.mark.parametrize(
    "name",
    [
        "DMSP-10-250_force_map.csv",
        "DMSP-20-300_force_map.csv",
        "musclesim_curves.csv",
        "static_hysteresis_0p10V_600ms.csv",
        "excitation_100Hz_first638rows.csv",
    ],
)
def test_real_measurements_are_left_alone(name):
    path = DATA / name
    if not path.exists():
        pytest.skip(f"reference file {name} is not beside this checkout")
    assert dict(read_measurement(path.read_bytes(), name).excluded_rows) == {}


def test_a_row_counts_once():
    slack = np.zeros(ROWS, bool)
    slack[:10] = True
    bad = np.zeros(ROWS, bool)
    bad[5:20] = True
    s = Sensors(0.0, 0.0)
    columns = isobaric(s, SINE, s.force(1500 * (1 - SINE) + 100))
    result = made(columns, marked_slack=slack, excluded_rows={"one": bad, "two": bad})
    assert dict(result.exclusions) == {"slack": 10, "one": 10}
    assert np.count_nonzero(result.usable) == ROWS - 20


def test_rows_in_which_the_muscle_pushes_are_left_out():
    """A force that runs through zero and on, and not the flat reading of a slack muscle with a wrong zero."""
    random = np.random.default_rng(4)
    pull = 220.0 * (1.0 - TRIANGLE / 0.9)
    read = pull + random.normal(0.0, 1.0, ROWS)
    columns = {"time": TIME, "pressure": np.full(ROWS, 2e5), "length": 0.3 - 0.06 * TRIANGLE}
    pushed = build({**columns, "force": read}, name="pushed", id="0")
    reason, count = next(iter(pushed.exclusions.items()))
    assert reason == "the muscle pushes (force below zero)"
    assert count == pytest.approx(np.count_nonzero(pull < -3.0), rel=0.1)
    slack = build({**columns, "force": np.maximum(pull, 0.0) - 15.0 + read - pull}, name="tared", id="1")
    assert slack.exclusions == {}
    wrong = build({**columns, "force": read - 150.0}, name="wrong zero", id="2")
    assert wrong.exclusions == {}


@pytest.mark.parametrize("noise", [0.0, 0.4])
def test_a_clipped_ramp_of_few_rows_is_found_whatever_its_noise(noise):
    """180 rows a loop, 5 N from row to row: too steep to show noise, and clipped to the last digit."""
    way = np.concatenate([np.linspace(0.0, 1.0, 90), np.linspace(1.0, 0.0, 90)])
    random = np.random.default_rng(6)
    true = np.concatenate([top * way for top in (250.0, 360.0, 620.0)]) + 40.0
    force = np.minimum(true + noise * random.standard_normal(len(true)), 445.0)
    columns = {
        "time": 0.3 * np.arange(len(true)),
        "pressure": np.repeat([1.4e5, 2.1e5, 4.1e5], 180) + 400.0 * random.standard_normal(len(true)),
        "length": 0.22 + 0.04 * np.tile(way, 3),
        "force": force,
    }
    found = build(columns, name="ramp", id="0", kind="isobaric").excluded_rows
    assert list(found) == ["force saturated"]
    assert np.array_equal(found["force saturated"], force == 445.0)
    assert np.count_nonzero(force == 445.0) > 50


def test_the_tops_of_slow_swings_against_a_spring_are_not_saturated():
    """One of the tops may be level by chance; the others are not, and a clipped cell clips all."""
    time = np.arange(0.0, 60.0, 0.02)
    frequency = np.where(time < 24.0, 0.1, 0.32)
    swing = np.sin(2.0 * np.pi * frequency * time)
    pressure = 3e5 + 2e5 * np.sin(2.0 * np.pi * frequency * (time + 0.12))
    columns = {"time": time, "pressure": pressure, "length": 0.21 - 0.012 * swing}
    force = 350.0 + 150.0 * swing
    slack = np.zeros(len(time), bool)
    for seed in range(6):
        noise = 1.5 * np.random.default_rng(seed).standard_normal(len(time))
        assert not unusable_rows(columns | {"force": force + noise}, "static", slack=slack)
        clipped = np.minimum(force, 440.0) + noise
        assert "force saturated" in unusable_rows(columns | {"force": clipped}, "static", slack=slack)


def test_a_hold_at_the_largest_force_under_a_steady_noisy_pressure_is_not_saturated():
    """The noise of a pressure that is constant throughout is no change that the force should show."""
    random = np.random.default_rng(2)
    way = np.concatenate([np.zeros(25), TRIANGLE])
    columns = {
        "time": 0.08 * np.arange(len(way)),
        "pressure": 2e5 + 600.0 * random.standard_normal(len(way)),
        "length": 0.118 - 0.02 * way,
        "force": 66.0 * (1.0 - 0.9 * way) + 0.12 * random.standard_normal(len(way)),
    }
    assert not unusable_rows(columns, "static", slack=np.zeros(len(way), bool))
