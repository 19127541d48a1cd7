"""Which effects of a model correlated noise would not explain as well: backward elimination by likelihood."""

from __future__ import annotations

import numpy as np

from mckibben.identification.diagnose.probability import log_odds
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import PROBABILITY


def needed(after: FittedModel, before: FittedModel) -> float:
    r"""Probability that the effects which one model has and another lacks are there, and not noise.

    Its odds are those of the effects before any data, times the ratio of the likelihoods of
    `mckibben.identification.residual.correlated`, in which each model chooses the noise under which it does
    best, by Schwarz's approximation:

    .. math:: \ln\frac{P}{1-P} = \sum_e\ln\frac{p_e}{1-p_e} + \ell_1 - \ell_0 - \tfrac12(k_1-k_0)\ln n

    Args:
        after: the model with them.
        before: the model without.
    """
    if before.lost:
        return 1.0
    further = [effect for effect in after.fit_model.effects if effect.id not in before.fit_model.ids]
    numbers = len(after.free) - len(before.free)
    odds = sum(map(log_odds, further)) + after.log_likelihood - before.log_likelihood
    odds -= 0.5 * numbers * float(np.log(len(after.residual)))
    return float(1.0 / (1.0 + np.exp(-np.clip(odds, -50.0, 50.0))))


def pruned(fitter: Fitter, model: FittedModel, root: FittedModel) -> FittedModel:
    """The model without the added effects that are likelier noise, the least needed one after the other.

    Args:
        fitter: of the search.
        model: what the search ended with.
        root: the start model, fitted.
    """
    while True:
        added = [name for name in model.fit_model.ids if name not in root.fit_model.ids]
        without = [fitter.dropping(model, name) for name in added]
        least = min(without, key=lambda less: needed(model, less), default=None)
        if least is None or needed(model, least) >= PROBABILITY.likely:
            return model
        model = least
