"""Which effects of a model correlated noise would not explain as well: backward elimination by likelihood."""

from __future__ import annotations

import numpy as np

from mckibben.identification.diagnose.score import LEAST_SCORE
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter


def needed(after: FittedModel, before: FittedModel) -> float:
    r"""How much more likely a model is with further free numbers than their number alone makes it.

    .. math:: 2(\ell_1 - \ell_0) - (k_1 - k_0)\ln n - S

    with the likelihoods of `mckibben.identification.residual.correlated`, in which each model chooses the
    noise under which it does best, and S = `LEAST_SCORE`: above 0 the further numbers are needed.

    Args:
        after: the model with them.
        before: the model without.
    """
    if before.lost:
        return np.inf
    further = len(after.free) - len(before.free)
    gain = 2.0 * (after.log_likelihood - before.log_likelihood)
    return gain - further * float(np.log(len(after.residual))) - LEAST_SCORE


def pruned(fitter: Fitter, model: FittedModel, root: FittedModel) -> FittedModel:
    """The model without the added effects that noise explains as well, the least needed one after the other.

    Args:
        fitter: of the search.
        model: what the search ended with.
        root: the start model, fitted.
    """
    while True:
        added = [name for name in model.fit_model.ids if name not in root.fit_model.ids]
        without = [fitter.dropping(model, name) for name in added]
        least = min(without, key=lambda less: needed(model, less), default=None)
        if least is None or needed(model, least) > 0.0:
            return model
        model = least
