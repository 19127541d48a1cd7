"""Runs of many parameter sets of one structure, in lanes: see `mckibben.simulation.integrate.lane_kernel`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mckibben.simulation.integrate.lane_buffers import Columns, LaneKernels, columns_of, lane_kernels
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    FIRST_STEP,
    bounce_of,
    outcome_of,
)
from mckibben.simulation.integrate.recycled import recycled
from mckibben.simulation.integrate.system import CompiledDrive
from mckibben.simulation.outcome import MAX_STEPS, Outcome

_KEPT_EVENTS = 256  # of each of many runs, which share one array


@dataclass(frozen=True, eq=False)
class ManySolutions:
    """Rows, and how each run went.

    Attributes:
        rows: shape (sets, rows, columns); NaN after the end of a run that ended early.
        written: number of rows of each set that hold a result, shape (sets,).
        ends, switches: at the end, shapes (sets, states), (sets, switches).
        events: of each set, see `mckibben.simulation.integrate.problem.Solution`.
        outcomes: of each set.
        steps, rejected: of each set, shape (sets,).
    """

    rows: np.ndarray
    written: np.ndarray
    ends: np.ndarray
    switches: np.ndarray
    events: tuple[np.ndarray, ...]
    outcomes: tuple[Outcome, ...]
    steps: np.ndarray
    rejected: np.ndarray

    def ending(self, number: int, max_steps: int) -> tuple[int, str]:
        """Accepted and rejected steps of a set, and why it stopped early; "" where it did not.

        Args:
            number: of the set.
            max_steps: the limit that it had.
        """
        outcome = self.outcomes[number]
        stop = "" if outcome is Outcome.COMPLETED else outcome.advice(max_steps)
        return int(self.steps[number] + self.rejected[number]), stop

    @cached_property
    def alike(self) -> np.ndarray:
        """Of each set, whether it ran like the first one: completed, with the same changes of switches.

        With ``together`` the rows of other sets are of no use.
        """
        if not self.events:
            return np.zeros(0, bool)
        first = self.events[0][:, 1:3]
        same = [
            outcome is Outcome.COMPLETED and np.array_equal(events[:, 1:3], first)
            for outcome, events in zip(self.outcomes, self.events, strict=True)
        ]
        return np.array(same, bool) & (self.written == self.written[0])


def constants_of_many(drive: CompiledDrive, parameters: np.ndarray) -> np.ndarray:
    """Constants of the runs, shape (sets, constants), of parameters, shape (sets, parameters)."""
    code = drive.codes.constants
    given = np.ascontiguousarray(parameters, dtype=float)
    constants = np.empty((len(given), code.width))
    lane_kernels.awaited().call_blocks(code.address, given[:, :, None], constants[:, :, None])
    return constants


def integrate_many(
    drive: CompiledDrive,
    *,
    parameters: np.ndarray,
    starts: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    tolerance: float,
    columns: Sequence[str] | None = None,
    switches: np.ndarray | None = None,
    restitution: float = 0.0,
    first_step: float = FIRST_STEP,
    max_steps: int = MAX_STEPS,
    together: bool = False,
) -> ManySolutions:
    """Integrate many parameter sets of a structure, each from its ``times[0]`` to its ``times[-1]``.

    The result of a set does not depend on the others, except with ``together``. It releases the interpreter
    lock and may be called from several threads.

    Args:
        drive: the compiled structure.
        parameters: of each set in the order of ``drive.model.parameters``, shape (sets, parameters).
        starts: states at the first boundary, shape (sets, states).
        times: segment boundaries, shape (segments + 1,) or (sets, segments + 1).
        inputs: of each segment, shape (segments, inputs) or (sets, segments, inputs).
        grid: ascending times of the rows within the boundaries, shape (rows,) or (sets, rows).
        tolerance: relative error per step; the absolute one is this times the scale of the state.
        columns: names of the states and outputs wanted; only these are computed. Default: all states, then
            all outputs.
        switches: at the first boundary, shape (sets, switches); default 0.
        restitution: see `mckibben.simulation.integrate.engine.integrate`.
        first_step: first step that is tried [s].
        max_steps: limit of accepted and rejected steps of a set.
        together: all sets take the steps of the first one, and where a switch changes, each the step up to
            its own instant of the same change. The difference to the first set is then smooth in the
            parameters: for derivatives by differences, of sets that differ little. Needs common ``times``;
            see `ManySolutions.alike`.

    Raises:
        ValueError: arrays whose shapes do not fit, or an unknown column.
    """
    kernels = lane_kernels.awaited()
    parameters = np.ascontiguousarray(parameters, dtype=float)
    sets = len(parameters)
    given = _Given(
        parameters,
        np.ascontiguousarray(starts, dtype=float),
        np.zeros((sets, len(drive.model.switches))) if switches is None else np.array(switches, dtype=float),
        _of_sets(times, 1),
        _of_sets(inputs, 2),
        _of_sets(grid, 1),
    )
    given.check(drive, together)
    order = np.arange(sets)
    if together and sets:
        order = _groups(sets, kernels.lanes)
        given = given.picked(order)
    chosen = columns_of(drive, columns)
    done = _run(
        drive, kernels, given, chosen, tolerance, (restitution, first_step), max_steps, together=together
    )
    if not together or not sets:
        return done
    return _separated(done, order)


@dataclass(frozen=True, eq=False)
class _Given:
    """The arrays of the sets."""

    parameters: np.ndarray
    starts: np.ndarray
    switches: np.ndarray
    times: np.ndarray
    inputs: np.ndarray
    grid: np.ndarray

    def check(self, drive: CompiledDrive, together: bool) -> None:
        """Raise ValueError for shapes that do not fit."""
        sets, segments = len(self.parameters), self.inputs.shape[1]
        wanted = {
            "parameters": (self.parameters, (sets, len(drive.model.parameters))),
            "starts": (self.starts, (sets, drive.size)),
            "switches": (self.switches, (sets, len(drive.model.switches))),
            "times": (self.times, (len(self.times), segments + 1)),
            "inputs": (self.inputs, (len(self.inputs), segments, len(drive.model.inputs))),
        }
        for name, (array, shape) in wanted.items():
            if array.shape != shape:
                raise ValueError(f"{name} has the shape {array.shape}, not {shape}")
        for name, array in (("times", self.times), ("inputs", self.inputs), ("grid", self.grid)):
            if len(array) not in (1, sets):
                raise ValueError(f"{name} is for {len(array)} sets, not {sets} and not 1")
        if together and len(self.times) > 1:
            raise ValueError("sets that run together need common times")

    def picked(self, order: np.ndarray) -> _Given:
        """The sets in another order, some of them repeatedly."""

        def pick(array: np.ndarray) -> np.ndarray:
            return array if len(array) == 1 else array[order]

        shared = (pick(array) for array in (self.times, self.inputs, self.grid))
        return _Given(self.parameters[order], self.starts[order], self.switches[order], *shared)


def _of_sets(array: np.ndarray, dimensions: int) -> np.ndarray:
    """An array with the sets as its first dimension."""
    array = np.ascontiguousarray(array, dtype=float)
    return array[None] if array.ndim == dimensions else array


def _groups(sets: int, lanes: int) -> np.ndarray:
    """Numbers of the sets in the order in which they run together: the first one in every group."""
    others = np.arange(1, sets)
    parts = [others[begin : begin + lanes - 1] for begin in range(0, max(sets - 1, 1), lanes - 1)]
    return np.concatenate([np.concatenate([[0], part]) for part in parts]).astype(int)


def _run(
    drive: CompiledDrive,
    kernels: LaneKernels,
    given: _Given,
    chosen: Columns,
    tolerance: float,
    options: tuple[float, float],
    max_steps: int,
    *,
    together: bool,
) -> ManySolutions:
    lanes, n = kernels.lanes, drive.size
    sets, rows, kinds = len(given.parameters), given.grid.shape[1], given.switches.shape[1]
    constants = constants_of_many(drive, given.parameters)
    stops = np.full((sets, kinds), np.nan)
    for index, place in enumerate(drive.stop_places):
        if place is not None:
            stops[:, index] = given.parameters[:, place]
    room = (rows + 2 * lanes - 1) // lanes * lanes
    padded = np.full((len(given.grid), rows + 2 * lanes), np.inf)
    padded[:, :rows] = given.grid
    out = recycled(sets, chosen.count, room)
    ends, counts, statuses = np.empty((sets, n)), np.zeros((sets, 4), np.int64), np.zeros(sets, np.int64)
    events = np.empty((sets, _KEPT_EVENTS, EVENT_WIDTH))
    with chosen.room(kernels) as arrays:
        kernels.run(
            *chosen.model,
            (drive.least, bounce_of(options[0]), drive.follows, drive.watched, drive.slides),
            stops,
            constants,
            given.starts,
            given.switches,
            given.times,
            given.inputs,
            np.full(sets, options[1]),
            padded,
            tolerance,
            tolerance * drive.scales,
            chosen.given,
            out,
            ends,
            events,
            counts,
            statuses,
            max_steps,
            together,
            0,
            kernels.no_loop,
            arrays,
        )
    table = out[:, :, :rows].transpose(0, 2, 1)
    for index in np.flatnonzero(counts[:, 2] < rows):
        table[index, counts[index, 2] :] = np.nan
    kept = np.minimum(counts[:, 3], _KEPT_EVENTS).tolist()
    happened = tuple(events[index, :count].copy() for index, count in enumerate(kept))
    return ManySolutions(
        table,
        counts[:, 2],
        ends,
        given.switches,
        happened,
        tuple(map(outcome_of, statuses.tolist())) if statuses.any() else (Outcome.COMPLETED,) * sets,
        counts[:, 0],
        counts[:, 1],
    )


def _separated(done: ManySolutions, order: np.ndarray) -> ManySolutions:
    """Results by set of sets that ran together."""
    first = np.flatnonzero(order == 0)
    wanted = np.concatenate([first[:1], np.flatnonzero(order != 0)])
    return ManySolutions(
        done.rows[wanted],
        done.written[wanted],
        done.ends[wanted],
        done.switches[wanted],
        tuple(done.events[index] for index in wanted),
        tuple(done.outcomes[index] for index in wanted),
        done.steps[wanted],
        done.rejected[wanted],
    )
