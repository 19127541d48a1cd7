"""Effects that these data cannot tell apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.diagnose.search import exchanged
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter

#: Fitted predictions that differ by less than this share of the noise are the same prediction: data of
#: another functional form than ours differ from the best fit by as much.
SAME = 0.5
_COSINE = 0.99
_AS_GOOD = 1.05  # rmse of an exchange whose sensitivity is parallel
_TRIED = 8


@dataclass(frozen=True)
class Alternative:
    """An effect that could stand in for one of the model.

    Attributes:
        of: the effect of the model.
        effect: the one that could be there instead.
        difference: rms difference of the fitted predictions over the noise.
        cosine: of the angle between both sensitivities.
        fitted_model: the model with the exchange.
    """

    of: str
    effect: str
    difference: float
    cosine: float
    fitted_model: FittedModel


def alternatives(fitter: Fitter, best: FittedModel, added: Sequence[str], noise: float) -> list[Alternative]:
    """For each added effect those that, exchanged for it and refitted, predict the same."""
    found = []
    for effect_id in added:
        less = fitter.dropping(best, effect_id)
        inside = set(best.fit_model.ids)
        others = [effect for effect in fitter.candidates if effect.id not in inside]
        own = next(effect for effect in best.fit_model.effects if effect.id == effect_id)
        mine = fitter.changes(less, own)
        for effect in fitter.promising(less, others)[:_TRIED]:
            fitted_model = exchanged(fitter, less, effect)
            difference = float(np.sqrt(np.mean((fitted_model.residual - best.residual) ** 2))) / noise
            cosine = _cosine(mine, fitter.changes(less, effect))
            parallel = abs(cosine) > _COSINE and fitted_model.rmse <= _AS_GOOD * best.rmse
            if difference < SAME or parallel:
                found.append(Alternative(effect_id, effect.id, difference, cosine, fitted_model))
    return found


def same_predictions(fitted_models: Sequence[tuple[str, FittedModel]], noise: float) -> dict[str, list[str]]:
    """Effect -> the others whose fitted model predicts the same."""
    found: dict[str, list[str]] = {name: [] for name, _ in fitted_models}
    for number, (first, one) in enumerate(fitted_models):
        for second, two in fitted_models[number + 1 :]:
            if same(one, two, noise):
                found[first].append(second)
                found[second].append(first)
    return found


def same(one: FittedModel, two: FittedModel, noise: float) -> bool:
    """Whether two fitted models predict the same as far as the noise lets see."""
    return bool(np.mean((one.residual - two.residual) ** 2) < (SAME * noise) ** 2)


def _cosine(first: np.ndarray, second: np.ndarray) -> float:
    pairs = [
        float(a @ b) / (np.linalg.norm(a) * np.linalg.norm(b))
        for a in first.T
        for b in second.T
        if np.any(a) and np.any(b)
    ]
    return float(max(pairs, key=abs, default=0.0))
