"""Joints of two muscles: they are refused with what can be done, and one muscle on a pulley can be read."""

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


def test_a_joint_is_refused_with_what_can_be_done_instead() -> None:
    with pytest.raises(InputError, match="joint of two muscles") as error:
        read(250.0 - 80.0 * SWING, [], [])
    for said in ("one of them vented", "antagonist", "force=torque [0 to 3 Nm", "displacement=angle"):
        assert said in str(error.value)
    assert "no text states the radius" not in str(error.value)  # which muscle is meant comes first


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
