"""Correlation of a residual with the input that drove the test: what is missed of how the input acts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from mckibben.facts.comparison import RESIDUAL
from mckibben.facts.result import Integers, Series, result_class

_LAGS = 25  # rows, both ways
_LEAST = 4  # lengths of the lags that a sweep has at least
_BAND = 1.959964  # standard deviations of a 95 % band
_VARIES = 0.03  # of its largest value; an input that changes by less within the sweeps is held constant
#: What drives a test, the most immediate first.
INPUTS = ("command", "pressure", "load", "contraction")


@result_class
class CrossCorrelation:
    """Of one channel."""

    FIGURES: ClassVar = RESIDUAL.name

    channel: str
    """The predicted channel."""
    input: str
    """Name of the input."""
    lags: Integers
    """Rows by which the residual comes after the input; negative: before."""
    correlation: Series
    band: float
    outside: float


def cross_correlation(
    channel: str, residual: np.ndarray, inputs: Mapping[str, np.ndarray], sweeps: Sequence[np.ndarray]
) -> CrossCorrelation | None:
    """Of the residual with the first of `INPUTS` that varies within the sweeps; None without one.

    The band is that of L. Ljung, System Identification, 2nd ed. (1999), section 16.6: the variance of the
    correlation at a lag is the sum over k of rho_residual(k) rho_input(k), over the number of rows.

    Args:
        channel: name of the predicted channel.
        residual: shape (values,).
        inputs: name -> shape (values,).
        sweeps: indices of the rows of each sweep in the order of time.
    """
    long = [rows for rows in sweeps if len(rows) >= _LEAST * _LAGS]
    others = [one for one in INPUTS if one in inputs and one != channel]
    name = next((one for one in others if _varies(inputs[one], long)), None)
    if name is None:
        return None
    ends = [_centred(residual[rows]) for rows in long]
    begins = [_centred(inputs[name][rows]) for rows in long]
    lags = np.arange(-_LAGS, _LAGS + 1)
    rho = np.array([_correlation(ends, begins, int(lag)) for lag in lags])
    reach = min(map(len, long)) // _LEAST
    spread = 1.0 + 2.0 * float(_autocorrelation(ends, reach) @ _autocorrelation(begins, reach))
    band = _BAND * float(np.sqrt(max(spread, 1.0) / sum(map(len, long))))
    return CrossCorrelation(channel, name, lags, rho, band, float(np.mean(np.abs(rho) > band)))


def _varies(values: np.ndarray, sweeps: Sequence[np.ndarray]) -> bool:
    """Whether an input is known in all rows and not held within the sweeps."""
    if not all(np.all(np.isfinite(values[rows])) for rows in sweeps):
        return False
    largest = max((float(np.max(np.abs(values[rows]))) for rows in sweeps), default=0.0)
    return any(float(np.ptp(values[rows])) > _VARIES * largest for rows in sweeps)


def _centred(values: np.ndarray) -> np.ndarray:
    return values - np.mean(values)


def _autocorrelation(lines: Sequence[np.ndarray], most: int) -> np.ndarray:
    """At the lags 1 to ``most``, all sweeps together; by Fourier transforms, as there are many lags."""
    sums = np.zeros(most + 1)
    for line in lines:
        power = np.abs(np.fft.rfft(line, 2 * len(line))) ** 2
        sums += np.fft.irfft(power)[: most + 1]
    return sums[1:] / sums[0] if sums[0] > 0.0 else sums[1:]


def _correlation(after: Sequence[np.ndarray], before: Sequence[np.ndarray], lag: int) -> float:
    """Of ``after`` at a row with ``before`` so many rows earlier, all sweeps together."""
    if lag < 0:
        return _correlation(before, after, -lag)
    products = sum(float(a[lag:] @ b[: len(b) - lag]) for a, b in zip(after, before, strict=True))
    squares = [sum(float(one @ one) for one in lines) for lines in (after, before)]
    size = float(np.sqrt(squares[0] * squares[1]))
    return products / size if size > 0.0 else 0.0
