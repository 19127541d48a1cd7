"""Transient runs of many designs: one compiled structure, two threads, few rows.

The figures of a proposal come from a separate run on the usual fine grid: see `mckibben.sizing.proposal`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import count, islice
from typing import TypeVar

import numpy as np

from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import before_of, constants_of, segments_of
from mckibben.simulation.integrate.engine import compiled_drive
from mckibben.simulation.integrate.many import lane_kernels
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing.catalogue import Design, Group, switch_on
from mckibben.sizing.prepared import NOTHING, ROWS_DOWN, ROWS_UP, Figures, Prepared, Timeline
from mckibben.sizing.side_by_side import Case, figures_of_many
from mckibben.sizing.task import Task

_THREADS = 2
_SIDE_BY_SIDE = 192  # designs a thread runs at a time
_LEVEL = (
    0  # optimisation of the machine code of runs one by one; most runs are in lanes, which have their own
)
_LOOK_EVERY = 0.1  # s; whether to go on, while the kernel of the lanes is compiled (once on a machine)

Item = TypeVar("Item")
Result = TypeVar("Result")


class EndedError(Exception):
    """The caller has cancelled, or the time limit is reached."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.label)
        self.outcome = outcome


class Bench:
    """Runs designs of one task.

    It begins when the kernel of the lanes is ready: what a search proposes never depends on whether it was.

    Args:
        task: the task.
        watch: asked between runs whether to go on.

    Raises:
        EndedError: the watch ends the work before it begins.
    """

    def __init__(self, task: Task, watch: Watch) -> None:
        self.task, self.watch = task, watch
        self._runs = count()
        self.runs = 0
        self._timelines: dict[tuple[object, ...], Timeline] = {}
        self._known: dict[tuple[Group, float, float], Figures] = {}
        loading = lane_kernels.warm()
        while loading.is_alive():
            loading.join(_LOOK_EVERY)
            self.check_end(0.0)
        lane_kernels.awaited()

    def each(
        self,
        function: Callable[[Item], Result],
        items: Iterable[Item],
        share: tuple[float, float],
        total: int,
    ) -> Iterator[Result]:
        """Results of a function over items, in order, from two threads.

        Args:
            function: must release the interpreter lock for most of its time, else two threads gain nothing.
            items: its arguments.
            share: progress before and after, as shares of the whole work.
            total: number of items.

        Raises:
            EndedError: the watch ends the work.
        """
        source, begin = iter(items), share[0]
        done = 0
        with ThreadPoolExecutor(_THREADS) as pool:
            while chunk := list(islice(source, 8 * _THREADS)):
                futures = [pool.submit(function, item) for item in chunk]
                try:
                    for future in futures:
                        self.check_end(begin + (share[1] - begin) * done / max(total, 1))
                        yield future.result()
                        done += 1
                finally:
                    for future in futures:  # what has not begun is not run any more
                        future.cancel()

    def count_run(self) -> None:
        """Count one more run; may be called from any thread."""
        self.runs = next(self._runs) + 1

    def compile(self, group: Group) -> None:
        """Compile the equations of a group in advance, so that no two threads do it at the same time."""
        compiled_drive(
            DriveStructure(group.effects, tube=group.tube.tube is not None, pair=group.duty.pair),
            _LEVEL,
        )

    def prepared(self, design: Design) -> Prepared:
        """A design ready to run."""
        group = design.group
        drive = group.drive(self.task, design.length, design.pressure)
        compiled = compiled_drive(drive.structure, _LEVEL)
        table = constants_of(drive)
        parameters = np.array([table[name] for name in compiled.model.parameters])
        return Prepared(design, drive, compiled, parameters, self._timeline(group, drive))

    def run(self, design: Design) -> Figures:
        """Simulate one cycle of a design, on few rows."""
        known = self._known.pop((design.group, design.length, design.pressure), None)
        if known is not None:
            return known
        self.count_run()
        prepared = self.prepared(design)
        try:
            return prepared.figures(prepared.parameters, prepared.inputs, self.task.returns)
        except InputError:  # no rest position at all: the stretched counter muscle is too strong
            return NOTHING

    def has_run(self, design: Design) -> bool:
        """Whether `run_ahead` has simulated a design that `run` has not been asked for."""
        return (design.group, design.length, design.pressure) in self._known

    def check_end(self, share: float) -> None:
        """Report progress.

        Raises:
            EndedError: the watch ends the work.
        """
        ended = self.watch.ended(share)
        if ended is not None:
            raise EndedError(ended)

    def run_cases(self, cases: Sequence[Case]) -> list[Figures]:
        """Figures of some runs, side by side."""
        for _ in cases:
            self.count_run()
        return figures_of_many(cases, self.task.returns)

    def run_ahead(self, designs: Sequence[Design], share: tuple[float, float]) -> None:
        """Simulate designs side by side; `run` then has the result of each at once.

        Raises:
            EndedError: the watch ends the work.
        """
        parts = [designs[begin : begin + _SIDE_BY_SIDE] for begin in range(0, len(designs), _SIDE_BY_SIDE)]

        def figures(part: Sequence[Design]) -> list[Figures]:
            prepared = [self.prepared(design) for design in part]
            cases = [Case(item, item.parameters, item.inputs) for item in prepared]
            return figures_of_many(cases, self.task.returns)

        for part, found in zip(parts, self.each(figures, parts, share, len(parts)), strict=True):
            for design, result in zip(part, found, strict=True):
                self.count_run()
                self._known[design.group, design.length, design.pressure] = result

    def _timeline(self, group: Group, drive: Drive) -> Timeline:
        key = (group.duty.pair, group.valve.id, group.tube.id)
        timeline = self._timelines.get(key)
        if timeline is None:
            timeline = self._timelines[key] = _timeline(self.task, group, drive)
        return timeline


def _timeline(task: Task, group: Group, drive: Drive) -> Timeline:
    on = switch_on(task, group.duty)
    off = on + task.fill_time
    grid = np.linspace(on, off, ROWS_UP)
    if task.returns:
        grid = np.concatenate([grid, np.linspace(off, off + task.vent_time, ROWS_DOWN)[1:]])
    times, inputs, _ = segments_of(replace(drive, duration=float(grid[-1])))
    return Timeline(times, inputs, before_of(drive, inputs), grid, on, off)
