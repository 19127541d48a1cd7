r"""Errors of readings within the stated accuracy: of a clamped length, of a sensor's zero.

Such an error e belongs to some rows: one clamped length, one file. To first order it changes the residual
by :math:`n e`, where n is 1 on these rows if the channel is predicted, and minus the derivative of the
prediction by the channel if it is an input. A fit treats each e as a parameter with the accuracy as its
prior deviation,

.. math:: \min_{\theta, e} \sum_i \frac{(r_i(\theta) - (N e)_i)^2}{s^2} + \sum_j \frac{e_j^2}{\sigma_j^2}

with the deviation s of the residual. The e are eliminated in closed form: the minimum over e is
:math:`|W r|^2 / s^2` with

.. math:: W = (I + X X^T)^{-1/2} = I - U \left(I - (I + S^2)^{-1/2}\right) U^T,
          \quad X = N \Sigma^{1/2} / s = U S V^T

So a weighted residual W r has as many values as r, and at the true model it is white noise of deviation s.
An error of more than its accuracy stays in it.

What the other sensors may be wrong by, a, is common to the m rows of an error and does not average out over
them. So for the error j, :math:`s_j^2 = s^2 + m_j a^2`.

Zero errors of specimens that are mounted one after the other on the same rig are deviations from each other:
what they have in common is an effect, the zero error of the sensor. They sum to zero, so their columns are
taken minus the mean of the columns, :math:`N (I - 11^T/n)`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mckibben.facts.comparison import READING_ERROR
from mckibben.facts.result import result_class

_NOTHING = 1e-9  # singular value below which a reading error changes nothing


@dataclass(frozen=True, eq=False)
class ReadingError:
    """A possible error of readings.

    Attributes:
        channel: that errs.
        of: what it belongs to, in words.
        sigma: its standard deviation, the accuracy [SI].
        unit: of the channel.
        rows: mask of the values that it concerns, shape (values,).
        deviation: whether it is a deviation from those of the same channel of other specimens; all of them
            sum to zero.
    """

    channel: str
    of: str
    sigma: float
    unit: str
    rows: np.ndarray
    deviation: bool = False


@result_class
class AbsorbedError:
    """The estimated error of a reading."""

    FIGURES: ClassVar = READING_ERROR.name

    channel: str
    """The channel."""
    of: str
    """What it belongs to."""
    value: float
    stderr: float
    accuracy: float
    unit: str
    """SI unit of value, stderr and accuracy."""
    rms: float


@dataclass(frozen=True, eq=False)
class ReadingWeights:
    """The matrix W: ``basis`` U of shape (values, errors), ``shrunk`` 1 - (1 + S^2)^(-1/2)."""

    basis: np.ndarray
    shrunk: np.ndarray

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """W times values of shape (values,) or (values, columns)."""
        taken = self.basis.T @ values
        return values - self.basis @ (
            self.shrunk[:, None] * taken if values.ndim > 1 else self.shrunk * taken
        )


def reading_weights(
    errors: Sequence[ReadingError], columns: np.ndarray, *, noise: float, floor: float
) -> ReadingWeights | None:
    """W for some reading errors; None if they change nothing.

    Args:
        errors: the possible errors.
        columns: change of the scaled residual by each error, shape (values, errors).
        noise: of the scaled residual.
        floor: what the other sensors may be wrong by, in the same unit.
    """
    sigmas, deviations = _deviations(errors, noise=noise, floor=floor)
    moved = columns @ _about_their_mean(errors)
    basis, size, _ = np.linalg.svd(moved * (sigmas / deviations), full_matrices=False)
    kept = size > _NOTHING
    if not np.any(kept):
        return None
    return ReadingWeights(basis[:, kept], 1.0 - 1.0 / np.sqrt(1.0 + size[kept] ** 2))


def _deviations(
    errors: Sequence[ReadingError], *, noise: float, floor: float
) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviation of each error, and of the residual as it counts for this error."""
    rows = np.array([np.count_nonzero(error.rows) for error in errors])
    return np.array([error.sigma for error in errors]), np.sqrt(noise**2 + rows * floor**2)


def _about_their_mean(errors: Sequence[ReadingError]) -> np.ndarray:
    """The matrix that takes the mean of each channel from its deviations; other errors stay as they are."""
    matrix = np.eye(len(errors))
    for channel in {error.channel for error in errors if error.deviation}:
        own = [n for n, error in enumerate(errors) if error.deviation and error.channel == channel]
        matrix[np.ix_(own, own)] -= 1.0 / len(own)
    return matrix


def absorbed_errors(
    errors: Sequence[ReadingError],
    columns: np.ndarray,
    residual: np.ndarray,
    *,
    noise: float,
    floor: float,
) -> list[AbsorbedError]:
    """The estimates of reading errors with their standard errors.

    Args:
        errors: the possible errors.
        columns: change of the scaled residual by each, shape (values, errors).
        residual: measured minus predicted over the scale, not weighted.
        noise, floor: as in `reading_weights`.
    """
    if not errors:
        return []
    sigmas, deviation_of = _deviations(errors, noise=noise, floor=floor)
    about = _about_their_mean(errors)
    scaled = (columns @ about) * (sigmas / deviation_of)
    covariance = np.linalg.inv(np.eye(len(errors)) + scaled.T @ scaled)
    values = about @ (sigmas * (covariance @ ((scaled.T @ residual) / deviation_of)))
    ways = about * sigmas
    deviations = np.sqrt(np.diag(ways @ covariance @ ways.T))
    return [
        AbsorbedError(
            error.channel, error.of, float(value), float(deviation), error.sigma, error.unit,
            float(np.sqrt(np.mean((column[error.rows] * value) ** 2))),
        )
        for error, value, deviation, column in zip(errors, values, deviations, columns.T, strict=True)
    ]  # fmt: skip
