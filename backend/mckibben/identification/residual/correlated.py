r"""Noise that is correlated from row to row: its likelihood, and what a fit determines in spite of it.

The noise of a channel is the sum of autoregressive noise e and of white noise, the share w of the variance:

.. math:: R = (1-w)\,A + w\,I,\qquad e_i = \phi_1e_{i-1} + \phi_2e_{i-2} + \epsilon_i

with A the correlations of e within an uninterrupted line of rows; :math:`A_{ij} = \rho^{|i-j|}` where
:math:`\phi_2 = 0`, else it swings. The inverse T of A has two diagonals beside the main one (Siddiqui, Ann.
Math. Statist. 29 (1958) 585). With D = 1/w at each row, and 0 at a row of the line that is not compared,

.. math:: R^{-1} = D - D\,\Big(\frac{T}{1-w} + D\Big)^{-1} D

so that the work grows with the number of rows.

The noise is not known: each one of a grid has the weight of its restricted likelihood (the parameters
integrated out), and half of the prior is on white noise. Nor is it known whether the noise goes on from one
line of a record to the next, so both are weighed. With the Jacobian J of a least-squares fit,
:math:`B = (J^TJ)^{-1}` and the variance :math:`\sigma^2_i` of each noise i, their covariance is

.. math:: V = B\,\Big(\sum_i p_i\,\sigma^2_i\,J^TR_i\,J\Big)\,B
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from math import cos, exp, log, pi, sqrt
from typing import NamedTuple

import numpy as np

from mckibben.identification.residual.simplex import lowest

#: Ways in which the rows of a channel may be lines of correlated noise: of each the lines of a `Chain`.
Ways = Sequence[Sequence[np.ndarray]]

_CORRELATIONS = (0.3, 0.6, 0.8, 0.9, 0.95, 0.98, 0.99, 0.997, 0.999, 0.9997)  # of neighbouring rows
_WHITE_SHARES = (0.0, 0.3, 0.7, 0.9)
# Noise that swings: radius of the poles, period in rows, and shares of white noise.
_RADII, _PERIODS, _SWINGING_SHARES = (0.8, 0.9, 0.97), (6.0, 10.0, 16.0, 30.0), (0.0, 0.4)
_SHORTEST = 2.2  # shortest period
_LASTING, _SLOWEST = 10.0, 2.0  # longest time in step, and longest period, over the longest line
_REFINED = 80  # evaluations of the search for the swinging noise that suits best
_STEPS = 0.3, 0.15, 1.0  # its first steps, in log(-log(1 - radius)), log(period), logit(share)
_FAR = 30.0  # beyond, exp(exp(x)) has no number
_FEWEST_OF_A_LINE = 4  # rows; in shorter lines noise that swings counts as white
_LEAST_WHITE = 1e-5  # instead of a share of 0, which the formula of the inverse does not take
_WHITE_PRIOR = 0.5
_LONGEST = 5.0  # correlation length over the longest line beyond which a correlation is not tried
_ROOM = 2**18  # numbers of whitened rows that are held at once
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
    def period(self) -> float:
        """Of noise that swings, in rows; infinite for noise that does not."""
        if not self.second:
            return np.inf
        return 2.0 * np.pi / float(np.arccos(0.5 * self.first / np.sqrt(-self.second)))

    @staticmethod
    def swinging(radius: float, period: float, white: float) -> Noise:
        """Noise with poles of a radius, that swings with a period of some rows."""
        period = max(period, _SHORTEST)
        first = 2.0 * radius * cos(2.0 * pi / period)
        return Noise(first, -(radius**2), min(max(white, _LEAST_WHITE), 1.0 - _LEAST_WHITE))

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
        Noise.swinging(radius, period, white)
        for radius in _RADII
        for period in _PERIODS
        for white in _SWINGING_SHARES
    ]
    return (*plain, *swinging)


class Chain:
    """Lines of rows one after the other, and products with the inverse of their correlations.

    Args:
        lines: indices of the rows of each line, in order; -1 for a row that is not there.
    """

    def __init__(self, lines: Sequence[np.ndarray]) -> None:
        self._lengths = np.array([len(line) for line in lines])
        rows = np.concatenate(lines)
        self._there = rows >= 0
        self.rows = rows[self._there]
        self._own = np.repeat(self._lengths, self._lengths)
        self._place = np.arange(len(rows)) - np.repeat(
            np.cumsum(self._lengths) - self._lengths, self._lengths
        )
        self._inverses: dict[tuple[float, float], tuple[np.ndarray, float]] = {}

    @property
    def longest(self) -> int:
        """Number of rows of the longest line, with those that are not there."""
        return int(np.max(self._lengths))

    def _inverse(self, noise: Noise) -> tuple[np.ndarray, float]:
        r"""Diagonals of :math:`T_{ij} = s^{-2}\sum_k a_ka_{k+j-i}`, a = (1, -phi_1, -phi_2); log det T."""
        key = noise.first, noise.second
        if key in self._inverses:
            return self._inverses[key]
        ahead, short = self._own - 1 - self._place, self._own < _fewest(noise)
        a, size = np.array([1.0, -noise.first, -noise.second]), 1.0 / noise.innovation
        order = 2 if noise.second else 1
        diagonals = np.zeros((order + 1, len(self._own)))
        for offset in range(order + 1):
            sums = np.cumsum(a[: order + 1 - offset] * a[offset : order + 1]) * size
            terms = np.minimum(np.minimum(self._place, ahead - offset), order - offset)
            values = np.where(terms < 0, 0.0, sums[np.maximum(terms, 0)])
            diagonals[offset] = np.where(short, 1.0 if offset == 0 else 0.0, values)
        long = self._lengths[self._lengths >= _fewest(noise)]
        log_det = -float(np.sum(long - order)) * float(np.log(noise.innovation))
        if order > 1:
            log_det -= len(long) * float(np.log1p(-(noise.next_one**2)))
        self._inverses[key] = diagonals, log_det
        return diagonals, log_det

    def products(self, table: np.ndarray, noises: Sequence[Noise]) -> Iterator[tuple[np.ndarray, float]]:
        """Of each noise the products of columns with the inverse of R between them, and log det R.

        Args:
            table: of the rows that are there, shape (rows, columns).
            noises: the noises.
        """
        from mckibben.identification.residual import whitening

        whiten = whitening.whiten.compiled()
        table = np.ascontiguousarray(table)
        rows, columns = table.shape
        together = min(max(_ROOM // max(rows * columns, 1), 1), len(noises))
        room, log_dets = np.empty((together, rows, columns)), np.empty(together)
        for start in range(0, len(noises), together):
            some = noises[start : start + together]
            numbers = np.array([(*each, each.innovation) for each in some])
            fewest = np.array([_fewest(each) for each in some])
            whiten(self._lengths, self._there, numbers, fewest, table, room, log_dets)
            for found, log_det in zip(room[: len(some)], log_dets.tolist(), strict=False):
                yield found.T @ found, log_det

    def misfit(self, table: np.ndarray, least: float) -> Callable[[Noise], float]:
        """-2 log likelihood of the last column beside the others, as a function of the noise.

        Args:
            table: of the rows that are there, shape (rows, columns).
            least: that the sum of squares can be.
        """
        from mckibben.identification.residual import whitening

        compiled, table = whitening.misfit.compiled(), np.ascontiguousarray(table)
        room = np.empty_like(table)

        def value(noise: Noise) -> float:
            numbers = np.array((*noise, noise.innovation))
            return compiled(self._lengths, self._there, numbers, _fewest(noise), table, room, least)

        return value

    def spread(self, jacobian: np.ndarray, noise: Noise) -> np.ndarray:
        """J^T R J."""
        alone = jacobian.T @ jacobian
        if noise == WHITE:
            return alone
        from scipy.linalg import cho_solve_banded, cholesky_banded

        factor = cholesky_banded(self._inverse(noise)[0], lower=True, check_finite=False)
        right = np.zeros((len(self._own), jacobian.shape[1]))
        right[self._there] = jacobian
        correlated = jacobian.T @ cho_solve_banded((factor, True), right, check_finite=False)[self._there]
        return (1.0 - noise.white) * correlated + noise.white * alone


def _fewest(noise: Noise) -> int:
    return _FEWEST_OF_A_LINE if noise.second else 2


class _Tried(NamedTuple):
    """One noise with what it leaves of a residual beside its parameters."""

    noise: Noise
    squares: float
    """Generalised sum of squares."""
    log_det: float
    """Of R."""
    normal: float
    """Log determinant of the normal matrix of the parameters."""

    def likelihood(self, rows: int) -> float:
        """Log likelihood of the residual with that variance which suits it best."""
        return -0.5 * (rows * np.log(self.squares / rows) + self.log_det)


def tried_noises(chain: Chain, basis: np.ndarray, residual: np.ndarray) -> list[_Tried]:
    """White noise, the noises that lines of these lengths can show, and the swinging one that suits best.

    Args:
        chain: the lines.
        basis: orthonormal columns of the parameters, shape (rows, parameters).
        residual: shape (rows,).
    """
    columns = np.column_stack([basis, residual])
    # No eigenvalue of R is larger than the longest line.
    least = float(residual @ residual) / chain.longest + 1e-300

    def tried(noises: Sequence[Noise]) -> list[_Tried]:
        found = list(chain.products(columns, noises))
        products, log_dets = np.array([each for each, _ in found]), [log_det for _, log_det in found]
        normal, right = products[:, :-1, :-1], products[:, :-1, -1:]
        explained = np.sum(right * np.linalg.solve(normal, right), axis=(1, 2))
        squares = np.maximum(products[:, -1, -1] - explained, least)
        normals = np.linalg.slogdet(normal)[1]
        return [
            _Tried(noise, float(square), float(log_det), float(own))
            for noise, square, log_det, own in zip(noises, squares, log_dets, normals, strict=True)
        ]

    rows, longest = len(residual), _LONGEST * chain.longest
    found = tried([noise for noise in (WHITE, *correlated_noises()) if noise.length <= longest])
    swinging = [each for each in found if each.noise.second]
    if swinging:
        best = max(swinging, key=lambda each: each.likelihood(rows)).noise
        with suppress(np.linalg.LinAlgError):  # so near to a pure line that nothing is left beside it
            found += tried([_likeliest_swing(chain, columns, least, best)])
    return found


def _likeliest_swing(chain: Chain, columns: np.ndarray, least: float, begin: Noise) -> Noise:
    """The swinging noise with the largest likelihood, from one of the grid on.

    Args:
        chain: the lines.
        columns: those of the parameters, and the residual as the last.
        least: that the squares can be.
        begin: where the search begins.
    """
    radius, slowest = 1.0 - 1.0 / (_LASTING * chain.longest), log(_SLOWEST * chain.longest)

    def noise_at(place: Sequence[float]) -> Noise:
        near, period, share = place
        return Noise.swinging(
            min(1.0 - exp(-exp(min(near, _FAR))), radius),
            exp(min(period, slowest)),
            1.0 / (1.0 + exp(-max(share, -_FAR))),
        )

    misfit = chain.misfit(columns, least)
    white = min(max(begin.white, 0.01), 0.99)
    start = log(-log(1.0 - sqrt(-begin.second))), log(begin.period), log(white / (1.0 - white))
    corners = [list(start)] + [
        [value + step * (place == axis) for place, value in enumerate(start)]
        for axis, step in enumerate(_STEPS)
    ]
    return noise_at(lowest(lambda place: misfit(noise_at(place)), corners, _REFINED))


@dataclass(frozen=True, eq=False)
class Weighed:
    """One noise of the grid, with its weight.

    Attributes:
        noise: the noise.
        weight: posterior probability; the weights of all sum to 1.
        variance: of the residual's noise.
        chain: lines in which it is correlated.
    """

    noise: Noise
    weight: float
    variance: float
    chain: Chain


#: What the noise of each channel may be.
Noises = Sequence[Sequence[Weighed]]


def _beside(
    jacobian: np.ndarray, residual: np.ndarray, lines: Sequence[np.ndarray]
) -> tuple[Chain, int, list[_Tried]]:
    """The chain of lines, the number of parameters that its rows determine, and the noises beside them."""
    chain = Chain(lines)
    left, sizes, _ = np.linalg.svd(jacobian[chain.rows], full_matrices=False)
    basis = left[:, sizes > _INDEPENDENT * float(np.max(sizes, initial=0.0))]
    return chain, basis.shape[1], tried_noises(chain, basis, residual[chain.rows])


def weighed_noises(jacobian: np.ndarray, residual: np.ndarray, ways: Ways) -> list[Weighed]:
    """What the noise of one channel may be.

    Args:
        jacobian: derivatives of all values at the fit, shape (values, parameters).
        residual: shape (values,).
        ways: lines of the channel.
    """
    found: list[tuple[float, Noise, float, Chain]] = []
    for lines in ways:
        chain, determined, tried = _beside(jacobian, residual, lines)
        freedom = max(len(chain.rows) - determined, 1)
        for each in tried:
            if each.noise == WHITE and found:
                continue
            prior = _WHITE_PRIOR if each.noise == WHITE else (1.0 - _WHITE_PRIOR) / len(correlated_noises())
            evidence = np.log(prior) - 0.5 * (freedom * np.log(each.squares) + each.log_det + each.normal)
            found.append((float(evidence), each.noise, each.squares / freedom, chain))
    evidence = np.array([each[0] for each in found])
    weights = np.exp(evidence - np.max(evidence))
    weights /= np.sum(weights)
    return [
        Weighed(noise, float(weight), variance, chain)
        for weight, (_, noise, variance, chain) in zip(weights, found, strict=True)
    ]


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
                    spread += share * each.chain.spread(unit[each.chain.rows], each.noise)
        matrix = inverse @ spread @ inverse
    else:
        matrix = inverse * float(residual @ residual) / freedom
    return 0.5 * (matrix + matrix.T) / np.outer(scale, scale)


def _times(residual: np.ndarray, weighed: Sequence[Weighed]) -> float:
    """Mean square of the rows of a residual over the variance of the noise."""
    variance = sum(each.weight * each.variance for each in weighed)
    return float(np.mean(residual[weighed[0].chain.rows] ** 2)) / max(variance, 1e-300)


def log_likelihood(jacobian: np.ndarray, residual: np.ndarray, channels: Sequence[Ways]) -> float:
    r"""Largest log likelihood of a residual over its noise, with the parameters at their best for that noise.

    .. math:: \max_R\;-\tfrac12\big(n\ln(\hat r^TR^{-1}\hat r/n) + \ln|R|\big)

    summed over the channels; constants that all models of the same values share are left out.

    Args:
        jacobian: derivatives of all values at the fit, shape (values, parameters).
        residual: shape (values,).
        channels: lines of the noise of each channel; without any it is white.
    """
    if not channels:
        return -0.5 * len(residual) * float(np.log(max(float(np.mean(residual**2)), 1e-300)))
    whole = 0.0
    for ways in channels:
        best = -np.inf
        for lines in ways:
            chain, _, tried = _beside(jacobian, residual, lines)
            best = max(best, *(each.likelihood(len(chain.rows)) for each in tried))
        whole += best
    return whole
