"""Every scenario without a controller beside scipy's Radau at 1e-10: at most 1e-5 m apart anywhere."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mckibben.api.answers.simulations import preset_document
from mckibben.drive_input import drive_of
from mckibben.resources import presets_folder
from mckibben.simulation.engine import compiled_drive
from mckibben.simulation.parts import Drive
from mckibben.simulation.transient import parameters_of, segments_of, simulate
from mckibben.studio import Studio

STUDIO = Studio(presets=presets_folder())
SCENARIOS = {
    preset.id: drive_of(preset_document(preset.id, STUDIO), STUDIO).drive
    for preset in STUDIO.library.list("drives")
}
FREE = {name: drive for name, drive in SCENARIOS.items() if drive.controller is None}


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


def test_there_are_scenarios_of_both_kinds() -> None:
    assert len(FREE) >= 5
    assert len(SCENARIOS) - len(FREE) >= 3
