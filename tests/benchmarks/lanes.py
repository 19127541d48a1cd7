"""Many parameter sets in lanes beside the same sets one by one. One command, one run:

    python -m tests.benchmarks.lanes

The reference lift and the preset propneu-20, 1000 sets with conductances, mass, pressure and effects times
0.7 to 1.4, 4001 rows. Scalar kernel and lanes take turns; the table gives medians. All columns are written in
parts of `PART` sets: 1000 sets with all columns would take a gigabyte. Beside it the error of the stroke
against a run at 1e-9 by tolerance, the cost of a start, and the compilation.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from mckibben.documents.drive_files import preset_document, read_document
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.resources import presets_folder
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate.engine import compiled_drive, integrate, kernel
from mckibben.simulation.integrate.many import integrate_many, lane_kernels
from tests.benchmarks.engine import say
from tests.benchmarks.lift import DOCUMENT

SETS, ROWS, PART, ROUNDS, TOLERANCE = 1000, 4001, 25, 5, 1e-5
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

    def one_by_one(self, tolerance: float = TOLERANCE) -> Work:
        def work(sets: Sequence[int]) -> np.ndarray:
            found = []
            for index in sets:
                rows = integrate(
                    self.compiled, parameters=self.parameters[index], start=self.starts.states[index],
                    switches=self.starts.switches[index], times=self.times, inputs=self.inputs,
                    grid=self.grid, tolerance=tolerance, engine="rodas", restitution=self.drive.restitution,
                ).rows  # fmt: skip
                found.append(rows[:, self.stroke].copy())
            return np.array(found)

        return work

    def in_lanes(self, columns: Sequence[str] | None, part: int, tolerance: float = TOLERANCE) -> Work:
        def work(sets: Sequence[int]) -> np.ndarray:
            found = np.empty((0, ROWS, 1))
            for begin in range(0, len(sets), part):
                chosen = list(sets[begin : begin + part])
                found = integrate_many(
                    self.compiled, parameters=self.parameters[chosen], starts=self.starts.states[chosen],
                    switches=self.starts.switches[chosen], times=self.times, inputs=self.inputs,
                    grid=self.grid, tolerance=tolerance, columns=columns, restitution=self.drive.restitution,
                ).rows  # fmt: skip
            return found[:, :, 0]

        return work


def speed(name: str, sets: Sets) -> None:
    """The table of runs per second."""
    works = {
        "one by one": sets.one_by_one(),
        "lanes, all columns": sets.in_lanes(None, PART),
        "lanes, stroke only": sets.in_lanes(["stroke"], SETS),
    }
    head = f"\n| {name}: {sets.compiled.size} states | threads | runs/s | runs/s of processor "
    say(f"{head}| times one by one |")
    say("|---|---:|---:|---:|---:|")
    for threads in (1, 2):
        halves = [range(i * SETS // threads, (i + 1) * SETS // threads) for i in range(threads)]
        clock: dict[str, list[float]] = {key: [] for key in works}
        used: dict[str, list[float]] = {key: [] for key in works}
        for _ in range(ROUNDS):
            for key, work in works.items():
                with ThreadPoolExecutor(threads) as pool:
                    began, processor = time.perf_counter(), time.process_time()
                    list(pool.map(work, halves))
                    clock[key].append(time.perf_counter() - began)
                    used[key].append(time.process_time() - processor)
        base = statistics.median(used["one by one"])
        for key in works:
            rate, taken = SETS / statistics.median(clock[key]), statistics.median(used[key])
            say(f"| {key} | {threads} | {rate:.0f} | {SETS / taken:.0f} | {base / taken:.1f} |")


def accuracy(name: str, sets: Sets) -> None:
    """Largest error of each set's stroke, of lanes and of runs one by one."""
    every = range(SETS)
    exact = sets.in_lanes(["stroke"], SETS, 1e-9)(every)
    say(f"\n| {name}: error of the stroke [m] | median | 99 % | largest | lanes - one by one, largest |")
    say("|---|---:|---:|---:|---:|")
    for tolerance in (10**-4.5, 1e-5, 10**-5.5, 1e-6):
        found = np.asarray(sets.in_lanes(["stroke"], SETS, tolerance)(every))
        apart = np.max(np.abs(found - sets.one_by_one(tolerance)(every)))
        errors = np.max(np.abs(found - exact), axis=1)
        middle, most = np.percentile(errors, [50, 99])
        say(f"| {tolerance:.1e} | {middle:.1e} | {most:.1e} | {errors.max():.1e} | {apart:.1e} |")


def costs(name: str, sets: Sets) -> None:
    """Starts, and the compilation of a structure."""

    def used(work: Callable[[], object]) -> float:
        taken = []
        for _ in range(3):
            began = time.process_time()
            work()
            taken.append(time.process_time() - began)
        return min(taken) * 1e3

    drive, compiled, rows = sets.drive, sets.compiled, sets.parameters
    together = used(lambda: starts_of_many(drive, compiled, rows, sets.before)) / SETS
    alone = used(lambda: [start_of(drive, compiled, row, sets.before) for row in rows[:100]]) / 100
    code = compiled_drive.__wrapped__
    scalar = used(lambda: code(drive.structure, 1))
    lanes = used(lambda: code(drive.structure, 1).lanes.step) - scalar
    say(
        f"\n{name}: a start {together * 1e3:.1f} us in lanes, {alone * 1e3:.0f} us alone; compilation "
        f"{scalar:.0f} ms, for lanes {lanes:.0f} ms more"
    )


def main() -> int:
    """Measure everything and print it."""
    kernel.awaited()
    say(f"{lane_kernels.awaited().lanes} lanes, tolerance {TOLERANCE:.0e}, {SETS} sets, {ROWS} rows")
    studio = Studio(presets=presets_folder())
    drives = {
        "reference lift": drive_of(read_document(DOCUMENT, "the lift"), studio).drive,
        "propneu-20": drive_of(preset_document("propneu-20", studio), studio).drive,
    }
    for name, drive in drives.items():
        sets = Sets(drive)
        speed(name, sets)
        accuracy(name, sets)
        costs(name, sets)
    return 0


if __name__ == "__main__":
    sys.exit(main())
