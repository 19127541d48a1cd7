"""A drive and others that differ little from it, run with the same steps: differences are derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    before_of,
    parameters_of,
    segments_of,
    skewed,
)
from mckibben.simulation.integrate.engine import compiled_drive
from mckibben.simulation.integrate.many import integrate_many

READINGS = ("pressure_reading", "stroke_reading", "force_reading")


def neighbours(
    drives: Sequence[Drive], *, grid: np.ndarray, tolerance: float = TOLERANCE
) -> list[dict[str, np.ndarray] | None]:
    """Readings of each drive on a grid, by the names of `READINGS`; the first one sets the steps of all.

    None for a drive that does not run like the first: its command changes at other instants, other switches
    change, its structure is another, or it cannot be run. If that is the first one, all are None.
    """
    first = drives[0]
    compiled = compiled_drive(first.structure)
    segments = [segments_of(drive) for drive in drives]
    times = segments[0][0]
    found: list[dict[str, np.ndarray] | None] = [None] * len(drives)
    chosen = [
        index
        for index, drive in enumerate(drives)
        if np.array_equal(segments[index][0], times) and drive.structure == first.structure
    ]
    parameters = np.array([parameters_of(drives[index], compiled) for index in chosen])
    inputs = np.array([segments[index][1] for index in chosen])
    before = np.array([before_of(drives[index], segments[index][1]) for index in chosen])
    starts = starts_of_many([drives[index] for index in chosen], compiled, parameters, before)
    sound = [row for row, error in enumerate(starts.errors) if error is None]
    if 0 not in sound:
        return found
    with np.errstate(all="ignore"):
        runs = integrate_many(
            compiled,
            parameters=parameters[sound],
            starts=starts.states[sound],
            switches=starts.switches[sound],
            restitution=first.restitution,
            times=times,
            inputs=inputs[sound],
            grid=grid,
            tolerance=tolerance,
            columns=READINGS,
            together=True,
        )
    for place, row in enumerate(sound):
        if runs.alike[place]:
            drive = drives[chosen[row]]
            readings: dict[str, np.ndarray] = {
                name: runs.rows[place, :, column] for column, name in enumerate(READINGS)
            }
            readings["force_reading"] = skewed(drive.model, grid, readings["force_reading"])
            found[chosen[row]] = readings
    return found
