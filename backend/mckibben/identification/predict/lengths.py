r"""The length at which a muscle carries a load while the pressure changes slowly.

It is where :math:`F(L) = W`, so :math:`dL/d\theta = (W_\theta - F_\theta)/F_L`. With dry friction the muscle
sticks. Its equilibrium is :math:`L_s` while shortening and :math:`L_l \le L_s` while lengthening, and along a
record

.. math:: L_t = \min(\max(L_{t-1}, L_l), L_s)

so friction needs no measured direction, and the prediction of a sticking muscle is constant. With memory the
muscle is followed row by row, see `mckibben.identification.predict.free_runs`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.predict.evaluate import Evaluation, State
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.identification.predict.free_runs import acting_of, followed_lengths, remembered
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.simulation.drive.isotonic import sliding

_NEWTON_STEPS = 40
_TOLERANCE = 1e-8  # m; last step of Newton's method, whose error is its square
_LARGEST_STEP = 0.02  # per Newton step, share of the nominal length
_SHORTEST = 0.35  # shortest length of the search, share of the nominal length
_CREEP = 1e-9  # m/s; speed that carries the direction where the measured speed is 0
_STEP = 1e-3  # difference step of a guide's parameter, share of its range
_LOAD_STEP = 1.0  # N; on a guide the friction may grow with the load, which it does in proportion

LengthAndGradient = tuple[np.ndarray, np.ndarray]


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
