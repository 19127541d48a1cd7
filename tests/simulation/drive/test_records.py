"""Driven runs against the static model, a closed form of a filter, and the free drive itself."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.drive.records import force_of_record, motion_of_record
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
TIME = np.linspace(0.0, 4.0, 401)
LENGTH = 0.28 + 0.012 * np.sin(1.7 * TIME)
PRESSURE = 4e5 + 1e5 * np.cos(0.9 * TIME)
RECORD = {"time": TIME, "pressure": PRESSURE, "length": LENGTH}


def test_without_memory_it_is_the_static_force():
    model = StaticModel(MUSCLE, {"bladder_elasticity": {}, "prestress": {}, "end_caps": {}})
    expected = model.force(pressure=PRESSURE, length=LENGTH)
    assert force_of_record(model, **RECORD) == pytest.approx(expected, rel=1e-9)


def test_sensor_errors_reach_the_reading():
    errors = {
        "pressure_offset": {"offset": 2e4},
        "force_scale": {"scale": 1.02},
        "length_offset": {"offset": 1e-3},
    }
    expected = 1.02 * StaticModel(MUSCLE).force(pressure=PRESSURE - 2e4, length=LENGTH - 1e-3)
    assert force_of_record(StaticModel(MUSCLE, errors), **RECORD) == pytest.approx(expected, rel=1e-9)


def test_friction_follows_the_direction_of_motion():
    plain = force_of_record(StaticModel(MUSCLE), **RECORD)
    rough = force_of_record(StaticModel(MUSCLE, {"coulomb_friction": {"force": 15.0}}), **RECORD)
    velocity = np.gradient(LENGTH, TIME)
    fast = np.abs(velocity) > 0.01
    assert (rough - plain)[fast] == pytest.approx(15.0 * np.sign(velocity[fast]), rel=0.01)


def test_times_that_do_not_ascend_are_refused():
    with pytest.raises(InputError, match="ascend"):
        force_of_record(StaticModel(MUSCLE), time=TIME[::-1], pressure=PRESSURE, length=LENGTH)


def test_motion_under_the_pressure_of_a_free_run_repeats_it():
    muscle = Muscle(0.8, 0.0218, radians(26.5), 0.0018, 0.02)
    model = StaticModel(muscle, {"bladder_elasticity": {}, "prestress": {"force": 25.0}})
    command = signal_from(
        {"shape": "pulse", "on": "0 s", "off": "1 s", "initial": -1.0}, unit="1", field="command"
    )
    drive = Drive(model, Valve(1e-8, 1e-8), Load(mass=8.0), command, 2.0, 6e5)
    free = simulate(drive, points=8001, tolerance=1e-7)
    driven = motion_of_record(
        drive, time=free.time, pressure=free.pressure, stroke=float(free.states["stroke"][0])
    )
    assert driven["stroke"] == pytest.approx(free.states["stroke"], abs=2e-5)
    assert np.ptp(driven["stroke"]) > 0.1
