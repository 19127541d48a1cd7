"""How long a sizing takes, and the same transients under scipy's odeint. One command, one run:

    python -m tests.benchmarks.sizing

The task: 20 kg up by 60 mm in 0.5 s at 6 bar, with every muscle, valve and tube of the catalogue; 10
proposals with 100 specimens each. Beside it run 100 of its own transients (designs that the search tries)
under odeint with the same equations as Python source at the same tolerance, and 1000 specimens of the best
proposal.

Seconds of processor time tell what the machine could do when others use it too.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import odeint

from mckibben.application.size.task import catalogue_of, task_of
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.resources import presets_folder
from mckibben.simulation.integrate.engine import integrate
from mckibben.simulation.integrate.lane_buffers import lane_kernels
from mckibben.simulation.outcome import Watch
from mckibben.sizing import Sizing, size
from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.prepared import Prepared
from mckibben.sizing.proposal import chance
from tests.benchmarks.engine import say
from tests.benchmarks.translated import translated

TASK: dict[str, Any] = {"load": {"mass": "20 kg"}, "stroke": "60 mm", "time": "0.5 s"}
ROUNDS, RUNS, SPECIMENS, TOLERANCE = 5, 100, 1000, 1e-5


def timed(work: Callable[[], Any]) -> tuple[Any, float, float]:
    """Result, seconds by the clock, seconds of processor time."""
    began, used = time.perf_counter(), time.process_time()
    found = work()
    return found, time.perf_counter() - began, time.process_time() - used


def by_odeint(prepared: Prepared, rates: Callable[[list[float]], list[float]], events: np.ndarray) -> float:
    """The stroke at the end of a run; it is told the ``events``."""
    line, compiled = prepared.timeline, prepared.compiled
    start = prepared.start(prepared.parameters)
    state, switches = start.state.copy(), start.switches.copy()
    stops, (stroke, speed) = compiled.stops(prepared.parameters), compiled.moved
    for index, inputs in enumerate(prepared.inputs):
        begin, end = line.times[index], line.times[index + 1]
        mine = events[(events[:, 0] >= begin) & (events[:, 0] < end)]
        for instant, number, to in [*mine[:, :3], (end, -1, 0.0)]:
            if instant > begin:
                rest = [*prepared.parameters.tolist(), *inputs.tolist(), *switches.tolist()]
                within = line.grid[(line.grid > begin) & (line.grid < instant)]
                state = odeint(
                    lambda y, t, rest=rest: rates([*y.tolist(), *rest]),
                    state,
                    np.concatenate([[begin], within, [instant]]),
                    rtol=TOLERANCE,
                    atol=TOLERANCE * compiled.scales,
                    mxstep=100_000,
                )[-1]
                begin = instant
            if number >= 0:
                k = int(number)
                switches[k] = to
                if to == 1.0 and np.isfinite(stops[k]):
                    state[stroke], state[speed] = stops[k], 0.0
    return float(state[0])


def events_of(prepared: Prepared) -> np.ndarray:
    """The events of a run; see `mckibben.simulation.integrate.problem.Solution`."""
    line, start = prepared.timeline, prepared.start(prepared.parameters)
    return integrate(
        prepared.compiled, parameters=prepared.parameters, start=start.state, switches=start.switches,
        restitution=prepared.drive.restitution, times=line.times, inputs=prepared.inputs, grid=line.grid,
        tolerance=TOLERANCE,
    ).events  # fmt: skip


def ratio(bench: Bench, designs: list[Design]) -> None:
    """Our transients beside odeint's, one after the other in one thread."""
    prepared = [bench.prepared(design) for design in designs]
    written: dict[int, Any] = {}
    for item in prepared:
        written.setdefault(id(item.compiled), translated(item.compiled.model, "python"))
    _, ours, ours_used = timed(lambda: [bench.run(design) for design in designs])
    events = [events_of(item) for item in prepared]
    _, theirs, theirs_used = timed(
        lambda: [
            by_odeint(item, written[id(item.compiled)], rows)
            for item, rows in zip(prepared, events, strict=True)
        ]
    )
    say(
        f"{len(designs)} transients, one thread: ours {ours:.2f} s ({ours_used:.2f} s of processor), odeint "
        f"{theirs:.2f} s ({theirs_used:.2f} s): {theirs_used / ours_used:.0f} times"
    )


def main() -> int:
    """Measure everything and print it."""
    lane_kernels.warm().join()
    studio = Studio(presets=presets_folder())
    document = SizingTask.model_validate(TASK)
    task, catalogue = task_of(document), catalogue_of(document, studio)
    found = Sizing()
    clock: list[float] = []
    used: list[float] = []
    for _ in range(ROUNDS):
        found, took, processor = timed(lambda: size(task, catalogue))
        clock.append(took)
        used.append(processor)
    specimens = sum(item.chance.specimens for item in found.proposals if item.chance)
    say(
        f"sizing: {found.combinations} combinations, {found.pruned} pruned in closed form, {found.simulated} "
        f"transients, {specimens} specimens: first {clock[0]:.2f} s, best {min(clock):.2f} s, median "
        f"{statistics.median(clock):.2f} s ({statistics.median(used):.2f} s of processor on two threads)"
    )
    bench = Bench(task, Watch())
    ratio(bench, [trial.design for trial in found.explored][:RUNS])
    best = found.proposals[0].design
    for _ in range(3):
        likely, took, processor = timed(lambda: chance(bench, best, (0.0, 1.0), SPECIMENS))
        say(f"{SPECIMENS} specimens: {took:.2f} s ({processor:.2f} s of processor), {likely.probability:.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
