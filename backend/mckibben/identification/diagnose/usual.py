"""Constants that the data do not tell, at their usual values.

Friction in a test at one pressure, say, fits alike whether it grows with the pressure or not. What it does at
another one is not known from the data, but the gas mostly presses the threads together: a model that has to
predict other conditions does better with what muscles mostly do, and says so.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import USUAL


def as_usual(
    fitter: Fitter, best: FittedModel, added: Collection[str], *, value: Callable[[FittedModel], float]
) -> FittedModel:
    """The model with the usual values of constants that these data do not tell, refitted.

    Args:
        fitter: of the search.
        best: its best model, or one that fits as well.
        added: ids of the effects that the search added; constants of others stay.
        value: score of a model.
    """
    for name, usual in _untold(best, added):
        if best.fit_model.number(name) == usual:
            continue
        other = fitter.at_constant(best, name, usual)
        alike = value(other) < value(best) + USUAL.told or other.rmse < USUAL.alike * best.rmse
        if alike and other.implausible <= best.implausible:
            best = fitter.known[other.key] = other
    return best


def taken_as_usual(best: FittedModel, added: Collection[str]) -> list[str]:
    """Notes on the constants of added effects that have their usual value because the data do not tell it."""
    notes = []
    for name, usual in _untold(best, added):
        if best.fit_model.number(name) == usual:
            effect_id, _, parameter = name.partition(".")
            effect = next(effect for effect in best.fit_model.effects if effect.id == effect_id)
            words = parameter.replace("_", " ")
            notes.append(
                f"{effect.title}: the {words} is taken as {usual:g}, as usual; these data do not tell it"
            )
    return notes


def _untold(best: FittedModel, added: Collection[str]) -> list[tuple[str, float]]:
    """Names of constants of added effects that have a usual value and are not fitted, and that value."""
    return [
        (f"{effect.id}.{p.name}", p.usual)
        for effect in best.fit_model.effects
        for p in effect.parameters
        if p.usual is not None and effect.id in added and f"{effect.id}.{p.name}" not in best.freed
    ]
