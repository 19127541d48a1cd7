"""An entry that may be wrong, with its evidence."""

from __future__ import annotations

from dataclasses import dataclass

from mckibben.identification.diagnose.entries import StatedEntry
from mckibben.identification.fit.fitted_model import FittedModel


@dataclass(frozen=True)
class WrongEntry:
    """A changed entry that explains the data better than, or as well as, effects.

    Attributes:
        entry: what is changed.
        value: the value that explains the data, SI; None for a way of reading.
        stderr: its standard error; None without one.
        explains: share of the start model's mean square over the noise that it explains by itself.
        best: the best model with it; errors in the units of the changed data.
        noise: of the changed data.
        scale: factor between errors of the changed and of the stated data.
        effects: effects that are missing with it.
        instead_of: effects of the best model that it does without, none of their family in their place.
        confidence: probability against the best model without it.
        odds: logarithm of its odds, from evidence and prior; the confidence is limited, because no model is
            exact.
        stands: whether it explains the data better by more than chance, or as well with fewer effects, so
            that it is asked about first.
        kept: whether the user has ruled it out.
    """

    entry: StatedEntry
    value: float | None
    stderr: float | None
    explains: float
    best: FittedModel
    noise: float | None
    scale: float
    effects: tuple[str, ...]
    instead_of: tuple[str, ...]
    confidence: float
    odds: float
    stands: bool
    kept: bool = False


def done_without(best: FittedModel, model: FittedModel) -> tuple[str, ...]:
    """Effects of the best model that another one does without, and without one of their family instead."""
    inside = {effect.id for effect in model.fit_model.effects}
    families = [e.family for e in model.fit_model.effects if e.id not in set(best.fit_model.ids)]
    lost = []
    for effect in best.fit_model.effects:
        if effect.id in inside:
            continue
        if effect.family in families:
            families.remove(effect.family)
        else:
            lost.append(effect.id)
    return tuple(lost)
