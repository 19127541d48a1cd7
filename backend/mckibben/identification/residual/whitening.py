r"""Rows made independent: the innovations of autoregressive noise with white noise beside it.

With the noise of `mckibben.identification.residual.correlated`, a filter (Kalman, J. Basic Eng. 82 (1960) 35)
goes along each line with the mean and the covariance P of the noise of this row and of the row before, given
the rows before. Of a row x the innovation v has the variance F,

.. math:: v = x - \hat e,\qquad F = P_{11} + w,\qquad
   X^TR^{-1}X = \sum v\,v^T/F,\qquad \ln|R| = \sum\ln F

so that no matrix is inverted and no digits are lost where the noise is strongly correlated.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from mckibben.simulation.integrate.stamp import kernel

_LINES = "int64[::1],boolean[::1]"


@njit(error_model="numpy")
def _filtered(
    lengths: np.ndarray,
    there: np.ndarray,
    noise: np.ndarray,
    fewest: int,
    table: np.ndarray,
    found: np.ndarray,
    room: np.ndarray,
) -> float:
    """Log det of the correlations of one noise, with its innovations written to ``found``; see `whiten`."""
    columns = table.shape[1]
    here, before = room[0], room[1]
    first, second, white = noise[0], noise[1], noise[2]
    size = 1.0 - white
    fresh, next_one = size * noise[3], first / (1.0 - second)
    place, row, log_det = 0, 0, 0.0
    for line in range(lengths.shape[0]):
        if lengths[line] < fewest:
            for _ in range(lengths[line]):
                if there[place]:
                    found[row] = table[row]
                    row += 1
                place += 1
            continue
        own, beside, other = size, size * next_one, size
        here[:], before[:] = 0.0, 0.0
        for _ in range(lengths[line]):
            if there[place]:
                variance = own + white
                log_det += np.log(variance)
                scale = 1.0 / np.sqrt(variance)
                gain, gain_before = own / variance, beside / variance
                for column in range(columns):
                    new = table[row, column] - here[column]
                    found[row, column] = scale * new
                    now = here[column] + gain * new
                    here[column] = first * now + second * (before[column] + gain_before * new)
                    before[column] = now
                other -= beside * gain_before
                own *= white / variance
                beside *= white / variance
                row += 1
            else:
                for column in range(columns):
                    now = here[column]
                    here[column] = first * now + second * before[column]
                    before[column] = now
            place += 1
            ahead = first * own + second * beside
            own, beside, other = (
                first * ahead + second * (first * beside + second * other) + fresh,
                ahead,
                own,
            )
    return log_det


@kernel(f"void({_LINES},float64[:,::1],int64[::1],float64[:,::1],float64[:,:,::1],float64[::1])")
def whiten(
    lengths: np.ndarray,
    there: np.ndarray,
    noises: np.ndarray,
    fewest: np.ndarray,
    table: np.ndarray,
    whitened: np.ndarray,
    log_dets: np.ndarray,
) -> None:
    """Innovations over their deviations, under each of some noises.

    Args:
        lengths: places of each line.
        there: whether there is a row at each place, of all lines one after the other.
        noises: both coefficients, share of white noise and innovation of each, shape (noises, 4).
        fewest: places of a line from which its rows are correlated, for each noise.
        table: of the rows that are there, shape (rows, columns).
        whitened: written, shape (noises, rows, columns).
        log_dets: written, of the correlations of each noise.
    """
    room = np.empty((2, table.shape[1]))
    for number in range(noises.shape[0]):
        log_dets[number] = _filtered(
            lengths, there, noises[number], fewest[number], table, whitened[number], room
        )


@kernel(f"float64({_LINES},float64[::1],int64,float64[:,::1],float64[:,::1],float64)")
def misfit(
    lengths: np.ndarray,
    there: np.ndarray,
    noise: np.ndarray,
    fewest: int,
    table: np.ndarray,
    whitened: np.ndarray,
    least: float,
) -> float:
    """n ln(squares/n) + ln det R under one noise, of the last column beside the others; infinite where
    these have no rank.

    Args:
        lengths, there, table: as of `whiten`.
        noise: as of `whiten`, shape (4,).
        fewest: places of a line from which its rows are correlated.
        whitened: room, shape (rows, columns).
        least: that the squares can be; less is rounding error.
    """
    rows, columns = table.shape
    log_det = _filtered(lengths, there, noise, fewest, table, whitened, np.empty((2, columns)))
    products = np.zeros((columns, columns))
    for row in range(rows):
        for one in range(columns):
            for other in range(one + 1):
                products[one, other] += whitened[row, one] * whitened[row, other]
    # Cholesky's factor; what is left of the last column is the sum of squares.
    for one in range(columns):
        for other in range(one + 1):
            left = products[one, other]
            for inner in range(other):
                left -= products[one, inner] * products[other, inner]
            if other < one:
                products[one, other] = left / products[other, other]
            elif one == columns - 1:
                return rows * np.log(max(left, least) / rows) + log_det
            elif left > 0.0:
                products[one, one] = np.sqrt(left)
            else:
                return np.inf
    return np.inf
