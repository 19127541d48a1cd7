"""A drive under a sampled position controller: integrate one sample, measure, set the next command."""

from __future__ import annotations

import time
from collections import deque

import numpy as np

from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.engine import CompiledDrive, Outcome, Solution, compiled_drive, integrate
from mckibben.simulation.outcome import Watch
from mckibben.simulation.parts import Drive
from mckibben.simulation.rest import start_of
from mckibben.simulation.segments import Segments
from mckibben.simulation.transient import (
    TOLERANCE,
    Run,
    dead_times,
    external_force,
    parameters_of,
    run_of,
)


def simulate_controlled(
    drive: Drive,
    *,
    points: int = 2001,
    grid: np.ndarray | None = None,
    tolerance: float = TOLERANCE,
    engine: str = "rodas",
    watch: Watch | None = None,
) -> Run:
    """Run a drive whose controller follows its reference; the command is held between samples.

    The controller sees the load's stroke as its sensor reads it. A command that rises (falls) acts after
    the dead time of opening (closing), in the order in which the commands were given. ``grid`` and ``watch``
    as in `mckibben.simulation.transient.simulate`.

    Raises:
        InputError: more than a million samples.
    """
    controller, reference = drive.controller, drive.reference
    if controller is None or reference is None:
        raise ValueError("the drive has no controller or no reference")
    period = controller.sample_time
    samples = int(np.ceil(drive.duration / period - 1e-9))
    if samples > 1_000_000:
        raise InputError(
            f"{drive.duration:g} s at {period:g} s make {samples} samples, at most a million",
            field="controller.sample_time",
        )
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    external = external_force(drive)
    grid = np.linspace(0.0, drive.duration, points) if grid is None else grid
    watch = watch or Watch()
    lever = drive.load.lever_ratio  # the controller sees the load
    set_points = reference.value(np.arange(samples) * period)
    delays = dead_times(drive)
    pending: deque[tuple[float, float]] = deque()
    active = 0.0
    state = start_of(drive, compiled, parameters, _inputs(active, drive.counter(active), external, 0.0)[0])
    began = time.perf_counter()
    first = _measured(compiled, state, parameters) / lever
    memory = controller.start(measurement=first)
    rows = [np.empty((0, compiled.size + compiled.width))]
    switches, steps, rejected = [(0.0, active)], 0, 0
    outcome, last_command = Outcome.COMPLETED, active
    for sample in range(samples):
        if ended := watch.ended(sample / samples):
            outcome = ended
            break
        now, end = sample * period, min((sample + 1) * period, drive.duration)
        measured = _measured(compiled, state, parameters) / lever
        command, memory = controller.step(float(set_points[sample]), measured, memory)
        delay = delays[0] if command > last_command else delays[1]
        last_command = command
        while pending and pending[-1][0] >= now + delay:  # never overtake an earlier command
            pending.pop()
        pending.append((now + delay, command))
        inner = external.times[(external.times > now) & (external.times < end)]
        for limit in np.append(inner, end):
            while now < limit:
                while pending and pending[0][0] <= now:
                    active = pending.popleft()[1]
                    switches.append((now, active))
                stop = min(limit, pending[0][0]) if pending else limit
                upper = np.searchsorted(grid, stop, side="right" if stop >= drive.duration else "left")
                lower = np.searchsorted(grid, now, side="left")
                found = integrate(
                    compiled,
                    parameters=parameters,
                    start=state,
                    times=np.array([now, stop]),
                    inputs=_inputs(active, drive.counter(active), external, now),
                    grid=grid[lower:upper],
                    tolerance=tolerance,
                    engine=engine,
                )
                rows.append(found.rows)
                steps, rejected, state, now = steps + found.steps, rejected + found.rejected, found.end, stop
                outcome = found.outcome
                if outcome is not Outcome.COMPLETED:
                    break
            if outcome is not Outcome.COMPLETED:
                break
        if outcome is not Outcome.COMPLETED:
            break
    instants, values = (np.array(column) for column in zip(*switches, strict=True))
    command_shape = Segments(np.append(instants, drive.duration), values, np.zeros(len(values)))
    solution = Solution(np.concatenate(rows), state, outcome, steps, rejected, engine)
    return run_of(drive, compiled, grid, solution, command_shape, time.perf_counter() - began)


def _inputs(opening: float, counter: float, external: Segments, now: float) -> np.ndarray:
    piece = int(np.clip(np.searchsorted(external.times, now, side="right") - 1, 0, len(external.slopes) - 1))
    given = {
        "opening": opening,
        "opening_slope": 0.0,
        "counter_opening": counter,
        "counter_opening_slope": 0.0,
        "external_force": float(external.value(now)),
        "external_force_slope": float(external.slopes[piece]),
        "begin": now,
    }
    return np.array([[given[name] for name in INPUTS]])


def _measured(compiled: CompiledDrive, state: np.ndarray, parameters: np.ndarray) -> float:
    """The muscle's stroke as its sensor reads it [m]; the inputs of the run have no part in it."""
    packed = np.concatenate([state, parameters, np.zeros(len(INPUTS))])
    return float(compiled.rates(packed)[compiled.size + OUTPUTS.index("stroke_reading")])
