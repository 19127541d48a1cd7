"""Errors of the models of a diagnosis as a comparison with each of them shows them.

A search weighs what the accuracy of the readings explains by the slopes of the start model, so that all its
models are judged alike. Another model has other slopes, and a comparison with it counts by those: what a step
promises is stated in the terms in which it is shown once it is taken.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.noise import allowing_for_errors


def reweighted(predictor: Predictor, fitted: FittedModel) -> FittedModel:
    """A fitted model whose residual and derivatives are weighed by its own slopes.

    Args:
        predictor: of the search.
        fitted: one of its models.
    """
    if not predictor.reading_errors:
        return fitted  # nothing is weighed
    own = allowing_for_errors(predictor, fitted.fit_model)
    residual = own.residual(fitted.fit_model)
    jacobian = fitted.jacobian
    if fitted.free:
        predicted, derivatives = own.linearised(fitted.fit_model, fitted.free)
        # Where the muscle is slack its force is 0, whatever the derivatives of the unclipped force say.
        same = np.isclose(residual, own.measured - predicted, rtol=1e-9)
        jacobian = own.weighted(np.where(same[:, None], derivatives, 0.0))
    return replace(fitted, residual=own.weighted(residual), jacobian=jacobian)
