"""What a call of the kernel of the lanes needs besides its sets: which columns it writes, and work arrays."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from mckibben.simulation.integrate.background import Background
from mckibben.simulation.integrate.lane_code import aligned
from mckibben.simulation.integrate.system import CompiledDrive
from mckibben.simulation.kept_code import one_process_at_a_time

_KEPT_ROOMS = 4  # of a structure and its columns, for as many threads


class LaneKernels(NamedTuple):
    """What numba compiles.

    The kernel of `mckibben.simulation.integrate.lane_kernel`, repeated calls, the kernel of
    `mckibben.simulation.integrate.row_by_row`, and sizes of the first one's arrays.
    """

    run: Callable[..., None]
    call_blocks: Callable[[int, np.ndarray, np.ndarray], None]
    find_roots: Callable[..., None]
    carry: Callable[..., None]
    lanes: int
    window: int
    numbers: int
    entries: int
    control: int
    no_loop: tuple[Any, ...]


def compile_kernels() -> LaneKernels:
    """The kernels; compiled where nothing is kept of them, which takes 20 s."""
    # Server and worker would take the cores from each other; one after the other, what every run needs first.
    with one_process_at_a_time("lane-kernels"):
        from mckibben.simulation.integrate.lane_control import CONTROL_ROWS
        from mckibben.simulation.integrate.lane_controller import NO_LOOP
        from mckibben.simulation.integrate.lane_kernel import rodas4_lanes
        from mckibben.simulation.integrate.lane_rows import ENTRIES, NUMBERS, WINDOW
        from mckibben.simulation.integrate.lane_type import LANES
        from mckibben.simulation.integrate.repeated import call_blocks, find_roots
        from mckibben.simulation.integrate.row_by_row import carry

        run, call, find = rodas4_lanes.compiled(), call_blocks.compiled(), find_roots.compiled()
        carried = carry.compiled()
    return LaneKernels(run, call, find, carried, LANES, WINDOW, NUMBERS, ENTRIES, CONTROL_ROWS, NO_LOOP)


lane_kernels = Background(compile_kernels, "lane-kernels")


class Columns:
    """Which states, switches and outputs of a structure are written, and where.

    Args:
        drive: the compiled structure.
        names: of the states and outputs; default all states, then all outputs.

    Raises:
        ValueError: an unknown name.
    """

    def __init__(self, drive: CompiledDrive, names: Sequence[str] | None) -> None:
        states = [state.name for state in drive.model.states]
        outputs = list(drive.model.output_names)
        names = [*states, *outputs] if names is None else list(names)
        unknown = [name for name in names if name not in states and name not in outputs]
        if unknown:
            raise ValueError(
                f"there is no state or output {unknown[0]}; there are {', '.join([*states, *outputs])}"
            )
        self.count = len(names)
        place = {states.index(name): column for column, name in enumerate(names) if name in states}
        wanted = [(column, outputs.index(name)) for column, name in enumerate(names) if name not in states]
        address, needs, first_switch = 0, np.zeros(0, np.int64), drive.codes.outputs.size
        if wanted:
            code, needs = drive.lanes.outputs([index for _, index in wanted])
            address, first_switch = code.address, code.size - len(drive.model.switches)
        kept = sorted({*place, *needs[needs < drive.size].tolist()})
        column_of = np.array([place.get(state, -1) for state in kept], np.int64)
        kept_switches = needs[needs >= first_switch] - first_switch
        #: ``columns`` of the kernel.
        self.given = (
            np.array(kept, np.int64),
            column_of,
            kept_switches,
            np.array([column for column, _ in wanted], np.int64),
        )
        step, codes = drive.lanes.step, drive.codes
        functions = [step[name].address for name in ("rates", "jacobian", "factorise", "solve")]
        #: First arguments of the kernel.
        self.model = (
            (*functions, address),
            codes.guards.address,
            np.ascontiguousarray(codes.timed, np.uint64),
            len(codes.entries),
            codes.plan.size,
            codes.clock,
            drive.moved,
        )
        self._drive, self._entries = drive, step["jacobian"].width
        self._rooms: list[tuple[Any, ...]] = []

    @contextmanager
    def room(self, kernels: LaneKernels) -> Iterator[tuple[Any, ...]]:
        """``arrays`` of the kernel, for one call at a time; their content does not matter."""
        room = self._rooms.pop() if self._rooms else self._new_room(kernels)
        yield room
        if len(self._rooms) < _KEPT_ROOMS:
            self._rooms.append(room)

    def _new_room(self, kernels: LaneKernels) -> tuple[Any, ...]:
        drive, lanes, (states, _, switches, outputs) = self._drive, kernels.lanes, self.given
        n, kinds, entries = drive.size, len(drive.model.switches), self._entries
        arguments = drive.codes.rates.size
        widest = max(n, len(outputs) * (kernels.window // lanes))
        kept = len(states) + len(switches)
        sizes = [n, n, 6 * n, n, drive.codes.plan.size, widest, kernels.control]
        sizes += [entries, entries, arguments, arguments, 4 * max(len(states), 1)]
        sizes.append(kept * (lanes + kernels.window))
        whole = aligned(sum(sizes), lanes)  # one array: each takes some microseconds
        parts = [whole[end - size : end] for size, end in zip(sizes, accumulate(sizes), strict=True)]
        return (
            tuple(parts[:7]),
            tuple(parts[7:9]),
            *parts[9:12],
            np.zeros((lanes, arguments)),
            parts[12].reshape(lanes, kept, lanes + kernels.window),
            (
                np.zeros(n),
                np.zeros(n),
                np.zeros((2, n)),
                np.zeros((2, kinds)),
                np.zeros(kinds + 1),
                np.zeros(kinds),
            ),
            (np.zeros((kernels.numbers, lanes), np.int64), np.zeros(kernels.entries, np.int64)),
        )


def columns_of(drive: CompiledDrive, names: Sequence[str] | None) -> Columns:
    """The columns of a structure, found once and kept with it."""
    key = None if names is None else tuple(names)
    found = drive.columns.get(key)
    if found is None:
        found = drive.columns.setdefault(key, Columns(drive, names))
    return found
