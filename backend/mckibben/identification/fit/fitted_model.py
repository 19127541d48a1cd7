"""A fitted model of a search: its parameters, its residual and its held-out error."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mckibben.identification.fit.effort import FitEffort, search_effort
from mckibben.identification.fit.least_squares import separable
from mckibben.identification.fit.misfit import Misfit, penalised
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.correlated import (
    Noises,
    Ways,
    Weighed,
    covariance,
    log_likelihood,
    weighed_noises,
)

_NEAR_BOUND = 1e-6  # share of the range; nearer to a bound a parameter cannot move
_BESIDE = 0.01  # of a range; so far beyond its end is still within
_AT_BOUND = 1e-3  # share of the range; nearer to a bound a parameter counts as being at it
_COLLINEAR = 3e-3  # singular value of the normalised Jacobian below which parameters are not separable
_CUTOFF = 1e-13  # share of the largest singular value below which a direction is not determined
_STOPPED = 1000  # implausible parameters that a model whose run stopped counts as
_DECADES = 30.0  # upper over lower bound from which a parameter is a scale, taken by its logarithm


@dataclass(frozen=True, eq=False)
class FittedModel:
    """A fitted model.

    Attributes:
        fit_model: the model with the fitted values.
        free: the free parameters; their starts are the fitted values.
        freed: names of further constants that were freed.
        residual: measured minus predicted, weighted (over the scale, with allowance for reading errors),
            shape (values,).
        jacobian: derivatives of the prediction, weighted likewise, shape (values, free).
        folds: folds of the held-out error, see `mckibben.identification.predict.predictor.Predictor`.
        noise_lines: see `mckibben.identification.predict.predictor.Predictor`.
        aside: values that count for nothing, a mask; None without any.
        lost: number of values without a finite prediction, because a run stopped: their residual is the
            penalty of the optimiser, and no figure of this model may be shown.
    """

    fit_model: FitModel
    free: tuple[Free, ...]
    freed: frozenset[str]
    residual: np.ndarray = field(repr=False)
    jacobian: np.ndarray = field(repr=False)
    folds: tuple[np.ndarray, ...] = field(repr=False)
    lost: int = 0
    noise_lines: Sequence[Ways] = field(default=(), repr=False)
    aside: np.ndarray | None = field(default=None, repr=False)

    @property
    def key(self) -> tuple[frozenset[str], frozenset[str]]:
        """Identity of the model in a search: its effects and freed constants."""
        return frozenset(self.fit_model.ids), self.freed

    @cached_property
    def mean_square(self) -> float:
        """Mean square of the residual."""
        counted = self.residual if self.aside is None else self.residual[~self.aside]
        return float(np.mean(counted**2))

    @property
    def rmse(self) -> float:
        """Root mean square of the residual."""
        return float(np.sqrt(self.mean_square))

    @cached_property
    def inner(self) -> np.ndarray:
        """Indices of the free parameters that are not at a bound and that affect the prediction."""
        scale = np.linalg.norm(self.jacobian, axis=0) if self.free else np.empty(0)
        span = np.array([p.upper - p.lower for p in self.free])
        gap = np.array([min(p.start - p.lower, p.upper - p.start) for p in self.free])
        largest = np.max(scale * span, initial=0.0)
        return np.flatnonzero((gap > _NEAR_BOUND * span) & (scale * span > 1e-12 * largest))

    @cached_property
    def idle(self) -> np.ndarray:
        """Mask of the free parameters that ended at their off value, where they have no effect."""
        return np.array([
            p.off is not None and abs(p.start - p.off) <= _AT_BOUND * (p.upper - p.lower) for p in self.free
        ], dtype=bool)  # fmt: skip

    @cached_property
    def at_bound(self) -> np.ndarray:
        """Mask of the free parameters that ended at a bound of their plausible range and have an effect.

        A natural bound, such as 0 or 1 of a share, is a plausible value and does not count.
        """
        span = np.array([p.upper - p.lower for p in self.free])
        gap = np.array([min(p.start - p.lower, p.upper - p.start) for p in self.free])
        natural = np.array([p.natural for p in self.free], dtype=bool)
        return (gap <= _AT_BOUND * span) & ~self.idle & ~natural

    @cached_property
    def implausible(self) -> int:
        """Number of parameters at a bound, beyond what muscles were found to have, or not separable from
        others; many where a run stopped.
        """
        if self.lost:
            return _STOPPED
        beyond = sum(p.measured is not None and not _within(p.start, p.measured) for p in self.free)
        inner = self.jacobian[:, ~self.at_bound & ~self.idle]
        if not inner.shape[1]:
            return beyond + int(np.count_nonzero(self.at_bound))
        scale = np.linalg.norm(inner, axis=0)
        weak = np.linalg.svd(inner / np.where(scale > 0.0, scale, 1.0), compute_uv=False) < _COLLINEAR
        return beyond + int(np.count_nonzero(self.at_bound) + np.count_nonzero(weak))

    @cached_property
    def noises(self) -> list[list[Weighed]]:
        """Of each channel, what its noise may be if the model is right."""
        inner = self.jacobian[:, self.inner]
        return [weighed_noises(inner, self.residual, ways) for ways in self.noise_lines]

    @cached_property
    def log_likelihood(self) -> float:
        """Log likelihood of the residual under the noise that suits it best, up to a constant."""
        return log_likelihood(self.jacobian[:, self.inner], self.residual, self.noise_lines)

    @property
    def standard_errors(self) -> list[float | None]:
        """Standard errors of the free parameters; None at a bound or where the data do not determine it."""
        return self.standard_errors_under(self.noises)

    def standard_errors_under(self, noises: Noises) -> list[float | None]:
        """`standard_errors` with noise that is known from a better model, of the size of this residual."""
        errors: list[float | None] = [None] * len(self.free)
        inner = [i for i in self.inner if not self.at_bound[i]]
        if not inner or self.implausible:
            return errors
        if len(self.residual) > len(inner) and separable(self.jacobian[:, inner]):
            matrix = covariance(self.jacobian[:, inner], self.residual, noises=noises or None)
            for place, index in enumerate(inner):
                errors[index] = float(np.sqrt(max(matrix[place, place], 0.0)))
        return errors

    @cached_property
    def fold_squares(self) -> tuple[np.ndarray, ...]:
        r"""Hold-out mean square of each fold, for each way of folding, without refitting.

        Leaving fold g out changes the parameters to first order by

        .. math:: -(J^TJ - J_g^TJ_g + \Lambda)^{+}\,(J_g^Tr_g + \Lambda(\theta-\theta_{off}))

        within their bounds. For a model that is linear in its parameters the result is exact. The prior
        :math:`\Lambda`, one standard deviation of the residual over the range of a parameter, matters only
        where fold g alone determines a parameter: without fold g, the parameter then goes to its off value.
        A scale whose plausible range spans decades grows by its logarithm at most: along its slope a short
        way would become a hundred times as long, where the slope says nothing any more.
        """
        return tuple(
            np.array([self.square_without(labels == label) for label in np.unique(labels)])
            for labels in self.folds
        )

    def square_without(self, rows: np.ndarray) -> float:
        """Hold-out mean square of some rows (a mask), as `fold_squares` defines it."""
        jacobian, normal, low, high, prior, pull = self._linear
        if self.aside is not None:
            rows = rows & ~self.aside if np.any(rows & ~self.aside) else rows
        out, left = jacobian[rows], self.residual[rows]
        if jacobian.shape[1]:
            inverse = np.linalg.pinv(normal - out.T @ out + np.diag(prior), rcond=_CUTOFF, hermitian=True)
            left = left - out @ np.clip(-inverse @ (out.T @ left + pull), low, high)
        return float(np.mean(left**2))

    @cached_property
    def _linear(self) -> tuple[np.ndarray, ...]:
        """Of the inner parameters over their ranges: Jacobian, normal matrix, bounds, prior and its pull."""
        inner = self.inner
        free = [self.free[i] for i in inner]
        span = np.array([_span(p) for p in free])
        jacobian = self.jacobian[:, inner] * span
        low, high = (np.array([_way(p, getattr(p, end)) for p in free]) / span for end in ("lower", "upper"))
        prior = np.array([0.0 if p.off is None else self.mean_square for p in free])
        pull = np.array([0.0 if p.off is None else self.mean_square * (p.start - p.off) for p in free]) / span
        return jacobian, jacobian.T @ jacobian, low, high, prior, pull

    @cached_property
    def holdout_square(self) -> float:
        """Mean square over all left-out groups together."""
        return float(np.average(self.fold_squares[0], weights=counts(self.folds[0])))

    @property
    def holdout_rmse(self) -> float:
        """Root of `holdout_square`."""
        return float(np.sqrt(self.holdout_square))


def _within(value: float, measured: tuple[float, float]) -> bool:
    """Whether a value is in a range, up to a hundredth of its width beyond it."""
    low, high = measured
    return low - _BESIDE * (high - low) <= value <= high + _BESIDE * (high - low)


def _over_decades(p: Free) -> bool:
    """Whether a parameter is a scale, such as a time or a way, whose plausible range spans decades."""
    return p.off is None and p.lower > 0.0 and p.upper > _DECADES * p.lower and p.start > 0.0


def _span(p: Free) -> float:
    """Range of a parameter; of a scale that of its logarithm, times the scale as it is."""
    return p.start * float(np.log(p.upper / p.lower)) if _over_decades(p) else p.upper - p.lower


def _way(p: Free, end: float) -> float:
    """Way from a parameter's value to a bound; of a scale upwards by its logarithm, which is shorter."""
    return p.start * float(np.log(end / p.start)) if _over_decades(p) and end > p.start else end - p.start


def counts(labels: np.ndarray) -> np.ndarray:
    """Number of rows of each fold, in the order of the labels."""
    return np.unique(labels, return_counts=True)[1]


def refitted(
    predictor: Predictor,
    fit_model: FitModel,
    free: Sequence[Free],
    *,
    freed: Collection[str] = (),
    effort: FitEffort | None = None,
) -> FittedModel:
    """Fit the free parameters jointly from their starts; the default effort is that of a search."""
    if not free:
        return unfitted(predictor, fit_model, freed=freed)
    misfit = Misfit(predictor, fit_model, free)
    numbers = misfit.fit(effort or search_effort(simulated=predictor.simulated))
    ended = misfit.fit_model(numbers)
    # Fits use the unclipped force, which may be negative; the residual uses the force of a slack muscle.
    residual, lost = penalised(predictor, predictor.residual(ended))
    same = np.isclose(residual, -misfit.value(numbers), rtol=1e-9)
    jacobian = np.where(same[:, None], misfit.derivatives(numbers), 0.0)
    at_solution = tuple(replace(p, start=float(x)) for p, x in zip(free, numbers, strict=True))
    return FittedModel(
        ended,
        at_solution,
        frozenset(freed),
        residual,
        jacobian,
        predictor.folds,
        lost=lost,
        noise_lines=predictor.noise_lines,
        aside=predictor.aside,
    )


def unfitted(predictor: Predictor, fit_model: FitModel, *, freed: Collection[str] = ()) -> FittedModel:
    """A model with the values that it has."""
    residual, lost = penalised(predictor, predictor.residual(fit_model))
    empty = np.empty((len(residual), 0))
    return FittedModel(
        fit_model,
        (),
        frozenset(freed),
        residual,
        empty,
        predictor.folds,
        lost=lost,
        noise_lines=predictor.noise_lines,
        aside=predictor.aside,
    )
