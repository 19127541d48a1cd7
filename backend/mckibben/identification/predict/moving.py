"""Transient measurements: simulation of the whole drive, or of its motion under the measured pressure.

With a command channel, pressure and displacement (and force where measured) are predicted. Without one, the
measured pressure is the input, and displacement (and force where measured) is predicted. Several channels
are scaled by their noise.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import records_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.folds import FEWEST
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.kept_runs import KeptRuns
from mckibben.identification.predict.moving_records import (
    MOST_ROWS,
    Record,
    record_of,
    recorded_channels,
    stroke_of,
)
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.predict.side_by_side import side_by_side
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.noise import noise_floor
from mckibben.measurement.settled import settled
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.model import Model
from mckibben.simulation.drive.driven import driven_motions
from mckibben.simulation.drive.many_runs import readings_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import StaticModel

# Error per step of a motion under a measured pressure: below 0.1 um in all where something damps the motion,
# 26 um after 200 swings of a load that nothing damps.
_TOLERANCE = 1e-5
# Most steps of a run for each row and segment, and at least: trial values may be those of a drive that rings
# faster than any muscle, whose run would cost more than all others of a fit.
_STEPS_EACH, _STEPS_AT_LEAST = 20, 20_000
_LOST = 1e3  # residual after a run has stopped early, over the noise
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
        recorded = recorded_channels(measurement, drive, commanded=self.commanded)
        if not recorded:
            raise InputError(
                f"{measurement.name}: a transient without a command column needs a displacement",
                field="displacement",
                hint="add a displacement column, or a command column to simulate valve and pressure (the "
                "command of a drive document is not used instead)",
            )
        labels = records_of(measurement)
        self._records = [
            record_of(measurement, drive, np.flatnonzero((labels == label) & measurement.usable))
            for label in np.unique(labels)
        ]
        if "pressure" not in columns and not self.commanded:
            raise InputError(
                f"{measurement.name}: neither command nor pressure was measured",
                field="pressure",
                hint="add a command column, or a pressure column (the command of a drive document is not "
                "used instead)",
            )
        rows = np.concatenate([record.rows for record in self._records])
        self.rows, count = data.rows[rows], len(rows)
        channels: list[PredictedChannel] = []
        self.rows_used, self.messages = (
            count,
            (*measurement.messages, *([data.message] if data.message else [])),
        )
        self.excluded = dict(measurement.exclusions)
        if data.repeated:
            self.excluded["repeated rows"] = data.repeated
        if between := int(np.count_nonzero(measurement.usable)) - count:
            self.excluded[f"in between ({MOST_ROWS} rows of each run are compared, evenly spread)"] = between
        for number, (name, unit, values) in enumerate(recorded):
            sweeps = [np.flatnonzero(labels == label) for label in np.unique(labels)]
            full_scale = float(np.max(np.abs(values)))
            noise = noise_floor(values, sweeps) or 1e-3 * full_scale
            place = slice(number * count, (number + 1) * count)
            channels.append(PredictedChannel(name, unit, place, max(noise, 1e-6 * full_scale), full_scale))
        self.channels = tuple(channels)
        self.measured = np.concatenate([values[rows] for _, _, values in recorded])
        several = len(recorded) > 1
        self.scale = np.concatenate(
            [np.full(count, channel.noise if several else 1.0) for channel in self.channels]
        )
        per_record = [np.full(len(record.rows), n) for n, record in enumerate(self._records)]
        self.records = np.tile(np.concatenate(per_record), len(recorded)) + np.repeat(
            len(self._records) * np.arange(len(recorded)), count
        )
        self.groups = self.records
        self.sweeps = [np.flatnonzero(self.records == label) for label in np.unique(self.records)]
        self.folds = (_blocks(self._records, len(recorded)),)
        time = np.concatenate([record.time for record in self._records])
        others = {name: columns[name][rows] for name in ("pressure", "command") if name in columns}
        stroke = stroke_of(measurement, drive)
        if stroke is not None:
            others |= {"displacement": stroke[rows], "velocity": -np.gradient(stroke, columns["time"])[rows]}
        self.inputs = {name: np.tile(v, len(recorded)) for name, v in {"time": time, **others}.items()}
        self._wide: tuple[tuple[Effect, ...], ...] = ()
        self._spent: dict[tuple[Effect, ...], float] = {}
        self._tried: dict[tuple[int, frozenset[Effect]], int] = {}
        self._made: dict[DriveStructure, float] = {}
        self._kept = KeptRuns()
        self._next: tuple[list[FitModel], list[np.ndarray | None]] = [], []

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The drive of each run: as documented, with the load, supply and command of the run."""
        return tuple(record.drive for record in self._records)

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
        ready = copy(self)
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
        """The channels of all records, stacked; far from the measurement after a run has stopped early."""
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

    def _of_records(self, models: Sequence[FitModel]) -> list[Sequence[Mapping[str, np.ndarray]]]:
        """Of each record the readings of models with the same effects."""
        drives = [[_drive_with(model, record) for model in models] for record in self._records]
        # Counted here, so that it does not depend on which thread is first.
        few = [self.commanded and self._few(*each) for each in zip(drives, self._records, strict=True)]
        runs = list(zip(drives, self._records, few, strict=True))
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

    def _stacked(self, readings: Sequence[Mapping[str, np.ndarray]]) -> np.ndarray:
        """The channels of the readings of all records; far from the measurement where there are none."""
        parts: list[list[np.ndarray]] = [[] for _ in self.channels]
        for record, of_record in zip(self._records, readings, strict=True):
            for part, channel in zip(parts, self.channels, strict=True):
                values = of_record.get(channel.name, np.empty(0))
                lost = np.full(len(record.rows) - len(values), np.nan)
                part.append(np.concatenate([values, lost]))
        predicted = np.concatenate([np.concatenate(part) for part in parts])
        return np.where(np.isfinite(predicted), predicted, self.measured + _LOST * self._noises())

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
            self._stacked(readings) if all(readings) else None for readings in zip(*of_records, strict=True)
        ]

    def _noises(self) -> np.ndarray:
        return np.repeat([channel.noise for channel in self.channels], len(self.rows))

    def _runs(self, drives: Sequence[Drive], record: Record, few: bool) -> Sequence[Mapping[str, np.ndarray]]:
        """Readings of drives with the same effects; none where the values of a fit are those of no drive."""
        if not self.commanded:
            return self._motions(drives, record)
        try:
            return _readings(drives, record, few)
        except InputError:
            return [{} for _ in drives]

    def _few(self, drives: Sequence[Drive], record: Record) -> bool:
        """Whether few runs of a structure have been made; counts these."""
        structure, weight = drives[0].structure, 1.0 + record.segments / _SEGMENTS
        made = self._made[structure] = self._made.get(structure, 0.0) + len(drives) * weight
        return made <= _FEW

    @staticmethod
    def _motions(drives: Sequence[Drive], record: Record) -> list[dict[str, np.ndarray]]:
        """Readings of drives under the measured pressure; none of one that does not follow it."""
        assert record.pressure is not None  # noqa: S101 - checked by the constructor
        try:
            runs = driven_motions(
                drives,
                time=record.time,
                pressure=record.pressure,
                stroke=record.stroke,
                tolerance=_TOLERANCE,
                max_steps=_most_steps(len(record.time)),
            )
        except InputError:  # values of the fit that no drive can have
            return [{} for _ in drives]
        return [{} if isinstance(run, InputError) else _named(run) for run in runs]


def _readings(
    drives: Sequence[Drive], record: Record, few: bool, *, together: bool = False
) -> list[dict[str, np.ndarray]]:
    """Readings of commanded drives with the same effects, see `readings_of_many`."""
    pieces = [record.pieces(drive) for drive in drives]
    most = _most_steps(len(record.time) + len(pieces[0][1]))
    runs = readings_of_many(drives, pieces, grid=record.time, together=together, few=few, max_steps=most)
    return [_named(run) for run in runs]


def _named(outputs: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The readings by the names of their channels."""
    return {name: outputs[output] for name, output in _READINGS.items() if output in outputs}


def _drive_with(fit_model: FitModel, record: Record) -> Drive:
    """The drive of a record with the model's muscle, effects and supply."""
    model = StaticModel.of(fit_model.muscle, Model(fit_model.effects).effects, fit_model.values)
    supply = fit_model.supply_factor * record.drive.supply_pressure
    return replace(record.drive, model=model, supply_pressure=supply)


def _most_steps(pieces: int) -> int:
    return max(_STEPS_AT_LEAST, _STEPS_EACH * pieces)


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
