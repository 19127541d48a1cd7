"""Operating points and goals as texts: "position 40 mm", "overshoot 5 %, settling 0.5 s"."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import si
from mckibben.simulation.linear.point import Condition, Kind
from mckibben.simulation.linear.trials import Goals

_UNITS: dict[str, str] = {"position": "m", "contraction": "1", "pressure": "Pa", "command": "1"}
_GOALS: dict[str, str] = {"overshoot": "1", "settling": "s", "step": "m"}
_UNSATURATED = "no saturation"
_AT_HINT = 'e.g. "position 40 mm", "contraction 10 %", "pressure 3 bar", "command 50 %"'
_DESIGN_HINT = 'e.g. "overshoot 5 %, settling 0.5 s, step 10 mm, no saturation"'


def condition_of(text: str) -> Condition:
    """The operating point that a text states.

    Raises:
        InputError: another word, no number, or a unit that does not fit; field "at".
    """
    word, _, value = text.strip().partition(" ")
    kind = word.lower()
    if kind not in get_args(Kind):
        raise InputError(f"'{text[:60]}' states no operating point", field="at", hint=_AT_HINT)
    return stated_condition(kind, value.strip())


def stated_condition(kind: str, value: float | str) -> Condition:
    """The operating point with a value in SI, or a text with a unit.

    Raises:
        InputError: no number, or a unit that does not fit; field "at".
    """
    if not str(value):
        raise InputError(f"the {kind} has no value", field="at", hint=_AT_HINT)
    try:
        number = si(value, _UNITS[kind], reference="gauge" if kind == "pressure" else None)
    except InputError as error:
        raise InputError(f"{kind}: {error.message}", field="at", hint=error.hint) from error
    return Condition(kind, number)  # type: ignore


def goals_of(text: str) -> Goals:
    """The goals that a text states, with the defaults of `Goals` for the others.

    Raises:
        InputError: another word, a value that is impossible, or a unit that does not fit; field "design".
    """
    goals = Goals()
    for part in filter(None, (each.strip() for each in text.split(","))):
        if part.lower() == _UNSATURATED:
            goals = replace(goals, unsaturated=True)
            continue
        word, _, value = part.partition(" ")
        if word.lower() not in _GOALS:
            known = did_you_mean(word, [*_GOALS, _UNSATURATED])
            raise InputError(f"there is no goal '{part[:40]}'", field="design", hint=known or _DESIGN_HINT)
        goals = replace(goals, **{word.lower(): _goal(word.lower(), value.strip())})
    return checked(goals)


def _goal(name: str, value: str) -> float:
    if not value:
        raise InputError(f"the goal {name} has no value", field="design", hint=_DESIGN_HINT)
    try:
        return si(value, _GOALS[name])
    except InputError as error:
        raise InputError(f"{name}: {error.message}", field="design", hint=error.hint) from error


def checked(goals: Goals) -> Goals:
    """The goals, if they are possible.

    Raises:
        InputError: a value out of its range; field "design".
    """
    wrong = None
    if not 0.0 <= goals.overshoot <= 1.0:
        wrong = f"an overshoot of {goals.overshoot * 100:g} % is not between 0 and 100 %"
    elif not 0.01 <= goals.settling <= 20.0:
        wrong = f"a settling time of {goals.settling:g} s is not between 10 ms and 20 s"
    elif goals.step is not None and not 1e-5 <= abs(goals.step) <= 10.0:
        wrong = f"a step of {goals.step:g} m is not between 0.01 mm and 10 m"
    if wrong is not None:
        raise InputError(wrong, field="design", hint=_DESIGN_HINT)
    return goals
