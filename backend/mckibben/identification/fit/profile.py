r"""Profile likelihood of a fitted constant: how much worse the model fits where it has another value.

.. math:: D(c) = \frac{n - p}{g} \left(\frac{S(c)}{S(\hat c)} - 1\right), \qquad S(c) = \min_\theta \sum r^2

All other p - 1 fitted constants are fitted again at each value, and the noise is that of the best fit.
Correlated noise makes neighbouring rows repeat each other: g is the variance of the constant under such noise
over that under white noise. Where D is below the quantile of a chi-squared with one degree of freedom, the
value is within the interval.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.special import gammaincinv

from mckibben.facts.result import Series, result_class
from mckibben.identification.fit.comparison import Comparison
from mckibben.identification.fit.effort import FitEffort
from mckibben.identification.fit.fitted_model import FittedModel, refitted
from mckibben.identification.predict.fit_model import FitModel, Free, with_values
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.errors import InputError, did_you_mean

_FAR = 1.5  # deviance over that of the interval up to which values are tried
_FIRST = 0.4  # first way from the best value, in standard errors
_GROWTH = 1.35  # each way over the one before
_CLOSER, _LEAST = 0.2, 1e-4  # a first way that was too long is shortened, down to a share of it
_BLIND = 0.01  # first way where there is no standard error, share of the range between the bounds
_MOST = 24  # values tried on either side
_EFFORT = FitEffort(1, 1e-8, 100)


@result_class
class Profile:
    """Profile likelihood of a constant."""

    name: str
    """The constant, as effect.parameter."""
    unit: str
    """Its SI unit."""
    best: float
    """The value with the least error."""
    stderr: float | None
    """Its standard error by the curvature at the best value; None where that says nothing."""
    share: float
    """Share of the interval."""
    limit: float
    """Deviance at the ends of the interval."""
    low: float | None
    """Lower end of the interval; None where the data do not bound it within its plausible range."""
    high: float | None
    """Upper end, likewise."""
    value: Series
    """The values that were tried, ascending; shape (n,)."""
    deviance: Series
    """Twice the log likelihood that is lost at each, 0 at the best; shape (n,)."""
    rmse: Series
    """Error with the other constants fitted again, in the unit of the comparison; shape (n,)."""


class _Tried(NamedTuple):
    value: float
    square: float
    model: FitModel


def profile(comparison: Comparison, name: str, *, share: float = 0.95) -> Profile:
    """The profile of a fitted constant.

    Args:
        comparison: with a fit.
        name: of the constant, "effect.parameter", a geometry field or what else was fitted.
        share: of the interval.

    Raises:
        InputError: nothing or something else was fitted.
    """
    if not 0.5 <= share < 1.0:
        raise InputError(f"a share of {share:g} is not between 0.5 and 1", field="share")
    free = comparison.free if comparison.fit is not None else ()
    known = [p.name for p in free]
    if name not in known:
        what = "no fit was requested" if not known else f"'{name}' was not fitted"
        hint = "fit=True" if not known else did_you_mean(name, known)
        raise InputError(what, field="name", hint=hint)
    target = free[known.index(name)]
    others = [p for p in free if p.name != name]
    predictor = comparison.predictor
    best = refitted(predictor, comparison.fit_model, free, effort=_EFFORT)
    at_best = best.fit_model.number(name)
    stderr = best.standard_errors[known.index(name)]
    widened = _widened(best, known.index(name), stderr)
    counted = len(best.residual) if best.aside is None else int(np.count_nonzero(~best.aside))
    counted = max(counted - len(free), 1)
    limit = 2.0 * float(gammaincinv(0.5, share))  # of chi-squared; scipy.stats takes a second to import
    step = _FIRST * stderr if stderr else _BLIND * (target.upper - target.lower)
    middle = _Tried(at_best, best.mean_square, best.fit_model)
    found = [middle]
    for sign in (-1.0, 1.0):
        here, way = middle, step
        for _ in range(_MOST):
            value = min(max(here.value + sign * way, target.lower), target.upper)
            if value == here.value:
                break
            tried = _at(predictor, here.model, target, value, others)
            found.append(tried)
            lost = counted * (tried.square / middle.square - 1.0) / widened
            if here is middle and lost > _FAR * limit and way > _LEAST * step:
                way *= _CLOSER  # the first way was too long to see the course
                continue
            if lost > _FAR * limit:
                break
            here, way = tried, way * _GROWTH
    found.sort()
    values, squares = (np.array(column) for column in ([t.value for t in found], [t.square for t in found]))
    least = int(np.argmin(squares))
    deviance = counted * (squares / squares[least] - 1.0) / widened
    return Profile(
        name=name,
        unit=target.unit,
        best=float(values[least]),
        stderr=stderr,
        share=share,
        limit=limit,
        low=_crossing(values[: least + 1][::-1], deviance[: least + 1][::-1], limit),
        high=_crossing(values[least:], deviance[least:], limit),
        value=values,
        deviance=deviance,
        rmse=np.sqrt(squares),
    )


def _at(
    predictor: Predictor, fit_model: FitModel, target: Free, value: float, others: Sequence[Free]
) -> _Tried:
    """The best fit at a value of the constant, from a fit beside it."""
    fixed = with_values(fit_model, [target], [value])
    free = [replace(p, start=min(max(fixed.number(p.name), p.lower), p.upper)) for p in others]
    fitted = refitted(predictor, fixed, free, effort=_EFFORT)
    return _Tried(value, fitted.mean_square, fitted.fit_model)


def _widened(best: FittedModel, place: int, stderr: float | None) -> float:
    """The variance of a constant under the noise that suits the residual, over that under white noise."""
    inner = list(best.inner)
    if stderr is None or place not in inner:
        return 1.0
    jacobian = best.jacobian[:, inner]
    left = max(len(best.residual) - len(inner), 1)
    white = np.linalg.pinv(jacobian.T @ jacobian) * float(best.residual @ best.residual) / left
    variance = float(white[inner.index(place), inner.index(place)])
    return stderr**2 / variance if variance > 0.0 and stderr > 0.0 else 1.0


def _crossing(values: np.ndarray, deviance: np.ndarray, limit: float) -> float | None:
    """Where the deviance first passes the limit; None where it does not. Roots are linear in the value."""
    roots, wanted = np.sqrt(np.maximum(deviance, 0.0)), float(np.sqrt(limit))
    for place in range(1, len(values)):
        if roots[place] >= wanted:
            share = (wanted - roots[place - 1]) / (roots[place] - roots[place - 1])
            return float(values[place - 1] + share * (values[place] - values[place - 1]))
    return None
