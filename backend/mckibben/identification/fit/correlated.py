r"""Covariance of fitted parameters under noise that may be correlated from row to row.

The noise of a channel is taken as the sum of an autoregressive part, whose correlation falls by :math:`\rho`
from row to row of an uninterrupted line, and of a white part, the share w of the variance:

.. math:: R = (1-w)\,A + w\,I, \qquad A_{ij} = \rho^{|i-j|}

Neither :math:`\rho` nor w is known: each pair of a grid has the weight of its restricted likelihood (the
parameters integrated out), and half of the prior is on white noise. Nor is it known whether the noise goes on
from one line of a record to the next, so both are weighed. With the Jacobian J of the least-squares fit,
:math:`B = (J^TJ)^{-1}` and the variance :math:`\sigma^2_i` of each pair i,

.. math:: V = B\,\Big(\sum_i p_i\,\sigma^2_i\,J^TR_i\,J\Big)\,B

The inverse T of A is tridiagonal and :math:`R^{-1} = ((1-w)I + wT)^{-1}\,T`, so the work grows with the
number of rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

#: Ways in which the rows of a channel may be lines of correlated noise: of each the indices of its lines.
Ways = Sequence[Sequence[np.ndarray]]

_CORRELATIONS = (0.3, 0.6, 0.8, 0.9, 0.95, 0.98, 0.99, 0.997, 0.999, 0.9997)
_WHITE_SHARES = (0.0, 0.3, 0.7, 0.9)
_WHITE_PRIOR = 0.5
_LONGEST = 5.0  # correlation length over the longest line beyond which a correlation is not tried
_INDEPENDENT = 1e-7  # singular value over the largest one below which a direction is not determined


class _Pair(NamedTuple):
    """One hypothesis of the noise of a channel."""

    evidence: float
    """Logarithm of its prior times its restricted likelihood, up to a constant."""
    variance: float
    spread: np.ndarray
    """J^T R J."""


def covariance(jacobian: np.ndarray, residual: np.ndarray, channels: Sequence[Ways] = ()) -> np.ndarray:
    """Covariance of the parameters of a least-squares fit, shape (parameters, parameters).

    Args:
        jacobian: derivatives at the solution, shape (values, parameters), of full rank.
        residual: there, shape (values,); more values than parameters.
        channels: lines of the noise of each channel; without any, the noise of all values is independent and
            of one size.
    """
    scale = np.linalg.norm(jacobian, axis=0)
    unit = jacobian / scale
    inverse = np.linalg.inv(unit.T @ unit)
    if channels:
        spread = sum(_spread(unit, residual, ways) for ways in channels)
        matrix = inverse @ spread @ inverse
    else:
        matrix = inverse * float(residual @ residual) / (len(residual) - len(scale))
    return 0.5 * (matrix + matrix.T) / np.outer(scale, scale)


def _spread(jacobian: np.ndarray, residual: np.ndarray, ways: Ways) -> np.ndarray:
    """J^T (sigma^2 R) J of the rows of one channel, averaged over what its noise may be."""
    pairs: list[_Pair] = []
    for lines in ways:
        rows = np.concatenate(lines)
        pairs += _pairs(jacobian[rows], residual[rows], [len(line) for line in lines], white=not pairs)
    evidence = np.array([pair.evidence for pair in pairs])
    weights = np.exp(evidence - np.max(evidence))
    weights /= np.sum(weights)
    return sum(
        (weight * pair.variance * pair.spread for weight, pair in zip(weights, pairs, strict=True)),
        np.zeros((jacobian.shape[1],) * 2),
    )


def _pairs(
    jacobian: np.ndarray, residual: np.ndarray, lengths: Sequence[int], *, white: bool
) -> Iterator[_Pair]:
    """The hypotheses of lines that follow each other; ``white``: with that of white noise."""
    from scipy.linalg import cho_solve_banded, cholesky_banded

    left, sizes, _ = np.linalg.svd(jacobian, full_matrices=False)
    basis = left[:, sizes > _INDEPENDENT * float(np.max(sizes, initial=0.0))]
    determined = basis.shape[1]
    freedom = max(len(residual) - determined, 1)
    columns = np.column_stack([basis, residual])
    # A residual that is rounding error is still one.
    least = 1e-30 * float(residual @ residual) + 1e-300

    def pair(solved: np.ndarray, log_determinant: float, prior: float, spread: np.ndarray) -> _Pair:
        product = columns.T @ solved
        normal, right = product[:-1, :-1], product[:-1, -1]
        squares = max(float(product[-1, -1] - right @ np.linalg.solve(normal, right)), least)
        of_parameters = float(np.linalg.slogdet(normal)[1])
        evidence = -0.5 * (freedom * np.log(squares) + of_parameters + log_determinant) + np.log(prior)
        return _Pair(float(evidence), squares / freedom, spread)

    alone = jacobian.T @ jacobian
    if white:
        yield pair(columns, 0.0, _WHITE_PRIOR, alone)
    ends = np.cumsum(lengths)[:-1] - 1
    linked = np.ones(max(len(residual) - 1, 0))
    linked[ends] = 0.0
    neighbours = np.append(linked, 0.0) + np.insert(linked, 0, 0.0)
    tried = [rho for rho in _CORRELATIONS if -1.0 / np.log(rho) <= _LONGEST * max(lengths)]
    prior = (1.0 - _WHITE_PRIOR) / (len(_CORRELATIONS) * len(_WHITE_SHARES))
    for rho in tried:
        gain = 1.0 / (1.0 - rho**2)
        inverse = np.zeros((2, len(residual)))  # T: its diagonal, and the one below
        inverse[0] = 1.0 + rho**2 * gain * neighbours
        inverse[1, :-1] = -rho * gain * linked
        of_inverse = float(np.log(gain) * np.sum(linked))
        through = inverse[0, :, None] * columns
        through[:-1] += inverse[1, :-1, None] * columns[1:]
        through[1:] += inverse[1, :-1, None] * columns[:-1]
        correlated = jacobian.T @ cho_solve_banded((cholesky_banded(inverse, lower=True), True), jacobian)
        for share in _WHITE_SHARES:
            solved, of_mixture = through, 0.0
            if share > 0.0:
                mixture = share * inverse
                mixture[0] += 1.0 - share
                factor = cholesky_banded(mixture, lower=True)
                solved = cho_solve_banded((factor, True), through)
                of_mixture = 2.0 * float(np.sum(np.log(factor[0])))
            spread = (1.0 - share) * correlated + share * alone
            yield pair(solved, of_mixture - of_inverse, prior, spread)
