"""Every scenario beside scipy's Radau at 1e-10: at most 1e-5 m apart anywhere."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mckibben.documents.drive_files import preset_document
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.resources import presets_folder
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times, parameters_of, segments_of, simulate
from mckibben.simulation.integrate.engine import compiled_drive

# The controlled runs do not drift apart: over their whole 6 s they stay as near as over half.
HORIZON = 3.0
STUDIO = Studio(presets=presets_folder())
SCENARIOS = {
    preset.id: drive_of(preset_document(preset.id, STUDIO), STUDIO).drive
    for preset in STUDIO.library.list("drives")
}
FREE = {name: drive for name, drive in SCENARIOS.items() if drive.controller is None}
CONTROLLED = {name: drive for name, drive in SCENARIOS.items() if drive.controller is not None}


def radau(drive: Drive, time: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Strokes at the times from the same equations by another method."""
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    times, inputs, _ = segments_of(drive)
    scale = np.array([state.scale for state in compiled.model.states])
    size, y = compiled.size, start
    names = [state.name for state in compiled.model.states]
    strokes = np.full(len(time), np.nan)
    for segment, given in enumerate(inputs):
        begin, end = times[segment], times[segment + 1]
        rows = (time >= begin) & ((time < end) | (segment == len(inputs) - 1))

        def rates(_t, y, given=given):
            return compiled.rates(np.concatenate([y, parameters, given]))[:size]

        def jacobian(_t, y, given=given):
            return compiled.jacobian(np.concatenate([y, parameters, given]))[size:].reshape(size, size)

        grid = np.union1d(time[rows], end)
        found = solve_ivp(rates, (begin, end), y, "Radau", grid, jac=jacobian, rtol=1e-10, atol=1e-10 * scale)
        strokes[rows] = found.y[names.index("stroke"), np.isin(grid, time[rows])]
        y = found.y[:, -1]
    return strokes


@pytest.mark.parametrize("scenario", sorted(FREE))
def test_scenario(scenario: str) -> None:
    drive = FREE[scenario]
    run = simulate(drive, points=401, engine="rodas")
    start = np.array([run.states[state.name][0] for state in compiled_drive(drive.structure).model.states])
    assert len(run.time) == 401
    assert np.max(np.abs(run.states["stroke"] - radau(drive, run.time, start))) <= 1e-5


def sampled_radau(drive: Drive, start: np.ndarray) -> np.ndarray:
    """Strokes at every sample: Radau from sample to sample, and a PID written on its own in between."""
    compiled, controller, reference = compiled_drive(drive.structure), drive.controller, drive.reference
    assert controller is not None
    assert reference is not None
    assert dead_times(drive) == (0.0, 0.0), "a command acts at once"
    codes, size = compiled.codes, compiled.size
    constants = codes.constants(parameters_of(drive, compiled))
    names = [state.name for state in compiled.model.states]
    scale = np.array([state.scale for state in compiled.model.states])
    period = controller.sample_time
    samples = round(HORIZON / period)
    packed = np.concatenate([start, constants, np.zeros(len(INPUTS))])

    def rates(_t, y):
        packed[:size] = y
        return codes.rates(packed)[:size]

    def jacobian(_t, y):
        packed[:size] = y
        return compiled.dense(codes.jacobian(packed))

    def measured(y):
        packed[:size] = y
        return codes.rates(packed)[size + OUTPUTS.index("stroke_reading")] / drive.load.lever_ratio

    y, integral, slope, last = start, 0.0, 0.0, measured(start)
    strokes = [start[names.index("stroke")]]
    inputs = {name: size + len(constants) + index for index, name in enumerate(INPUTS)}
    for sample in range(samples):
        here, wanted = measured(y), float(reference.value(sample * period))
        slope = controller.derivative_filter * slope + here - last
        slope, last = slope / (controller.derivative_filter + period), here
        fixed = controller.kp * (wanted - here) - controller.kd * slope + controller.feed_forward * wanted
        grown = integral + controller.ki * period * (wanted - here)
        outside = not controller.output_min <= fixed + grown <= controller.output_max
        further = (grown > integral) == (fixed + grown > controller.output_max)
        integral = integral if outside and further else grown
        command = float(np.clip(fixed + integral, controller.output_min, controller.output_max))
        packed[inputs["opening"]] = command
        packed[inputs["counter_opening"]] = drive.counter(command)
        packed[inputs["begin"]] = begin = sample * period
        span = (begin, begin + period)
        y = solve_ivp(rates, span, y, "Radau", jac=jacobian, rtol=1e-10, atol=1e-10 * scale).y[:, -1]
        strokes.append(y[names.index("stroke")])
    return np.array(strokes)


@pytest.mark.parametrize("scenario", sorted(CONTROLLED))
def test_controlled_scenario(scenario: str) -> None:
    drive = CONTROLLED[scenario]
    assert drive.controller is not None
    grid = np.arange(round(HORIZON / drive.controller.sample_time) + 1) * drive.controller.sample_time
    run = simulate_controlled(drive, grid=grid)
    start = np.array([run.states[state.name][0] for state in compiled_drive(drive.structure).model.states])
    assert np.max(np.abs(run.states["stroke"] - sampled_radau(drive, start))) <= 1e-5


def test_there_are_scenarios_of_both_kinds() -> None:
    assert len(FREE) >= 5
    assert len(CONTROLLED) >= 3
