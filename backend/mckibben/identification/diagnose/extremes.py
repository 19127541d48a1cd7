"""Choice between models that fit alike: by their prediction of the ends of the data that are left out.

Levels of pressure, lengths, speeds and loads that lie outside the others are what a repaired model has to
predict later. Two models whose scores differ by less than chance may differ there by much: an effect that
acts at one end of the data alone can imitate what another one does everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mckibben.identification.diagnose.score import score
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.thresholds import ENDS, SCORE

_INPUTS = ("pressure", "length", "velocity", "load", "time")


def ends_of(predictor: Predictor) -> list[np.ndarray]:
    """Masks of the rows at either end of each input, and of the fastest motion."""
    ends = []
    for name in _INPUTS:
        values = predictor.inputs.get(name)
        if values is None or not np.ptp(values) > 0.0:
            continue
        low, high = np.quantile(values, [ENDS.share, 1.0 - ENDS.share])
        if name == "velocity":
            ends.append(np.abs(values) >= np.quantile(np.abs(values), 1.0 - ENDS.share))
        else:
            ends += [values <= low, values >= high]
    return [end for end in ends if 0 < np.count_nonzero(end) <= ENDS.most * len(end)]


def reaching_farthest(
    best: FittedModel,
    known: Iterable[FittedModel],
    predictor: Predictor,
    *,
    rows: float,
    noise: float | None,
    start: Sequence[str],
) -> FittedModel:
    """Of the models that fit as well as the best one, that which predicts the ends of the data best.

    Args:
        best: the best model of a search.
        known: the models that it visited.
        predictor: the data.
        rows: effective number of rows.
        noise: of the scaled residual.
        start: ids of the effects that every model has.
    """
    ends = ends_of(predictor)
    if not ends or not best.free:
        return best
    floor = (noise or 0.0) ** 2 + 1e-300
    limit = score(best, rows=rows, noise=noise) + SCORE.least_score

    def at_ends(model: FittedModel) -> float:
        return float(np.mean([np.log(max(model.square_without(end), floor)) for end in ends]))

    alike = [
        model
        for model in known
        if model.free
        and len(model.fit_model.ids) <= len(best.fit_model.ids)
        and set(start) <= set(model.fit_model.ids)
        and model.implausible <= best.implausible
        and model.rmse <= ENDS.alike * best.rmse
        and score(model, rows=rows, noise=noise) <= limit
    ]
    farthest = min(alike, key=at_ends, default=best)
    return farthest if at_ends(farthest) < at_ends(best) - ENDS.least else best
