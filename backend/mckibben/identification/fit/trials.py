"""Models that a fitter tries beside a fitted one, without fitting them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mckibben.identification.fit.first_order import between
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics.effect import Effect
from mckibben.physics.parameter import Parameter

_SLOWER = (1.0, 10.0, 100.0)
_PLACES = 12  # places tried of an effect that acts beyond some state only


def off_of(effect: Effect, *, fitted: bool = True) -> dict[str, float]:
    """Parameters declared as fitted, or the others, that have a value at which they have no effect: these."""
    return {p.name: p.off for p in effect.parameters if p.off is not None and p.fitted is fitted}


def place_of(effect: Effect) -> Parameter | None:
    """Where an effect begins that acts beyond some state only: a fitted parameter without an off value."""
    places = [p for p in effect.parameters if p.off is None and p.fitted]
    return places[0] if len(places) == 1 else None


def pace_of(effect: Effect) -> Parameter | None:
    """The time by which an effect creeps, where a fit leaves it at its usual value at first."""
    times = [p for p in effect.parameters if p.off is None and not p.fitted and p.unit == "s"]
    return times[0] if len(times) == 1 and any(state.applied for state in effect.states) else None


def at_places(fit_model: FitModel, effect: Effect, place: Parameter) -> dict[float, FitModel]:
    """Places over its range, the usual one first -> the model with the effect acting from there.

    Of a time by which an effect creeps: ten and a hundred times as long as usual.
    """
    acting = effect.off | between(effect, off_of(effect))
    if place.fitted:
        places = [place.default, *np.linspace(place.lower, place.upper, _PLACES + 2)[1:-1].tolist()]
    else:  # a time: holds last from seconds to hours
        places = [place.default * times for times in _SLOWER if place.default * times <= place.upper]
    return {value: fit_model.adding(effect, acting | {place.name: value}) for value in places}


def with_each(
    fit_model: FitModel, effect: Effect, off: dict[str, float], placed: Mapping[str, float]
) -> list[FitModel]:
    """The model with each parameter of one more effect a little way from off, the others off.

    Args:
        fit_model: the model.
        effect: to add.
        off: its parameters and their off values.
        placed: where it begins.
    """
    there = between(effect, off)
    return [fit_model.adding(effect, {**effect.off, **placed, name: there[name]}) for name in off]
