"""A muscle that its first measurements have changed for good: later ones may go on with it."""

from __future__ import annotations

from mckibben.application.envelope import Envelope
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.residual.digits import brief

_CLOSER = 0.98  # largest error over that of a new muscle with which the muscle counts as used


def preconditioned_model(predictor: Predictor, model: FitModel, envelope: Envelope) -> tuple[FitModel, str]:
    """The model of a muscle used before, as far as in earlier measurements, where data are closer to it.

    Files do not say whether a muscle is the one that was measured before or a new one of the same kind.

    Args:
        predictor: the later data.
        model: fitted to earlier data; it takes the muscle as new where it does not say how far it was used.
        envelope: ranges of the earlier data.

    Returns:
        The model, and a sentence; the model as it was and "" where nothing lasts or the muscle is closer to
        a new one.
    """
    changes = {
        f"{effect.id}.{state.lasting}": (effect, envelope[state.largest].most)
        for effect in model.effects
        for state in effect.states
        if state.lasting and model.values[effect.id][state.lasting] == 0.0 and state.largest in envelope
    }
    numbers = {
        name: min(most, effect.parameter(name.partition(".")[2]).upper)
        for name, (effect, most) in changes.items()
        if most > 0.0
    }
    if not numbers:
        return model, ""
    used = model.with_numbers(list(numbers), list(numbers.values()))
    new, after = (predictor.rmse(predictor.residual(each)) for each in (model, used))
    if not after < _CLOSER * new:
        return model, ""
    titles = " and ".join(dict.fromkeys(effect.title for effect, _ in changes.values()))
    stated = ", ".join(f"{name} = {number:.3g}" for name, number in numbers.items())
    factor, unit = {"m": (1e3, " mm"), "1": (1.0, " times the noise")}.get(
        predictor.unit, (1.0, f" {predictor.unit}")
    )
    return used, (
        f"{titles}: the muscle is taken as used before, as far as in the measurements of the model "
        f"({stated}): error {brief(factor * after)}{unit}, as a new muscle {brief(factor * new)}{unit}"
    )
