r"""The length at which a muscle carries a load while the pressure changes slowly.

It is where :math:`F(L) = W`, so :math:`dL/d\theta = (W_\theta - F_\theta)/F_L`. With dry friction the muscle
sticks: shortening it would come to :math:`L_s`, lengthening to :math:`L_l \le L_s`, and along a record

.. math:: L_t = \min(\max(L_{t-1}, L_l), L_s)

so friction needs no measured direction, and a length that does not move is predicted not to.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.identification.predict.evaluate import Evaluation, State
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model

_NEWTON_STEPS = 40
_TOLERANCE = 1e-9  # m
_LARGEST_STEP = 0.02  # of the nominal length, per Newton step
_SHORTEST = 0.35  # share of the nominal length down to which a length is looked for
_CREEP = 1e-9  # m/s, for the sense of a motion of no speed
_STEP = 1e-3  # of a parameter's range, for the guide's derivative

Found = tuple[np.ndarray, np.ndarray]


def predicted_lengths(evaluation: Evaluation, fit_model: FitModel, names: Sequence[str] = ()) -> Found:
    """Length of each row [m], and its derivatives by the named numbers, shape (rows, names)."""
    state = evaluation.state(fit_model)
    if not any(map(_rubs, fit_model.effects)):
        return _balance(evaluation, fit_model, names, state)
    branches = []
    for sign in (-1.0, 1.0):
        speed = np.abs(state["velocity"]) * sign
        moving = {**state, "velocity": speed, "direction": np.full(len(speed), sign)}
        branches.append(_balance(evaluation, fit_model, names, moving))
    return _stuck(evaluation, *branches)


def _rubs(effect: Effect) -> bool:
    """Whether an effect opposes the motion whatever its speed: a guide, or friction without memory."""
    rubbing = "friction" in effect.slots and "direction" in effect.wanted("friction") and not effect.states
    return "guide" in effect.slots or rubbing


def _stuck(evaluation: Evaluation, shortening: Found, lengthening: Found) -> Found:
    """The length along each record between the two branches."""
    task = evaluation.task
    short, long = shortening[0], lengthening[0]
    upper, lower = np.maximum(short, long), np.minimum(short, long)
    length = np.empty(len(short))
    gradient = np.zeros_like(shortening[1])
    previous, slope, record = 0.0, np.zeros(gradient.shape[1]), None
    for row in range(len(length)):
        if task.records[row] != record:
            record, previous = task.records[row], float(task.measured[row])
            slope = np.zeros(gradient.shape[1])
        if previous > upper[row]:
            previous, slope = float(upper[row]), shortening[1][row]
        elif previous < lower[row]:
            previous, slope = float(lower[row]), lengthening[1][row]
        length[row], gradient[row] = previous, slope
    return length, gradient


def _balance(evaluation: Evaluation, fit_model: FitModel, names: Sequence[str], state: State) -> Found:
    """Newton's method from the measured length, in bounded steps, within what the braid allows."""
    task = evaluation.task
    rest = fit_model.muscle.nominal_length
    low, high = _SHORTEST * rest, 0.9999 * float(fit_model.muscle.braid.thread_length)
    first = task.measured if task.channel == "length" else np.full(len(task.measured), rest)
    length = np.clip(first, low, high)
    load = _load(task.state["load"], fit_model, state, length)
    for _ in range(_NEWTON_STEPS):
        out, _ = evaluation.at(fit_model, (), {**state, "length": length})
        excess, slope = out["force"] - load, out["force_by_length"]
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(slope > 0.0, excess / slope, np.sign(excess))
        limit = _LARGEST_STEP * rest
        moved = np.clip(length - np.clip(step, -limit, limit), low, high)
        done = np.max(np.abs(moved - length)) < _TOLERANCE
        length = moved
        if done:
            break
    if not names:
        return length, np.empty((len(length), 0))
    out, gradient = evaluation.at(fit_model, names, {**state, "length": length})
    gradient = -gradient
    for column, name in enumerate(names):
        gradient[:, column] += _load_slope(name, fit_model, state, length)
    slope = out["force_by_length"]
    inside = (length > low) & (length < high) & (slope > 0.0)
    return length, np.where(inside[:, None], gradient / np.where(inside, slope, 1.0)[:, None], 0.0)


def _load(stated: np.ndarray, fit_model: FitModel, state: State, length: np.ndarray) -> np.ndarray:
    """What the muscle has to pull: load, unknown load, and the guide against the motion [N]."""
    creeping = np.where(state["velocity"] == 0.0, _CREEP * state["direction"], state["velocity"])
    context = {
        "stroke": fit_model.muscle.nominal_length - length,
        "speed": -creeping,
        "direction": -state["direction"],
    }
    guides = [effect for effect in fit_model.effects if "guide" in effect.slots]
    values = {
        e.id: {**fit_model.values[e.id], **_sliding(e, fit_model.values[e.id], context)} for e in guides
    }
    return stated + fit_model.load + Model(tuple(guides)).sum("guide", values, context)


def _sliding(
    effect: Effect, values: Mapping[str, float], context: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """States of a guide when it has slid for long: their rates, linear in each, are zero."""
    if not effect.states:
        return {}
    empty, full = (
        effect.call("drive_rates", context, {**values, **dict.fromkeys((s.name for s in effect.states), z)})
        for z in (0.0, 1.0)
    )
    return {s.name: low / (low - high) for s, low, high in zip(effect.states, empty, full, strict=True)}


def _load_slope(name: str, fit_model: FitModel, state: State, length: np.ndarray) -> np.ndarray | float:
    if name == LOAD:
        return 1.0
    effect = next((e for e in fit_model.effects if e.id == name.partition(".")[0]), None)
    if effect is None or "guide" not in effect.slots:
        return 0.0
    declared = effect.parameter(name.partition(".")[2])
    step = _STEP * (declared.upper - declared.lower)
    zero = np.zeros(len(length))
    here = fit_model.number(name)
    ends = [
        _load(zero, fit_model.with_numbers([name], [value]), state, length) for value in (here, here + step)
    ]
    return (ends[1] - ends[0]) / step
