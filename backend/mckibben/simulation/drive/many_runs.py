"""Readings of drives of one structure that run side by side in lanes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.simulation.drive.initial_state import Start, start_of
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.recorded_run import RecordedRun
from mckibben.simulation.drive.transient import TOLERANCE, before_of, parameters_of, skewed
from mckibben.simulation.integrate.engine import CompiledDrive, compiled_drive, quick_drive
from mckibben.simulation.integrate.many import ManySolutions, integrate_many
from mckibben.simulation.outcome import MAX_STEPS

READINGS = ("pressure_reading", "stroke_reading", "force_reading")
#: Boundaries of the segments of a run, shape (segments + 1,) [s], and inputs, shape (segments, inputs).
Pieces = tuple[np.ndarray, np.ndarray]


def readings_of_many(
    drives: Sequence[Drive],
    pieces: Sequence[Pieces],
    *,
    grid: np.ndarray,
    tolerance: float = TOLERANCE,
    together: bool = False,
    few: bool = False,
    max_steps: int = MAX_STEPS,
) -> list[RecordedRun]:
    """Readings of each drive on a grid, by the names of `READINGS`, SI; none of a drive that has no start.

    Each has the numbers that it has alone, fewer of them where the run ends early. ``together``, the first
    drive sets the steps of all, so that differences to it are derivatives; then there are none of a drive
    that does not run like the first: its command changes at other instants, or other switches change.

    Args:
        drives: of one structure and restitution.
        pieces: of each drive, see `mckibben.simulation.drive.transient.segments_of`.
        grid: ascending times of the rows [s].
        tolerance: relative error per step.
        together: see above.
        few: only some hundred runs of this structure are expected, so that it is compiled quickly.
        max_steps: of a run, which ends there.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    compiled = (quick_drive if few else compiled_drive)(drives[0].structure)
    parameters = [parameters_of(drive, compiled) for drive in drives]
    starts: dict[int, Start] = {}
    found = [RecordedRun({}) for _ in drives]
    for index, (drive, (times, inputs)) in enumerate(zip(drives, pieces, strict=True)):
        if together and not np.array_equal(times, pieces[0][0]):
            continue
        try:
            starts[index] = start_of(drive, compiled, parameters[index], before_of(drive, inputs))
        except InputError as error:
            found[index] = RecordedRun({}, stop=error.message)
    if together and 0 not in starts:
        return found
    groups: dict[int, list[int]] = {}  # dead times change the number of segments
    for index in starts:
        groups.setdefault(len(pieces[index][1]), []).append(index)
    for group in groups.values():
        runs = _integrated(
            compiled,
            [starts[index] for index in group],
            np.array([parameters[index] for index in group]),
            [pieces[index] for index in group],
            (drives[0].restitution, tolerance, max_steps),
            grid,
            together=together,
        )
        for place, index in enumerate(group):
            if together and not runs.alike[place]:
                continue
            rows = runs.rows[place, : runs.written[place]]
            readings = dict(zip(READINGS, rows.T.copy(), strict=True))
            force = readings["force_reading"]
            readings["force_reading"] = skewed(drives[index].model, grid[: len(rows)], force)
            found[index] = RecordedRun(readings, *runs.ending(place, max_steps))
    return found


def _integrated(
    compiled: CompiledDrive,
    starts: Sequence[Start],
    parameters: np.ndarray,
    pieces: Sequence[Pieces],
    options: tuple[float, float, int],
    grid: np.ndarray,
    *,
    together: bool,
) -> ManySolutions:
    """The runs of drives with as many segments as the first one; options: restitution, tolerance, steps."""
    same = together or all(times is pieces[0][0] for times, _ in pieces)
    shared = all(inputs is pieces[0][1] for _, inputs in pieces)
    with np.errstate(all="ignore"):
        return integrate_many(
            compiled,
            parameters=parameters,
            starts=np.array([start.state for start in starts]),
            switches=np.array([start.switches for start in starts]),
            restitution=options[0],
            times=pieces[0][0] if same else np.array([times for times, _ in pieces]),
            inputs=pieces[0][1] if shared else np.array([inputs for _, inputs in pieces]),
            grid=grid,
            tolerance=options[1],
            max_steps=options[2],
            columns=READINGS,
            together=together,
        )
