"""Friction with memory on the two branches of a slow loop: its states at the values of a long motion.

A static curve knows a direction of motion, but no history. Dahl friction, Maxwell slip and their relatives
build up over a short travel after a reversal; on the branches of a loop they have long reached their value
`StateVariable.sliding`, times the sign of the velocity. Without a direction the states are at rest, so the
curve is the mean of the two branches: there friction and damping are zero and need not be computed.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import lru_cache

from mckibben.physics.effect import Effect
from mckibben.physics.ops import Value
from mckibben.physics.slots import SLOTS

_RATES = ("rates", "drive_rates")


def sliding_effects(*, effects: Iterable[Effect]) -> tuple[Effect, ...]:
    """The effects for curves with a direction; an effect without a sliding state is the same object."""
    return tuple(
        _sliding(effect) if any(state.sliding for state in effect.states) else effect for effect in effects
    )


def acting_at_rest(*, effects: Iterable[Effect]) -> tuple[Effect, ...]:
    """The effects without those that act in motion alone, for curves without a direction and a velocity.

    Left out is what acts through ``friction`` only and declares to be zero without motion.
    """
    return tuple(effect for effect in effects if not _acts_in_motion_alone(effect))


def _acts_in_motion_alone(effect: Effect) -> bool:
    slots = set(effect.slots)
    return slots <= {"friction", "rates"} and "no_motion" in effect.signature.zero_at


@lru_cache(maxsize=256)
def _sliding(effect: Effect) -> Effect:
    """The effect with its sliding states as functions of the direction; the same object at each call, since
    compiled models are kept by the identity of their effects.
    """
    reached = {state.name: state.sliding for state in effect.states if state.sliding}
    slots = {
        slot: _at_the_end_of_a_motion(function, effect.wanted(slot), reached)
        if set(effect.wanted(slot)) & set(reached)
        and slot not in _RATES
        and "direction" in SLOTS[slot].context
        else function
        for slot, function in effect.slots.items()
    }
    return replace(effect, slots=slots)


def _at_the_end_of_a_motion(
    function: Callable[..., Value], wanted: tuple[str, ...], reached: dict[str, float]
) -> Callable[..., Value]:
    def at_direction(*, direction: Value, **others: Value) -> Value:
        given = {**others, "direction": direction}
        states = {name: value * direction for name, value in reached.items()}
        return function(**{name: states[name] if name in states else given[name] for name in wanted})

    names = dict.fromkeys([*(name for name in wanted if name not in reached), "direction"])
    at_direction.__signature__ = inspect.Signature(  # type: ignore
        [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY) for name in names]
    )
    return at_direction
