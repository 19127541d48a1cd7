"""Bounded least squares with several starts, and a report of parameters that are not determined."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.facts.result import result_class
from mckibben.identification.fit.levenberg import Minimum, minimise
from mckibben.identification.predict.fit_model import Free
from mckibben.identification.residual.correlated import Ways
from mckibben.identification.residual.correlated import covariance as covariance_of

_AT_BOUND = 1e-3  # share of the range; nearer to a bound a parameter counts as being at it
_CORRELATED = 0.95  # correlations above are reported
_UNDETERMINED = 1e10  # condition number of the scaled normal matrix beyond which no errors are given


@dataclass(frozen=True, slots=True)
class Fitted:
    """A fitted parameter; ``stderr`` is None when the data do not determine it."""

    name: str
    value: float
    stderr: float | None
    unit: str
    at_bound: bool


@result_class
class FittedCovariance:
    """Covariance of the fitted parameters that the data determine."""

    names: list[str]
    """effect.parameter, or a dimension of the muscle."""
    matrix: list[list[float]]
    """Products of their SI units, one row per name, shape (names, names)."""


@dataclass(frozen=True, slots=True)
class FitResult:
    """The fitted parameters, their correlations above 0.95 and notes for the user.

    ``covariance`` is None where the data cannot separate the parameters, or where none was determined.
    """

    parameters: tuple[Fitted, ...]
    correlations: tuple[tuple[str, str, float], ...]
    messages: tuple[str, ...]
    covariance: FittedCovariance | None = None

    @property
    def numbers(self) -> list[float]:
        """Values in the order of the free parameters."""
        return [parameter.value for parameter in self.parameters]


def least_squares_fit(
    residual: Callable[[np.ndarray], np.ndarray],
    jacobian: Callable[[np.ndarray], np.ndarray],
    free: Sequence[Free],
    *,
    starts: int = 4,
    seed: int = 0,
    tolerance: float = 1e-12,
    evaluations: int = 200,
    secants: int = 0,
) -> Minimum:
    """Minimise the sum of squared residuals over the free parameters within their bounds.

    Args:
        residual: values -> residuals.
        jacobian: values -> derivatives, shape (residuals, free).
        free: at least one free parameter.
        starts: the given start and ``starts - 1`` random ones inside the bounds; the best result counts.
        seed: of the random starts, so that a fit is repeatable.
        tolerance: relative change of the sum of squares at which the fit stops.
        evaluations: most evaluations from each start.
        secants: see `minimise`.
    """
    lower = np.array([parameter.lower for parameter in free])
    upper = np.array([parameter.upper for parameter in free])
    first = np.array([parameter.start for parameter in free])
    random = np.random.default_rng(seed).uniform(0.02, 0.98, (starts - 1, len(free)))
    best = None
    for start in (first, *(lower + share * (upper - lower) for share in random)):
        minimum = minimise(
            residual, jacobian, start, lower, upper, tolerance=tolerance, evaluations=evaluations,
            secants=secants,
        )  # fmt: skip
        if best is None or minimum.squares < best.squares * (1.0 - 1e-9):
            best = minimum
    assert best is not None  # noqa: S101 - there is always at least the first start
    return best


def separable(jacobian: np.ndarray) -> bool:
    """Whether columns are far enough from being combinations of each other for errors of their numbers."""
    scale = np.linalg.norm(jacobian, axis=0)
    if not np.all(scale > 0.0):
        return False
    unit = jacobian / scale
    return bool(np.linalg.cond(unit.T @ unit) <= _UNDETERMINED)


def fit_report(
    numbers: np.ndarray,
    jacobian: np.ndarray,
    residuals: np.ndarray,
    free: Sequence[Free],
    *,
    noise_lines: Sequence[Ways] = (),
) -> FitResult:
    """What a fit that ended at these numbers determines.

    Standard errors allow for noise that is correlated from row to row
    (`mckibben.identification.residual.correlated`). A parameter at a bound has none, nor has one that the
    data cannot separate from others.

    Args:
        numbers: values of the free parameters.
        jacobian: derivatives of the residuals, shape (residuals, free).
        residuals: there.
        free: the free parameters with their bounds.
        noise_lines: in which the noise may be correlated; without any it is independent.
    """
    span = np.array([parameter.upper - parameter.lower for parameter in free])
    reach = np.linalg.norm(jacobian, axis=0) * span
    blind = reach <= 1e-12 * np.max(reach, initial=0.0)
    ended = np.array([
        min(x - p.lower, p.upper - x) < _AT_BOUND * s for x, p, s in zip(numbers, free, span, strict=True)
    ])  # fmt: skip
    # A law may be flat at a bound to which the data have driven it; where it is off it is none.
    off = np.array([
        p.off is not None and abs(x - p.off) < _AT_BOUND * s
        for x, p, s in zip(numbers, free, span, strict=True)
    ])  # fmt: skip
    at_bound = (ended & ~(blind & off)).tolist()
    blind &= ~np.array(at_bound)
    inner = np.flatnonzero(~np.array(at_bound) & ~blind)
    errors: list[float | None] = [None] * len(free)
    correlations: list[tuple[str, str, float]] = []
    covariance = None
    messages = [f"{p.name} ends at its bound" for p, bound in zip(free, at_bound, strict=True) if bound]
    freedom = len(residuals) - len(free)
    scale = np.linalg.norm(jacobian[:, inner], axis=0)
    messages += [
        f"{p.name} has no effect on the predicted values" for p, idle in zip(free, blind, strict=True) if idle
    ]
    if freedom <= 0:
        messages.append(f"{len(residuals)} values cannot determine {len(free)} parameters")
    elif len(inner):
        if not separable(jacobian[:, inner]):
            alike = ", ".join(free[index].name for index in inner)
            messages.append(f"the data cannot separate {alike}: no standard errors are given")
        else:
            matrix = covariance_of(jacobian[:, inner], residuals, noise_lines)
            unit = jacobian[:, inner] / scale
            normal = unit.T @ unit
            deviation = np.sqrt(np.diag(matrix))
            names = [free[index].name for index in inner]
            covariance = FittedCovariance(names, matrix.tolist())
            for place, index in enumerate(inner):
                errors[index] = float(deviation[place])
            inverse = np.linalg.inv(normal)
            sizes = np.sqrt(np.diag(inverse))
            correlation = inverse / np.outer(sizes, sizes)
            for i, first in enumerate(inner):
                for j, second in enumerate(inner[i + 1 :], i + 1):
                    if abs(correlation[i, j]) > _CORRELATED:
                        pair = (free[first].name, free[second].name, float(correlation[i, j]))
                        correlations.append(pair)
    return FitResult(
        tuple(
            Fitted(p.name, float(x), error, p.unit, bound)
            for p, x, error, bound in zip(free, numbers, errors, at_bound, strict=True)
        ),
        tuple(correlations),
        tuple(messages),
        covariance,
    )
