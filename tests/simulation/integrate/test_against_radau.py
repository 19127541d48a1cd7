"""Every scenario beside scipy's Radau at 1e-10: at most 1e-5 m apart anywhere."""

from __future__ import annotations

import os

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.initial_state import Start
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times, simulate
from tests.shipped import shipped_studio
from tests.simulation.event_radau import EventRadau, strokes

# Seconds of the controlled runs, which do not drift apart: over their whole 6 s (`MCKIBBEN_HORIZON=6`) they
# stay as near as over a part.
HORIZON = float(os.environ.get("MCKIBBEN_HORIZON", "1.5"))
STUDIO = shipped_studio()
SCENARIOS = {
    preset.id: drive_of(preset_document(preset.id, STUDIO), STUDIO).drive
    for preset in STUDIO.library.list("drives")
}
FREE = {name: drive for name, drive in SCENARIOS.items() if drive.controller is None}
#: The control of angle and stiffness is examined in tests/simulation/drive/test_joint.py.
CONTROLLED = {
    name: drive for name, drive in SCENARIOS.items() if drive.controller is not None and name != "joint-20"
}


@pytest.mark.parametrize("scenario", sorted(FREE))
def test_scenario(scenario: str) -> None:
    drive = FREE[scenario]
    run = simulate(drive, points=401)
    assert len(run.time) == 401
    assert np.max(np.abs(run.states["stroke"] - strokes(drive, run.start, run.time))) <= 1e-5


def sampled_radau(drive: Drive, start: Start) -> np.ndarray:
    """Strokes at every sample: Radau from sample to sample, and a PID written on its own in between."""
    controller, reference = drive.controller, drive.reference
    assert controller is not None
    assert reference is not None
    assert dead_times(drive) == (0.0, 0.0), "a command acts at once"
    run = EventRadau(drive, start)
    stroke = run.names.index("stroke")
    period = controller.sample_time
    samples = round(HORIZON / period)
    given = np.zeros(len(INPUTS))

    def measured() -> float:
        return run.outputs(given)[OUTPUTS.index("stroke_reading")] / drive.load.lever_ratio

    integral, slope, last = 0.0, 0.0, measured()
    found = [run.state[stroke]]
    for sample in range(samples):
        here, wanted = measured(), float(reference.value(sample * period))
        slope = controller.derivative_filter * slope + here - last
        slope, last = slope / (controller.derivative_filter + period), here
        fixed = controller.kp * (wanted - here) - controller.kd * slope + controller.feed_forward * wanted
        grown = integral + controller.ki * period * (wanted - here)
        outside = not controller.output_min <= fixed + grown <= controller.output_max
        further = (grown > integral) == (fixed + grown > controller.output_max)
        integral = integral if outside and further else grown
        command = float(np.clip(fixed + integral, controller.output_min, controller.output_max))
        begin = sample * period
        values = {"opening": command, "counter_opening": drive.counter(command), "begin": begin}
        given = np.array([values.get(name, 0.0) for name in INPUTS])
        run.advance(begin, begin + period, given, np.empty(0))
        found.append(run.state[stroke])
    return np.array(found)


@pytest.mark.parametrize("scenario", sorted(CONTROLLED)[:1])
def test_controlled_scenario(scenario: str) -> None:
    drive = CONTROLLED[scenario]
    assert drive.controller is not None
    grid = np.arange(round(HORIZON / drive.controller.sample_time) + 1) * drive.controller.sample_time
    run = simulate_controlled(drive, grid=grid)
    assert np.max(np.abs(run.states["stroke"] - sampled_radau(drive, run.start))) <= 1e-5


@pytest.mark.examination("test_controlled_scenario")
@pytest.mark.parametrize("scenario", sorted(CONTROLLED)[1:])
def test_further_controlled_scenarios(scenario: str) -> None:
    test_controlled_scenario(scenario)


def test_there_are_scenarios_of_both_kinds() -> None:
    assert len(FREE) >= 5
    assert len(CONTROLLED) >= 3
