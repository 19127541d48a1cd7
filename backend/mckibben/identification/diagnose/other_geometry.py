"""Whether the muscle has other dimensions than the model: they may do what effects were added for."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel, refitted
from mckibben.identification.predict.fit_model import FitModel, free_geometry, free_numbers
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.predictor import Predictor

_BY_HAND = ("braid_angle", "braid_diameter", "nominal_length")
_AS_GOOD = 1.05  # of the error that the effects leave
_PLAUSIBLE = 0.6  # of what a fit of geometry may change


def geometry_instead(
    predictor: Predictor,
    first: FitModel,
    best: FittedModel,
    *,
    held: Collection[str] = (),
    load: Free | None = None,
) -> list[str]:
    """The dimension that explains the data as well as the added effects, in a sentence; empty without one.

    Args:
        predictor: the data.
        first: the start model.
        best: the best model, with effects added to it.
        held: numbers of the start model that no fit changes.
        load: bounds of the load where every fit has to find it.
    """
    found = []
    for name in _BY_HAND:
        (dimension,) = free_geometry(first.muscle, [name], {})
        numbers = free_numbers(first, [dimension], load=load)
        free = [parameter for parameter in numbers if parameter.name not in held]
        fitted_model = refitted(predictor, first, free)
        value = fitted_model.fit_model.number(name)
        moved = abs(value - dimension.start) / (dimension.upper - dimension.start)
        if moved < _PLAUSIBLE and fitted_model.rmse <= _AS_GOOD * best.rmse:
            given = _shown(dimension.start, dimension.unit)
            found.append(f"a {name.replace('_', ' ')} of {_shown(value, dimension.unit)} instead of {given}")
    if not found:
        return []
    return [f"{' or '.join(found)} would explain these data as well as the added effects: measure it first"]


def _shown(value: float, unit: str) -> str:
    return f"{np.degrees(value):.2f}°" if unit == "rad" else f"{1e3 * value:.4g} mm"
