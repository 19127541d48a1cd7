"""From a drive's equations to a run: machine code for the rates and the exact Jacobian, then an integrator.

The integrator is the Rodas4 kernel once numba has it ready (compiled once per installation, in the
background, then cached on disk); until then the same compiled functions run under scipy's LSODA.
"""

from __future__ import annotations

import ctypes
import threading
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import symengine as se

from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import Structure
from mckibben.physics.driven import DrivenModel
from mckibben.physics.effect import Effect
from mckibben.simulation.outcome import Outcome, Watch

__all__ = ["CompiledDrive", "Outcome", "Solution", "compiled_drive", "integrate", "kernel"]

MAX_STEPS = 400_000


@dataclass(frozen=True)
class CompiledDrive:
    """A system of equations as machine code.

    Attributes:
        model: names of states, parameters, inputs.
        rates: packed inputs -> rates and outputs.
        jacobian: packed inputs -> rates and Jacobian by rows.
        pointers: addresses of both functions and of their data, as the kernel wants them.
        dynamic: number of leading states that some rate depends on; the rest are mere integrals.
    """

    model: DriveModel | DrivenModel
    rates: Any
    jacobian: Any
    pointers: tuple[int, int, int, int]
    dynamic: int

    @property
    def width(self) -> int:
        """Number of outputs."""
        return len(self.model.output_names)

    @property
    def size(self) -> int:
        """Number of states."""
        return len(self.model.states)


@lru_cache(maxsize=128)
def compiled_drive(structure: Structure) -> CompiledDrive:
    """A drive's compiled equations, built once (50 to 100 ms) and kept."""
    return compile_system(DriveModel(structure))


@lru_cache(maxsize=128)
def compiled_driven(effects: tuple[Effect, ...], motion: bool) -> CompiledDrive:
    """The compiled equations of a muscle whose pressure is measured, built once and kept."""
    return compile_system(DrivenModel(effects, motion=motion))


def compile_system(model: DriveModel | DrivenModel) -> CompiledDrive:
    """Machine code of a system and of its exact Jacobian."""
    states = list(model.symbols.values())
    arguments = [*states, *model.parameters.values(), *model.inputs.values()]
    matrix = se.Matrix(model.rates).jacobian(se.Matrix(states))
    rates = se.Lambdify(arguments, [*model.rates, *model.outputs], backend="llvm", cse=True)
    jacobian = se.Lambdify(arguments, [*model.rates, *matrix], backend="llvm", cse=True)
    pointers: list[int] = []
    for function in (rates, jacobian):
        address, data = function.as_ctypes()
        pointers += [ctypes.cast(address, ctypes.c_void_p).value or 0, data.value or 0]
    first, first_data, second, second_data = pointers
    size = len(states)
    used = [any(matrix[row, column] != 0 for row in range(size)) for column in range(size)]
    dynamic = max((column + 1 for column in range(size) if used[column]), default=1)
    return CompiledDrive(model, rates, jacobian, (first, first_data, second, second_data), dynamic)


class _Kernel:
    """The Rodas4 kernel, imported (and on first use compiled) in the background."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._function: Callable[..., int] | None = None

    def warm(self) -> threading.Thread:
        """Start getting the kernel ready; returns the thread that does it."""
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._load, name="rodas-kernel", daemon=True)
                self._thread.start()
            return self._thread

    def ready(self) -> Callable[..., int] | None:
        """The kernel, or None while it is not ready."""
        if self._function is None:
            self.warm()
        return self._function

    def _load(self) -> None:
        from mckibben.simulation.rodas import rodas4  # numba: 0.6 s cached, 5 s the first time ever

        self._function = rodas4


kernel = _Kernel()


class _EndedError(Exception):
    """Leaves an integrator that cannot be told to stop."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.label)
        self.outcome = outcome


@dataclass(frozen=True)
class Solution:
    """Rows of states and outputs on the grid, the end state, and how it went."""

    rows: np.ndarray
    end: np.ndarray
    outcome: Outcome
    steps: int
    rejected: int
    engine: str


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
) -> Solution:
    """Integrate from ``times[0]`` to ``times[-1]``, segment by segment.

    Args:
        drive: the compiled structure.
        parameters: constants of the run in the order of ``drive.model.parameters``.
        start: states at ``times[0]``.
        times: segment limits, one more than rows of ``inputs``.
        inputs: constants of each segment in the order of the model's inputs.
        grid: times of the rows wanted, inside the limits.
        tolerance: relative error per step; the absolute one is the state's scale times it.
        engine: "rodas", "lsoda", or "auto" for the first that is ready.
        watch: may end LSODA early; the kernel is not asked, its steps are limited instead.
    """
    function = kernel.ready() if engine == "auto" else None
    if engine == "rodas":
        kernel.warm().join()
        function = kernel.ready()
    absolute = tolerance * np.array([state.scale for state in drive.model.states])
    if function is None:
        return _lsoda(drive, parameters, start, times, inputs, grid, tolerance, absolute, watch or Watch())
    rows = np.full((len(grid), drive.size + drive.width), np.nan)
    counts = np.zeros(3, np.int64)
    end = start.copy()
    status = function(
        *drive.pointers,
        parameters,
        end,
        times,
        inputs,
        grid,
        tolerance,
        absolute,
        rows,
        counts,
        MAX_STEPS,
        drive.dynamic,
    )
    outcome = {0: Outcome.COMPLETED, 2: Outcome.STUCK}.get(int(status), Outcome.DIVERGED)
    return Solution(rows[: counts[2]], end, outcome, int(counts[0]), int(counts[1]), "rodas")


def _lsoda(
    drive: CompiledDrive,
    parameters: np.ndarray,
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
    packed = np.concatenate([start, parameters, np.zeros(inputs.shape[1])])

    def rates(now: float, y: np.ndarray) -> np.ndarray:
        if ended := watch.ended(now / times[-1]):
            raise _EndedError(ended)
        packed[:size] = y
        return drive.rates(packed)[:size]

    def jacobian(_time: float, y: np.ndarray) -> np.ndarray:
        packed[:size] = y
        return drive.jacobian(packed)[size:].reshape(size, size)

    for segment, given in enumerate(inputs):
        begin, finish = times[segment], times[segment + 1]
        if not finish > begin:
            continue
        packed[size + len(parameters) :] = given
        last = segment == len(inputs) - 1
        stop = np.searchsorted(grid, finish, side="right" if last else "left")
        wanted = grid[written:stop]
        try:
            # LSODA also warns of what its result says.
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
            rows[row, :size], rows[row, size:] = y, drive.rates(packed)[size:]
        written += len(wanted)
        state = found.y[:, -1]
    return Solution(rows[:written], state, Outcome.COMPLETED, steps, 0, "lsoda")
