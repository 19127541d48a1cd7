"""Checks whether a wrong dimension of the muscle explains the data as well as the added effects."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel, refitted
from mckibben.identification.predict.fit_model import FitModel, free_geometry, free_numbers
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.predictor import Predictor

# Dimensions that are measured by hand, so most likely wrong.
_BY_HAND = ("braid_angle", "braid_diameter", "nominal_length")
_AS_GOOD = 1.05  # largest error, relative to the error with the added effects
_PLAUSIBLE = 0.6  # largest change, share of the tolerance of the dimension


def geometry_instead(
    predictor: Predictor,
    first: FitModel,
    best: FittedModel,
    *,
    fixed: Collection[str] = (),
    load: Free | None = None,
) -> list[str]:
    """A sentence on the dimensions that explain the data as well as the added effects; empty without any.

    Args:
        predictor: the data.
        first: the start model.
        best: the best model, with effects added to it.
        fixed: parameters of the start model that no fit changes.
        load: bounds of the load, when it is unknown and fitted.
    """
    explanations = []
    for name in _BY_HAND:
        (dimension,) = free_geometry(first.muscle, [name], {})
        choice = free_numbers(first, [dimension], load=load)
        free = [parameter for parameter in choice if parameter.name not in fixed]
        fitted_model = refitted(predictor, first, free)
        value = fitted_model.fit_model.number(name)
        change = abs(value - dimension.start) / (dimension.upper - dimension.start)
        if change < _PLAUSIBLE and fitted_model.rmse <= _AS_GOOD * best.rmse:
            stated = _shown(dimension.start, dimension.unit)
            explanations.append(
                f"a {name.replace('_', ' ')} of {_shown(value, dimension.unit)} instead of {stated}"
            )
    if not explanations:
        return []
    return [
        f"{' or '.join(explanations)} would explain these data as well as the added effects: measure it first"
    ]


def _shown(value: float, unit: str) -> str:
    return f"{np.degrees(value):.2f}°" if unit == "rad" else f"{1e3 * value:.4g} mm"
