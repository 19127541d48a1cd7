r"""Quasistatic measurements of force, length or diameter: static evaluation, memory along the records.

A muscle that carries a load while the pressure changes slowly has the length where :math:`F(L) = W`, so
:math:`dL/d\theta = (W_\theta - F_\theta)/F_L`. With dry friction the muscle sticks. Its equilibrium is
:math:`L_s` while shortening and :math:`L_l \le L_s` while lengthening, and along a record

.. math:: L_t = \min(\max(L_{t-1}, L_l), L_s)

so friction needs no measured direction, and the prediction of a sticking muscle is constant. With memory the
muscle is followed row by row, see `mckibben.identification.predict.free_runs`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.evaluate import Evaluation, State, sorted_effects
from mckibben.identification.predict.fit_model import LOAD, FitModel, Free
from mckibben.identification.predict.folds import folds_of, ranges_of, sweeps_of
from mckibben.identification.predict.free_runs import acting_of, followed_lengths, remembered
from mckibben.identification.predict.input_noise import with_smooth_pressure
from mckibben.identification.predict.memory import HISTORIES, remembers
from mckibben.identification.predict.predictor import PredictedChannel, Predictor, Reversals
from mckibben.identification.predict.sensor_dynamics import as_read, late
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.simulation.drive.isotonic import sliding
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
_SLACK_BAND = 0.02  # scatter of the readings of a slack muscle, share of the range of the force

_NEWTON_STEPS = 40
_TOLERANCE = 1e-8  # m; last step of Newton's method, whose error is its square
_LARGEST_STEP = 0.02  # per Newton step, share of the nominal length
_SHORTEST = 0.35  # shortest length of the search, share of the nominal length
_CREEP = 1e-9  # m/s; speed that carries the direction where the measured speed is 0
_STEP = 1e-3  # difference step of a guide's parameter, share of its range
_LOAD_STEP = 1.0  # N; on a guide the friction may grow with the load, which it does in proportion

LengthAndGradient = tuple[np.ndarray, np.ndarray]

_SUDDEN = 4.0  # change of the speed at a corner over those before and behind it: both sides are straight
_CLEAR = 6.0  # distance of a corner from the line between its rows, over the noise of the way
_APPARENT = 0.05  # the same over the longer step beside it: less changes no reading
_EVEN = 1.5  # longest time step over the shortest one around a corner
_NOISE = 0.6745 * np.sqrt(20.0)  # median third difference of white noise of standard deviation 1
_SOON = 1e-6  # time from a corner to the way behind it, share of the time step


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
        self.row_numbers = counted.rows
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

    def at_reversals(self, fit_model: FitModel) -> Reversals | None:
        """As of the base class: the range lies between the forces of both directions of motion."""
        rows, task = self.task.reversing, self.task
        if rows is None or task.channel != "force":
            return None
        at_once = _at_once(fit_model)
        state = self._evaluation.state(at_once)
        ends = [
            clip_slack(self._evaluation.at(at_once, (), {**state, "direction": np.full(len(rows), way)})[0])
            for way in (-1.0, 1.0)
        ]
        time = {} if task.time is None else {"time": task.time}
        return Reversals(
            measured=task.measured[rows],
            low=np.minimum(*ends)[rows],
            high=np.maximum(*ends)[rows],
            inputs={name: values[rows] for name, values in {**task.state, **time}.items()},
            muscle_length=np.full(int(np.count_nonzero(rows)), float(fit_model.muscle.nominal_length)),
            rows=task.rows[rows],
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


def predicted_lengths(
    evaluation: Evaluation, fit_model: FitModel, names: Sequence[str] = ()
) -> LengthAndGradient:
    """Length of each row [m], and its derivatives by the named parameters, shape (rows, names)."""
    acting = acting_of(fit_model, names)
    if remembered(acting):
        return followed_lengths(evaluation, acting, names)
    state = evaluation.state(fit_model)
    if not any(map(rubs, acting.effects)):
        return _balance(evaluation, fit_model, names, state)
    branches = []
    for sign in (-1.0, 1.0):
        speed = np.abs(state["velocity"]) * sign
        moving = {**state, "velocity": speed, "direction": np.full(len(speed), sign)}
        branches.append(_balance(evaluation, fit_model, names, moving, branch=sign))
    return _stuck(evaluation, *branches)


def rubs(effect: Effect) -> bool:
    """Whether an effect opposes the motion at any speed: a guide, or friction without memory."""
    rubbing = "friction" in effect.slots and "direction" in effect.wanted("friction") and not effect.states
    return "guide" in effect.slots or rubbing


def _stuck(
    evaluation: Evaluation, shortening: LengthAndGradient, lengthening: LengthAndGradient
) -> LengthAndGradient:
    """The length along each record, which sticks between the two branches."""
    task = evaluation.task
    short, long = shortening[0], lengthening[0]
    upper, lower = np.maximum(short, long).tolist(), np.minimum(short, long).tolist()
    measured, begins = task.measured.tolist(), [True, *(np.diff(task.records) != 0).tolist()]
    length, held_at, held_by = [], [], []  # the row at which a branch was met last, and which (0: none)
    previous, at, by = 0.0, 0, 0
    for row, (high, low, begin) in enumerate(zip(upper, lower, begins, strict=True)):
        if begin:
            previous, by = measured[row], 0
        if previous > high:
            previous, at, by = high, row, 1
        elif previous < low:
            previous, at, by = low, row, 2
        length.append(previous)
        held_at.append(at)
        held_by.append(by)
    branch = np.array(held_by)[:, None]
    slopes = np.where(branch == 1, shortening[1][held_at], lengthening[1][held_at])
    return np.array(length), np.where(branch > 0, slopes, 0.0)


def _balance(
    evaluation: Evaluation, fit_model: FitModel, names: Sequence[str], state: State, branch: float = 0.0
) -> LengthAndGradient:
    """Newton's method in bounded steps, up to the lock of the braid.

    It begins where the model before was in balance, which a fit has changed little, else at the measured
    lengths.
    """
    task = evaluation.task
    rest = fit_model.muscle.nominal_length
    low, high = _SHORTEST * rest, 0.9999 * float(fit_model.muscle.braid.thread_length)
    first = task.measured if task.channel == "length" else np.full(len(task.measured), rest)
    load = _load(task.state["load"], fit_model, state, np.clip(first, low, high))
    length = np.clip(evaluation.balanced.get(branch, first), low, high)
    force_at, limit = evaluation.by_length(fit_model, state), _LARGEST_STEP * rest
    load = np.broadcast_to(load, length.shape)
    left = np.arange(len(length))  # rows that still move
    inside = np.zeros(len(length), bool)
    for _ in range(_NEWTON_STEPS):
        here = length[left]
        force, slope = force_at(here, left)
        excess = force - load[left]
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(slope > 0.0, excess / slope, np.sign(excess))
        inside[left] = slope > 0.0
        length[left] = np.clip(here - np.clip(step, -limit, limit), low, high)
        left = left[~(np.abs(length[left] - here) < _TOLERANCE)]
        if not len(left):
            break
    inside &= (length > low) & (length < high)
    evaluation.balanced[branch] = np.where(inside, length, first)
    if not names:
        return length, np.empty((len(length), 0))
    out, gradient = evaluation.at(fit_model, names, {**state, "length": length})
    gradient = -gradient
    for column, name in enumerate(names):
        gradient[:, column] += _load_slope(name, fit_model, task.state["load"], state, length)
    slope = out["force_by_length"]
    inside &= slope > 0.0
    return length, np.where(inside[:, None], gradient / np.where(inside, slope, 1.0)[:, None], 0.0)


def _load(stated: np.ndarray, fit_model: FitModel, state: State, length: np.ndarray) -> np.ndarray:
    """Force that the muscle has to balance: load, unknown load and friction of the guide [N]."""
    creeping = np.where(state["velocity"] == 0.0, _CREEP * state["direction"], state["velocity"])
    context = {
        "stroke": fit_model.muscle.nominal_length - length,
        "speed": -creeping,
        "direction": -state["direction"],
        "load": np.abs(stated + fit_model.load),
    }
    guides = [effect for effect in acting_of(fit_model).effects if "guide" in effect.slots]
    values = {e.id: {**fit_model.values[e.id], **sliding(e, fit_model.values[e.id], context)} for e in guides}
    return stated + fit_model.load + Model(tuple(guides)).sum("guide", values, context)


def _load_slope(
    name: str, fit_model: FitModel, stated: np.ndarray, state: State, length: np.ndarray
) -> np.ndarray | float:
    if name == LOAD:
        step = _LOAD_STEP
    else:
        effect = next((e for e in fit_model.effects if e.id == name.partition(".")[0]), None)
        if effect is None or "guide" not in effect.slots:
            return 0.0
        declared = effect.parameter(name.partition(".")[2])
        step = _STEP * (declared.upper - declared.lower)
    here = fit_model.number(name)
    ends = [
        _load(stated, fit_model.with_numbers([name], [value]), state, length) for value in (here, here + step)
    ]
    return (ends[1] - ends[0]) / step


def with_corners(task: ComparableRows) -> ComparableRows:
    r"""The rows with two more at each corner of the way between two of them, which are not to be scored.

    Both sides of a corner are straight. Their lines meet between the rows k and k + 1 at

    .. math:: t_c = t_k + \frac{y_{k+1} - y_k - v_r\,(t_{k+1} - t_k)}{v_l - v_r}

    with the speeds :math:`v_l` before row k and :math:`v_r` behind row k + 1: subcell resolution (A. Harten,
    J. Comput. Phys. 83 (1989) 148, doi 10.1016/0021-9991(89)90226-X). A late reading at row k + 1 is one of
    an instant between the rows; a straight line from row to row would cut the corner off.

    The way is the pressure where the length is held, else the length. The first of the two rows moves as the
    row before the corner, the second one as that behind it. The same rows where the force is not predicted.
    """
    name = "pressure" if task.kind == "isometric" else "length"
    if task.time is None or task.channel != "force" or name not in task.state:
        return task
    row, after = _corners(task.time, task.state[name], task.records)
    if not len(row):
        return task
    step = task.time[row + 1] - task.time[row]
    share = after / step
    tip = _onward(task.time, task.state[name], row, after)

    def inserted(values: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        return np.insert(values, np.repeat(row + 1, 2), np.stack([first, second], axis=1).ravel())

    def between(values: np.ndarray) -> np.ndarray:
        there = values[row] + share * (values[row + 1] - values[row])
        return inserted(values, there, there)

    def repeated(values: np.ndarray) -> np.ndarray:
        return inserted(values, values[row], values[row])

    state: Mapping[str, np.ndarray] = {
        **{one: between(values) for one, values in task.state.items()},
        **{
            one: inserted(task.state[one], task.state[one][row], task.state[one][row + 1])
            for one in ("velocity", "direction")
        },
        name: inserted(task.state[name], tip, tip),
    }
    at = task.time[row] + after
    unscored = np.ones(len(row), bool)
    by_rest_length = task.by_rest_length
    return replace(
        task,
        measured=between(task.measured),
        state=state,
        time=inserted(task.time, at, at + _SOON * step),
        records=repeated(task.records),
        groups=repeated(task.groups),
        turning=inserted(task.turning, unscored, unscored),
        rows=repeated(task.rows),
        by_rest_length=repeated(by_rest_length) if isinstance(by_rest_length, np.ndarray) else by_rest_length,
        corners=inserted(np.zeros(len(task.rows), bool), unscored, unscored),
        reversing=None,
    )


def _onward(time: np.ndarray, way: np.ndarray, row: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The way a time after a row, if it went on as it did before the row."""
    return way[row] + (way[row] - way[row - 1]) / (time[row] - time[row - 1]) * after


def _corners(time: np.ndarray, way: np.ndarray, records: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The row before each corner, and the time from it to the corner [s]."""
    if len(way) < 6:
        return np.empty(0, int), np.empty(0)
    row = np.arange(2, len(way) - 3)
    row = row[records[row - 2] == records[row + 3]]
    # Between records time may step back or stand still, and the speed need not change.
    with np.errstate(divide="ignore", invalid="ignore"):
        step = np.diff(time)
        speed = np.diff(way) / step
        left, right = speed[row - 1], speed[row + 1]
        after = (way[row + 1] - way[row] - right * step[row]) / (left - right)
    steps = np.stack([step[row + place] for place in range(-2, 3)])
    bent = np.maximum(np.abs(left - speed[row - 2]), np.abs(right - speed[row + 2]))
    found = np.max(steps, axis=0, initial=0.0) < _EVEN * np.min(steps, axis=0, initial=np.inf)
    found &= (np.abs(right - left) > _SUDDEN * bent) & (after > 0.0) & (after < (1.0 - _SOON) * step[row])
    row, after, left, right = row[found], after[found], left[found], right[found]
    off = np.abs(left - speed[row]) * after
    longer = step[row] * np.maximum(np.abs(left), np.abs(right))
    # Corners are few, and do not count in a median.
    noise = float(np.median(np.abs(np.diff(way, 3)))) / _NOISE
    clear = off > np.maximum(_CLEAR * noise, _APPARENT * longer)
    return row[clear], after[clear]
