"""The worked examples of an effect, evaluated."""

from __future__ import annotations

import math

import numpy as np

from mckibben.physics.effect import Effect, Example
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

_ROUNDING = 1e-15


def evaluated(*, effect: Effect, example: Example) -> float:
    """What the effect gives in the state of an example, SI."""
    if example.quantity.startswith("slot:"):
        _, slot, *index = example.quantity.split(":")
        context = {"muscle": Muscle(**example.muscle)} if example.muscle else {}
        got = effect.call(slot, context | dict(example.state), {**effect.defaults, **example.parameters})
        return float(np.atleast_1d(np.asarray(got, float))[int(index[0]) if index else 0])
    muscle = Muscle(**example.muscle)
    quantity = example.quantity.removesuffix("_change")
    values = {effect.id: {**effect.defaults, **example.parameters}}
    got = getattr(Model([effect]).evaluate(muscle=muscle, values=values, **example.state), quantity)
    if quantity != example.quantity:
        got = got - getattr(Model().evaluate(muscle=muscle, values={}, **example.state), quantity)
    return float(got)


def wrong_examples(*, effect: Effect) -> list[str]:
    """Which examples of an effect are not as they say, each in one sentence; none if all are."""
    found = []
    for number, example in enumerate(effect.examples, 1):
        got = evaluated(effect=effect, example=example)
        if not math.isclose(got, example.expected, rel_tol=example.tolerance, abs_tol=_ROUNDING):
            found.append(f"example {number}: {example.quantity} is {got:.9g}, not {example.expected:.9g}")
    return found
