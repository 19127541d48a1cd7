"""Runs of a drive with varied values, in the lanes of `mckibben.simulation.integrate.many`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.documents.located import one_line
from mckibben.facts.run import TRACKING
from mckibben.facts.study import WATCHED
from mckibben.facts.timing import TIMING
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.initial_state import Start
from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    Run,
    before_of,
    parameters_of,
    run_of,
    segments_of,
)
from mckibben.simulation.integrate.engine import CompiledDrive, Solution, compiled_drive
from mckibben.simulation.integrate.many import integrate_many
from mckibben.simulation.outcome import Outcome
from mckibben.simulation.timing.evaluation import grid_of, timing_of, trace_of, tracking_of
from mckibben.simulation.timing.trace import Trace
from mckibben.studies.table import COMPLETED, Figure, Row

Array = np.ndarray
REFUSED = "refused"  # outcome of values that no drive can have, or with which nothing holds its load
_POINTS = 2001  # rows of a run; the grid of the timing table is finer where needed
_MOST_NUMBERS = 4_000_000  # in the rows of runs side by side: 32 MB, which memory is kept for

_PICKS = {"largest": np.max, "smallest": np.min, "last": lambda column: column[-1]}

#: Path -> SI unit: the timing table, tracking of a reference, and extremes and last values of columns.
DRIVE_FIGURES: dict[str, str] = {
    path: figure.unit
    for path, figure in WATCHED.items()
    if path.partition(".")[0] in {TIMING.name, TRACKING.name, *_PICKS}
}


@dataclass(frozen=True, eq=False)
class _Case:
    """A drive ready to run, and its place among the points."""

    place: int
    drive: Drive
    compiled: CompiledDrive
    parameters: Array
    times: Array
    inputs: Array
    command: Segments
    grid: Array

    @property
    def kind(self) -> tuple[object, ...]:
        """Cases that run side by side have the same."""
        return id(self.compiled), self.drive.restitution, self.inputs.shape, self.grid.shape


class DriveRuns:
    """Evaluates points of a study: `mckibben.studies.table.Evaluate`.

    The kernel of the lanes is awaited, so that a result never depends on whether it was ready.

    Args:
        drive_at: the drive of a point; raises InputError for one that cannot be.
        paths: of the figures.
    """

    def __init__(self, drive_at: Callable[[Array], Drive], paths: Sequence[str]) -> None:
        self._drive_at, self._paths = drive_at, tuple(paths)

    def __call__(self, points: Array) -> list[Row]:
        """The rows of points, shape (runs, variables)."""
        rows: dict[int, Row] = {}
        alike: dict[tuple[object, ...], list[_Case]] = {}
        with np.errstate(all="ignore"):  # a diverging run ends with an outcome, not with warnings
            for place, point in enumerate(points):
                try:
                    drive = self._drive_at(point)
                    if drive.controller is not None:
                        rows[place] = self._controlled(drive)
                    else:
                        case = _case(place, drive)
                        alike.setdefault(case.kind, []).append(case)
                except InputError as error:
                    rows[place] = self._refused(error)
            for cases in alike.values():
                width = cases[0].compiled.size + cases[0].compiled.width
                at_once = max(8, _MOST_NUMBERS // (len(cases[0].grid) * width))
                for begin in range(0, len(cases), at_once):
                    rows |= self._side_by_side(cases[begin : begin + at_once])
        return [rows[place] for place in range(len(points))]

    def _side_by_side(self, cases: list[_Case]) -> dict[int, Row]:
        compiled = cases[0].compiled
        starts = starts_of_many(
            [case.drive for case in cases],
            compiled,
            np.array([case.parameters for case in cases]),
            np.array([before_of(case.drive, case.inputs) for case in cases]),
        )
        errors = {case.place: error for case, error in zip(cases, starts.errors, strict=True)}
        rows = {place: self._refused(error) for place, error in errors.items() if error is not None}
        sound = [index for index, case in enumerate(cases) if errors[case.place] is None]
        if not sound:
            return rows
        chosen = [cases[index] for index in sound]
        done = integrate_many(
            compiled,
            parameters=np.array([case.parameters for case in chosen]),
            starts=starts.states[sound],
            switches=starts.switches[sound],
            restitution=chosen[0].drive.restitution,
            times=np.array([case.times for case in chosen]),
            inputs=np.array([case.inputs for case in chosen]),
            grid=np.array([case.grid for case in chosen]),
            tolerance=TOLERANCE,
        )
        for index, (case, place) in enumerate(zip(chosen, sound, strict=True)):
            solution = Solution(
                done.rows[index, : done.written[index]],
                done.ends[index],
                done.switches[index],
                done.events[index],
                done.outcomes[index],
                int(done.steps[index]),
                int(done.rejected[index]),
            )
            start = Start(
                starts.states[place], starts.switches[place], float(starts.strokes[place]), starts.why[place]
            )
            rows[case.place] = self._row(
                run_of(case.drive, compiled, case.grid, start, solution, case.command, 0.0)
            )
        return rows

    def _controlled(self, drive: Drive) -> Row:
        """A sampled controller acts between the steps of one run, so these run one by one."""
        return self._row(simulate_controlled(drive, grid=_grid(drive)))

    def _row(self, run: Run) -> Row:
        figures, message = figures_of_run(run, self._paths)
        if run.outcome is not Outcome.COMPLETED:
            return Row(run.outcome.label, figures, run.outcome.advice())
        return Row(COMPLETED, figures, message)

    def _refused(self, error: InputError) -> Row:
        return Row(REFUSED, (float("nan"),) * len(self._paths), one_line(error))


def _case(place: int, drive: Drive) -> _Case:
    compiled = compiled_drive(drive.structure)
    times, inputs, command = segments_of(drive)
    return _Case(place, drive, compiled, parameters_of(drive, compiled), times, inputs, command, _grid(drive))


def _grid(drive: Drive) -> Array:
    return grid_of(duration=drive.duration, begin=0.0, end=drive.duration, points=_POINTS).time


def figures_named(paths: Sequence[str], known: dict[str, str]) -> tuple[Figure, ...]:
    """The figures with these paths.

    Args:
        paths: of a study.
        known: path -> SI unit of the figures of the subject.

    Raises:
        InputError: an unknown figure; names the nearest.
    """
    for path in paths:
        if path not in known:
            hint = did_you_mean(path, known) or f"e.g. {next(iter(known))}"
            raise InputError(f"the subject has no figure {path}", field="figures", hint=hint)
    return tuple(Figure(path, known[path]) for path in paths)


def figures_of_run(run: Run, paths: Sequence[str]) -> tuple[tuple[float, ...], str]:
    """Values of figures, NaN for one that does not exist, and why those do not exist."""
    trace = trace_of(run)
    table = timing_of(run.drive, trace)
    follows = tracking_of(run, trace) if any(path.startswith("tracking.") for path in paths) else None
    values: list[float] = []
    reasons: dict[str, None] = {}
    for path in paths:
        first, _, rest = path.partition(".")
        value: float | None = None
        if first == "timing":
            phase, _, name = rest.partition(".")
            value, why = getattr(getattr(table, phase), name), table.notes.get(rest, "")
        elif first == "tracking":
            why = TRACKING["rms"].exists_when.otherwise
            if follows is not None:
                value, why = getattr(follows, rest), follows.notes.get(rest, "")
        else:
            value, why = _picked(trace, first, rest), WATCHED[path].exists_when.otherwise
        if value is None:
            reasons[f"{path}: {why}"] = None
        values.append(float("nan") if value is None else float(value))
    return tuple(values), "; ".join(reasons)


def _picked(trace: Trace | None, pick: str, name: str) -> float | None:
    return None if trace is None else float(_PICKS[pick](getattr(trace, name)))
