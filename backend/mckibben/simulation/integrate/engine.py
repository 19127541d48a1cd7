"""From a drive's equations to a run: machine code for the rates and the exact Jacobian, then an integrator.

The integrator is the Rodas4 kernel once numba has it ready (compiled once per installation, in the
background, then cached on disk); until then the same compiled functions run under scipy's LSODA.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mckibben.simulation.integrate.system import (
    CompiledDrive,
    compile_system,
    compiled_drive,
    compiled_driven,
)
from mckibben.simulation.outcome import Outcome, Watch

__all__ = [
    "FIRST_STEP",
    "MAX_STEPS",
    "CompiledDrive",
    "Outcome",
    "Solution",
    "compile_system",
    "compiled_drive",
    "compiled_driven",
    "integrate",
    "kernel",
    "outcome_of",
]

MAX_STEPS = 400_000
FIRST_STEP = 1e-4  # s


class Kernels(NamedTuple):
    """The kernels of `mckibben.simulation.integrate.kernels`: a free run, and one under a controller."""

    free: Callable[..., int]
    sampled: Callable[..., int]


class _Kernel:
    """The Rodas4 kernel, imported (and on first use compiled) in the background."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._function: Kernels | None = None

    def warm(self) -> threading.Thread:
        """Start getting the kernel ready; returns the thread that does it."""
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._load, name="rodas-kernel", daemon=True)
                self._thread.start()
            return self._thread

    def ready(self) -> Kernels | None:
        """The kernel, or None while it is not ready."""
        if self._function is None:
            self.warm()
        return self._function

    def _load(self) -> None:
        # numba: 0.6 s cached, 5 s the first time ever
        from mckibben.simulation.integrate.kernels import rodas4, rodas4_sampled

        self._function = Kernels(rodas4, rodas4_sampled)


kernel = _Kernel()


class _EndedError(Exception):
    """Aborts an integrator that has no way to stop it."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.label)
        self.outcome = outcome


@dataclass(frozen=True)
class Solution:
    """Rows of states and outputs on the grid, the end state, step counts, outcome, and the next step size."""

    rows: np.ndarray
    end: np.ndarray
    outcome: Outcome
    steps: int
    rejected: int
    engine: str
    next_step: float = FIRST_STEP


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
    """
    kernels = kernel.ready() if engine == "auto" else None
    if engine == "rodas":
        kernel.warm().join()
        kernels = kernel.ready()
    absolute = tolerance * drive.scales
    constants = drive.codes.constants(parameters)
    if kernels is None:
        return _lsoda(drive, constants, start, times, inputs, grid, tolerance, absolute, watch or Watch())
    rows = np.empty((len(grid), drive.size + drive.width))
    counts = np.zeros(3, np.int64)
    end, step = start.copy(), np.array([first_step])
    status = kernels.free(
        *drive.codes.given,
        constants,
        end,
        times,
        inputs,
        step,
        grid,
        tolerance,
        absolute,
        rows,
        counts,
        MAX_STEPS,
    )
    steps, rejected, written = (int(count) for count in counts)
    return Solution(rows[:written], end, outcome_of(status), steps, rejected, "rodas", float(step[0]))


def outcome_of(status: int) -> Outcome:
    """The outcome that corresponds to a status of the kernel."""
    return {0: Outcome.COMPLETED, 2: Outcome.STUCK}.get(int(status), Outcome.DIVERGED)


def _lsoda(
    drive: CompiledDrive,
    constants: np.ndarray,
    start: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    tolerance: float,
    absolute: np.ndarray,
    watch: Watch,
) -> Solution:
    from scipy.integrate import solve_ivp

    size, width = drive.size, drive.width
    rows = np.full((len(grid), size + width), np.nan)
    state, steps, written = start.copy(), 0, 0
    packed = np.concatenate([start, constants, np.zeros(inputs.shape[1])])

    def rates(now: float, y: np.ndarray) -> np.ndarray:
        if ended := watch.ended(now / times[-1]):
            raise _EndedError(ended)
        packed[:size] = y
        return drive.codes.rates(packed)[:size]

    def jacobian(_time: float, y: np.ndarray) -> np.ndarray:
        packed[:size] = y
        return drive.dense(drive.codes.jacobian(packed))

    for segment, segment_inputs in enumerate(inputs):
        begin, finish = times[segment], times[segment + 1]
        if not finish > begin:
            continue
        packed[size + len(constants) :] = segment_inputs
        last = segment == len(inputs) - 1
        stop = np.searchsorted(grid, finish, side="right" if last else "left")
        wanted = grid[written:stop]
        try:
            # LSODA warns of failures that its result reports as well.
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = solve_ivp(
                    rates,
                    (begin, finish),
                    state,
                    method="LSODA",
                    jac=jacobian,
                    t_eval=np.union1d(wanted, finish),
                    rtol=tolerance,
                    atol=absolute,
                )
        except _EndedError as end:
            return Solution(rows[:written], state, end.outcome, steps, 0, "lsoda")
        steps += len(found.t)
        if not found.success or not np.all(np.isfinite(found.y)):
            return Solution(rows[:written], state, Outcome.DIVERGED, steps, 0, "lsoda")
        for row, y in enumerate(found.y.T[: len(wanted)], written):
            packed[:size] = y
            rows[row, :size], rows[row, size:] = y, drive.codes.rates(packed)[size:]
        written += len(wanted)
        state = found.y[:, -1]
    return Solution(rows[:written], state, Outcome.COMPLETED, steps, 0, "lsoda")
