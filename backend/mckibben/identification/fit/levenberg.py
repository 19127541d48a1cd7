r"""Levenberg-Marquardt within bounds, from starts that may lie on a bound.

Most numbers of an effect start where the effect is off, and that is a bound. Interior methods shorten every
step that would cross it, also in the other directions, and stop where they began. Here each step solves

.. math:: \min_d |J d + r|^2 + \lambda |D d|^2, \quad l \le x + d \le u

over the box itself: numbers that would leave it stay at their bound, the others go on.

Where derivatives are dear, some steps change J by Broyden's secant formula instead, in the scaled numbers; a
step that disappoints, and the end of the search, ask for exact ones.

Marquardt, J. SIAM 11 (1963) 431; scaling and tests of convergence as in MINPACK (More, LNM 630, 1978);
change of the damping after Nielsen, IMM-REP-1999-05; Broyden, Math. Comp. 19 (1965) 577.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

_FIRST_DAMPING = 1e-3  # nearly a Gauss-Newton step: the starts are usual values
_LEAST_DAMPING = 1e-12
_MOST_DAMPING = 1e10  # the search gives up beyond
_ACCEPTED = 1e-4  # share of the predicted reduction from which a step is accepted
_KEPT = 0.5  # share of the predicted reduction from which a secant is good enough
_FLAT = 1e-30  # share of the largest column norm below which a parameter changes nothing


@dataclass(frozen=True, slots=True)
class Minimum:
    """The solution: parameter values, and the residuals and their derivatives there."""

    numbers: np.ndarray
    residuals: np.ndarray
    jacobian: np.ndarray

    @property
    def squares(self) -> float:
        """Sum of squared residuals."""
        return float(self.residuals @ self.residuals)


def minimise(
    residual: Callable[[np.ndarray], np.ndarray],
    jacobian: Callable[[np.ndarray], np.ndarray],
    start: np.ndarray,
    lower: np.ndarray,
    upper: np.ndarray,
    *,
    tolerance: float,
    evaluations: int,
    secants: int = 0,
) -> Minimum:
    """Minimise the sum of squared residuals from a start within bounds.

    Args:
        residual: numbers, shape (n,) -> residuals, shape (m,), finite.
        jacobian: numbers -> derivatives, shape (m, n); called where the residuals were just evaluated, with
            secants also where they were evaluated last but one.
        start, lower, upper: shape (n,); a start outside is moved to the bound.
        tolerance: relative reduction of the sum of squares, predicted and achieved, at which it stops.
        evaluations: most evaluations of the residuals.
        secants: most steps in a row without new derivatives.
    """
    x = np.clip(start, lower, upper)
    r, j = residual(x), jacobian(x)
    squares = float(r @ r)
    scale = np.linalg.norm(j, axis=0)
    damping, growth, old = _FIRST_DAMPING, 2.0, 0  # steps since the derivatives were new
    for _ in range(evaluations - 1):
        scale = np.maximum(scale, np.linalg.norm(j, axis=0))
        weights = _weights(scale) ** 2
        d = _step(j, r, damping * weights, lower - x, upper - x)
        linear = j @ d + r
        predicted = squares - float(linear @ linear)
        if not predicted > 0.0 or damping > _MOST_DAMPING:
            if not old:
                break
            j, old = jacobian(x), 0
            continue
        new = np.clip(x + d, lower, upper)
        moved = residual(new)
        achieved = squares - float(moved @ moved)
        ratio = achieved / predicted
        small = max(abs(achieved), predicted) <= tolerance * squares and ratio <= 2.0
        if ratio > _ACCEPTED:
            if old < secants and ratio > _KEPT and not small:
                j = j + np.outer(moved - linear, weights * d) / float(d @ (weights * d))
                old += 1
            else:
                j, old, small = jacobian(new), 0, small and not old
            x, r, squares = new, moved, squares - achieved
            damping = max(damping * max(1.0 / 3.0, 1.0 - (2.0 * ratio - 1.0) ** 3), _LEAST_DAMPING)
            growth = 2.0
        elif old:
            j, old, small = jacobian(x), 0, False
        else:
            damping, growth = damping * growth, 2.0 * growth
        if small or not squares > 0.0:
            break
    if old:
        j = jacobian(x)
    return Minimum(x, r, j)


def _weights(scale: np.ndarray) -> np.ndarray:
    """Weights of the damping: the column norms; for zero columns the largest norm."""
    largest = float(np.max(scale, initial=0.0)) or 1.0
    return np.where(scale > _FLAT * largest, scale, largest)


def _step(
    jacobian: np.ndarray, residuals: np.ndarray, damping: np.ndarray, lower: np.ndarray, upper: np.ndarray
) -> np.ndarray:
    """The damped least-squares step within a box that contains 0, by an active-set method."""
    unit = 1.0 / np.sqrt(damping)  # in these units the damping is 1 for every number
    columns = jacobian * unit
    normal = columns.T @ columns + np.eye(len(unit))
    slope = columns.T @ residuals
    low, high = lower / unit, upper / unit
    d = np.zeros(len(unit))
    at_bound = ((low >= 0.0) & (slope > 0.0)) | ((high <= 0.0) & (slope < 0.0))
    for _ in range(3 * len(unit) + 3):
        free = ~at_bound
        if np.any(free):
            wanted = d.copy()
            right = -slope[free] - normal[np.ix_(free, at_bound)] @ d[at_bound]
            wanted[free] = np.linalg.solve(normal[np.ix_(free, free)], right)
            change = wanted - d
            room = np.where(change > 0.0, high - d, low - d)[free]
            share = np.divide(room, change[free], out=np.ones(len(room)), where=change[free] != 0.0)
            part = float(np.min(share, initial=1.0))
            d = np.clip(d + max(part, 0.0) * change, low, high)
            if part < 1.0:
                at_bound[np.flatnonzero(free)[np.argmin(share)]] = True
                continue
        pull = normal @ d + slope  # at an active bound it must point out of the box
        inward = at_bound & np.where(d <= low, pull < 0.0, np.where(d >= high, pull > 0.0, True))
        if not np.any(inward):
            break
        at_bound[np.argmax(np.where(inward, np.abs(pull), -1.0))] = False
    return d * unit
