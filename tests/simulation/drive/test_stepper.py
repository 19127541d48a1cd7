"""A drive carried step by step is the drive of a run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mckibben as mk

DRIVE: dict[str, Any] = {
    "muscle": "DMSP-20:400mm", "valve": "MPYE-5-1/8-LF", "tube": "PUN-H-6x1", "supply": "6 bar",
    "load": "12 kg", "command": {"shape": "pulse", "on": "0.02 s", "off": "0.32 s"}, "duration": "0.6 s",
    "effects": {"bladder_elasticity": {}, "coulomb_friction": {}, "viscous_damping": {}},
}  # fmt: skip
DELAYED = {**DRIVE["effects"], "valve_delay": {"opening_time": "13 ms", "closing_time": "7 ms"}}
PAIR = {
    "muscle": "DMSP-20:300mm", "valve": "VPPM-6", "start_pressure": "3 bar", "duration": "0.6 s",
    "load": {"mass": "4 kg", "arrangement": "antagonist", "pulley_radius": "30 mm"},
    "command": {"shape": "pulse", "on": "0.02 s", "off": "0.32 s", "level": 0.7},
}  # fmt: skip


@pytest.mark.parametrize("changes", [{}, {"effects": DELAYED}, PAIR], ids=["drive", "dead times", "pair"])
def test_steps_and_looks_ahead_are_the_run(changes: dict[str, Any]) -> None:
    drive = mk.Drive(**{**({} if "load" in changes else DRIVE), **changes})
    run = drive.run(points=61)
    plant = drive.stepper("10 ms")
    rest, level = plant.command, changes.get("command", {}).get("level", 1.0)
    commands = np.array([level if 0.02 <= 0.01 * k + 1e-9 < 0.32 else rest for k in range(60)])
    ahead = plant.ahead(np.array([commands, np.full(60, rest)]))
    read = [plant.read()]
    for command in commands:
        plant.set(command)
        plant.step()
        read.append(plant.read())
    for name, within in (("position", 2e-6), ("pressure", 50.0), ("velocity", 2e-3)):
        assert [each[name] for each in read] == pytest.approx(getattr(run, name).tolist(), abs=within)
    if "valve_delay" not in changes.get("effects", {}):  # by whole steps there
        assert ahead[0] == pytest.approx([each["position"] for each in read[1:]], abs=2e-6)
    assert np.ptp(ahead[1]) < np.ptp(ahead[0])


def test_a_copy_goes_its_own_way_and_what_cannot_be_is_refused() -> None:
    plant = mk.Drive(**DRIVE).stepper(0.01)
    other = plant.copy()
    other.set(1.0)
    other.step(10)
    assert (plant.time, plant.position) == (0.0, 0.0)
    assert other.time == pytest.approx(0.1)
    assert other.pressure > 1e5
    with pytest.raises(mk.Problem, match="command of 2 is not between -1 and 1"):
        plant.set(2.0)
    with pytest.raises(mk.Problem, match=r"no reading 'positon'.*position"):
        plant.ahead([0.0], read="positon")
    with pytest.raises(mk.Problem, match="dt"):
        mk.Drive(**DRIVE).stepper(0)
    with pytest.raises(mk.Problem, match="pulse-width"):
        mk.Drive(**DRIVE, pwm={"frequency": "20 Hz"}).stepper("1 ms")


def test_a_plant_carries_its_state_in_a_vector() -> None:
    """What python-control calls, without it."""
    from mckibben.simulation.drive.stepper import Stepper

    drive = mk.Drive(**DRIVE)
    engine = Stepper(drive._annotated().drive, 0.01)
    vector = engine.vector
    for _ in range(5):
        vector = engine.carried(vector, 1.0, 0.0)
    assert engine.time == 0.0
    engine.set(1.0)
    for _ in range(5):
        engine.step()
    assert vector == pytest.approx(engine.vector, rel=1e-6, abs=1e-9)
    delayed = Stepper(mk.Drive(**{**DRIVE, "effects": DELAYED})._annotated().drive, 0.01)
    with pytest.raises(ValueError, match="dead times"):
        delayed.carried(delayed.vector, 1.0, 0.0)
