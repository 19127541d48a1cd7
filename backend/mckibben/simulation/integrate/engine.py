"""From a drive's equations to a run: machine code for the rates and the exact Jacobian, then the integrator.

The integrator is the Rodas4 kernel of `mckibben.simulation.integrate.lane_kernel`, for one run as for many.
"""

from __future__ import annotations

import numpy as np

from mckibben.simulation.integrate.alone import Alone
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    FIRST_STEP,
    MOST_EVENTS,
    SLOWEST_REBOUND,
    Solution,
    outcome_of,
)
from mckibben.simulation.integrate.system import (
    CompiledDrive,
    compile_system,
    compiled_drive,
    compiled_driven,
    quick_drive,
)
from mckibben.simulation.outcome import MAX_STEPS, Outcome

__all__ = [
    "EVENT_WIDTH",
    "FIRST_STEP",
    "MAX_STEPS",
    "MOST_EVENTS",
    "SLOWEST_REBOUND",
    "CompiledDrive",
    "Outcome",
    "Solution",
    "compile_system",
    "compiled_drive",
    "compiled_driven",
    "integrate",
    "outcome_of",
    "quick_drive",
]


def integrate(
    drive: CompiledDrive,
    *,
    parameters: np.ndarray,
    start: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    tolerance: float,
    first_step: float = FIRST_STEP,
    switches: np.ndarray | None = None,
    restitution: float = 0.0,
) -> Solution:
    """Integrate from ``times[0]`` to ``times[-1]``, segment by segment.

    Args:
        drive: the compiled structure.
        parameters: constants of the run in the order of ``drive.model.parameters``.
        start: states at ``times[0]``.
        times: segment boundaries, one more than rows of ``inputs``.
        inputs: constants of each segment in the order of the model's inputs.
        grid: times of the rows, within the boundaries.
        tolerance: relative error per step; the absolute one is this times the scale of the state.
        first_step: first step that is tried [s].
        switches: at ``times[0]``; default 0.
        restitution: share of the speed that an impact on an end stop leaves, in the opposite direction.
    """
    began = np.zeros(len(drive.model.switches)) if switches is None else np.array(switches, dtype=float)
    alone = Alone(drive, parameters=parameters, tolerance=tolerance, restitution=restitution)
    return alone.run(
        start=start, switches=began, times=times, inputs=inputs, grid=grid, first_step=first_step
    )
