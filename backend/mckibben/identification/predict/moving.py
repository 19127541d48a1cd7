"""Transient measurements: simulation of the whole drive, or of its motion under the measured pressure.

With a command channel, pressure and displacement (and force where measured) are predicted. Without one, the
measured pressure is the input, and displacement (and force where measured) is predicted. Several channels
are scaled by their noise.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import replace
from functools import cache
from typing import Self, TypeVar

import numpy as np

from mckibben.identification.predict.comparable_rows import records_of
from mckibben.identification.predict.fit_model import START_SPEED, START_STROKE, FitModel, Free
from mckibben.identification.predict.folds import FEWEST
from mckibben.identification.predict.moving_records import (
    MOST_DRIVING,
    MOST_ROWS,
    Record,
    middle_of,
    record_of,
    recorded_channels,
    stroke_of,
    thinned,
)
from mckibben.identification.predict.predictor import PredictedChannel, Predictor, StoppedRun
from mckibben.measurement.derivative import noise_of, rates
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.noise import noise_floor
from mckibben.measurement.settled import settled
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.model import Model
from mckibben.simulation.drive.many_runs import readings_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.recorded_run import RecordedRun
from mckibben.simulation.drive.records import motions_of_records
from mckibben.simulation.drive.windows import WholeRun, whole_motion, whole_run
from mckibben.simulation.integrate.engine import compiled_driven
from mckibben.simulation.statics.model import StaticModel

# Error per step of a motion under a measured pressure: below 0.1 um in all where something damps the motion,
# 26 um after 200 swings of a load that nothing damps.
_TOLERANCE = 1e-5
_FEWEST_ROWS = 3  # of a run
# How far a free start may lie from the first reading: share of the stroke, or deviations of its noise.
_START_OFF, _START_NOISE = 0.1, 6.0
_READINGS = {"pressure": "pressure_reading", "displacement": "stroke_reading", "force": "force_reading"}
# Derivatives by runs that take the same steps: relative step, fewest parameters, and the number of runs for
# derivatives of a structure after which its fits need them; so many segments of a command count as a run.
_STEP_TOGETHER, _FEWEST_TOGETHER, _MANY, _SEGMENTS = 1e-4, 3, 200.0, 50.0
_FEW = 400.0  # runs of a structure, counted likewise, up to which a quick compilation pays
_FEW_TRIED = (3, 24)  # models whose compilation takes as long as that of candidates without states, of all
# Slots of the air flow only; irrelevant when the pressure is measured.
_AIR = (
    "extra_volume", "heat", "leakage", "command_delay", "opening", "fill_conductance", "exhaust_conductance",
    "tube_conductance", "supply", "exhaust_sink",
)  # fmt: skip

_KEPT_NUMBERS = 1_000_000  # kept, 8 MB

Item = TypeVar("Item")
Result = TypeVar("Result")

_THREADS = 2  # cores of a small computer
_THREAD_NAMES = "records"


class TransientPredictor(Predictor):
    """Transient measurements of one drive.

    Args:
        measurement: of kind transient.
        drive: the drive as documented; load and supply pressure of the measurement take precedence.

    Raises:
        InputError: no predicted channel was measured.
    """

    simulated = True
    step = 2e-2

    def __init__(self, measurement: Measurement, drive: Drive) -> None:
        data = settled(measurement)
        measurement = data.measurement
        columns = measurement.columns
        self.kind = measurement.kind
        self.commanded = "command" in columns
        self._recorded = recorded_channels(measurement, drive, commanded=self.commanded)
        if not self._recorded:
            raise InputError(
                f"{measurement.name}: a transient without a command column needs a displacement",
                field="displacement",
                hint="add a displacement column, or a command column to simulate valve and pressure (the "
                "command of a drive document is not used instead)",
            )
        if "pressure" not in columns and not self.commanded:
            raise InputError(
                f"{measurement.name}: neither command nor pressure was measured",
                field="pressure",
                hint="add a command column, or a pressure column (the command of a drive document is not "
                "used instead)",
            )
        labels = records_of(measurement)
        runs = [np.flatnonzero((labels == label) & measurement.usable) for label in np.unique(labels)]
        self._records = [record_of(measurement, drive, rows) for rows in runs]
        if len(runs) > 1:
            self.number_runs(1)
        self._measurement, self._row_numbers = measurement, data.rows
        self.messages = (*measurement.messages, *([data.message] if data.message else []))
        if any(self._thinly_driven(rows) for rows in runs):
            self.messages += (
                f"the pressure of {MOST_DRIVING:,} rows of each run, evenly spread, drives the model".replace(
                    ",", " "
                ),
            )
        sweeps = [np.flatnonzero(labels == label) for label in np.unique(labels)]
        self._noise = []
        for name, _, values in self._recorded:
            full_scale = float(np.max(np.abs(values)))
            noise = noise_floor(values, sweeps) or 1e-3 * full_scale
            noise = float(np.hypot(noise, measurement.shared_noise.get(name, 0.0)))
            self._noise.append((max(noise, 1e-6 * full_scale), full_scale))
        self._arrange()
        self.excluded = dict(measurement.exclusions)
        if data.repeated:
            self.excluded["repeated rows"] = data.repeated
        if between := int(np.count_nonzero(measurement.usable)) - self.rows_used:
            self.excluded[f"in between ({MOST_ROWS} rows of each run are compared, evenly spread)"] = between
        self._wide: tuple[tuple[Effect, ...], ...] = ()
        self._spent: dict[tuple[Effect, ...], float] = {}
        self._tried: dict[tuple[int, frozenset[Effect]], int] = {}
        self._made: dict[DriveStructure, float] = {}
        self._kept = KeptRuns()
        self._next: tuple[list[FitModel], list[np.ndarray | None]] = [], []

    def _thinly_driven(self, rows: np.ndarray) -> bool:
        return not self.commanded and len(rows) > MOST_DRIVING

    def _arrange(self) -> None:
        """Set the stacked arrays to the rows of the records."""
        measurement, columns = self._measurement, self._measurement.columns
        rows = np.concatenate([record.rows for record in self._records])
        self.rows, self.rows_used = self._row_numbers[rows], len(rows)
        count, several = len(rows), len(self._recorded)
        self.channels = tuple(
            PredictedChannel(name, unit, slice(number * count, (number + 1) * count), *noise)
            for number, ((name, unit, _), noise) in enumerate(zip(self._recorded, self._noise, strict=True))
        )
        self.measured = np.concatenate([values[rows] for _, _, values in self._recorded])
        self.scale = np.repeat([noise if several > 1 else 1.0 for noise, _ in self._noise], count)
        per_record = [np.full(len(record.rows), n) for n, record in enumerate(self._records)]
        self.records = np.tile(np.concatenate(per_record), several) + np.repeat(
            len(self._records) * np.arange(several), count
        )
        self.groups = self.records
        self.row_numbers = np.tile(self.rows, several)
        self.sweeps = [np.flatnonzero(self.records == label) for label in np.unique(self.records)]
        self.folds = (_blocks(self._records, several),)
        time = np.concatenate([record.time for record in self._records])
        others = {name: columns[name][rows] for name in ("pressure", "command") if name in columns}
        stroke = stroke_of(measurement, self._records[0].drive)
        if stroke is not None:
            others |= {"displacement": stroke[rows], "velocity": -np.gradient(stroke, columns["time"])[rows]}
        self.inputs = {name: np.tile(v, several) for name, v in {"time": time, **others}.items()}

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The drive of each run: as documented, with the load, supply and command of the run."""
        return tuple(record.drive for record in self._records)

    def free_starts(self) -> tuple[Free, ...]:
        """As of the base class: within a tenth of the stroke, and up to the fastest measured speed."""
        if self.commanded or "displacement" not in {name for name, *_ in self._recorded}:
            return super().free_starts()
        stroke, time = stroke_of(self._measurement, self._records[0].drive), self._measurement.columns["time"]
        assert stroke is not None  # noqa: S101 - it is recorded
        found = []
        for record in self._records:
            own = stroke[record.rows]
            far = max(_START_OFF * float(np.ptp(own)), _START_NOISE * noise_of(own))
            moving = rates(time[record.rows], own).value
            fast = max(float(np.max(np.abs(moving), initial=0.0)), far / max(float(record.time[-1]), 1e-9))
            # A fit begins where the model begins (`free_numbers`): at 0, of which no change is a share.
            found += [
                Free(f"{name}{record.number}", float("nan"), -most, most, unit, off=0.0, usual=0.1 * most)
                for name, most, unit in ((START_STROKE, far, "m"), (START_SPEED, fast, "m/s"))
            ]
        return tuple(found)

    def number_runs(self, first: int) -> None:
        """Give the runs numbers from ``first`` on, unless they have some."""
        if not any(record.number for record in self._records):
            self._records = [
                replace(record, number=f"_{number}") for number, record in enumerate(self._records, first)
            ]

    @property
    def prepared_from(self) -> Measurement:
        """The measurement, which says what its preparation has done to noise."""
        return self._measurement

    @property
    def runs(self) -> int:
        """Number of uninterrupted records."""
        return len(self._records)

    def whole_run(self, fit_model: FitModel, number: int) -> tuple[WholeRun, dict[str, np.ndarray]]:
        """The run of a model on all rows of a record, and the readings there, SI.

        The readings are those of the predicted channels, the stroke from the middle of a pair on, and the
        pressure where it was measured.

        Raises:
            InputError: values that no drive can have.
        """
        record, columns = self._records[number], self._measurement.columns
        rows = np.arange(record.rows[0], record.rows[-1] + 1)
        rows = thinned(rows[self._measurement.usable[rows]], MOST_DRIVING)
        time = columns["time"][rows]
        grid = np.minimum(time - time[0], record.time[-1])
        drive = _drive_with(fit_model, record)
        readings = {name: values[rows] for name, _, values in self._recorded}
        if "displacement" in readings:
            readings["displacement"] = readings["displacement"] - middle_of(drive)
        if "pressure" in columns:
            readings["pressure"] = columns["pressure"][rows]
        if self.commanded:
            run = whole_run(drive, record.pieces(drive), grid=grid, max_steps=record.most_steps)
            return run, readings
        driving = _driving(drive, record)
        start = (record.begun_by([fit_model]).starts or ((0.0, 0.0),))[0]
        run = whole_motion(
            drive, time=driving[0], pressure=driving[1], stroke=record.stroke + start[0], speed=start[1],
            grid=grid, tolerance=_TOLERANCE, max_steps=record.most_steps,
        )  # fmt: skip
        return run, readings

    def elsewhere(self, measurement: Measurement) -> TransientPredictor:
        """The same drive and channels, with the noise of these data, for other runs.

        Args:
            measurement: set points of the runs; its predicted channels are placeholders.
        """
        other = TransientPredictor(measurement, self._records[0].drive)
        other.channels = tuple(
            replace(there, noise=here.noise, full_scale=here.full_scale)
            for there, here in zip(other.channels, self.channels, strict=True)
        )
        noises = [channel.noise if len(self.channels) > 1 else 1.0 for channel in self.channels]
        other.scale = np.repeat(noises, len(other.rows))
        return other

    def why_hidden(self, effect: Effect) -> str:
        """Checked by the kinds of the effect; effects on the air flow need a command channel."""
        if self.kind not in effect.kinds:
            return f"it does not show in {self.kind} data, only in {effect.shown_in}"
        forced = any(channel.name == "force" for channel in self.channels)
        if not forced and set(effect.slots) <= {"force_sensor", "skew"}:
            return "it acts on the force reading, and no force was measured"
        if not self.commanded and set(effect.slots) & set(_AIR):
            return "it acts on the flow of air; here the measured pressure is the input"
        if self.commanded and effect.between_sensor_and_muscle:
            return "it acts between a pressure sensor and the muscle; here the drive fills the muscle"
        drive = self._records[0].drive
        if effect.of_tube and drive.tube is None and drive.assumed_tube is None:
            return "it acts on the tube, and the drive states that there is none"
        return ""

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> TransientPredictor:
        """With two models for quick trials, of the candidates without states and of all that can be off.

        Without the states of other effects a run is quicker, and takes the steps that the fitted model takes:
        an effect that changes nothing then shows no change, not one of the size of the integration error.
        """
        inside = {effect.id for effect in fit_model.effects}
        # An energy balance instead of a polytrope changes the equations even without heat flow.
        # So does a tube that the drive does not state.
        tubeless = self._records[0].drive.tube is None
        other = {"heat", "tube_conductance"} if tubeless else {"heat"}
        further = [e for e in candidates if e.id not in inside and not other & set(e.slots) and not _fast(e)]
        ready = self.beginning(fit_model)
        ready.quick = plain = tuple(effect for effect in further if not effect.states)
        ready._wide = tuple(Model((*fit_model.effects, *added)).effects for added in (plain, further))
        return ready

    def trial(self, fit_model: FitModel) -> np.ndarray:
        """As `predict`, with a compiled model of all candidates if there is one that contains this model."""
        return self.predict(self._widened(fit_model))

    def try_ahead(self, fit_models: Iterable[FitModel]) -> None:
        """As of the base class."""
        fit_models = list(fit_models)
        for fit_model in fit_models:
            kind = self._kind(fit_model)
            self._tried[kind] = self._tried.get(kind, 0) + 1
        self.predictions([self._widened(fit_model) for fit_model in fit_models])

    def _kind(self, fit_model: FitModel) -> tuple[int, frozenset[Effect]]:
        """Which of the two contains a model, and the effects that are in neither."""
        effects = frozenset(fit_model.effects)
        further = effects.difference(*self._wide)
        return next((n for n, wide in enumerate(self._wide) if effects - further <= set(wide)), 0), further

    def _widened(self, fit_model: FitModel) -> FitModel:
        """The model with candidates that are off, where so many are tried that compiling them pays."""
        number, further = kind = self._kind(fit_model)
        if not self._wide or (further and self._tried.get(kind, 0) <= _FEW_TRIED[number]):
            return fit_model
        effects = Model((*self._wide[number], *further)).effects
        values = {effect.id: fit_model.values.get(effect.id, effect.off) for effect in effects}
        return replace(fit_model, effects=effects, values=values)

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        """The channels of all records, stacked; NaN after a run has stopped early."""
        del clipped  # a slack muscle reads no force in either case
        return self.predictions([fit_model])[0]

    def predictions(self, fit_models: Sequence[FitModel]) -> list[np.ndarray]:
        """`predict` of several models; those with the same effects run side by side."""
        return self._kept.of(fit_models, self._new_predictions)

    def _new_predictions(self, fit_models: Sequence[FitModel]) -> list[np.ndarray]:
        alike: dict[frozenset[Effect], list[int]] = {}
        for index, fit_model in enumerate(fit_models):
            alike.setdefault(frozenset(fit_model.effects), []).append(index)
        found: dict[int, np.ndarray] = {}
        for group in alike.values():
            of_records = self._of_records([fit_models[index] for index in group])
            for index, readings in zip(group, zip(*of_records, strict=True), strict=True):
                found[index] = self._stacked(readings)
        return [found[index] for index in range(len(fit_models))]

    def _of_records(self, models: Sequence[FitModel]) -> list[Sequence[RecordedRun]]:
        """Of each record the runs of models with the same effects."""
        drives = [[_drive_with(model, record) for model in models] for record in self._records]
        records = [record.begun_by(models) for record in self._records]
        # Counted here, so that it does not depend on which thread is first.
        few = [self.commanded and self._few(*each) for each in zip(drives, records, strict=True)]
        runs = list(zip(drives, records, few, strict=True))
        return side_by_side(lambda run: self._runs(*run), runs)

    def within_fit(self, fit_model: FitModel, free: Sequence[Free]) -> np.ndarray:
        """As of the base class: the lanes beside the run make those that the derivatives need."""
        if not (self.commanded and self._needs_smooth(fit_model, len(free))):
            moved = self.moved(fit_model, free, self.step)
            return self.predictions([fit_model, *(model for _, model in moved)])[0]
        if fit_model not in self._kept:
            moved = self.moved(fit_model, free, _STEP_TOGETHER)
            models = [fit_model, *(model for _, model in moved)]
            self._next = models, self._side_by_side(models)
            if (here := self._next[1][0]) is not None:
                self._kept.keep(fit_model, here)
        return self.predict(fit_model)

    def stopped(self, fit_model: FitModel) -> tuple[StoppedRun, ...]:
        """The runs that end before the last rows of their records, and why."""
        if np.all(np.isfinite(self.predict(fit_model))):
            return ()
        found = []
        several = len(self._records) > 1
        runs = [of_record[0] for of_record in self._of_records([fit_model])]
        for number, (record, run, count) in enumerate(
            zip(self._records, runs, self._reached(fit_model), strict=True), 1
        ):
            if count == len(record.rows):
                continue
            found.append(
                StoppedRun(
                    of="",
                    run=number if several else 0,
                    reached=float(record.time[count - 1]) if count else float("nan"),
                    duration=float(record.time[-1]),
                    share=1.0 - count / len(record.rows),
                    reason=run.stop or "it has no finite value there",
                )
            )
        return tuple(found)

    def reached(self, fit_model: FitModel) -> TransientPredictor:
        """As of the base class; a run that reaches less than three rows is left out."""
        counts = self._reached(fit_model)
        wholes = [len(record.rows) for record in self._records]
        if counts == wholes:
            return self
        left = [count if count >= _FEWEST_ROWS else 0 for count in counts]
        if not any(left):
            raise InputError(
                f"{self._measurement.name}: {self.stopped(fit_model)[0].event}",
                field="effects",
                hint="without three rows of a run nothing can be compared",
            )
        inside = [np.arange(whole) < count for whole, count in zip(wholes, left, strict=True)]
        kept = np.tile(np.concatenate(inside), len(self._recorded))
        other = self._with_records([
            record.until(count) for record, count in zip(self._records, left, strict=True) if count
        ])  # fmt: skip
        other._arrange()
        other.reading_errors = tuple(replace(error, rows=error.rows[kept]) for error in self.reading_errors)
        lost = int(np.count_nonzero(~kept)) // len(self._recorded)
        other.excluded = {**self.excluded, "after the run of the model stopped": lost}
        other._kept.keep(fit_model, self.predict(fit_model)[kept])
        return other

    def _reached(self, fit_model: FitModel) -> list[int]:
        """Of each record the number of rows up to the first one without a finite prediction."""
        finite = np.isfinite(self.predict(fit_model)).reshape(len(self._recorded), -1).all(axis=0)
        ends = np.cumsum([len(record.rows) for record in self._records])[:-1]
        return [int(np.argmin([*part, False])) for part in np.split(finite, ends)]

    def beginning(self, fit_model: FitModel) -> TransientPredictor:
        """As of the base class."""
        runs = [of_record[0] for of_record in self._of_records([fit_model])]
        records = [record.beginning(run.steps) for record, run in zip(self._records, runs, strict=True)]
        other = self._with_records(records)
        other._kept.keep(fit_model, self._stacked(runs))
        return other

    def _with_records(self, records: list[Record]) -> TransientPredictor:
        """This predictor with other records, whose runs are not known yet."""
        other = copy(self)
        other._records, other._kept, other._next = records, KeptRuns(), ([], [])
        return other

    def _stacked(self, runs: Sequence[RecordedRun]) -> np.ndarray:
        """The channels of the readings of all records; NaN where there are none."""
        parts: list[list[np.ndarray]] = [[] for _ in self.channels]
        for record, run in zip(self._records, runs, strict=True):
            for part, channel in zip(parts, self.channels, strict=True):
                values = run.readings.get(_READINGS[channel.name], np.empty(0))
                if channel.name == "displacement":  # a pair's stroke counts from its middle
                    values = values + middle_of(record.drive)
                lost = np.full(len(record.rows) - len(values), np.nan)
                part.append(np.concatenate([values, lost]))
        return np.concatenate([np.concatenate(part) for part in parts])

    def differences(
        self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None
    ) -> np.ndarray:
        """As `Predictor.differences`; after many runs of a structure, all runs take the same steps.

        That gives smooth differences from much smaller changes.
        """
        if here is None or not self.commanded or not self._many_runs(fit_model, len(free)):
            return super().differences(fit_model, free, here)
        moved = self.moved(fit_model, free, _STEP_TOGETHER)
        models = [fit_model, *(model for _, model in moved)]
        first, *others = self._next[1] if self._next[0] == models else self._side_by_side(models)
        # What runs another course takes a run of its own.
        lost = [p for p, found in zip(free, others, strict=True) if first is None or found is None]
        alone = iter(super().differences(fit_model, lost, here).T)
        columns = [
            next(alone) if first is None or found is None else (found - first) / size
            for found, (size, _) in zip(others, moved, strict=True)
        ]
        return np.column_stack(columns)

    def _many_runs(self, fit_model: FitModel, count: int) -> bool:
        """Whether derivatives need runs that take the same steps; counts these runs."""
        if count < _FEWEST_TOGETHER:
            return False
        smooth = self._needs_smooth(fit_model, count)
        self._spent[fit_model.effects] = self._spent_with(fit_model, count)
        return smooth

    def _needs_smooth(self, fit_model: FitModel, count: int) -> bool:
        return count >= _FEWEST_TOGETHER and self._spent_with(fit_model, count) > _MANY

    def _spent_with(self, fit_model: FitModel, count: int) -> float:
        segments = sum(record.segments for record in self._records)
        return self._spent.get(fit_model.effects, 0.0) + count * (len(self._records) + segments / _SEGMENTS)

    def _side_by_side(self, models: Sequence[FitModel]) -> list[np.ndarray | None]:
        """`predict` of models that differ little from the first; None for one that runs another course."""
        drives = [[_drive_with(model, record) for model in models] for record in self._records]
        few = [self._few(*each) for each in zip(drives, self._records, strict=True)]

        runs = list(zip(drives, self._records, few, strict=True))
        of_records = side_by_side(lambda run: _readings(*run, together=True), runs)
        return [
            self._stacked(runs) if all(run.readings for run in runs) else None
            for runs in zip(*of_records, strict=True)
        ]

    def _runs(self, drives: Sequence[Drive], record: Record, few: bool) -> Sequence[RecordedRun]:
        """Readings of drives with the same effects; none where the values of a fit are those of no drive."""
        if not self.commanded:
            return self._motions(drives, record)
        try:
            return _readings(drives, record, few)
        except InputError as error:
            return [RecordedRun({}, stop=error.message) for _ in drives]

    def _few(self, drives: Sequence[Drive], record: Record) -> bool:
        """Whether few runs of a structure have been made; counts these."""
        structure, weight = drives[0].structure, 1.0 + record.segments / _SEGMENTS
        made = self._made[structure] = self._made.get(structure, 0.0) + len(drives) * weight
        return made <= _FEW

    @staticmethod
    def _motions(drives: Sequence[Drive], record: Record) -> list[RecordedRun]:
        """Runs of drives under the measured pressure; without readings where no drive can have the values."""
        try:
            time, pressure = _driving(drives[0], record)
            return motions_of_records(
                drives,
                time=time,
                pressure=pressure,
                stroke=record.stroke,
                starts=record.starts,
                tolerance=_TOLERANCE,
                grid=record.time,
                max_steps=record.most_steps,
            )
        except InputError as error:  # values of the fit that no drive can have
            return [RecordedRun({}, stop=error.message) for _ in drives]


def _driving(drive: Drive, record: Record) -> tuple[np.ndarray, np.ndarray]:
    """Times and pressures that drive the motion of a load under a measured pressure."""
    assert record.driving is not None  # noqa: S101 - checked by the constructor
    sticks = compiled_driven(drive.model.effects, True).slides.any()
    return record.smooth_driving if sticks else record.driving


def _readings(
    drives: Sequence[Drive], record: Record, few: bool, *, together: bool = False
) -> list[RecordedRun]:
    """Runs of commanded drives with the same effects, see `readings_of_many`."""
    return readings_of_many(
        drives,
        [record.pieces(drive) for drive in drives],
        grid=record.time,
        together=together,
        few=few,
        max_steps=record.most_steps,
    )


def _drive_with(fit_model: FitModel, record: Record) -> Drive:
    """The drive of a record with the model's muscle, effects and supply."""
    model = StaticModel.of(fit_model.muscle, Model(fit_model.effects).effects, fit_model.values)
    supply = fit_model.supply_factor * record.drive.supply_pressure
    return replace(record.drive, model=model, supply_pressure=supply)


def _fast(effect: Effect) -> bool:
    """Whether a state of the drive becomes infinitely fast when the effect is off."""
    return "drive_rates" in effect.slots


def _blocks(records: Sequence[Record], channels: int) -> np.ndarray:
    """Contiguous blocks of time as folds, at least six; a fold contains all channels of its block."""
    blocks = max(2, -(-FEWEST // len(records)))
    labels = [
        number * blocks + np.arange(len(record.rows)) * blocks // len(record.rows)
        for number, record in enumerate(records)
    ]
    return np.tile(np.concatenate(labels), channels)


class KeptRuns:
    """The predictions of the models that were asked for last.

    A search asks for many of them twice: of a fit where it ended, of its derivatives where it goes on.
    """

    def __init__(self) -> None:
        self._known: dict[Hashable, np.ndarray] = {}

    def __reduce__(self) -> tuple[type[Self], tuple[()]]:
        """Copies in other processes begin empty."""
        return type(self), ()

    def of(
        self, fit_models: Sequence[FitModel], run: Callable[[list[FitModel]], Sequence[np.ndarray]]
    ) -> list[np.ndarray]:
        """The prediction of each model; ``run`` is called once with those that are not known."""
        keys = [_key(fit_model) for fit_model in fit_models]
        missing = {key: model for key, model in zip(keys, fit_models, strict=True) if key not in self._known}
        for key in keys:  # what is asked for again stays longest
            if key not in missing:
                self._known[key] = self._known.pop(key)
        new = dict(zip(missing, run(list(missing.values())), strict=True)) if missing else {}
        found = [new[key] if key in new else self._known[key] for key in keys]
        for key, prediction in new.items():
            self._keep(key, prediction, least=len(new))
        return found

    def __contains__(self, fit_model: FitModel) -> bool:
        return _key(fit_model) in self._known

    def keep(self, fit_model: FitModel, prediction: np.ndarray) -> None:
        """Keep a prediction that was found otherwise."""
        self._keep(_key(fit_model), prediction)

    def _keep(self, key: Hashable, prediction: np.ndarray, *, least: int = 1) -> None:
        self._known[key] = prediction
        while len(self._known) > max(_KEPT_NUMBERS // max(len(prediction), 1), least):
            del self._known[next(iter(self._known))]


def _key(fit_model: FitModel) -> Hashable:
    """All that a run depends on."""
    values = frozenset((effect, *fit_model.values[effect.id].items()) for effect in fit_model.effects)
    return fit_model.muscle, fit_model.supply_factor, values, frozenset(fit_model.starts.items())


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(_THREADS, _THREAD_NAMES)


def side_by_side(function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """Results of a function of items in two threads, in their order.

    A single item is done in this thread, and so are items of items, which would wait for each other.

    Args:
        function: must release the interpreter lock for most of its time, else two threads gain nothing. Its
            result must not depend on which item is done first.
    """
    if len(items) < 2 or threading.current_thread().name.startswith(_THREAD_NAMES):
        return [function(item) for item in items]
    return list(_pool().map(function, items))
