"""Transient measurements: simulation of the whole drive, or of its motion under the measured pressure.

With a command channel, pressure and displacement (and force where measured) are predicted. Without one, the
measured pressure is the input, and displacement (and force where measured) is predicted. Several channels
are scaled by their noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import records_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.folds import FEWEST
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.moving_records import (
    MOST_ROWS,
    Record,
    record_of,
    recorded_channels,
    stroke_of,
)
from mckibben.identification.predict.predictor import PredictedChannel, Predictor, farther
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.noise import noise_floor
from mckibben.measurement.settled import settled
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.model import Model
from mckibben.simulation.drive.driven import driven_motions
from mckibben.simulation.drive.neighbours import neighbours
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.integrate.many import lane_kernels
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.statics.model import StaticModel

_LOST = 1e3  # residual after a run has stopped early, over the noise
_READINGS = {"pressure": "pressure_reading", "displacement": "stroke_reading", "force": "force_reading"}
# Derivatives side by side: relative step, fewest parameters, and the number of runs that take as long as the
# compilation; so many segments of a command take as long as another run.
_STEP_TOGETHER, _FEWEST_TOGETHER, _PAYS_OFF, _SEGMENTS = 1e-4, 3, 200.0, 50.0
_TIME_LIMIT = 2.0  # s; a longer run means implausible values of a fit
# Slots of the air flow only; irrelevant when the pressure is measured.
_AIR = (
    "extra_volume", "heat", "leakage", "command_delay", "opening", "fill_conductance", "exhaust_conductance",
    "tube_conductance", "supply",
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
        self._wide: tuple[Effect, ...] = ()
        self._spent: dict[tuple[Effect, ...], float] = {}

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
        drive = self._records[0].drive
        if effect.of_tube and drive.tube is None and drive.assumed_tube is None:
            return "it acts on the tube, and the drive states that there is none"
        return ""

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> TransientPredictor:
        """With one compiled model of all candidates that can be off, for quick trials."""
        inside = {effect.id for effect in fit_model.effects}
        # An energy balance instead of a polytrope changes the equations even without heat flow.
        # So does a tube that the drive does not state.
        tubeless = self._records[0].drive.tube is None
        other = {"heat", "tube_conductance"} if tubeless else {"heat"}
        further = [e for e in candidates if e.id not in inside and not other & set(e.slots) and not _fast(e)]
        ready = copy(self)
        ready._wide = Model((*fit_model.effects, *further)).effects
        return ready

    def trial(self, fit_model: FitModel) -> np.ndarray:
        """As `predict`, with the compiled model of all candidates if it contains this model."""
        if not set(fit_model.effects) <= set(self._wide):
            return self.predict(fit_model)
        values = {effect.id: fit_model.values.get(effect.id, effect.off) for effect in self._wide}
        return self.predict(replace(fit_model, effects=self._wide, values=values))

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        """The channels of all records, stacked; far from the measurement after a run has stopped early."""
        return self._stacked([self._run(_drive_with(fit_model, record), record) for record in self._records])

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

    def _alone_side_by_side(self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray) -> np.ndarray:
        """One-sided differences of runs under the measured pressure: all in one call, each as if alone."""
        changed = [self.ends(fit_model, parameter, self.step) for parameter in free]
        others = [farther(*ends) for ends in changed]
        models = [
            fit_model.with_numbers([parameter.name], [other])
            for parameter, other in zip(free, others, strict=True)
        ]
        readings = [
            self._motions([_drive_with(model, record) for model in models], record)
            for record in self._records
        ]
        columns = [
            (self._stacked(of_model) - here) / (other - value)
            for of_model, other, (value, _, _) in zip(
                zip(*readings, strict=True), others, changed, strict=True
            )
        ]
        return np.column_stack(columns)

    def differences(
        self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None
    ) -> np.ndarray:
        """As `Predictor.differences`; after many runs of a structure, all parameters run side by side.

        That gives smooth differences from much smaller steps, but each structure is compiled for it first.
        """
        if here is not None and free and not self.commanded:
            return self._alone_side_by_side(fit_model, free, here)
        if here is None or not self._many_runs(fit_model, len(free)):
            return super().differences(fit_model, free, here)
        changed = [self.ends(fit_model, parameter, _STEP_TOGETHER) for parameter in free]
        others = [farther(*ends) for ends in changed]
        models = [
            fit_model,
            *(
                fit_model.with_numbers([parameter.name], [other])
                for parameter, other in zip(free, others, strict=True)
            ),
        ]
        values = self._side_by_side(models)
        first = values[0]
        columns = []
        for parameter, (value, _, _), other, found in zip(free, changed, others, values[1:], strict=True):
            if first is None or found is None:  # it runs another course: by a run of its own
                columns.append(super().differences(fit_model, [parameter], here)[:, 0])
            else:
                columns.append((found - first) / (other - value))
        return np.column_stack(columns)

    def _many_runs(self, fit_model: FitModel, count: int) -> bool:
        """Whether the runs for derivatives so far would have paid the compilation; counts these.

        The kernel of the lanes is awaited, so that a fit never depends on whether it was ready.
        """
        if count < _FEWEST_TOGETHER:
            return False
        lane_kernels.warm()
        segments = sum(record.segments for record in self._records)
        runs = self._spent.get(fit_model.effects, 0.0) + count * (len(self._records) + segments / _SEGMENTS)
        self._spent[fit_model.effects] = runs
        if runs <= _PAYS_OFF:
            return False
        lane_kernels.awaited()
        return True

    def _side_by_side(self, models: Sequence[FitModel]) -> list[np.ndarray | None]:
        """`predict` of models that differ little from the first; None for one that runs another course."""
        parts: list[list[list[np.ndarray]]] = [[[] for _ in self.channels] for _ in models]
        lost: set[int] = set()
        for record in self._records:
            drives = [_drive_with(model, record) for model in models]
            for number, readings in enumerate(neighbours(drives, grid=record.time)):
                if readings is None:
                    lost.add(number)
                    continue
                for part, channel in zip(parts[number], self.channels, strict=True):
                    part.append(readings[_READINGS[channel.name]])
        return [
            None if number in lost else np.concatenate([np.concatenate(part) for part in parts[number]])
            for number in range(len(models))
        ]

    def _noises(self) -> np.ndarray:
        return np.repeat([channel.noise for channel in self.channels], len(self.rows))

    def _run(self, drive: Drive, record: Record) -> dict[str, np.ndarray]:
        try:
            if self.commanded:
                # Fits run thousands of times: always the compiled engine, so that digits never depend on what
                # is loaded.
                run = simulate(drive, grid=record.time, watch=Watch(time_limit=_TIME_LIMIT), engine="rodas")
                if run.outcome is Outcome.CANCELLED:
                    return {}
                results = run.outputs
            else:
                return self._motions([drive], record)[0]
        except InputError:  # values of the fit that no drive can have
            return {}
        return _named(results)

    @staticmethod
    def _motions(drives: Sequence[Drive], record: Record) -> list[dict[str, np.ndarray]]:
        """Readings of drives under the measured pressure; none of one that does not follow it."""
        assert record.pressure is not None  # noqa: S101 - checked by the constructor
        try:
            runs = driven_motions(drives, time=record.time, pressure=record.pressure, stroke=record.stroke)
        except InputError:  # values of the fit that no drive can have
            return [{} for _ in drives]
        return [{} if isinstance(run, InputError) else _named(run) for run in runs]


def _named(outputs: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The readings by the names of their channels."""
    return {name: outputs[output] for name, output in _READINGS.items() if output in outputs}


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
