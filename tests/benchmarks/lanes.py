"""Many parameter sets in lanes beside the same sets one by one. One command, every figure:

    python -m tests.benchmarks.lanes

The reference lift and the preset propneu-20: sets with conductances, mass, pressure and effects times 0.7 to
1.4, 4001 rows. One by one each set is a lane, the others idle. Both take turns; the tables give the least
processor time of some rounds, which other work on the machine disturbs least. All columns are written in
parts of `PART` sets, by both. The tolerance is the largest at which 99 % of the strokes are within 1e-5 m of
a run at 1e-9.

Beside it the cost of a start, how long a structure takes until it can run when its code is not kept on the
disk, and a whole sizing with and without runs side by side.
"""

from __future__ import annotations

import sys
import time
from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from unittest.mock import patch

import numpy as np

from mckibben.application.size.task import catalogue_of, task_of
from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate import machine_code
from mckibben.simulation.integrate.engine import compiled_drive, integrate
from mckibben.simulation.integrate.many import integrate_many, lane_kernels
from mckibben.sizing import batch, size
from mckibben.sizing.prepared import NOTHING, Figures
from mckibben.sizing.side_by_side import Case
from tests.benchmarks.engine import say
from tests.benchmarks.lift import DOCUMENT, WITH_SPOOL
from tests.benchmarks.sizing import TASK

SETS, ROWS, PART, ROUNDS, CLOSE = 384, 4001, 32, 5, 1e-5
TOLERANCES = tuple(10**-exponent for exponent in (4.5, 5.0, 5.25, 5.5, 5.75, 6.0))
VARIED = (
    "mass",
    "fill_conductance",
    "exhaust_conductance",
    "supply_pressure",
    "dahl.force",
    "creep.stiffness",
)
Work = Callable[[Sequence[int]], object]


class Sets:
    """Random parameter sets of a drive."""

    def __init__(self, drive: Drive) -> None:
        self.drive, self.compiled = drive, compiled_drive(drive.structure, 1)
        self.grid = np.linspace(0.0, drive.duration, ROWS)
        self.times, self.inputs, _ = segments_of(drive)
        names, random = list(self.compiled.model.parameters), np.random.default_rng(7)
        free = [names.index(name) for name in VARIED if name in names]
        self.parameters = np.tile(parameters_of(drive, self.compiled), (SETS, 1))
        self.parameters[:, free] *= np.exp(random.uniform(np.log(0.7), np.log(1.4), (SETS, len(free))))
        self.before = self.inputs[0] * 0.0
        self.starts = starts_of_many(drive, self.compiled, self.parameters, self.before)
        self.stroke = [state.name for state in self.compiled.model.states].index("stroke")

    def one_by_one(self, tolerance: float, kept: int = 1) -> Work:
        """Runs one by one; the rows of the last ``kept`` runs stay in memory, as those of a part in lanes."""

        def work(sets: Sequence[int]) -> np.ndarray:
            found, rows = [], deque(maxlen=kept)
            for index in sets:
                rows.append(integrate(
                    self.compiled, parameters=self.parameters[index], start=self.starts.states[index],
                    switches=self.starts.switches[index], times=self.times, inputs=self.inputs,
                    grid=self.grid, tolerance=tolerance, restitution=self.drive.restitution,
                ).rows)  # fmt: skip
                found.append(rows[-1][:, self.stroke].copy())
            return np.array(found)

        return work

    def in_lanes(self, columns: Sequence[str] | None, part: int, tolerance: float) -> Work:
        def work(sets: Sequence[int]) -> np.ndarray:
            found = None
            for begin in range(0, len(sets), part):
                chosen = list(sets[begin : begin + part])
                found = None  # its memory serves the next part
                found = integrate_many(
                    self.compiled, parameters=self.parameters[chosen], starts=self.starts.states[chosen],
                    switches=self.starts.switches[chosen], times=self.times, inputs=self.inputs,
                    grid=self.grid, tolerance=tolerance, columns=columns, restitution=self.drive.restitution,
                ).rows  # fmt: skip
            assert found is not None
            return found[:, :, 0]

        return work


def least_times(works: dict[str, Callable[[], object]], rounds: int = ROUNDS) -> dict[str, float]:
    """Least processor time of each work, which take turns [s]."""
    used = dict.fromkeys(works, np.inf)
    for _ in range(rounds):
        for key, work in works.items():
            began = time.process_time()
            work()
            used[key] = min(used[key], time.process_time() - began)
    return used


def speed(name: str, sets: Sets, tolerance: float) -> None:
    """The table of runs per second."""
    works = {
        "one by one": sets.one_by_one(tolerance),
        f"one by one, all columns of {PART} sets kept": sets.one_by_one(tolerance, kept=PART),
        f"lanes, all columns of {PART} sets kept": sets.in_lanes(None, PART, tolerance),
        "lanes, stroke only": sets.in_lanes(["stroke"], SETS, tolerance),
    }
    used = least_times({key: partial(work, range(SETS)) for key, work in works.items()})
    base, kept = list(used.values())[:2]
    head = f"\n| {name}: {sets.compiled.size} states, tolerance {tolerance:.1e} | runs/s of processor "
    say(f"{head}| times one by one | ... kept |")
    say("|---|---:|---:|---:|")
    for key, taken in used.items():
        say(f"| {key} | {SETS / taken:.0f} | {base / taken:.1f} | {kept / taken:.1f} |")


def accuracy(name: str, sets: Sets) -> float:
    """Largest error of each set's stroke, of lanes and of runs one by one; returns the tolerance to use."""
    every = range(SETS)
    exact = sets.in_lanes(["stroke"], SETS, 1e-9)(every)
    say(f"\n| {name}: error of the stroke [m] | median | 99 % | largest | lanes - one by one, largest |")
    say("|---|---:|---:|---:|---:|")
    wanted = TOLERANCES[-1]
    for tolerance in TOLERANCES:
        found = np.asarray(sets.in_lanes(["stroke"], SETS, tolerance)(every))
        apart = np.max(np.abs(found - sets.one_by_one(tolerance)(every)))
        errors = np.max(np.abs(found - exact), axis=1)
        middle, most = np.percentile(errors, [50, 99])
        say(f"| {tolerance:.1e} | {middle:.1e} | {most:.1e} | {errors.max():.1e} | {apart:.1e} |")
        wanted = max(wanted, tolerance) if most <= CLOSE else wanted
    return wanted


def costs(name: str, sets: Sets) -> None:
    """Starts, and how long a structure takes until it can run."""
    drive, compiled, rows = sets.drive, sets.compiled, sets.parameters
    build, outputs = compiled_drive.__wrapped__, range(compiled.width)
    works = {
        "start": lambda: starts_of_many(drive, compiled, rows, sets.before),
        "alone": lambda: [start_of(drive, compiled, row, sets.before) for row in rows[:100]],
        "scalar": lambda: build(drive.structure),
        "lanes": lambda: build(drive.structure).lanes.step,
        "columns": lambda: (ready := build(drive.structure).lanes).step and ready.outputs(outputs),
    }
    with patch.object(machine_code, "kept", lambda _: None), patch.object(machine_code, "keep"):
        used = least_times(works, 3)
    say(
        f"\n{name}, {compiled.size} states: a start {used['start'] / SETS * 1e6:.1f} us in lanes, "
        f"{used['alone'] / 100 * 1e6:.0f} us alone; ready to run under LSODA after "
        f"{used['scalar'] * 1e3:.0f} ms, in lanes {used['lanes'] * 1e3:.0f} ms, with all columns "
        f"{used['columns'] * 1e3:.0f} ms"
    )


def _alone(cases: Sequence[Case], returns: bool) -> list[Figures]:
    """In place of `figures_of_many`: each case a run of its own."""

    def figures(case: Case) -> Figures:
        try:
            return case.prepared.figures(case.parameters, case.inputs, returns)
        except InputError:  # nothing holds the load before the run
            return NOTHING

    return [figures(case) for case in cases]


def sizing(studio: Studio) -> None:
    """A whole sizing, with and without lanes."""
    document = SizingTask.model_validate(TASK)
    task, catalogue = task_of(document), catalogue_of(document, studio)

    def one_by_one() -> None:
        with patch.object(batch, "figures_of_many", _alone):
            size(task, catalogue)

    one_by_one()  # compiles
    began = time.process_time()
    size(task, catalogue)
    first = time.process_time() - began
    used = least_times({"one by one": one_by_one, "lanes": lambda: size(task, catalogue)})
    say(
        f"\na whole sizing: {used['one by one']:.2f} s of processor one by one, {used['lanes']:.2f} s in "
        f"lanes ({used['one by one'] / used['lanes']:.1f} times), the first one {first:.2f} s with compiling"
    )


def main() -> int:
    """Measure everything and print it."""
    say(f"{lane_kernels.awaited().lanes} lanes, {SETS} sets, {ROWS} rows")
    studio = Studio(presets=presets_folder())
    drives = {
        "reference lift": drive_of(read_document(DOCUMENT, "the lift"), studio).drive,
        "propneu-20": drive_of(preset_document("propneu-20", studio), studio).drive,
        "lift with spool and friction": drive_of(read_document(WITH_SPOOL, "the lift"), studio).drive,
    }
    for name, drive in drives.items():
        sets = Sets(drive)
        if "spool" not in name:
            speed(name, sets, accuracy(name, sets))
        costs(name, sets)
    sizing(studio)
    return 0


if __name__ == "__main__":
    sys.exit(main())
