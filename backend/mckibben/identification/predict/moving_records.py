"""The runs of a transient measurement: the drive of each as documented, its times and what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mckibben.identification.predict.fit_model import START_SPEED, START_STROKE, FitModel
from mckibben.identification.predict.input_noise import without_input_noise
from mckibben.measurement.derivative import noise_of
from mckibben.measurement.kind import weights_of_runs
from mckibben.measurement.measurement import STROKES, Measurement, lengths
from mckibben.measurement.reading.conditions import COMMAND_BEFORE
from mckibben.physics.errors import InputError
from mckibben.physics.units import GRAVITY
from mckibben.simulation.command.signals import TableSignal
from mckibben.simulation.drive.joint_path import refuse_path
from mckibben.simulation.drive.many_runs import Pieces
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times, segments_after
from mckibben.simulation.outcome import MAX_STEPS

#: Most rows of a run that are compared; more are thinned evenly.
MOST_ROWS = 1000
#: Most rows of a run whose pressure drives the model; more are thinned evenly.
MOST_DRIVING = 100_000
_STEPS_EACH = 4  # most steps of a run for each segment of its input, where that is more than `MAX_STEPS`
# Most steps of a run of a fit over those of the run that the fit begins with, and at least: trial values may
# be those of a drive that rings faster than any muscle, whose run would cost more than all others.
_STEPS_OVER, _STEPS_AT_LEAST = 10, 50_000
_PIECES = 8  # kept; only dead times change them
_FEW_LEVELS = 0.2  # share of rows at which the command changes, up to which it is held between changes
_FIRST_ROWS = 50  # most rows for the start pressure
_RESTING = 0.02  # share of the rows of a run for which a load rests at its lowest, at least
_STRETCHED = 2e-3  # share of the rest length; less is a zero error of the sensor
_PASSED = 5e-3  # of contraction; a record that goes further beyond a stop shows that none is there
_OUT_OF_WAY = 0.4  # contraction of a stop that is not reached
_ROOM = 1.1  # the same, over what was seen
_NOT_VENTED = 30e3  # Pa from the documented start pressure; less may be a zero error of the gauge


@dataclass(frozen=True, kw_only=True, eq=False)
class Recorded(TableSignal):
    """A measured command; if the first row is not 0, the command is switched on at that row.

    Attributes:
        stated_before: command before the first row as the file states it; None = it does not.
    """

    shape = "recorded"
    stated_before: float | None = None

    @property
    def before(self) -> float:
        """Command before the first row: 0 if the first row fills, because the muscle was at rest."""
        return min(float(self.values[0]), 0.0) if self.stated_before is None else self.stated_before


@dataclass(frozen=True)
class Record:
    """One uninterrupted run.

    Attributes:
        drive: as documented.
        time: of the compared rows, from 0 [s].
        driving: times and readings of the pressure that drives the model, of all rows; None where a command
            does.
        stroke: of the drive at the first row [m].
        rows: the compared rows of the measurement.
        most_steps: accepted and rejected steps after which a run of the model stops.
        number: what the names of its start end with, "_2"; "" of the only run.
        starts: of runs that begin elsewhere than at rest at the first reading, of each how far beyond it [m],
            and how fast [m/s]; None where all do.
    """

    drive: Drive
    time: np.ndarray
    driving: tuple[np.ndarray, np.ndarray] | None
    stroke: float
    rows: np.ndarray
    most_steps: int
    number: str = ""
    starts: tuple[tuple[float, float], ...] | None = None
    _pieces: dict[tuple[float, float], Pieces] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def pieces(self, drive: Drive) -> Pieces:
        """Segments of the command and inputs of a drive that differs in model and supply from this one's."""
        delays = dead_times(drive)
        if delays not in self._pieces:
            if len(self._pieces) >= _PIECES:
                del self._pieces[next(iter(self._pieces))]
            self._pieces[delays] = segments_after(drive, delays)[:2]
        return self._pieces[delays]

    @cached_property
    def smooth_driving(self) -> tuple[np.ndarray, np.ndarray]:
        """``driving`` without the noise of its sensor, which would break a load away that friction holds."""
        assert self.driving is not None  # noqa: S101 - of a measured pressure
        time, pressure = self.driving
        return time, without_input_noise(time, pressure)

    def begun_by(self, models: Sequence[FitModel]) -> Record:
        """The run with the starts that these models give it."""
        if not any(model.starts for model in models):
            return self
        names = f"{START_STROKE}{self.number}", f"{START_SPEED}{self.number}"
        starts = tuple((model.number(names[0]), model.number(names[1])) for model in models)
        return replace(self, starts=starts)

    def until(self, count: int) -> Record:
        """The first rows of the run."""
        time, driving = self.time[:count], self.driving
        if driving is not None:
            last = int(np.searchsorted(driving[0], time[-1])) + 1
            driving = driving[0][:last], driving[1][:last]
        return replace(self, time=time, rows=self.rows[:count], driving=driving)

    def beginning(self, steps: int) -> Record:
        """The run for fits that begin with a run of so many steps."""
        most = max(_STEPS_AT_LEAST, _STEPS_OVER * steps)
        return replace(self, most_steps=min(most, self.most_steps))

    @cached_property
    def segments(self) -> int:
        """Pieces of the command, at each of which the integration starts afresh."""
        return len(self.drive.command.segments(self.drive.duration).slopes)


def stroke_of(measurement: Measurement, drive: Drive) -> np.ndarray | None:
    """Contraction stroke of each row [m]; None where no length was measured."""
    if not any(name in measurement.columns for name in STROKES):
        return None
    if "displacement" in measurement.columns:
        return measurement.columns["displacement"]
    return drive.muscle.nominal_length - lengths(measurement, drive.muscle.nominal_length)


def middle_of(drive: Drive) -> float:
    """Contraction stroke where the stroke of the drive is 0 [m]: of a pair in its middle position."""
    return drive.precontraction * drive.muscle.nominal_length


def lowest_stop(measurement: Measurement, rest_length: float) -> float:
    """Contraction at which a load without stated stops rests at its lowest: 0, or where it was seen below.

    A load that hangs on a muscle without air stretches it, or was set to zero with another one.

    Args:
        measurement: of a transient.
        rest_length: of the muscle [m].
    """
    if not any(name in measurement.columns for name in STROKES):
        return 0.0
    length = lengths(measurement, rest_length)[measurement.usable]
    if not len(length):
        return 0.0
    longest = float(np.quantile(length, 1.0 - _RESTING))
    beyond = longest - rest_length
    if beyond < max(_STRETCHED * rest_length, 5.0 * noise_of(length)):
        return 0.0
    return -beyond / rest_length


def highest_stop(measurement: Measurement | None, rest_length: float, stop: float | None) -> float:
    """Contraction of the upper stop: ``stop``, or one that is not reached where the record passes it.

    A stop is no obstacle where the muscle was seen beyond it, whoever stated it: simulated, it would hold
    back what was measured, and effects would be invented for it.

    Args:
        measurement: of a transient, if it is known.
        rest_length: of the muscle [m].
        stop: stated, or the limit of the maker; None = none.
    """
    free = _OUT_OF_WAY
    if measurement is not None and any(name in measurement.columns for name in STROKES):
        length = lengths(measurement, rest_length)[measurement.usable]
        if len(length):
            seen = 1.0 - float(np.quantile(length, _RESTING)) / rest_length
            free = max(free, _ROOM * seen)
            if stop is not None and seen - stop > max(_PASSED, 5.0 * noise_of(length) / rest_length):
                return free
    return free if stop is None else stop


def hung_weights(measurement: Measurement) -> np.ndarray | None:
    """Weight of the load of each row [N], where the file states one for each run; None = it does not."""
    if {"load_mass", "load_force"} & set(measurement.conditions):
        return None
    return weights_of_runs(measurement.columns)


def recorded_channels(
    measurement: Measurement, drive: Drive, *, commanded: bool
) -> list[tuple[str, str, np.ndarray]]:
    """Name, SI unit and readings of each channel that a run predicts."""
    columns = measurement.columns
    channels = []
    if commanded and "pressure" in columns:
        channels.append(("pressure", "Pa", columns["pressure"]))
    stroke = stroke_of(measurement, drive)
    if stroke is not None:
        channels.append(("displacement", "m", stroke))
    weighed = hung_weights(measurement) is not None  # stated, no reading
    if "force" in columns and not weighed and (commanded or stroke is not None):
        channels.append(("force", "N", columns["force"]))
    return channels


def record_of(measurement: Measurement, drive: Drive, rows: np.ndarray) -> Record:
    """The run of some rows.

    Raises:
        InputError: it is too short.
    """
    columns, conditions = measurement.columns, measurement.conditions
    refuse_path(drive.path, f"{measurement.name}: a comparison over time")
    if drive.stiffness is not None:
        raise InputError(
            f"{measurement.name}: a joint whose stiffness is controlled is not compared: its two commands "
            "differ, and a measurement holds one",
            field="controller.stiffness",
            hint="compare a run of the joint with a command, or leave the stiffness out of the drive",
        )
    if len(rows) < 3:
        raise InputError(f"{measurement.name}: a run of {len(rows)} rows is too short", field="time")
    whole, rows = rows, thinned(rows, MOST_ROWS)
    time = columns["time"][rows] - columns["time"][rows[0]]
    load = drive.load
    if "load_mass" in conditions:
        load = replace(load, mass=float(conditions["load_mass"]))
    if "load_force" in conditions:
        load = replace(load, force=float(conditions["load_force"]))
    if (weights := hung_weights(measurement)) is not None:
        load = replace(load, mass=float(weights[rows[0]]) / GRAVITY)
    changed: dict = {"duration": float(time[-1]), "load": load, "controller": None, "reference": None}
    if "supply_pressure" in conditions:
        changed["supply_pressure"] = float(conditions["supply_pressure"])
    if "command" in columns:
        before = conditions.get(COMMAND_BEFORE)
        changed["command"] = _command(columns["time"], columns["command"], rows, before)
    driving = None
    if "command" not in columns:
        whole = thinned(whole, MOST_DRIVING)
        driving = columns["time"][whole] - columns["time"][whole[0]], columns["pressure"][whole]
    elif "pressure" in columns:
        pressure = columns["pressure"][rows]
        changed["start_pressure"] = _start_pressure(drive, pressure, columns["command"][rows])
    stroke = stroke_of(measurement, drive)
    own = replace(drive, **changed)
    segments = len(own.command.segments(own.duration).slopes) if driving is None else len(driving[0])
    return Record(
        drive=own,
        time=time,
        driving=driving,
        stroke=0.0 if stroke is None else float(stroke[rows[0]]) - middle_of(drive),
        rows=rows,
        most_steps=max(MAX_STEPS, _STEPS_EACH * segments),
    )


def thinned(rows: np.ndarray, most: int) -> np.ndarray:
    """At most so many of the rows, evenly spread, with the first and the last one."""
    return rows if len(rows) <= most else rows[np.unique(np.linspace(0, len(rows) - 1, most).astype(int))]


def _start_pressure(drive: Drive, pressure: np.ndarray, command: np.ndarray) -> float:
    """Measured pressure before the valve first moves if clearly not the documented one, else that [Pa]."""
    closed = command[0] == 0.0
    resting = int(np.argmax(command != 0.0)) or len(command) if closed else 1
    measured = float(np.median(pressure[: min(resting, _FIRST_ROWS)]))
    return measured if abs(measured - drive.start_pressure) > _NOT_VENTED else drive.start_pressure


def _command(time: np.ndarray, command: np.ndarray, rows: np.ndarray, before: float | str | None) -> Recorded:
    """The measured command: held between changes if they are few, else interpolated linearly."""
    # Of a later run of the file it is that of the row before.
    stated = None if before is None else float(before) if rows[0] == 0 else float(command[rows[0] - 1])
    part = slice(rows[0], rows[-1] + 1)
    t, u = time[part] - time[part.start], command[part]
    changes = np.flatnonzero(np.diff(u) != 0.0) + 1
    if len(changes) > _FEW_LEVELS * len(u):
        return Recorded(times=t, values=u, interpolation="linear", stated_before=stated)
    kept = np.concatenate([[0], changes])
    return Recorded(times=t[kept], values=u[kept], interpolation="hold", stated_before=stated)
