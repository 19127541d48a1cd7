"""A proposal: a refined design with figures from a run on the usual fine grid."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np

from mckibben.facts.sizing import LIFTED
from mckibben.physics.drive_terms import HIGH_STOP
from mckibben.physics.gas import ANR_DENSITY
from mckibben.simulation.drive.transient import dead_times, simulate
from mckibben.simulation.outcome import Outcome
from mckibben.simulation.timing.evaluation import moving_mass, stops_of, time_step, trace_of
from mckibben.simulation.timing.table import Phase, timing
from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design, switch_on
from mckibben.sizing.prepared import HOLD_SHARE, ON_STOP, Figures, arrival
from mckibben.sizing.side_by_side import Case, figures_of_many
from mckibben.sizing.spread import spread_of
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial, judged, times_over

_MILLIMETRE, _PRESSURE_STEP = 1e-3, 1e3

_CHUNK = 128  # specimens a thread takes at a time


@dataclass(frozen=True, slots=True)
class Chance:
    """Share of the specimens that fulfil the task, its standard error, and the number of specimens."""

    probability: float
    error: float
    specimens: int


def chance(bench: Bench, design: Design, share: tuple[float, float], specimens: int) -> Chance:
    """The probability that a design fulfils the task.

    Args:
        bench: runs the designs of the task.
        design: the design.
        share: progress before and after, as shares of the whole work.
        specimens: number of specimens simulated.

    Raises:
        EndedError: the bench's watch ends the work.
    """
    prepared, spread = bench.prepared(design), spread_of(design, bench.task, specimens)
    starts = range(0, specimens, _CHUNK)

    def successes(begin: int) -> int:
        chosen = range(begin, min(begin + _CHUNK, specimens))
        cases = [
            Case(prepared, *prepared.specimen(spread.shift[i], spread.friction[i], spread.pressure[i]))
            for i in chosen
        ]
        return sum(_succeeds(figures, bench.task) for figures in figures_of_many(cases, bench.task.returns))

    probability = sum(bench.each(successes, starts, share, len(starts))) / specimens
    # At 0 and 1 the variance is that of one deviating specimen, not zero.
    variance = max(probability * (1.0 - probability), 1.0 / specimens)
    return Chance(probability, sqrt(variance / specimens), specimens)


def _succeeds(figures: Figures, task: Task) -> bool:
    """Whether one specimen reaches the end of the stroke in time, stays there, and returns in time."""
    late = max(times_over(figures, task).values(), default=0.0)
    return figures.time is not None and figures.holds and late <= 1.0


@dataclass(frozen=True, eq=False)
class Proposal:
    """A drive that fulfils the task.

    Attributes:
        trial: design, statics and figures of the run.
        impacts: energy of all moving mass at the stop that ends the stroke, and at that of the return [J].
        end_speed: speed of the load at the end of the stroke [m/s].
        max_speed: largest speed of the load, of stroke and return [m/s].
        pressure_start, pressure_end: in the muscle when the load leaves its stop, and on arrival [Pa].
        chance: probability that it fulfils the task; None when no specimens were requested.
        reservations: what speaks against it although it keeps every limit.
        reason: explanation of its rank.
        front: whether it is on the Pareto front: no other design is better in every aim.
    """

    trial: Trial
    impacts: tuple[float, float]
    end_speed: float
    max_speed: float
    pressure_start: float
    pressure_end: float
    chance: Chance | None = None
    reservations: tuple[str, ...] = ()
    reason: str = ""
    front: bool = False

    @property
    def design(self) -> Design:
        """The design."""
        return self.trial.design

    @property
    def impact_energy(self) -> float:
        """The larger of the impacts: what the stops have to take [J]."""
        return max(self.impacts)


def propose(trial: Trial, bench: Bench) -> Proposal | Trial:
    """The proposal of a trial, in whole millimetres and hundredths of a bar if these keep every limit.

    A trial that breaks a limit on the fine grid is returned with its figures on that grid.
    """
    design = trial.design
    length = ceil(design.length / _MILLIMETRE - 1e-6) * _MILLIMETRE
    pressure = ceil(design.pressure / _PRESSURE_STEP - 1e-6) * _PRESSURE_STEP
    exact = round(length, 6), design.pressure
    choices = [(round(length, 6), pressure), exact, (design.length, design.pressure)]
    measured = trial
    for length, pressure in dict.fromkeys(choices):
        candidate = _measured(Design(design.group, length, pressure), bench)
        if candidate is None:
            continue
        if candidate.trial.keeps_limits:
            return candidate
        measured = candidate.trial
    return measured


def _measured(design: Design, bench: Bench) -> Proposal | None:
    """A design run on the fine grid, whether it fulfils the task or not; None when the run fails."""
    task, group = bench.task, design.group
    drive = group.drive(task, design.length, design.pressure)
    bench.count_run()
    step = time_step(drive.duration)
    grid = np.linspace(0.0, drive.duration, ceil(drive.duration / step) + 1)
    with np.errstate(all="ignore"):
        run = simulate(drive, grid=grid)
    if run.outcome is not Outcome.COMPLETED or not np.isfinite(run.states["stroke"]).all():
        return None
    on = switch_on(task, group.duty)
    off = on + task.fill_time
    trace = trace_of(run)
    if trace is None:
        return None
    low, _ = stops_of(drive)
    table = timing(
        trace,
        fill=Phase((on, off)),
        vent=Phase((off, drive.duration)),
        mass=moving_mass(drive),
        delays=dead_times(drive),
    )
    up, down = table.extend, table.retract
    begin, late, end = np.searchsorted(trace.time, (on, off - HOLD_SHARE * task.fill_time, off))
    resting = trace.position[late : end + 1] >= stops_of(drive)[1] - ON_STOP
    # Without an impact the table means 95 % of the stroke; here it is the stop.
    time = up.positioning_time if arrival(run.events, HIGH_STOP, on, off) is not None else None
    figures = Figures(
        time=time,
        time_down=down.positioning_time if trace.contact[-1] else None,
        holds=bool(np.all(resting)),
        air=float(trace.supplied[-1] - trace.supplied[begin]) / ANR_DENSITY * group.parallel,
        peak_force=float(np.max(run.outputs["force"])),
        reached=float(np.max(trace.position[begin : end + 1])) - low,
    )
    filled = slice(begin, end + 1)
    left = int(np.argmax(trace.position[filled] > low + LIFTED))
    pressures = trace.pressure[filled]
    arrived = 0.0 if time is None else float(np.interp(on + time, trace.time, trace.pressure))
    return Proposal(
        judged(design, figures, task),
        impacts=(
            float(up.impact_energy or 0.0) * group.parallel,
            float(down.impact_energy or 0.0) * group.parallel,
        ),
        end_speed=float(up.end_speed or 0.0),
        max_speed=max(float(up.max_speed or 0.0), float(down.max_speed or 0.0)),
        pressure_start=float(pressures[left]),
        pressure_end=arrived,
    )
