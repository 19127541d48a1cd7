"""Quasistatic measurements of force, length or diameter: static evaluation, memory along the records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.corners import with_corners
from mckibben.identification.predict.evaluate import Evaluation, sorted_effects
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.identification.predict.folds import folds_of, ranges_of, sweeps_of
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.free_runs import acting_of, remembered
from mckibben.identification.predict.input_noise import with_smooth_pressure
from mckibben.identification.predict.lengths import predicted_lengths, rubs
from mckibben.identification.predict.memory import HISTORIES, remembers
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.predict.sensor_dynamics import as_read, late
from mckibben.physics.effect import Effect
from mckibben.simulation.statics.model import clip_slack

_LEAST = 0.01  # quantile that serves as the smallest force: a single row may be an outlier
_NEAR_ZERO = 0.05  # largest force of a slack muscle, share of the range of the force
_INPUT_STEP = 2e-4  # step of a difference by an input, share of its largest value
_ALL_SLACK = (
    0.02  # of the blocked force; what a slack muscle reads throughout, zero error and noise, is below
)
_FEWEST_READINGS = 8  # that show no trend
_TREND = (
    0.3  # of the variance; readings that follow pressure or length less are those of no muscle that pulls
)
_BEYOND_CHANCE = 3.0  # standard deviations of the noise from which a row lies outside of a range
_SLACK_BAND = 0.02  # scatter of the readings of a slack muscle, share of the range of the force


class QuasistaticPredictor(Predictor):
    """Predicts the comparable rows of any kind but transient.

    Args:
        task: the rows.
        largest_load: upper bound of an unknown load [N].
    """

    def __init__(self, task: ComparableRows, *, largest_load: float = 0.0) -> None:
        self.kind = task.kind
        self._blocked = largest_load
        self._follow(task)
        # A late reading is one of an instant between two rows, where the way may have turned.
        cornered = with_corners(task) if np.any(~task.turning) else task
        self._cornered = None if cornered is task else copy(self)
        if self._cornered is not None:
            self._cornered._follow(cornered)
        counted = task.chosen(self._counted)
        self.measured = counted.measured
        self.scale = np.ones(len(self.measured))
        full_scale = float(np.max(np.abs(self.measured)))
        self.channels = (PredictedChannel(task.channel, task.unit, slice(None), 1.0, full_scale),)
        self.records, self.groups = counted.records, counted.groups
        self.rows_used, self.excluded, self.messages = len(self.measured), task.excluded, self.task.messages
        within = "pressure" if task.kind in ("isometric", "isotonic") else "length"
        other = ranges_of(counted.state.get(within, counted.state["pressure"]))
        ways = [folds_of(self.groups), other]
        self.folds = tuple(ways if np.ptp(other) else ways[:1])
        self.sweeps = sweeps_of(
            self.groups,
            self.records,
            counted.state.get("length"),
            counted.state["pressure"],
            ordered=task.ordered,
        )
        time = {} if counted.time is None else {"time": counted.time}
        self.inputs = {
            name: values
            for name, values in {**counted.state, **time}.items()
            if name != "temperature" or np.ptp(values) > 0.0
        }
        if task.unknown_load:
            self.unknown_load = Free(LOAD, 0.05 * largest_load, 0.0, largest_load, "N")
        self._wide: tuple[Effect, ...] = ()

    def _follow(self, task: ComparableRows) -> None:
        """Evaluate models along these rows."""
        if task.channel == "length":
            task, self.input_floor = with_smooth_pressure(task)
        self.task = task
        # Rows where the motion turns belong to the path, but are not scored.
        self._counted = ~task.turning if np.any(~task.turning) else np.ones(len(task.turning), bool)
        self._idle = np.zeros(len(task.measured), bool)
        if task.channel == "force":
            self._idle = self._like_slack(task.measured, np.ones(len(task.measured), bool))
        self._evaluation = Evaluation(task)

    def _along(self, fit_model: FitModel) -> QuasistaticPredictor:
        """This predictor, for late readings along the rows and the corners between them."""
        if self._cornered is None or not any(map(late, fit_model.effects)):
            return self
        other, along = self._cornered, copy(self)
        along.task, along._counted, along._idle = other.task, other._counted, other._idle
        along._evaluation = other._evaluation.after(self._evaluation.history(_at_once(fit_model)))
        along._cornered = None
        return along

    def why_hidden(self, effect: Effect) -> str:
        """Checked by the kinds of the effect; memory needs an order in time.

        Static rows with time also reveal effects of isobaric and isometric measurements.
        """
        free = self.kind == "static" and self.task.ordered
        if not effect.kinds & ({"static", "isobaric", "isometric"} if free else {self.kind}):
            return f"it does not show in {self.kind} data, only in {effect.shown_in}"
        delays = late(effect)
        # What a hysteretic effect remembers depends on the way alone, which the order of rows shows as well.
        known = self.task.ordered and effect.type == "hysteretic"
        if (remembers(effect) or delays) and self.task.time is None and not known:
            return self.without_time
        if delays and self.task.channel != "force":
            return "it delays the force reading, and no force was predicted"
        if self.kind == "isotonic" and not self.task.load_read and "force_sensor" in effect.slots:
            return "it acts on the force reading, and no force was measured"
        if "compliance" in effect.slots and self.task.channel == "diameter":
            return "it does not change the diameter"
        return ""

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> QuasistaticPredictor:
        """With one compiled model for every model of a search; absent effects are off in it."""
        inside = {effect.id for effect in fit_model.effects}
        further = [e for e in candidates if e.id not in inside and not late(e)]
        ready = copy(self)
        ready._wide = sorted_effects((*fit_model.effects, *further))
        return ready

    def trial(self, fit_model: FitModel) -> np.ndarray:
        """As `predict`, with the compiled model of all candidates if it contains this model."""
        if not set(fit_model.effects) <= set(self._wide):
            return self.predict(fit_model, clipped=False)
        values = {effect.id: fit_model.values.get(effect.id, effect.off) for effect in self._wide}
        wide = replace(fit_model, effects=self._wide, values=values)
        quick = copy(self)
        quick._evaluation = self._evaluation.without_derivatives()
        if not quick._evaluation.pinned:
            # What creep goes on from changes all rows, a motion before the record the first ones only.
            creeping = len(self.histories(fit_model.effects)) > 1
            quick = quick.after(quick.history(wide) if creeping else ("rest",))
        return quick.predict(wide, clipped=False)

    def histories(self, effects: Sequence[Effect]) -> tuple[tuple[str, ...], ...]:
        """See `Evaluation.histories`; a fit finds a motion before the record by itself."""
        names = self._evaluation.histories([effect for effect in effects if not late(effect)])
        return tuple((name,) for name in names if not HISTORIES[name].slid)

    def history(self, fit_model: FitModel) -> tuple[str, ...]:
        """See `Evaluation.history`."""
        return (self._evaluation.history(_at_once(fit_model)),)

    def after(self, history: tuple[str, ...]) -> QuasistaticPredictor:
        """This predictor with a history that does not depend on the model."""
        pinned = copy(self)
        pinned._evaluation = self._evaluation.after(history[0])
        return pinned

    def reading(self, values: np.ndarray) -> QuasistaticPredictor:
        """This predictor of other readings; where they are those of a slack muscle, models may be slack."""
        measured = self.task.measured.copy()
        measured[self._counted] = values
        other = copy(self)
        other.measured, other.task = values, replace(self.task, measured=measured)
        other._idle = np.zeros(len(measured), bool)
        if self.task.channel == "force":
            other._idle[self._counted] = self._like_slack(values, self._counted)
        return other

    def _like_slack(self, force: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Mask of the forces that a slack muscle may show, in some rows of the task."""
        inputs = [self.task.state[name][rows] for name in ("pressure", "length") if name in self.task.state]
        if _is_slack_throughout(force, inputs, self._blocked):
            return np.ones(len(force), bool)
        return _like_slack(force)

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        """Force, length or diameter of each row; the length is limited by the lock of the braid."""
        along = self._along(fit_model)
        return along._everywhere(fit_model, clipped=clipped)[along._counted]

    def input_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        """Central difference over all rows at once; a slack muscle has none."""
        along = self._along(fit_model)
        values = along.task.state.get(channel)
        if values is None:
            return super().input_slope(fit_model, channel)
        step = _INPUT_STEP * float(np.max(np.abs(values)))
        ends, (history,) = [], along.history(fit_model)
        for sign in (-1.0, 1.0):
            other = copy(along)
            other._cornered = None
            other.task = replace(along.task, state={**along.task.state, channel: values + sign * step})
            other._evaluation = Evaluation(other.task).after(history)
            ends.append(other.predict(fit_model))
        slope = (ends[1] - ends[0]) / (2.0 * step) if step > 0.0 else np.zeros(len(self.measured))
        return np.where(np.isfinite(slope), slope, 0.0)

    def at_reversals(self, fit_model: FitModel, noise: float | None) -> tuple[str, ...]:
        """As of the base class: dry friction may have any value there between those of both directions."""
        rows, task = self.task.reversing, self.task
        if rows is None or task.channel != "force" or not any(map(rubs, fit_model.effects)):
            return ()
        at_once = _at_once(fit_model)
        state = self._evaluation.state(at_once)
        ends = [
            clip_slack(self._evaluation.at(at_once, (), {**state, "direction": np.full(len(rows), way)})[0])
            for way in (-1.0, 1.0)
        ]
        low, high, measured = np.minimum(*ends)[rows], np.maximum(*ends)[rows], task.measured[rows]
        beyond = np.maximum(np.maximum(low - measured, measured - high), 0.0)
        outside = beyond > _BEYOND_CHANCE * (noise or 0.0)
        told = "all lie within it"
        if np.any(outside):
            told = f"{np.count_nonzero(outside)} lie outside of it, by up to {np.max(beyond):.3g} N"
        return (
            f"{len(beyond)} rows at reversals are counted apart: dry friction may have any value of its "
            f"range there; {told}",
        )

    def lost(self, fit_model: FitModel) -> tuple[int, int]:
        """Number of rows without a finite prediction, scored or not, and of all rows."""
        with np.errstate(all="ignore"):
            values = self._everywhere(fit_model, clipped=False)
        return int(np.count_nonzero(~np.isfinite(values))), len(values)

    def _everywhere(self, fit_model: FitModel, *, clipped: bool) -> np.ndarray:
        if self.task.channel == "length":
            # Compared with lengths that were calculated with the nominal length of the rows.
            return predicted_lengths(self._evaluation, fit_model)[0] - self._evaluation.moved(fit_model)
        if self.task.channel == "diameter":
            return self._diameter(fit_model)
        out = self._evaluation.at(_at_once(fit_model))[0]
        force = clip_slack(out) if clipped else self._followed(out)
        return self._as_read(fit_model, force) if any(map(late, fit_model.effects)) else force

    def linearised(self, fit_model: FitModel, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Predicted values; exact derivatives of force and length, finite differences of the diameter."""
        names = tuple(parameter.name for parameter in free)
        if self.task.channel == "diameter":
            return super().linearised(fit_model, free)
        if any(map(late, fit_model.effects)):
            return self._along(fit_model)._late_linearised(fit_model, free)
        if self.task.channel == "force":
            out, gradient = self._evaluation.at(fit_model, names)
            gradient[self._slack(out)] = 0.0
            return self._followed(out)[self._counted], gradient[self._counted]
        length, gradient = predicted_lengths(self._evaluation, fit_model, names)
        length = length - self._evaluation.moved(fit_model)
        if "nominal_length" in names:
            gradient[:, names.index("nominal_length")] -= self.task.by_rest_length
        return length[self._counted], gradient[self._counted]

    def follows(self, fit_model: FitModel, free: Sequence[Free]) -> bool:
        """As of the base class: the length of a muscle with memory is followed row by row."""
        acting = acting_of(fit_model, [parameter.name for parameter in free])
        return self.task.channel == "length" and remembered(acting)

    def slopes(self, fit_model: FitModel, free: Sequence[Free], here: np.ndarray | None = None) -> np.ndarray:
        """As of the base class, exact ones."""
        del here
        return self.linearised(fit_model, free)[1]

    def _late_linearised(self, fit_model: FitModel, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """The filter applied to the exact derivatives; finite differences by its own parameters."""
        ids = {effect.id for effect in fit_model.effects if late(effect)}
        inner = [p.name for p in free if p.name.partition(".")[0] not in ids]
        out, slopes = self._evaluation.at(_at_once(fit_model), tuple(inner))
        # The filter would spread a NaN of one row to all rows after it.
        slopes = np.where(np.isfinite(slopes), slopes, 0.0)
        slopes[self._slack(out)] = 0.0
        force = self._followed(out)
        shown = self._as_read(fit_model, np.column_stack([force, slopes]))
        gradient = np.empty((len(shown), len(free)))
        for column, parameter in enumerate(free):
            if parameter.name in inner:
                gradient[:, column] = shown[:, 1 + inner.index(parameter.name)]
                continue
            here = fit_model.number(parameter.name)
            step = self.step * min(parameter.upper - parameter.lower, max(abs(here), parameter.typical))
            low, high = max(here - step, parameter.lower), min(here + step, parameter.upper)
            first, last = (
                self._as_read(fit_model.with_numbers([parameter.name], [end]), force) for end in (low, high)
            )
            gradient[:, column] = (last - first) / (high - low)
        return shown[:, 0][self._counted], gradient[self._counted]

    def _followed(self, out: Mapping[str, np.ndarray]) -> np.ndarray:
        """The unclipped force of a fit; clipped where the measured muscle is slack as well."""
        return np.where(self._slack(out), out["slack_force"], out["force"])

    def _slack(self, out: Mapping[str, np.ndarray]) -> np.ndarray:
        """Mask of the rows at which the muscle is slack in the model and in the measurement."""
        return self._idle & (out["tension"] <= 0.0)

    def _as_read(self, fit_model: FitModel, values: np.ndarray) -> np.ndarray:
        """Values of every row after the lags and the skew of a model; rows without time show neither."""
        task = self.task
        if task.time is None:
            return values
        records = [np.flatnonzero(task.records == label) for label in np.unique(task.records)]
        return as_read(fit_model, time=task.time, records=records, values=values)

    def _diameter(self, fit_model: FitModel) -> np.ndarray:
        if "length" in self.task.state:
            return self._evaluation.at(fit_model)[0]["diameter"]
        length, _ = predicted_lengths(self._evaluation, fit_model)
        state = {**self._evaluation.state(fit_model), "length": length}
        return self._evaluation.at(fit_model, (), state)[0]["diameter"]


def _like_slack(force: np.ndarray) -> np.ndarray:
    """Mask of the forces that a slack muscle may show: near the smallest, if that is near zero.

    A negative smallest force shows how far the readings of a slack muscle scatter.
    """
    least, span = float(np.quantile(force, _LEAST)), float(np.ptp(force))
    if span == 0.0 or abs(least) > _NEAR_ZERO * span:
        return np.zeros(len(force), bool)
    return force <= max(least + _SLACK_BAND * span, -least)


def _is_slack_throughout(force: np.ndarray, inputs: Sequence[np.ndarray], blocked: float) -> bool:
    """Whether readings are those of a muscle that never pulls: small, and no matter of pressure or length.

    Args:
        force: the readings [N].
        inputs: what the force of a muscle that pulls depends on.
        blocked: force at the highest pressure and the rest length [N]; 0 = unknown.
    """
    if len(force) < _FEWEST_READINGS or not np.max(np.abs(force)) < _ALL_SLACK * blocked:
        return False
    spread = float(np.sum((force - np.mean(force)) ** 2))
    if spread == 0.0:
        return True
    columns = [np.ones(len(force)), *((v - np.mean(v)) / max(float(np.std(v)), 1e-300) for v in inputs)]
    left = force - np.column_stack(columns) @ np.linalg.lstsq(np.column_stack(columns), force)[0]
    return float(np.sum(left**2)) > (1.0 - _TREND) * spread


def _at_once(fit_model: FitModel) -> FitModel:
    """The model without delaying effects."""
    return replace(fit_model, effects=tuple(effect for effect in fit_model.effects if not late(effect)))
