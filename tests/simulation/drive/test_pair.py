"""An antagonist pair on a pulley: symmetry, torque and stiffness against the two muscles taken alone."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians, sqrt

import numpy as np
import pytest

from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
MODEL = StaticModel(MUSCLE, {"bladder_elasticity": {}, "prestress": {"force": 25.0}})
MIDDLE, PRESSURE, MASS = 0.08, 3e5, 25.0


def signal(unit: str = "1", **shape):
    return signal_from(shape, unit=unit, field="command")


PAIR = Drive(
    model=MODEL,
    valve=Valve(0.0, 0.0),
    load=Load(mass=MASS, inclination=0.0),
    command=signal(shape="step", at="0 s", level=0.0),
    duration=2.0,
    supply_pressure=6e5,
    min_contraction=MIDDLE - 0.05,
    max_contraction=MIDDLE + 0.05,
    start_pressure=PRESSURE,
    pair=True,
    precontraction=MIDDLE,
)


def test_equal_pressures_hold_the_middle():
    run = simulate(PAIR)
    assert np.max(np.abs(run.states["stroke"])) < 1e-9
    expected = MODEL.force(length=0.3 * (1 - MIDDLE), pressure=PRESSURE)[0]
    assert run.outputs["force"][-1] == pytest.approx(expected, rel=1e-9)
    assert run.outputs["force@counter"][-1] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("exponent", [1.0, 1.4])
def test_the_joint_swings_with_both_closed_stiffnesses(exponent):
    kick = signal("N", shape="pulse", on="0 s", off="0.01 s", level="5 N")
    case = replace(PAIR, load=replace(PAIR.load, force=kick), polytropic_exponent=exponent)
    run = simulate(case, points=8001, tolerance=1e-9)
    late = run.time > 0.05
    t, y = run.time[late], run.states["stroke"][late]
    y = y - 0.5 * (y.max() + y.min())
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    crossings = t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])
    found = 2 * pi / np.mean(np.diff(crossings))
    curves = MODEL.curves(np.array([PRESSURE]), np.array([0.3 * (1 - MIDDLE)]), polytropic_exponent=exponent)
    assert found == pytest.approx(sqrt(2 * curves.stiffness_closed[0, 0] / MASS), rel=1e-3)


def test_the_valves_work_against_each_other_and_end_where_the_tensions_balance():
    damped = {
        "bladder_elasticity": {},
        "prestress": {"force": 25.0},
        "viscous_damping": {"coefficient": 200.0},
    }
    case = replace(
        PAIR,
        model=StaticModel(MUSCLE, damped),
        valve=Valve(5e-9, 5e-9),
        command=signal(shape="pulse", on="0 s", off="0.1 s", level=1.0, initial=0.0),
        duration=4.0,
    )
    run = simulate(case, points=4001)
    first, second = (run.states[name][-1] - 101325.0 for name in ("pressure", "pressure@counter"))
    assert first > PRESSURE > second > 0.0
    stroke = run.states["stroke"][-1]
    assert 0.002 < stroke < 0.015
    pulls = [
        MODEL.force(length=0.3 * (1 - MIDDLE) - sign * stroke, pressure=pressure)[0]
        for sign, pressure in ((1, first), (-1, second))
    ]
    assert pulls[0] == pytest.approx(pulls[1], abs=0.5)
