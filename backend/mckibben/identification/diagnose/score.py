r"""Score of a model: the held-out error of each fold, plus a penalty for every free parameter.

The score of a model, lower is better, is

.. math:: S = n_e\,\sum_g w_g\ln h_g + k\ln n_e

with the mean square :math:`h_g` of fold g when it is left out, its share :math:`w_g` of the rows, the number
k of free parameters, and the effective number of rows :math:`n_e`. The sum is averaged over the ways of
folding. :math:`n_e` is below the number of rows because the residuals of an incomplete model are
autocorrelated. A parameter at a bound of its plausible range, or one that the data cannot separate from
others, costs `SCORE.least_score`. The logarithm gives every fold the same weight: without it, an effect that
grows with pressure would be judged by the highest pressure alone.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel, counts
from mckibben.identification.thresholds import SCORE

_ORDER = {"static": 0, "rate": 1, "dynamic": 1, "hysteretic": 2, "measurement": 3}
_SIMPLER = 1e-2  # penalty per step of `_ORDER`; small, so that it decides ties only


def effective_rows(residual: np.ndarray, sweeps: Sequence[np.ndarray], folds: Sequence[np.ndarray]) -> float:
    r"""Number of independent rows: rows over the integrated autocorrelation time 1 + 2 sum rho_k.

    The sum runs within sweeps up to the first correlation below 0.05. The result is at least two per fold.
    """
    centred = residual - np.mean(residual)
    variance = float(np.mean(centred**2))
    if not variance > 0.0:
        return float(len(residual))
    lengths = np.array([len(rows) for rows in sweeps])
    residuals = np.zeros((len(lengths), np.max(lengths)))
    residuals[np.arange(residuals.shape[1]) < lengths[:, None]] = centred[np.concatenate(sweeps)]
    correlation_length = 1.0
    for lag in range(1, residuals.shape[1]):
        products = np.sum(residuals[:, lag:] * residuals[:, :-lag])
        rho = float(products) / float(np.sum(np.maximum(lengths - lag, 0))) / variance
        if rho <= 0.05:
            break
        correlation_length += 2.0 * rho
    return max(len(centred) / correlation_length, 2.0 * sum(len(np.unique(labels)) for labels in folds))


def score(fitted_model: FittedModel, *, rows: float, noise: float | None) -> float:
    """Score S as defined in the docstring of this module."""
    floor = (SCORE.below_floor * (noise or 0.0)) ** 2 + 1e-300
    ways = [
        float(np.average(np.log(np.maximum(squares, floor)), weights=counts(labels)))
        for squares, labels in zip(fitted_model.fold_squares, fitted_model.folds, strict=True)
    ]
    return rows * float(np.mean(ways)) + _penalty(fitted_model, rows)


def score_within(fitted_model: FittedModel, *, rows: float, noise: float | None) -> float:
    """The score S with the mean square of all rows in place of those left out: Schwarz's criterion.

    An error below the noise counts as the noise: further constants can follow it, and say nothing by that.
    """
    floor = (noise or 0.0) ** 2 + 1e-300
    return rows * float(np.log(max(fitted_model.mean_square, floor))) + _penalty(fitted_model, rows)


def _penalty(fitted_model: FittedModel, rows: float) -> float:
    """Of free parameters, implausible ones and less simple kinds of effects."""
    free = len(fitted_model.free) * float(np.log(rows))
    return free + SCORE.least_score * fitted_model.implausible + _complexity(fitted_model)


def _complexity(fitted_model: FittedModel) -> float:
    """Small penalty for less simple kinds of effects, so that ties go to the simpler one."""
    return _SIMPLER * sum(_ORDER.get(effect.type, 0) for effect in fitted_model.fit_model.effects)


def better(after: FittedModel, before: FittedModel, *, rows: float, noise: float | None) -> bool:
    """Whether a model with more parameters is better, with no additional implausible parameter."""
    if after.implausible > before.implausible:
        return False
    gain = 1.0 - after.rmse / before.rmse if before.rmse > 0.0 else 0.0
    least = SCORE.least_gain_at_floor if before.rmse < SCORE.at_floor * (noise or 0.0) else SCORE.least_gain
    drop = score(before, rows=rows, noise=noise) - score(after, rows=rows, noise=noise)
    return gain > least and drop > SCORE.least_score
