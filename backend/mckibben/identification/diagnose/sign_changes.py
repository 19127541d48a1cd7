"""Constants of the start model whose sign a fit has turned: something else may have moved them."""

from __future__ import annotations

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict.fit_model import FitModel

_PARALLEL = 0.9  # cosine between changes of the prediction above which an effect could have moved a constant
_TOLD = 4  # most effects named per constant


def sign_changes(fitter: Fitter, first: FitModel, best: FittedModel) -> list[str]:
    """A sentence on each constant whose sign has changed, with what else could have moved it.

    Args:
        fitter: of the search.
        first: the start model as given.
        best: the best model.
    """
    inside = set(best.fit_model.ids)
    notes = []
    for place, free in enumerate(best.free):
        effect_id, _, parameter = free.name.partition(".")
        if not parameter or effect_id not in first.ids:
            continue
        before, after = first.number(free.name), best.fit_model.number(free.name)
        if not before * after < 0.0:
            continue
        column = best.jacobian[:, place]
        alike = []
        for effect in fitter.candidates:
            if effect.id in inside:
                continue
            cosine = max((_cosine(column, change) for change in fitter.changes(best, effect).T), default=0.0)
            if cosine > _PARALLEL:
                alike.append((cosine, effect.title))
        names = [title for _, title in sorted(alike, reverse=True)[:_TOLD]]
        else_ = f": {', '.join(names)} could have moved it instead" if names else ""
        notes.append(
            f"the fit reversed the sign of {free.name}, from {before:.4g} to {after:.4g} {free.unit}{else_}"
        )
    return notes


def _cosine(one: np.ndarray, other: np.ndarray) -> float:
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return abs(float(one @ other)) / size if size > 0.0 else 0.0
