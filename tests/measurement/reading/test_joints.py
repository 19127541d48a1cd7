"""Joints: torque over angle with one or two pressures, and one muscle on a pulley as on its rim."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import spoken_correction
from mckibben.physics.errors import InputError

RADIUS = 0.03  # m
TIME = np.arange(120.0)
SWING = np.sin(TIME / 12.0)


def read(second: np.ndarray, columns: list[str], ignore: list[str]) -> Measurement:
    """A joint that swings slowly: pressures in kPa, angle in degrees, torque in Nm."""
    first = 250.0 + 80.0 * SWING
    angle, torque = 20.0 - 15.0 * np.cos(TIME / 30.0), 0.03 * (first - second) + 2.0
    rows = [
        f"{t:.0f};{p:.2f};{q:.2f};{a:.4f};{m:.5f}"
        for t, p, q, a, m in zip(TIME, first, second, angle, torque, strict=True)
    ]
    text = "\n".join(["# rest length 300 mm", "t [s];P1 [kPa];P2 [kPa];angle [deg];torque [Nm]", *rows])
    return read_measurement(text.encode(), "joint.csv", spoken_correction(columns=columns, ignore=ignore))


RIM = f"{np.radians(90.0) * RADIUS * 1e3:.6f}"
ON_RIM = ["force=torque [0 to 3 Nm = 0 to 100 N]", f"displacement=angle [0 to 90 deg = 0 to {RIM} mm]"]


def test_a_joint_of_two_muscles_is_torque_over_angle_with_two_pressures() -> None:
    found = read(250.0 - 80.0 * SWING, [], [])
    assert found.columns["pressure"] == pytest.approx(1e3 * (250.0 + 80.0 * SWING), abs=6.0)
    assert found.columns["counter_pressure"] == pytest.approx(1e3 * (250.0 - 80.0 * SWING), abs=6.0)
    assert found.columns["angle"] == pytest.approx(np.radians(20.0 - 15.0 * np.cos(TIME / 30.0)), abs=1e-5)
    assert found.columns["torque"] == pytest.approx(0.03 * 160.0 * SWING + 2.0, abs=1e-4)
    assert "force" not in found.columns
    assert any("'P2 [kPa]' is read as the pressure of the second muscle" in said for said in found.messages)


def test_one_pressure_twice_is_none_of_a_second_muscle() -> None:
    assert "counter_pressure" not in read(251.0 + 80.5 * SWING, [], []).columns


def test_whoever_takes_one_of_its_pressures_is_told_what_that_means() -> None:
    found = read(250.0 - 80.0 * SWING, ["pressure=P1", *ON_RIM], [])
    assert any("force is that of both" in message for message in found.messages)


def test_one_muscle_on_a_pulley_is_read_as_on_its_rim() -> None:
    """The other one is vented: force = torque / radius, stroke = radius x angle."""
    found = read(np.zeros(len(TIME)), ["pressure=P1", *ON_RIM], ["P2"])
    torque = 0.03 * (250.0 + 80.0 * SWING) + 2.0
    assert found.columns["force"] == pytest.approx(torque / RADIUS, abs=1e-3)
    angle = np.radians(20.0 - 15.0 * np.cos(TIME / 30.0))
    assert found.columns["displacement"] == pytest.approx(RADIUS * angle, abs=1e-6)
    assert not any("second muscle" in message for message in found.messages)


def test_a_torque_without_a_force_is_asked_about() -> None:
    with pytest.raises(InputError, match="holds a torque, and the file has no force") as error:
        read(np.zeros(len(TIME)), ["pressure=P1", ON_RIM[1]], ["P2"])
    assert "radius" in str(error.value)
