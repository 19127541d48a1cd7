"""Base of the predictors: measured values, and their prediction by a model."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

import numpy as np

from mckibben.facts.result import Number, result_class
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.reading_errors import ReadingError, ReadingWeights, reading_weights
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError

#: What went before a record, of `mckibben.identification.predict.memory.HISTORIES`, in words.
_FRICTION = "friction depends on the motion before the record, which no file states: "
_CREEP = "creep depends on what went before the record, which no file states: "
_BEST = "because the readings fit best with it"
_ASSUMED = {
    "the same way": f"{_FRICTION}a motion that went on where it begins was assumed, {_BEST}",
    "the other way": f"{_FRICTION}a motion the other way that turned where it begins was assumed, {_BEST}",
    "applied": f"{_CREEP}that its first pressure and load were put on just before it, after a rest "
    f"without them, was assumed, {_BEST}",
    "applied anew": f"{_CREEP}that pressure and load were put on anew before each level, after a rest "
    f"without them, was assumed, {_BEST}",
}


@dataclass(frozen=True)
class PredictedChannel:
    """One predicted channel.

    Attributes:
        name: as in `mckibben.measurement.measurement.CHANNEL_UNITS`.
        unit: SI.
        rows: its values in the stacked arrays of the predictor.
        noise: standard deviation of its noise; 1 if unknown.
        full_scale: largest measured magnitude.
    """

    name: str
    unit: str
    rows: slice
    noise: float
    full_scale: float


@result_class
class StoppedRun:
    """A run of the model that ended before the last row of its record."""

    of: str
    """Name of the measurement; empty for a single one."""
    run: int
    """Its number within the measurement, from 1; 0 for the only one."""
    reached: Number
    """Time of the last row that it reached, from the first one on [s]; NaN where it never began."""
    duration: float
    """Duration of the record [s]."""
    share: float
    """Share of the compared rows of the record that it did not reach [-]."""
    reason: str
    """Why it ended."""

    @property
    def event(self) -> str:
        """What happened, in words."""
        begin = f"{self.of}: " if self.of else ""
        which = f"run {self.run}" if self.run else "the run"
        reason = self.reason[:1].lower() + self.reason[1:].rstrip(".")
        if not self.reached > 0.0:
            return f"{begin}{which} of the model did not begin: {reason}"
        return f"{begin}{which} of the model stopped at {self.reached:.3g} of {self.duration:.3g} s: {reason}"

    @property
    def sentence(self) -> str:
        """The same, with what the figures of a comparison are of."""
        percent = 100.0 * self.share
        lost = f"{percent:.{0 if percent >= 10.0 else 1}f} % of {'its' if self.run else 'the'} rows"
        return f"{self.event}. The figures are of the rows before; {lost} were not reached"


_MOST_MISSING = 20  # rows that are not compared, over which noise is followed
_LISTED = 8  # rows that are listed
_BEYOND_CHANCE = 3.0  # standard deviations of the noise from which a reading lies outside of a range


@dataclass(frozen=True, eq=False)
class Reversals:
    """Readings of force at which the motion turns.

    Dry friction holds or slides there, in either direction: the model allows every force between those of its
    two branches, which are one without friction. Such rows are counted apart, each by its distance from that
    range.

    Attributes:
        measured: shape (rows,), SI.
        low: the least force that the model allows, of the same shape.
        high: the greatest one.
        inputs: of the same rows, as those of `Predictor`, which may hold fewer.
        muscle_length: rest length of the muscle of each row [m].
        rows: index of each row in its measurement.
        unit: of the readings, SI.
    """

    measured: np.ndarray
    low: np.ndarray
    high: np.ndarray
    inputs: Mapping[str, np.ndarray]
    muscle_length: np.ndarray
    rows: np.ndarray
    unit: str = "N"

    @property
    def distance(self) -> np.ndarray:
        """How far each reading lies outside of its range; 0 within."""
        return np.maximum(np.maximum(self.low - self.measured, self.measured - self.high), 0.0)

    def outside(self, noise: float | None, error: float) -> int:
        """Number of readings farther outside than three standard deviations of the noise.

        Without friction of the model they have to be farther off than the others, too.

        Args:
            noise: where it is known.
            error: of the other rows.
        """
        level = (noise or 0.0) if self._rub else max(noise or 0.0, error)
        return int(np.count_nonzero(self.distance > _BEYOND_CHANCE * level))

    @property
    def _rub(self) -> bool:
        """Whether the model has friction, so that there is a range."""
        return bool(np.any(self.high > self.low))

    def sentence(self, noise: float | None, error: float) -> str:
        """What they say of the model; empty where they fit a model without friction. See `outside`."""
        outside, rows = self.outside(noise, error), len(self.measured)
        farthest = np.argsort(-self.distance, kind="stable")[: min(outside, _LISTED)]
        names = ", ".join(f"row {self.rows[row] + 1}" for row in np.sort(farthest))
        more = f" and {outside - _LISTED} more" if outside > _LISTED else ""
        off = f"by up to {np.max(self.distance):.3g} {self.unit}: {names}{more}"
        apart = (
            f"{rows} rows at reversals are counted apart: dry friction may have any value of its range there"
        )
        if self._rub:
            return f"{apart}; {f'{outside} lie outside of it, {off}' if outside else 'all lie within it'}"
        lie = "lies" if outside == 1 else "lie"
        return f"{apart}; {outside} {lie} off the model, which has none, {off}" if outside else ""

    @staticmethod
    def together(parts: Sequence[Reversals]) -> Reversals | None:
        """Those of several measurements; inputs that not all of them have are left out. None of none."""
        if not parts:
            return None
        names = [name for name in parts[0].inputs if all(name in part.inputs for part in parts)]

        def joined(of: Callable[[Reversals], np.ndarray]) -> np.ndarray:
            return np.concatenate([of(part) for part in parts])

        return Reversals(
            joined(lambda part: part.measured),
            joined(lambda part: part.low),
            joined(lambda part: part.high),
            {name: joined(lambda part, name=name: part.inputs[name]) for name in names},
            joined(lambda part: part.muscle_length),
            joined(lambda part: part.rows),
            parts[0].unit,
        )


class Predictor(ABC):
    """Measured values and their prediction; arrays are stacked over the predicted channels.

    Attributes:
        kind: kind of the measurement.
        channels: the predicted channels.
        measured: shape (values,), SI.
        scale: divisor of the residuals: 1 for a single channel, the noise of each channel for several,
            shape (values,).
        folds: ways of folding, each a label of the fold of each value, shape (values,): first by groups, then
            by ranges of the quantity that changes within a group.
        groups: label of the curve that a value belongs to, shape (values,).
        records: label of the uninterrupted record, shape (values,).
        row_numbers: row of its file that a value was read from, shape (values,).
        sweeps: indices of the values of each smooth sweep, in order.
        inputs: variables that the residual may depend on, name -> shape (values,), SI.
        simulated: whether each prediction is a simulated run: a thousand times the cost of a closed form,
            with derivatives by finite differences.
        step: of finite differences, relative to the size of a parameter or its usual change.
        rows_used: number of rows that are scored.
        excluded: reason -> number of excluded rows.
        messages: the assumptions.
        unknown_load: bounds of the load when it is fitted.
        reading_errors: possible errors of readings within their accuracy.
        accuracy: channel -> standard deviation of what its sensor may be wrong by all the time [SI].
        weights: how fits allow for reading errors; None before `allowing`, and without any.
        accuracy_floor: error of the scaled residual due to `accuracy`; known after `allowing`.
        input_floor: error of the scaled residual due to noise of inputs that neighbouring rows share.
        aside: values that count for nothing, because they do not fit; None without any.
        quick: candidates whose equations are compiled together, so that the best of them is known soon.
    """

    kind: str
    channels: tuple[PredictedChannel, ...]
    measured: np.ndarray
    scale: np.ndarray
    folds: tuple[np.ndarray, ...]
    groups: np.ndarray
    records: np.ndarray
    row_numbers: np.ndarray
    sweeps: Sequence[np.ndarray]
    inputs: Mapping[str, np.ndarray]
    rows_used: int
    excluded: Mapping[str, int]
    messages: tuple[str, ...]
    simulated: bool = False
    step: float = 5e-3
    unknown_load: Free | None = None
    reading_errors: tuple[ReadingError, ...] = ()
    accuracy: Mapping[str, float] = MappingProxyType({})
    weights: ReadingWeights | None = None
    accuracy_floor: float = 0.0
    input_floor: float = 0.0
    aside: np.ndarray | None = None
    quick: tuple[Effect, ...] = ()

    @abstractmethod
    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        """Predicted values, shape (values,), NaN where there is none; ``clipped``: a slack muscle reads no
        force.
        """

    def predictions(self, fit_models: Sequence[FitModel]) -> list[np.ndarray]:
        """Unclipped predictions of several models; simulated runs go side by side."""
        return [self.predict(fit_model, clipped=False) for fit_model in fit_models]

    def within_fit(self, fit_model: FitModel, free: Sequence[Free]) -> np.ndarray:
        """Unclipped prediction of a model whose `differences` are likely to be asked for next."""
        del free
        return self.predict(fit_model, clipped=False)

    def trial(self, fit_model: FitModel) -> np.ndarray:
        """Unclipped prediction by the quickest method, for the change caused by a candidate."""
        return self.predict(fit_model, clipped=False)

    def try_ahead(self, fit_models: Iterable[FitModel]) -> None:
        """Simulate the trials of these models side by side, so that `trial` has them; else do nothing."""
        del fit_models

    def history(self, fit_model: FitModel) -> tuple[str, ...]:
        """What went before each measurement, of `mckibben.identification.predict.memory.HISTORIES`.

        Files do not say it, and friction with memory depends on it: that with which a model fits best.
        """
        return ()

    def histories(self, effects: Sequence[Effect]) -> tuple[tuple[str, ...], ...]:
        """Histories from each of which a fit with these effects begins, as one does not lead to another.

        The first is the usual one.
        """
        del effects
        return ((),)

    def after(self, history: tuple[str, ...]) -> Predictor:
        """This predictor with a history that does not depend on the model."""
        return self

    def assumed_history(self, fit_model: FitModel) -> tuple[str, ...]:
        """A sentence where another history than rest was assumed, and on what no rest undoes."""
        names = [name for name in dict.fromkeys(self.history(fit_model)) if name != "rest"]
        lasting = [
            f"{effect.title}: the muscle is taken as new in each record; of one that had been used before, "
            f"{effect.id}.{state.lasting} says how far"
            for effect in fit_model.effects
            for state in effect.states
            if state.lasting and fit_model.values[effect.id][state.lasting] == 0.0
        ]
        return (*(_ASSUMED[name] for name in names), *lasting)

    def at_reversals(self, fit_model: FitModel) -> Reversals | None:
        """Readings of force at which the motion turns, where the model has dry friction; None without any."""
        del fit_model
        return None

    def reading(self, values: np.ndarray) -> Predictor:
        """This predictor of other readings, shape (values,), at the same inputs."""
        other = copy(self)
        other.measured = values
        return other

    def setting_aside(self, values: Sequence[int]) -> Predictor:
        """This predictor without some values (indices): they weigh nothing, and are in no line of noise."""
        other = copy(self)
        other.aside = np.zeros(len(self.measured), bool)
        other.aside[list(values)] = True
        return other

    #: Why rows without time do not reveal what remembers the past.
    without_time = "it depends on what happened before, and the rows have no time"

    @abstractmethod
    def why_hidden(self, effect: Effect) -> str:
        """Why these data cannot reveal an effect; empty if they can."""

    @abstractmethod
    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> Predictor:
        """This predictor, prepared for a search over the start model with any of the candidates."""

    @property
    def several_lengths(self) -> bool:
        """Whether the data are of muscles of different rest lengths."""
        return False

    def rest_length(self, fit_model: FitModel) -> np.ndarray | float:
        """Rest length of the muscle [m]; of each value where there are several muscles."""
        return float(fit_model.muscle.nominal_length)

    def stopped(self, fit_model: FitModel) -> tuple[StoppedRun, ...]:
        """The runs of a model that end before the last rows; a closed form has none."""
        del fit_model
        return ()

    def free_starts(self) -> tuple[Free, ...]:
        """The starts of the runs as parameters of a fit: stroke beyond the first reading, and speed.

        Raises:
            InputError: there are no runs that begin from a measured stroke under a measured pressure.
        """
        raise InputError(
            "a start can be fitted to records of a stroke over time under a measured pressure only",
            field="free",
            hint="leave 'start' out; a run with a command begins at rest at its first pressure",
        )

    def reached(self, fit_model: FitModel) -> Predictor:
        """This predictor of the rows alone that the runs of a model reach.

        Raises:
            InputError: no run reaches three rows.
        """
        del fit_model
        return self

    def beginning(self, fit_model: FitModel) -> Predictor:
        """This predictor for fits that begin with a model: a run that takes many more steps stops."""
        del fit_model
        return self

    def lost(self, fit_model: FitModel) -> tuple[int, int]:
        """Number of rows without a finite prediction, and of all rows."""
        return 0, len(self.measured)

    def linearised(self, fit_model: FitModel, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Predicted values and their derivatives by the free parameters, shape (values, free)."""
        predicted = self.within_fit(fit_model, free)
        return predicted, self.differences(fit_model, free, predicted if self.simulated else None)

    def follows(self, fit_model: FitModel, free: Sequence[Free]) -> bool:
        """Whether derivatives by these parameters cost much more than a prediction, but no simulated runs."""
        del fit_model, free
        return False

    def slopes(self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None) -> np.ndarray:
        """Derivatives by the free parameters, where the prediction ``here`` is known."""
        return self.differences(fit_model, free, here)

    def differences(
        self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None
    ) -> np.ndarray:
        """Finite differences of `predict`, shape (values, free): central, or from the prediction ``here``."""
        if here is not None:
            moved = self.moved(fit_model, free, self.step)
            changed = self.predictions([model for _, model in moved])
            columns = [(end - here) / size for end, (size, _) in zip(changed, moved, strict=True)]
        else:
            columns = []
            for parameter in free:
                _, low, high = self.ends(fit_model, parameter, self.step)
                first, last = self.predictions([
                    fit_model.with_numbers([parameter.name], [end]) for end in (low, high)
                ])  # fmt: skip
                columns.append((last - first) / (high - low))
        return np.column_stack(columns) if columns else np.empty((len(self.measured), 0))

    def moved(self, fit_model: FitModel, free: Sequence[Free], step: float) -> list[tuple[float, FitModel]]:
        """For one-sided differences: of each parameter its change, and the model with it."""
        changes = [self.ends(fit_model, parameter, step) for parameter in free]
        return [
            (farther(*change) - change[0], fit_model.with_numbers([parameter.name], [farther(*change)]))
            for parameter, change in zip(free, changes, strict=True)
        ]

    def ends(self, fit_model: FitModel, parameter: Free, step: float) -> tuple[float, float, float]:
        """The value of a parameter, and the ends of a difference with this relative step."""
        value = fit_model.number(parameter.name)
        size = step * min(parameter.upper - parameter.lower, max(abs(value), parameter.typical))
        return value, max(value - size, parameter.lower), min(value + size, parameter.upper)

    def residual(self, fit_model: FitModel) -> np.ndarray:
        """Measured minus predicted."""
        return self.measured - self.predict(fit_model)

    def weighted(self, values: np.ndarray) -> np.ndarray:
        """Residuals or derivatives as fits see them: over the scale, with allowance for reading errors.

        Args:
            values: shape (values,) or (values, columns), SI.
        """
        scaled = values / (self.scale if values.ndim == 1 else self.scale[:, None])
        if self.aside is not None:
            scaled[self.aside] = 0.0
        return scaled if self.weights is None else self.weights(scaled)

    def input_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        """Derivative of the prediction by the readings of an input channel; 0 if it is none."""
        del fit_model, channel
        return np.zeros(len(self.measured))

    def error_columns(self, fit_model: FitModel) -> np.ndarray:
        """Change of the scaled residual by each possible reading error, shape (values, errors)."""
        slopes = {
            name: self._reading_slope(fit_model, name)
            for name in {error.channel for error in self.reading_errors}
        }
        columns = np.zeros((len(self.measured), len(self.reading_errors)))
        for number, error in enumerate(self.reading_errors):
            columns[:, number] = np.where(error.rows, slopes[error.channel], 0.0) / self.scale
        return columns

    def _reading_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        """Change of the residual by an error of a channel, shape (values,)."""
        own = [each for each in self.channels if each.name == channel]
        return np.ones(len(self.measured)) if own else -self.input_slope(fit_model, channel)

    def allowing(self, fit_model: FitModel, noise: float) -> Self:
        """This predictor, whose fits allow for reading errors and know what the accuracy permits.

        Args:
            fit_model: the model whose derivatives count.
            noise: of the scaled residual.
        """
        if not self.reading_errors and not self.accuracy:
            return self
        ready = copy(self)
        squares = [
            np.mean((sigma * self._reading_slope(fit_model, name) / self.scale) ** 2)
            for name, sigma in self.accuracy.items()
        ]
        ready.accuracy_floor = float(np.sqrt(np.sum(squares)))
        if self.reading_errors:
            columns = self.error_columns(fit_model)
            ready.weights = reading_weights(
                self.reading_errors, columns, noise=noise, floor=ready.accuracy_floor
            )
        return ready

    def rmse(self, residual: np.ndarray) -> float:
        """Root mean square of the residual over its scale."""
        return float(np.sqrt(np.mean((residual / self.scale) ** 2)))

    @property
    def noise_lines(self) -> list[list[list[np.ndarray]]]:
        """Of each channel, ways in which its noise may go on from row to row: by records, by sweeps.

        A line holds the values in the order of their rows; -1 stands for a row of the file between them that
        is not compared.
        """
        channels = []
        for channel in self.channels:
            rows = np.arange(len(self.measured))[channel.rows]
            inside = np.zeros(len(self.measured), bool)
            inside[rows] = True
            records = [rows[self.records[rows] == label] for label in np.unique(self.records[rows])]
            sweeps = [sweep[inside[sweep]] for sweep in self.sweeps]
            inside[np.concatenate([*sweeps, rows[:0]])] = False
            sweeps = [sweep for sweep in sweeps if len(sweep)] + list(np.flatnonzero(inside)[:, None])
            ways = [records] if len(sweeps) == len(records) else [records, sweeps]
            lines = [[part for line in way for part in self._unbroken(line)] for way in ways]
            if self.aside is not None:
                counts = np.append(~self.aside, False)  # the last one for rows that are not there
                lines = [
                    [np.where(counts[line], line, -1) for line in way if counts[line].any()] for way in lines
                ]
            channels.append(lines)
        return channels

    def _unbroken(self, line: np.ndarray) -> list[np.ndarray]:
        """A line cut where many rows are missing, or where it does not follow the file."""
        steps = np.diff(self.row_numbers[line])
        parts = np.split(line, np.flatnonzero((steps < 1) | (steps > _MOST_MISSING)) + 1)
        found = []
        for part in parts:
            numbers = self.row_numbers[part] - self.row_numbers[part[0]]
            whole = np.full(numbers[-1] + 1, -1)
            whole[numbers] = part
            found.append(whole)
        return found

    @property
    def unit(self) -> str:
        """Unit of the error: of the channel, or "1" when several are scaled by their noise."""
        return self.channels[0].unit if len(self.channels) == 1 else "1"

    @property
    def predicted(self) -> str:
        """Names of the predicted channels."""
        return ", ".join(channel.name for channel in self.channels)


def farther(value: float, low: float, high: float) -> float:
    """The end of a one-sided difference: a bound may cut the other side off."""
    return high if high - value >= value - low else low
