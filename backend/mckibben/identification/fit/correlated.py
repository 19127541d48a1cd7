r"""Noise that is correlated from row to row: its likelihood, and what a fit determines in spite of it.

The noise of a channel is the sum of autoregressive noise e and of white noise, the share w of the variance:

.. math:: R = (1-w)\,A + w\,I,\qquad e_i = \phi_1e_{i-1} + \phi_2e_{i-2} + \epsilon_i

with A the correlations of e within an uninterrupted line of rows; :math:`A_{ij} = \rho^{|i-j|}` where
:math:`\phi_2 = 0`, else it swings. The inverse T of A has two diagonals beside the main one (Siddiqui, Ann.
Math. Statist. 29 (1958) 585), so that the work of products with :math:`R^{-1} = ((1-w)I + wT)^{-1}\,T` grows
with the number of rows.

The noise is not known: each one of a grid has the weight of its restricted likelihood (the parameters
integrated out), and half of the prior is on white noise. Nor is it known whether the noise goes on from one
line of a record to the next, so both are weighed. With the Jacobian J of a least-squares fit,
:math:`B = (J^TJ)^{-1}` and the variance :math:`\sigma^2_i` of each noise i, their covariance is

.. math:: V = B\,\Big(\sum_i p_i\,\sigma^2_i\,J^TR_i\,J\Big)\,B
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

#: Ways in which the rows of a channel may be lines of correlated noise: of each the indices of its lines.
Ways = Sequence[Sequence[np.ndarray]]

_CORRELATIONS = (0.3, 0.6, 0.8, 0.9, 0.95, 0.98, 0.99, 0.997, 0.999, 0.9997)  # of neighbouring rows
_WHITE_SHARES = (0.0, 0.3, 0.7, 0.9)
# Noise that swings: radius of the poles, period in rows, and shares of white noise.
_RADII, _PERIODS, _SWINGING_SHARES = (0.8, 0.9, 0.97), (6.0, 10.0, 16.0, 30.0), (0.0, 0.4)
_FEWEST_OF_A_LINE = 4  # rows; in shorter lines noise that swings counts as white
_LEAST_WHITE = 1e-6  # instead of a share of 0, so that equal rows do not make the matrix singular
_WHITE_PRIOR = 0.5
_LONGEST = 5.0  # correlation length over the longest line beyond which a correlation is not tried
_COUNTS = 1e-4  # weight below which a noise does not count
_INDEPENDENT = 1e-7  # singular value over the largest one below which a direction is not determined


class Noise(NamedTuple):
    """Autoregressive noise with white noise beside it: its coefficients, and the share of the white one."""

    first: float
    second: float
    white: float

    @property
    def next_one(self) -> float:
        """Correlation of the autoregressive part of neighbouring rows."""
        return self.first / (1.0 - self.second)

    @property
    def innovation(self) -> float:
        """Variance of what is new in each row, over the variance."""
        return (1.0 - self.next_one**2) * (1.0 - self.second**2)

    @property
    def length(self) -> float:
        """Rows over which the autoregressive part falls to 1/e."""
        radius = np.sqrt(-self.second) if self.second else self.first
        return -1.0 / float(np.log(radius)) if radius > 0.0 else 0.0


#: Noise without any correlation.
WHITE = Noise(0.0, 0.0, 1.0)


@cache
def correlated_noises() -> tuple[Noise, ...]:
    """The grid without white noise alone."""
    plain = [Noise(rho, 0.0, max(white, _LEAST_WHITE)) for rho in _CORRELATIONS for white in _WHITE_SHARES]
    swinging = [
        Noise(2.0 * radius * float(np.cos(2.0 * np.pi / period)), -(radius**2), max(white, _LEAST_WHITE))
        for radius in _RADII
        for period in _PERIODS
        for white in _SWINGING_SHARES
    ]
    return (*plain, *swinging)


def noises_of(lengths: Sequence[int]) -> Iterator[Noise]:
    """White noise, and the noises that lines of these lengths can show."""
    yield WHITE
    longest = _LONGEST * max(lengths)
    yield from (noise for noise in correlated_noises() if noise.length <= longest)


class Chain:
    """Rows of one line after the other, and products with the inverse of their correlations.

    Args:
        lengths: number of rows of each line.
    """

    def __init__(self, lengths: Sequence[int]) -> None:
        self.lengths = np.asarray(lengths, dtype=np.intp)
        self._own = np.repeat(self.lengths, self.lengths)
        self._inverses: dict[tuple[float, float], tuple[np.ndarray, ...]] = {}
        self._place = np.arange(len(self._own)) - np.repeat(
            np.cumsum(self.lengths) - self.lengths, self.lengths
        )

    def __len__(self) -> int:
        return len(self._own)

    def _inverse(self, noise: Noise) -> tuple[np.ndarray, ...]:
        r"""Diagonals of T: :math:`T_{ij} = s^{-2}\sum_k a_ka_{k+j-i}`, a = (1, -phi_1, -phi_2)."""
        key = noise.first, noise.second
        if key not in self._inverses:
            self._inverses[key] = self._diagonals(noise)
        return self._inverses[key]

    def _diagonals(self, noise: Noise) -> tuple[np.ndarray, ...]:
        ahead, short = self._own - 1 - self._place, self._own < _fewest(noise)
        a, size = np.array([1.0, -noise.first, -noise.second]), 1.0 / noise.innovation
        order = 2 if noise.second else 1
        diagonals = []
        for offset in range(order + 1):
            sums = np.cumsum(a[: order + 1 - offset] * a[offset : order + 1]) * size
            terms = np.minimum(np.minimum(self._place, ahead - offset), order - offset)
            values = np.where(terms < 0, 0.0, sums[np.maximum(terms, 0)])
            diagonals.append(np.where(short, 1.0 if offset == 0 else 0.0, values))
        return tuple(diagonals)

    def products(self, table: np.ndarray, noise: Noise) -> tuple[np.ndarray, float]:
        """Products of columns with the inverse of R between them, and log det R.

        Args:
            table: shape (rows, columns).
            noise: the noise.
        """
        if noise == WHITE:
            return table.T @ table, 0.0
        from scipy.linalg import cho_solve_banded, cholesky_banded

        diagonals = self._inverse(noise)
        banded = noise.white * np.array(diagonals)
        banded[0] += 1.0 - noise.white
        factor = cholesky_banded(banded, lower=True, check_finite=False)
        solved = cho_solve_banded((factor, True), table, check_finite=False)
        inverse = diagonals[0][:, None] * solved
        for offset, beside in enumerate(diagonals[1:], start=1):
            inverse[offset:] += beside[:-offset, None] * solved[:-offset]
            inverse[:-offset] += beside[:-offset, None] * solved[offset:]
        long = self.lengths[self.lengths >= _fewest(noise)]
        order = 2 if noise.second else 1
        log_det = float(np.sum(long - order)) * np.log(noise.innovation)
        if order > 1:
            log_det += len(long) * np.log1p(-(noise.next_one**2))
        return table.T @ inverse, float(log_det) + 2.0 * float(np.sum(np.log(factor[0])))

    def spread(self, jacobian: np.ndarray, noise: Noise) -> np.ndarray:
        """J^T R J."""
        alone = jacobian.T @ jacobian
        if noise == WHITE:
            return alone
        from scipy.linalg import cho_solve_banded, cholesky_banded

        factor = cholesky_banded(np.array(self._inverse(noise)), lower=True, check_finite=False)
        correlated = jacobian.T @ cho_solve_banded((factor, True), jacobian, check_finite=False)
        return (1.0 - noise.white) * correlated + noise.white * alone


def _fewest(noise: Noise) -> int:
    return _FEWEST_OF_A_LINE if noise.second else 2


@dataclass(frozen=True, eq=False)
class Weighed:
    """One noise of the grid, with its weight.

    Attributes:
        noise: the noise.
        weight: posterior probability; the weights of all sum to 1.
        variance: of the residual's noise.
        chain: lines in which it is correlated.
        rows: of the residual, in the order of the chain.
    """

    noise: Noise
    weight: float
    variance: float
    chain: Chain
    rows: np.ndarray


#: What the noise of each channel may be.
Noises = Sequence[Sequence[Weighed]]


def weighed_noises(jacobian: np.ndarray, residual: np.ndarray, ways: Ways) -> list[Weighed]:
    """What the noise of one channel may be.

    Args:
        jacobian: derivatives of all values at the fit, shape (values, parameters).
        residual: shape (values,).
        ways: lines of the channel.
    """
    found: list[tuple[float, Noise, float, Chain, np.ndarray]] = []
    for lines in ways:
        rows, chain = np.concatenate(lines), Chain([len(line) for line in lines])
        left, sizes, _ = np.linalg.svd(jacobian[rows], full_matrices=False)
        basis = left[:, sizes > _INDEPENDENT * float(np.max(sizes, initial=0.0))]
        freedom = max(len(rows) - basis.shape[1], 1)
        columns = np.column_stack([basis, residual[rows]])
        # A residual that is rounding error is still one.
        least = 1e-30 * float(residual[rows] @ residual[rows]) + 1e-300
        noises = list(noises_of(chain.lengths.tolist()))
        for noise in noises:
            if noise == WHITE and found:
                continue
            products, log_det = chain.products(columns, noise)
            normal, right = products[:-1, :-1], products[:-1, -1]
            squares = max(float(products[-1, -1] - right @ np.linalg.solve(normal, right)), least)
            log_det += float(np.linalg.slogdet(normal)[1])
            prior = _WHITE_PRIOR if noise == WHITE else (1.0 - _WHITE_PRIOR) / len(correlated_noises())
            evidence = -0.5 * (freedom * np.log(squares) + log_det) + np.log(prior)
            found.append((float(evidence), noise, squares / freedom, chain, rows))
    evidence = np.array([each[0] for each in found])
    weights = np.exp(evidence - np.max(evidence))
    weights /= np.sum(weights)
    return [Weighed(noise, float(w), *rest) for w, (_, noise, *rest) in zip(weights, found, strict=True)]


def covariance(
    jacobian: np.ndarray,
    residual: np.ndarray,
    channels: Sequence[Ways] = (),
    *,
    noises: Noises | None = None,
) -> np.ndarray:
    """Covariance of the parameters of a least-squares fit, shape (parameters, parameters).

    Args:
        jacobian: derivatives at the solution, shape (values, parameters), of full rank.
        residual: there, shape (values,); more values than parameters.
        channels: lines of the noise of each channel; without any, the noise of all values is independent and
            of one size.
        noises: of each channel, where they are known from a better model of the same values; their size is
            that of this residual.
    """
    scale = np.linalg.norm(jacobian, axis=0)
    unit = jacobian / scale
    inverse = np.linalg.inv(unit.T @ unit)
    freedom = max(len(residual) - len(scale), 1)
    if noises is None:
        noises = [weighed_noises(unit, residual, ways) for ways in channels]
        sizes = [1.0] * len(noises)
    else:
        sizes = [_times(residual, weighed) * len(residual) / freedom for weighed in noises]
    if noises:
        spread = np.zeros((len(scale), len(scale)))
        for weighed, size in zip(noises, sizes, strict=True):
            for each in weighed:
                if each.weight > _COUNTS:
                    share = size * each.weight * each.variance
                    spread += share * each.chain.spread(unit[each.rows], each.noise)
        matrix = inverse @ spread @ inverse
    else:
        matrix = inverse * float(residual @ residual) / freedom
    return 0.5 * (matrix + matrix.T) / np.outer(scale, scale)


def _times(residual: np.ndarray, weighed: Sequence[Weighed]) -> float:
    """Mean square of the rows of a residual over the variance of the noise."""
    variance = sum(each.weight * each.variance for each in weighed)
    return float(np.mean(residual[weighed[0].rows] ** 2)) / max(variance, 1e-300)


def log_likelihood(jacobian: np.ndarray, residual: np.ndarray, channels: Sequence[Ways]) -> float:
    r"""Largest log likelihood of a residual over its noise, with the parameters at their best for that noise.

    .. math:: \max_R\;-\tfrac12\big(n\ln(\hat r^TR^{-1}\hat r/n) + \ln|R|\big)

    summed over the channels; constants that all models of the same values share are left out.

    Args:
        jacobian: derivatives of all values at the fit, shape (values, parameters).
        residual: shape (values,).
        channels: lines of the noise of each channel.
    """
    whole = 0.0
    for ways in channels:
        best = -np.inf
        for lines in ways:
            rows, chain = np.concatenate(lines), Chain([len(line) for line in lines])
            left, sizes, _ = np.linalg.svd(jacobian[rows], full_matrices=False)
            basis = left[:, sizes > _INDEPENDENT * float(np.max(sizes, initial=0.0))]
            columns = np.column_stack([basis, residual[rows]])
            for noise in noises_of(chain.lengths.tolist()):
                products, log_det = chain.products(columns, noise)
                normal, right = products[:-1, :-1], products[:-1, -1]
                squares = float(products[-1, -1] - right @ np.linalg.solve(normal, right))
                best = max(best, -0.5 * (len(rows) * np.log(max(squares, 1e-300) / len(rows)) + log_det))
        whole += best
    return whole
