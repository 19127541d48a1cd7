"""Where a drive rests, against roots of the ideal muscle's quadratic and a run that has come to rest."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians, sin, sqrt, tan

import numpy as np
import pytest

from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.drive.static_contraction import static_contraction
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel

LENGTH, DIAMETER, ANGLE, GRAVITY = 0.3, 0.02, radians(25.0), 9.80665
#: The ideal muscle pulls p (A (1 - k)^2 - B) (Chou and Hannaford 1996, eq. 8).
A = 0.25 * pi * DIAMETER**2 * 3.0 / tan(ANGLE) ** 2
B = 0.25 * pi * DIAMETER**2 / sin(ANGLE) ** 2
SINGLE = Drive(
    model=StaticModel(Muscle(LENGTH, DIAMETER, ANGLE)),
    valve=Valve(1e-8, 1e-8),
    load=Load(mass=100.0, spring=2e4, lever_ratio=2.0),
    command=signal_from({"shape": "step", "at": "0 s", "level": 0.0}, unit="1", field="command"),
    duration=1.0,
    supply_pressure=6e5,
    max_contraction=0.3,
)


def resting(drive: Drive, pressures: list[float], forces: list[float], counter: list[float] | None = None):
    second = None if counter is None else np.array(counter)
    return static_contraction(
        drive,
        pressure=np.array(pressures),
        counter_pressure=second,
        load_force=np.array(forces),
        direction=0.0,
    )


def test_weight_spring_and_lever_against_the_quadratic():
    """i^2 p (A (1 - k)^2 - B) = i (W + F) + c k L, in r = 1 - k: a r^2 + b r + d = 0."""
    pressures, forces = [3e5, 4e5, 6e5], [100.0, -150.0, 50.0]
    load = SINGLE.load
    wanted = []
    for p, f in zip(pressures, forces, strict=True):
        a, b = load.lever_ratio**2 * p * A, load.spring * LENGTH
        d = -(load.lever_ratio**2) * p * B - load.lever_ratio * (load.mass * GRAVITY + f) - b
        wanted.append(1.0 - (-b + sqrt(b * b - 4.0 * a * d)) / (2.0 * a))
    assert all(0.0 < k < 0.3 for k in wanted)
    assert resting(SINGLE, pressures, forces) == pytest.approx(wanted, abs=1e-9)


def test_a_pair_against_the_quadratic():
    """p (A (1 - m - u)^2 - B) - q (A (1 - m + u)^2 - B) = F, with the stroke u L from the middle m."""
    middle = 0.1
    pair = replace(SINGLE, load=Load(inclination=0.0), pair=True, precontraction=middle, max_contraction=0.2)
    p, q, force = [2e5, 3e5, 5e5], [2e5, 2e5, 4e5], [100.0, 150.0, 50.0]
    wanted = []
    for one, two, f in zip(p, q, force, strict=True):
        r = 1.0 - middle
        a, b = (one - two) * A, -2.0 * (one + two) * A * r
        d = (one - two) * (A * r * r - B) - f
        wanted.append(middle + (-d / b if a == 0.0 else (-b - sqrt(b * b - 4.0 * a * d)) / (2.0 * a)))
    assert all(0.0 < k < 0.2 for k in wanted)
    assert resting(pair, p, force, q) == pytest.approx(wanted, abs=1e-9)
    assert np.isnan(resting(pair, [0.0], [0.0], [0.0])).all()


def test_stops_and_a_place_that_nothing_determines():
    free = replace(SINGLE, load=Load(inclination=0.0))
    lock = 1.0 - sqrt(B / A)  # free contraction of the ideal muscle
    found = resting(replace(free, max_contraction=0.4), [0.0, 0.0, 0.0, 1e5], [0.0, 10.0, -10.0, 0.0])
    assert np.isnan(found[0])
    assert found[1:] == pytest.approx([0.0, 0.4, lock], abs=1e-9)


def test_a_run_that_has_come_to_rest_is_there():
    model = StaticModel(Muscle(LENGTH, DIAMETER, ANGLE), {"viscous_damping": {"coefficient": 2000.0}})
    command = signal_from({"shape": "step", "at": "0 s", "level": 1.0}, unit="1", field="command")
    run = simulate(replace(SINGLE, model=model, command=command, duration=10.0), points=11)
    found = resting(SINGLE, [float(run.pressure[-1])], [0.0])
    assert run.states["stroke"][-1] / LENGTH == pytest.approx(found[0], abs=1e-5)
    assert 0.0 < found[0] < 0.3


def test_friction_acts_against_the_motion():
    friction = StaticModel(Muscle(LENGTH, DIAMETER, ANGLE), {"coulomb_friction": {}})
    drive = replace(SINGLE, model=friction)
    at = {"pressure": np.array([4e5]), "counter_pressure": None, "load_force": np.array([50.0])}
    up, free, down = (static_contraction(drive, direction=way, **at)[0] for way in (-1.0, 0.0, 1.0))
    assert up < free < down
