"""From a drive's equations to a run: machine code for the rates and the exact Jacobian, then an integrator.

The integrator is the Rodas4 kernel of `mckibben.simulation.integrate.lane_kernel` once numba has it ready
(compiled once per installation, in the background, then cached on disk), for one run as for many; until then
the same equations run under scipy's LSODA.
"""

from __future__ import annotations

import threading

import numpy as np

from mckibben.simulation.integrate.alone import Alone
from mckibben.simulation.integrate.lane_buffers import lane_kernels as kernel
from mckibben.simulation.integrate.lsoda import by_lsoda
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    FIRST_STEP,
    MOST_EVENTS,
    SLOWEST_REBOUND,
    Problem,
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
from mckibben.simulation.outcome import MAX_STEPS, Outcome, Watch

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
    "engine_for_records",
    "integrate",
    "kernel",
    "outcome_of",
    "quick_drive",
]

_BEFORE_COMPILING = 2000  # segments; some seconds of LSODA, where compiling takes half a minute
_FEW_SEGMENTS = 20  # LSODA needs less for them than the 0.6 s that loading the kernel takes


def engine_by_size(segments: int) -> str:
    """The engine for a run of so many segments, whatever is loaded: the same question gives the same digits.

    Args:
        segments: of the inputs.
    """
    return "lsoda" if segments <= _FEW_SEGMENTS else "rodas"


def engine_for_records(segments: int, *, runs: int, among: int = 0) -> str:
    """The engine for runs along a measured record: by size, but no short work waits for a compilation.

    Until the kernel has been compiled for this machine, LSODA follows the first `_BEFORE_COMPILING` segments
    of a process: a comparison of a static map ends long before the compilation would. The results agree to
    the tolerance.

    Args:
        segments: of the record.
        runs: along it.
        among: segments of all records that are followed again and again; many short ones are worth it.
    """
    chosen = engine_by_size(max(segments, among))
    if chosen == "lsoda" or kernel.at_hand() or not _spared.take(segments * runs):
        return chosen
    return "lsoda"


class _Spared:
    """Segments that may still be followed without the kernel."""

    def __init__(self, left: int) -> None:
        self._left, self._lock = left, threading.Lock()

    def take(self, segments: int) -> bool:
        """Whether so many are left; then they are taken. Once there are not, none are left."""
        with self._lock:
            enough = segments <= self._left
            self._left = self._left - segments if enough else 0
        return enough


_spared = _Spared(_BEFORE_COMPILING)


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
    began = np.zeros(len(drive.model.switches)) if switches is None else np.array(switches, dtype=float)
    if engine == "rodas" or (engine == "auto" and kernel.ready() is not None):
        alone = Alone(drive, parameters=parameters, tolerance=tolerance, restitution=restitution)
        return alone.run(
            start=start, switches=began, times=times, inputs=inputs, grid=grid, first_step=first_step
        )
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
    return by_lsoda(problem, watch or Watch())
