"""A controlled run as its controllers see it: its inputs, and what the position sensor reads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.initial_state import Start
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.integrate.engine import CompiledDrive
from mckibben.simulation.outcome import Watch

_MEASURED = OUTPUTS.index("stroke_reading")


@dataclass(frozen=True)
class ControlLoop:
    """A controlled run and its inputs.

    Attributes:
        drive, compiled, parameters, tolerance: as for a free run.
        controller: the controller.
        external: external force on the load over time.
        set_points: reference at every sample [m], shape (samples,).
        start: states and switches at rest.
        grid: times of the rows.
        watch: may end it early.
    """

    drive: Drive
    compiled: CompiledDrive
    controller: PidController
    external: Segments
    set_points: np.ndarray
    parameters: np.ndarray
    start: Start
    grid: np.ndarray
    tolerance: float
    watch: Watch


def measured_position(loop: ControlLoop, state: np.ndarray) -> float:
    """Sensor reading of the load's stroke [m]; it does not depend on the inputs of the run."""
    packed = np.concatenate([state, loop.parameters, np.zeros(len(INPUTS))])
    reading = float(loop.compiled.outputs(packed)[_MEASURED])
    return reading / loop.drive.load.lever_ratio
