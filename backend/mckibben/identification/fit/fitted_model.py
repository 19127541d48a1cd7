"""One fitted model in a search: its numbers, its residuals, and how it does on what it was not fitted to."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mckibben.identification.fit.effort import FitEffort, search_effort
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.predictor import Predictor

_NEAR_BOUND = 1e-6  # of the range
_AT_BOUND = 1e-3  # of the range
_COLLINEAR = 3e-3  # singular value of the normalised Jacobian below which numbers stand in for each other
_CUTOFF = 1e-13  # of the largest singular value, below which a direction is not determined


@dataclass(frozen=True, eq=False)
class FittedModel:
    """A fitted model.

    Attributes:
        fit_model: with the fitted numbers.
        free: what was free, starts at the fitted numbers.
        freed: names of further constants that were freed.
        residual: measured minus predicted over the scale, shape (values,).
        jacobian: derivatives of the prediction over the scale, shape (values, free).
        folds: ways of leaving out, see `mckibben.identification.predict.predictor.Predictor`.
    """

    fit_model: FitModel
    free: tuple[Free, ...]
    freed: frozenset[str]
    residual: np.ndarray = field(repr=False)
    jacobian: np.ndarray = field(repr=False)
    folds: tuple[np.ndarray, ...] = field(repr=False)

    @property
    def key(self) -> tuple[frozenset[str], frozenset[str]]:
        """What was searched: the effects and the freed constants."""
        return frozenset(self.fit_model.ids), self.freed

    @cached_property
    def mean_square(self) -> float:
        """Of the residual."""
        return float(np.mean(self.residual**2))

    @property
    def rmse(self) -> float:
        """Root mean square of the residual."""
        return float(np.sqrt(self.mean_square))

    @cached_property
    def inner(self) -> np.ndarray:
        """Indices of the free numbers that are not at a bound and that the data see."""
        scale = np.linalg.norm(self.jacobian, axis=0) if self.free else np.empty(0)
        span = np.array([p.upper - p.lower for p in self.free])
        gap = np.array([min(p.start - p.lower, p.upper - p.start) for p in self.free])
        largest = np.max(scale * span, initial=0.0)
        return np.flatnonzero((gap > _NEAR_BOUND * span) & (scale * span > 1e-12 * largest))

    @cached_property
    def idle(self) -> np.ndarray:
        """Which free numbers ended where they do nothing, mask."""
        return np.array([
            p.off is not None and abs(p.start - p.off) <= _AT_BOUND * (p.upper - p.lower) for p in self.free
        ], dtype=bool)  # fmt: skip

    @cached_property
    def at_bound(self) -> np.ndarray:
        """Which free numbers ended at a bound of what is plausible and still do something, mask.

        Where a bound is the end of the definition, as of a share, a value there is plausible.
        """
        span = np.array([p.upper - p.lower for p in self.free])
        gap = np.array([min(p.start - p.lower, p.upper - p.start) for p in self.free])
        natural = np.array([p.natural for p in self.free], dtype=bool)
        return (gap <= _AT_BOUND * span) & ~self.idle & ~natural

    @cached_property
    def implausible(self) -> int:
        """How many numbers are at a bound, or are determined only together with others."""
        inner = self.jacobian[:, ~self.at_bound & ~self.idle]
        if not inner.shape[1]:
            return int(np.count_nonzero(self.at_bound))
        scale = np.linalg.norm(inner, axis=0)
        weak = np.linalg.svd(inner / np.where(scale > 0.0, scale, 1.0), compute_uv=False) < _COLLINEAR
        return int(np.count_nonzero(self.at_bound) + np.count_nonzero(weak))

    @cached_property
    def standard_errors(self) -> list[float | None]:
        """Of the free numbers; None at a bound, or where the data do not determine it."""
        errors: list[float | None] = [None] * len(self.free)
        inner = [i for i in self.inner if not self.at_bound[i]]
        if not inner or self.implausible:
            return errors
        jacobian = self.jacobian[:, inner]
        variance = self.mean_square * len(self.residual) / max(len(self.residual) - len(inner), 1)
        covariance = variance * np.linalg.pinv(jacobian.T @ jacobian)
        for place, index in enumerate(inner):
            errors[index] = float(np.sqrt(max(covariance[place, place], 0.0)))
        return errors

    @cached_property
    def fold_squares(self) -> tuple[np.ndarray, ...]:
        r"""Mean square of what is left out, per fold of each way of folding, without refitting.

        Leaving fold g out moves the numbers to first order by

        .. math:: -(J^TJ - J_g^TJ_g + \Lambda)^{+}\,(J_g^Tr_g + \Lambda(\theta-\theta_{off}))

        within their bounds; for a model that is linear in its numbers this is the exact hold-out residual.
        The prior :math:`\Lambda`, one noise over the whole range of a number, matters only where fold g alone
        determines a number: without it nobody would know of the effect, so it goes to where it does nothing.
        """
        inner = self.inner
        free = [self.free[i] for i in inner]
        span = np.array([p.upper - p.lower for p in free])
        jacobian = self.jacobian[:, inner] * span
        normal = jacobian.T @ jacobian
        here = np.array([p.start for p in free])
        low, high = ((np.array([getattr(p, end) for p in free]) - here) / span for end in ("lower", "upper"))
        prior = np.array([0.0 if p.off is None else self.mean_square for p in free])
        pull = np.array([0.0 if p.off is None else self.mean_square * (p.start - p.off) for p in free]) / span

        def square(rows: np.ndarray) -> float:
            out, left = jacobian[rows], self.residual[rows]
            if len(inner):
                inverse = np.linalg.pinv(normal - out.T @ out + np.diag(prior), rcond=_CUTOFF, hermitian=True)
                left = left - out @ np.clip(-inverse @ (out.T @ left + pull), low, high)
            return float(np.mean(left**2))

        return tuple(
            np.array([square(labels == label) for label in np.unique(labels)]) for labels in self.folds
        )

    @cached_property
    def holdout_square(self) -> float:
        """Mean square over all left-out groups together."""
        return float(np.average(self.fold_squares[0], weights=counts(self.folds[0])))

    @property
    def holdout_rmse(self) -> float:
        """Root of `holdout_square`."""
        return float(np.sqrt(self.holdout_square))


def counts(labels: np.ndarray) -> np.ndarray:
    """Rows of each fold, in the order of its label."""
    return np.unique(labels, return_counts=True)[1]


def refitted(
    predictor: Predictor,
    fit_model: FitModel,
    free: Sequence[Free],
    *,
    freed: Collection[str] = (),
    effort: FitEffort | None = None,
) -> FittedModel:
    """Fit the free numbers jointly from their starts; without an effort as tightly as a search needs it."""
    if not free:
        residual = predictor.residual(fit_model) / predictor.scale
        empty = np.empty((len(residual), 0))
        return FittedModel(fit_model, (), frozenset(freed), residual, empty, predictor.folds)
    misfit = Misfit(predictor, fit_model, free)
    result = misfit.fit(effort or search_effort(simulated=predictor.simulated))
    numbers = np.array(result.numbers)
    ended = misfit.fit_model(numbers)
    # Fits follow the force below zero too; what counts is what a slack muscle reads.
    residual = predictor.residual(ended) / predictor.scale
    same = np.isclose(residual, -misfit.value(numbers), rtol=1e-9)
    jacobian = np.where(same[:, None], misfit.derivatives(numbers), 0.0)
    there = tuple(replace(p, start=float(x)) for p, x in zip(free, numbers, strict=True))
    return FittedModel(ended, there, frozenset(freed), residual, jacobian, predictor.folds)
