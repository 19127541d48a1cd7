"""From a drive's equations to a run: machine code for the rates and the exact Jacobian, then an integrator.

The integrator is the Rodas4 kernel once numba has it ready (compiled once per installation, in the
background, then cached on disk); until then the same compiled functions run under scipy's LSODA.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mckibben.simulation.integrate.background import Background
from mckibben.simulation.integrate.lsoda import by_lsoda
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    FIRST_STEP,
    MOST_EVENTS,
    SLOWEST_REBOUND,
    Problem,
    Solution,
    switching_of,
)
from mckibben.simulation.integrate.system import (
    CompiledDrive,
    compile_system,
    compiled_drive,
    compiled_driven,
)
from mckibben.simulation.outcome import Outcome, Watch

__all__ = [
    "EVENT_WIDTH",
    "FIRST_STEP",
    "MAX_STEPS",
    "MOST_EVENTS",
    "SLOWEST_REBOUND",
    "CompiledDrive",
    "Outcome",
    "Problem",
    "Solution",
    "compile_system",
    "compiled_drive",
    "compiled_driven",
    "engine_by_size",
    "integrate",
    "kernel",
    "outcome_of",
    "switching_of",
]

MAX_STEPS = 400_000


class Kernels(NamedTuple):
    """The kernels of `mckibben.simulation.integrate.kernels`: a free run, and one under a controller."""

    free: Callable[..., int]
    sampled: Callable[..., int]


def _load_kernels() -> Kernels:
    # numba: 0.6 s cached, 5 s the first time ever
    from mckibben.simulation.integrate.kernels import rodas4, rodas4_sampled

    return Kernels(rodas4, rodas4_sampled)


kernel = Background(_load_kernels, "rodas-kernel")
_FEW_SEGMENTS = 20  # LSODA needs less for them than the 0.6 s that loading the kernel takes


def engine_by_size(segments: int) -> str:
    """The engine for a run of so many segments, whatever is loaded: the same question gives the same digits.

    Args:
        segments: of the inputs.
    """
    return "lsoda" if segments <= _FEW_SEGMENTS else "rodas"


def integrate(
    drive: CompiledDrive,
    *,
    parameters: np.ndarray,
    start: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    tolerance: float,
    engine: str = "auto",
    watch: Watch | None = None,
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
        engine: "rodas", "lsoda", or "auto" for the first that is ready.
        watch: may end LSODA early; the kernel has a limit of steps instead.
        first_step: first step that the kernel tries [s].
        switches: at ``times[0]``; default 0.
        restitution: share of the speed that an impact on an end stop leaves, in the opposite direction.
    """
    kernels = kernel.ready() if engine == "auto" else None
    if engine == "rodas":
        kernels = kernel.awaited()
    began = np.zeros(len(drive.model.switches)) if switches is None else np.array(switches, dtype=float)
    problem = Problem(
        drive=drive,
        constants=drive.codes.constants(parameters),
        stops=drive.stops(parameters),
        restitution=restitution,
        state=start.copy(),
        switches=began,
        times=times,
        inputs=inputs,
        grid=grid,
        tolerance=tolerance,
    )
    if kernels is None:
        return by_lsoda(problem, watch or Watch())
    rows, events = problem.empty_rows(), np.zeros((MOST_EVENTS, EVENT_WIDTH))
    counts, step = np.zeros(4, np.int64), np.array([first_step])
    status = kernels.free(
        *drive.codes.given,
        drive.moved,
        problem.switching,
        problem.constants,
        problem.state,
        problem.switches,
        times,
        inputs,
        step,
        grid,
        tolerance,
        problem.absolute,
        rows,
        events,
        counts,
        MAX_STEPS,
    )
    steps, rejected, written, happened = (int(count) for count in counts)
    return Solution(
        rows[:written],
        problem.state,
        problem.switches,
        events[:happened],
        outcome_of(status),
        steps,
        rejected,
        "rodas",
        float(step[0]),
    )


def outcome_of(status: int) -> Outcome:
    """The outcome that corresponds to a status of the kernel."""
    return {0: Outcome.COMPLETED, 2: Outcome.STUCK}.get(int(status), Outcome.DIVERGED)
