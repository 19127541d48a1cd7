"""A design ready to run with varied parameters, and the figures of such a run on few rows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, INPUTS, LOW_STOP
from mckibben.physics.gas import ANR_DENSITY
from mckibben.simulation.drive.events import Event, each_event
from mckibben.simulation.drive.initial_state import Start, start_of
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.integrate.engine import CompiledDrive, integrate
from mckibben.sizing.catalogue import Design

ROWS_UP, ROWS_DOWN = 160, 120
# Coarse, times within 0.1 %: a proposal is run again at the usual tolerance.
TOLERANCE = 1e-5
#: Distance from a stop within which a load counts as resting on it [m].
ON_STOP = 1e-8
#: Last share of the fill in which the load must rest on the stop: a load that is too heavy swings back.
HOLD_SHARE = 0.25
_HOLDS_BACK = 0.999  # largest friction as a share of the load: friction holds a load, it does not lift it


@dataclass(frozen=True, slots=True)
class Figures:
    """Figures of a run: times [s], air of all muscles in a cycle at ANR [m^3], largest tension [N].

    Attributes:
        time, time_down: to the end of the stroke and back; None when not reached in the simulated time.
        holds: whether the load stays there until the valve stops filling.
        reached: largest stroke of the load [m].
    """

    time: float | None
    time_down: float | None
    holds: bool
    air: float
    peak_force: float
    reached: float


#: For a run that never starts or fails.
NOTHING = Figures(None, None, False, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Timeline:
    """Time grid and inputs, shared by all designs of a task with the same parts.

    Attributes:
        times, inputs: boundaries and inputs of the segments.
        before: inputs before the run.
        grid: instants of the rows: `ROWS_UP` for the fill, then those of the return.
        on, off: start and end of the fill [s].
    """

    times: np.ndarray
    inputs: np.ndarray
    before: np.ndarray
    grid: np.ndarray
    on: float
    off: float


@dataclass(frozen=True, eq=False)
class Prepared:
    """A design with its compiled equations; parameters and inputs may be varied."""

    design: Design
    drive: Drive
    compiled: CompiledDrive
    parameters: np.ndarray
    timeline: Timeline

    @property
    def inputs(self) -> np.ndarray:
        """Inputs of each segment."""
        inputs = self.timeline.inputs.copy()
        inputs[:, INPUTS.index("external_force")] = self.drive.load.force
        return inputs

    def parameter_index(self, name: str) -> int:
        """Position of a parameter."""
        return self.compiled.parameter_places[name]

    def specimen(self, shift: float, friction: float, pressure: float) -> tuple[np.ndarray, np.ndarray]:
        """Parameters and inputs with the deviations of one specimen.

        Args:
            shift: added to the contraction ratio.
            friction: friction of one muscle, against the motion in both directions [N].
            pressure: factor on the supply pressure.
        """
        drive, duty = self.drive, self.design.group.duty
        parameters, inputs = self.parameters.copy(), self.inputs
        parameters[self.parameter_index("precontraction")] += shift * drive.muscle.nominal_length
        supply = drive.supply_pressure * pressure + drive.ambient_pressure
        parameters[self.parameter_index("supply_pressure")] = supply
        forward = back = friction * duty.lever_ratio
        if not duty.pair:  # the load at the start of the stroke, where a spring does not pull yet
            pulling = float(duty.load(np.zeros(1))[0]) / self.design.group.parallel
            back = min(back, _HOLDS_BACK * max(pulling, 0.0))
        filling = inputs[:, INPUTS.index("opening")] > 0.0
        inputs[:, INPUTS.index("external_force")] += np.where(filling, forward, -back)
        return parameters, inputs

    def figures(self, parameters: np.ndarray, inputs: np.ndarray, returns: bool) -> Figures:
        """Run with the given parameters and inputs.

        Raises:
            InputError: nothing holds the load before the run.
        """
        line, compiled = self.timeline, self.compiled
        with np.errstate(all="ignore"):
            start = self.start(parameters)
            solution = integrate(
                compiled,
                parameters=parameters,
                start=start.state,
                switches=start.switches,
                restitution=self.drive.restitution,
                times=line.times,
                inputs=inputs,
                grid=line.grid,
                tolerance=TOLERANCE,
            )
        names = [*(state.name for state in compiled.model.states), *compiled.model.output_names]
        rows = solution.rows[None, :, [names.index(name) for name in self.columns]]
        return figures_of([self], rows, [solution.events], returns)[0]

    @property
    def columns(self) -> tuple[str, ...]:
        """States and outputs of a run that `figures_of` needs."""
        names = [state.name for state in self.compiled.model.states]
        return "stroke", "force", *(n for n in ("supplied", f"supplied{COUNTER}") if n in names)

    def start(self, parameters: np.ndarray) -> Start:
        """The load at rest before the run.

        A pair starts on the lower stop: its second muscle has pulled it there before the fill.
        """
        return start_of(self.resting, self.compiled, parameters, self.before)

    @cached_property
    def resting(self) -> Drive:
        """The drive before the run."""
        drive = self.drive
        if drive.pair:
            drive = replace(drive, start_position=drive.stops[0] / drive.load.lever_ratio)
        return drive

    @property
    def before(self) -> np.ndarray:
        """Inputs before the run."""
        before = self.timeline.before.copy()
        before[INPUTS.index("external_force")] = self.drive.load.force
        return before


def figures_of(
    runs: Sequence[Prepared], rows: np.ndarray, events: Sequence[np.ndarray], returns: bool
) -> list[Figures]:
    """The figures of runs with the same equations and as many rows; `NOTHING` for one that ended early.

    Args:
        runs: what ran.
        rows: of `Prepared.columns`, shape (runs, rows, columns).
        events: of each run, see `mckibben.simulation.integrate.problem.Solution`.
        returns: whether the return stroke counts.
    """
    size = len(runs[0].timeline.grid)
    if rows.shape[1] < size:
        return [NOTHING] * len(runs)
    sound = np.all(np.isfinite(rows), axis=(1, 2))
    up = rows[:, :ROWS_UP, 0]
    least = up[:, -int(HOLD_SHARE * ROWS_UP) :].min(axis=1)
    air, force = (rows[:, -1, 2:] - rows[:, 0, 2:]).sum(axis=1), rows[:, :, 1].max(axis=1)
    names = [switch.name for switch in runs[0].compiled.model.switches]
    top, bottom = names.index(HIGH_STOP), names.index(LOW_STOP)
    found = []
    for index, (run, farthest) in enumerate(zip(runs, up.max(axis=1).tolist(), strict=True)):
        if not sound[index]:
            found.append(NOTHING)
            continue
        line, low, high = run.timeline, *run.drive.stops
        mine = events[index]
        found.append(
            Figures(
                arrival(each_event(run.compiled, mine[mine[:, 1] == top]), HIGH_STOP, line.on, line.off),
                arrival(each_event(run.compiled, mine[mine[:, 1] == bottom]), LOW_STOP, line.off, np.inf)
                if returns
                else None,
                bool(least[index] >= high - ON_STOP),
                float(air[index]) * run.design.group.parallel / ANR_DENSITY,
                float(force[index]),
                (farthest - low) / run.drive.load.lever_ratio,
            )
        )
    return found


def arrival(events: Iterable[Event], stop: str, begin: float, end: float) -> float | None:
    """Time from ``begin`` to the first impact on a stop before ``end`` [s]; None without one."""
    for event in events:
        if event.switch == stop and event.impact and begin <= event.time < end:
            return event.time - begin
    return None
