"""Several measurements predicted together: specimens of one or more muscles, each with its own geometry.

A model of several specimens has one set of effects and one reference muscle. The muscle of a specimen keeps
its ratio to the reference: if a fit changes the braid angle of the reference by 1 %, it changes that of every
specimen by 1 %.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.folds import folds_of
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.predictor import PredictedChannel, Predictor, Reversals, StoppedRun
from mckibben.identification.predict.reading_errors import ReadingError
from mckibben.measurement.kind import common_kind
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY, Muscle


@dataclass(frozen=True)
class SpecimenData:
    """One measurement of several: its name, its predictor and its muscle."""

    name: str
    predictor: Predictor
    muscle: Muscle


def own_muscle(muscle: Muscle, *, reference: Muscle, own: Muscle) -> Muscle:
    """The muscle of a specimen, where the reference has become ``muscle``; fields without a value stay so."""
    return Muscle(
        *(
            value if not before else mine * value / before
            for value, before, mine in zip(muscle, reference, own, strict=True)
        )
    )


class SpecimensPredictor(Predictor):
    """Predicts several measurements of the same kind, or of kinds whose force is predicted.

    Args:
        specimens: at least two, with the same predicted channels.
        reference: the muscle of the model.

    Raises:
        InputError: different channels of the specimens are predicted.
    """

    def __init__(self, specimens: Sequence[SpecimenData], *, reference: Muscle) -> None:
        self._specimens, self._reference = tuple(specimens), reference
        first_run = 1
        for specimen in specimens:
            if isinstance(specimen.predictor, TransientPredictor):
                specimen.predictor.number_runs(first_run)
                first_run += specimen.predictor.runs
        parts = [specimen.predictor for specimen in specimens]
        first = parts[0]
        kind = first.kind
        for specimen in specimens[1:]:
            other = specimen.predictor
            together = common_kind(kind, other.kind)
            if together is None or other.predicted != first.predicted:
                raise InputError(
                    f"of {specimen.name} {other.predicted} is predicted ({other.kind}), of "
                    f"{specimens[0].name} {first.predicted} ({first.kind})",
                    field="kind",
                    hint="compare them one after the other",
                )
            kind = together
        self.kind, self.simulated, self.step = kind, first.simulated, first.step
        # The values are ordered by channel, then by specimen.
        sizes = [len(part.measured) for part in parts]
        begins = np.cumsum([0, *sizes[:-1]])
        order, channels, begin = [], [], 0
        for number, channel in enumerate(first.channels):
            rows = [
                np.arange(size)[part.channels[number].rows] for part, size in zip(parts, sizes, strict=True)
            ]
            order += [inside + start for inside, start in zip(rows, begins, strict=True)]
            same = [part.channels[number] for part in parts]
            count = sum(map(len, rows))
            weights = [len(inside) for inside in rows]
            noise = float(np.sqrt(np.average([each.noise**2 for each in same], weights=weights)))
            scale = max(each.full_scale for each in same)
            channels.append(
                PredictedChannel(channel.name, channel.unit, slice(begin, begin + count), noise, scale)
            )
            begin += count
        self.input_floor = float(np.sqrt(np.average([p.input_floor**2 for p in parts], weights=sizes)))
        self._order = np.concatenate(order)
        self._back = np.empty(len(self._order), dtype=np.intp)
        self._back[self._order] = np.arange(len(self._order))
        self.channels = tuple(channels)
        self.measured = self._stacked([part.measured for part in parts])
        self.scale = self._stacked([part.scale for part in parts])
        self.specimen = self._stacked([np.full(size, number) for number, size in enumerate(sizes)])
        self.groups, self.records = (
            self._stacked(_numbered([getattr(part, name) for part in parts]))
            for name in ("groups", "records")
        )
        self.row_numbers = self._stacked([part.row_numbers for part in parts])
        self.folds = self._folds(parts)
        self.sweeps = [
            self._back[sweep + start]
            for part, start in zip(parts, begins, strict=True)
            for sweep in part.sweeps
        ]
        shared = [name for name in first.inputs if all(name in part.inputs for part in parts)]
        self.inputs = {name: self._stacked([part.inputs[name] for part in parts]) for name in shared}
        self.rows_used = sum(part.rows_used for part in parts)
        self.excluded = _summed([part.excluded for part in parts])
        self.messages = tuple(
            f"{each.name}: {message}" for each in specimens for message in each.predictor.messages
        )
        unknown = [part.unknown_load for part in parts if part.unknown_load is not None]
        if unknown:
            largest = max(each.upper for each in unknown)
            self.unknown_load = replace(unknown[0], upper=largest, start=0.05 * largest)
        self.reading_errors = tuple(
            replace(
                error,
                of=f"{each.name}: {error.of}" if error.of else each.name,
                rows=self._alone(n, error.rows),
            )
            for n, each in enumerate(specimens)
            for error in each.predictor.reading_errors
        )
        names = {name for part in parts for name in part.accuracy}
        self.accuracy = {
            name: float(np.sqrt(np.mean([part.accuracy.get(name, 0.0) ** 2 for part in parts])))
            for name in names
        }

    @property
    def several_lengths(self) -> bool:
        """Whether the muscles have different rest lengths."""
        rest = [float(each.muscle.nominal_length) for each in self._specimens]
        return max(rest) > 1.01 * min(rest)

    @property
    def specimens(self) -> tuple[SpecimenData, ...]:
        """The measurements."""
        return self._specimens

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each specimen."""
        return tuple(each.name for each in self._specimens)

    def parts(self, fit_model: FitModel) -> list[tuple[Predictor, FitModel]]:
        """The predictor of each specimen, and the model with its muscle."""
        return [(each.predictor, self._own(fit_model, each)) for each in self._specimens]

    def free_starts(self) -> tuple[Free, ...]:
        """Those of all specimens."""
        return tuple(free for each in self._specimens for free in each.predictor.free_starts())

    def without(self, number: int) -> SpecimensPredictor:
        """The data of all specimens but one, prepared alike; reading errors are to be allowed for again."""
        left = [each for place, each in enumerate(self._specimens) if place != number]
        return SpecimensPredictor(left, reference=self._reference)

    def _folds(self, parts: Sequence[Predictor]) -> tuple[np.ndarray, ...]:
        """Folds by groups of all specimens; other ways where all specimens have them."""
        ways = [folds_of(self.groups)] if self.kind != "transient" else []
        first = 0 if self.kind == "transient" else 1
        for way in range(first, min(len(part.folds) for part in parts)):
            labels = [part.folds[way] for part in parts]
            ways.append(self._stacked(_numbered(labels) if self.kind == "transient" else labels))
        return tuple(ways)

    def _stacked(self, parts: Sequence[np.ndarray]) -> np.ndarray:
        return np.concatenate(parts)[self._order]

    def _alone(self, number: int, rows: np.ndarray) -> np.ndarray:
        """A mask of the values of one specimen as one of all values."""
        return self._stacked(
            [
                rows if place == number else np.zeros(len(each.predictor.measured), bool)
                for place, each in enumerate(self._specimens)
            ]
        )

    def _own(self, fit_model: FitModel, specimen: SpecimenData) -> FitModel:
        muscle = own_muscle(fit_model.muscle, reference=self._reference, own=specimen.muscle)
        return replace(fit_model, muscle=muscle)

    def _each(self, evaluate: Callable[[Predictor, FitModel], np.ndarray], fit_model: FitModel) -> np.ndarray:
        return self._stacked(
            [evaluate(each.predictor, self._own(fit_model, each)) for each in self._specimens]
        )

    def rest_length(self, fit_model: FitModel) -> np.ndarray:
        """Rest length of the muscle of each value [m], shape (values,)."""
        return self._each(
            lambda part, own: np.full(len(part.measured), float(own.muscle.nominal_length)), fit_model
        )

    def at_reversals(self, fit_model: FitModel) -> Reversals | None:
        """Those of every specimen with its own muscle."""
        found = (each.predictor.at_reversals(self._own(fit_model, each)) for each in self._specimens)
        return Reversals.together([part for part in found if part is not None])

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        """The prediction of every specimen with its own muscle."""
        return self._each(lambda part, own: part.predict(own, clipped=clipped), fit_model)

    def trial(self, fit_model: FitModel) -> np.ndarray:
        """The trial of every specimen."""
        return self._each(lambda part, own: part.trial(own), fit_model)

    def linearised(self, fit_model: FitModel, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Predictions and derivatives; a geometry field acts in its ratio to the reference."""
        values, slopes = [], []
        for each in self._specimens:
            own = self._own(fit_model, each)
            scaled = [_scaled(parameter, fit_model, own) for parameter in free]
            predicted, gradient = each.predictor.linearised(own, scaled)
            values.append(predicted)
            slopes.append(gradient * np.array([_ratio(p.name, fit_model, own) for p in free]))
        return self._stacked(values), np.concatenate(slopes)[self._order]

    def follows(self, fit_model: FitModel, free: Sequence[Free]) -> bool:
        """Whether one of the specimens does."""
        return any(each.predictor.follows(fit_model, free) for each in self._specimens)

    def slopes(self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None) -> np.ndarray:
        """Those of `linearised`, unless all specimens are simulated."""
        if self.simulated:
            return super().slopes(fit_model, free, here)
        return self.linearised(fit_model, free)[1]

    def why_hidden(self, effect: Effect) -> str:
        """An effect shows if it shows in one of the measurements."""
        reasons = [each.predictor.why_hidden(effect) for each in self._specimens]
        return "" if not all(reasons) else reasons[0]

    def history(self, fit_model: FitModel) -> tuple[str, ...]:
        """Of each specimen."""
        own = (each.predictor.history(self._own(fit_model, each)) for each in self._specimens)
        return tuple(name for names in own for name in (names or ("rest",)))

    def histories(self, effects: Sequence[Effect]) -> tuple[tuple[str, ...], ...]:
        """The same one before each specimen."""
        own = [each.predictor.histories(effects) for each in self._specimens]
        shared = [names[0] for names in own[0] if names and all(names in other for other in own)]
        return tuple((name,) * len(own) for name in shared) or ((),)

    def after(self, history: tuple[str, ...]) -> SpecimensPredictor:
        """This predictor with histories that do not depend on the model."""
        if not history:
            return self
        pinned = copy(self)
        pinned._specimens = tuple(
            replace(each, predictor=each.predictor.after((name,)))
            for each, name in zip(self._specimens, history, strict=True)
        )
        return pinned

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> SpecimensPredictor:
        """Every specimen prepared."""
        ready = copy(self)
        ready._specimens = tuple(
            replace(each, predictor=each.predictor.prepared(self._own(fit_model, each), candidates))
            for each in self._specimens
        )
        return ready

    def input_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        """That of every specimen."""
        return self._each(lambda part, own: part.input_slope(own, channel), fit_model)

    def _reading_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        """Also that of a dimension that is stated wrong, in proportion to the reference."""
        if channel not in GEOMETRY:
            return super()._reading_slope(fit_model, channel)
        value = fit_model.number(channel)
        field = Free(channel, value, 0.9 * value, 1.1 * value, "")
        return -self.linearised(fit_model, [field])[1][:, 0]

    def stopped(self, fit_model: FitModel) -> tuple[StoppedRun, ...]:
        """Those of all specimens, by their names."""
        return tuple(
            replace(run, of=each.name)
            for each in self._specimens
            for run in each.predictor.stopped(self._own(fit_model, each))
        )

    def reached(self, fit_model: FitModel) -> SpecimensPredictor:
        """The rows that the runs of every specimen reach.

        Raises:
            InputError: no run of a specimen reaches three rows.
        """
        if not self.stopped(fit_model):
            return self
        own = [
            replace(each, predictor=each.predictor.reached(self._own(fit_model, each)))
            for each in self._specimens
        ]
        return SpecimensPredictor(own, reference=self._reference)

    def beginning(self, fit_model: FitModel) -> SpecimensPredictor:
        """That of every specimen."""
        other = copy(self)
        other._specimens = tuple(
            replace(each, predictor=each.predictor.beginning(self._own(fit_model, each)))
            for each in self._specimens
        )
        return other

    def lost(self, fit_model: FitModel) -> tuple[int, int]:
        """Sums over the specimens."""
        pairs = [each.predictor.lost(self._own(fit_model, each)) for each in self._specimens]
        return sum(lost for lost, _ in pairs), sum(rows for _, rows in pairs)


def zero_errors(
    specimen: SpecimenData, accuracy: Mapping[str, float], deviations: Collection[str] = ()
) -> SpecimenData:
    """The specimen with a possible zero error of each of its sensors, within the accuracy.

    Args:
        specimen: one of several.
        accuracy: channel -> standard deviation [SI].
        deviations: channels whose errors are deviations from those of the other specimens.
    """
    predictor = copy(specimen.predictor)
    rows = np.ones(len(predictor.measured), bool)
    taken = {error.channel for error in predictor.reading_errors}
    units = {"length": "m", "force": "N", "pressure": "Pa", "diameter": "m"}
    seen = {channel.name for channel in predictor.channels} | set(predictor.inputs)
    predictor.reading_errors = (
        *predictor.reading_errors,
        *(
            ReadingError(channel, "", sigma, units[channel], rows, channel in deviations)
            for channel, sigma in accuracy.items()
            if sigma > 0.0 and channel not in taken and channel in seen
        ),
    )
    return replace(specimen, predictor=predictor)


def own_geometry(specimen: SpecimenData, spread: Mapping[str, float]) -> SpecimenData:
    """The specimen with possible deviations of its geometry from that of the others, in proportion.

    Args:
        specimen: one of several.
        spread: geometry field -> standard deviation between specimens [SI].
    """
    predictor = copy(specimen.predictor)
    rows = np.ones(len(predictor.measured), bool)
    predictor.reading_errors = (
        *predictor.reading_errors,
        *(
            ReadingError(name, "", sigma, "rad" if name == "braid_angle" else "m", rows, deviation=True)
            for name, sigma in spread.items()
        ),
    )
    return replace(specimen, predictor=predictor)


def _ratio(name: str, fit_model: FitModel, own: FitModel) -> float:
    if name not in GEOMETRY:
        return 1.0
    value = fit_model.number(name)
    return own.number(name) / value if value else 1.0


def _scaled(parameter: Free, fit_model: FitModel, own: FitModel) -> Free:
    ratio = _ratio(parameter.name, fit_model, own)
    if ratio == 1.0:
        return parameter
    return replace(
        parameter, start=parameter.start * ratio, lower=parameter.lower * ratio, upper=parameter.upper * ratio
    )


def _numbered(labels: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Labels that differ from specimen to specimen."""
    offset, result = 0, []
    for values in labels:
        numbers = np.unique(values, return_inverse=True)[1]
        result.append(numbers + offset)
        offset += int(numbers.max()) + 1
    return result


def _summed(counts: Sequence[Mapping[str, int]]) -> dict[str, int]:
    total: dict[str, int] = {}
    for part in counts:
        for reason, number in part.items():
            total[reason] = total.get(reason, 0) + number
    return total
