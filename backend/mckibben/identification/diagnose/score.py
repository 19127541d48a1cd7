r"""When is a model better than another: hold-out error fold by fold, and a price for every number.

The score of a model, lower is better, is

.. math:: S = n_e\,\sum_g w_g\ln h_g + k\ln n_e

with the mean square :math:`h_g` of fold g when it is left out, its share :math:`w_g` of the rows (the mean
over the ways of leaving out), the number k of free numbers, and the effective number of rows :math:`n_e`,
because neighbouring residuals are alike as long as something is missing. A number at the bound of what is
plausible, or one that others can stand in for, costs as much as an addition must bring. The logarithm makes
the folds equal: an effect whose size grows with pressure would otherwise be judged by the highest alone.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel, counts

#: A model must lower the score by this much: between "strong" (6) and "very strong" (10) on the scale of
#: Kass & Raftery (1995).
LEAST_SCORE = 8.0
#: An addition must lower the rms error by this share, else it is not worth a number.
LEAST_GAIN = 0.02
#: The same where the error is within 15 % of the noise: what is left there may be the form of a right effect.
LEAST_GAIN_AT_FLOOR = 0.05
#: An error of at most this many times the noise has reached it: the noise itself is an estimate.
AT_FLOOR = 1.15
_ORDER = {"static": 0, "rate": 1, "dynamic": 1, "hysteretic": 2, "measurement": 3}
_SIMPLER = 1e-2  # of the score for each step of this order: decides ties only
_BELOW_FLOOR = 0.5  # errors below this share of the noise are luck


def effective_rows(residual: np.ndarray, sweeps: Sequence[np.ndarray], folds: Sequence[np.ndarray]) -> float:
    r"""Number of independent rows: rows over the integrated autocorrelation time 1 + 2 sum rho_k.

    The sum runs within sweeps until the first correlation below 0.05; at least two for each fold.
    """
    centred = residual - np.mean(residual)
    variance = float(np.mean(centred**2))
    if not variance > 0.0:
        return float(len(residual))
    lines = [centred[rows] for rows in sweeps]
    length = 1.0
    for lag in range(1, max(map(len, lines))):
        products = [line[lag:] * line[:-lag] for line in lines if len(line) > lag]
        rho = sum(float(np.sum(p)) for p in products) / sum(map(len, products)) / variance
        if rho <= 0.05:
            break
        length += 2.0 * rho
    return max(len(centred) / length, 2.0 * sum(len(np.unique(labels)) for labels in folds))


def score(fitted_model: FittedModel, *, rows: float, noise: float | None) -> float:
    """S of the module's docstring."""
    floor = (_BELOW_FLOOR * (noise or 0.0)) ** 2 + 1e-300
    ways = [
        float(np.average(np.log(np.maximum(squares, floor)), weights=counts(labels)))
        for squares, labels in zip(fitted_model.fold_squares, fitted_model.folds, strict=True)
    ]
    price = len(fitted_model.free) * float(np.log(rows)) + LEAST_SCORE * fitted_model.implausible
    return rows * float(np.mean(ways)) + price + _complexity(fitted_model)


def _complexity(fitted_model: FittedModel) -> float:
    """Names the simpler one of two effects that predict the same."""
    return _SIMPLER * sum(_ORDER.get(effect.type, 0) for effect in fitted_model.fit_model.effects)


def log_ratio(before: FittedModel, after: FittedModel) -> tuple[float, float]:
    """Mean over groups of ln(error before / error after) in rms, and its standard error."""
    first, second = (np.maximum(fitted_model.fold_squares[0], 1e-300) for fitted_model in (before, after))
    ratios = 0.5 * np.log(first / second)
    return float(np.mean(ratios)), float(np.std(ratios, ddof=1) / np.sqrt(len(ratios)))


def better(after: FittedModel, before: FittedModel, *, rows: float, noise: float | None) -> bool:
    """Whether a model with more numbers earns them, and none of them is implausible."""
    if after.implausible > before.implausible:
        return False
    gain = 1.0 - after.rmse / before.rmse if before.rmse > 0.0 else 0.0
    least = LEAST_GAIN_AT_FLOOR if before.rmse < AT_FLOOR * (noise or 0.0) else LEAST_GAIN
    drop = score(before, rows=rows, noise=noise) - score(after, rows=rows, noise=noise)
    return gain > least and drop > LEAST_SCORE
