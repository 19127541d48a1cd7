"""A varied quantity: from the unit interval to its values, by the inverse of its distribution function."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

Array = np.ndarray
Quantile = Callable[[Array], Array]

# Nearest distance of a share to 0 and 1, where a normal distribution is infinite: 8.1 standard deviations.
_EDGE = 2.0**-52


@dataclass(frozen=True, eq=False)
class Variable:
    """A varied quantity. Points of a study hold its value in SI, or for a choice the number of its text.

    Attributes:
        name: of its column.
        path: in the document of the subject.
        unit: SI unit; "1" for factors; None for a choice or a plain number.
        values: the values of a list, grid or design; None for a distribution without points.
        choices: texts, of a quantity that is a choice; its points are their numbers.
        quantile: from shares in (0, 1) to values; None for a choice or a list of values.
        relative: whether its value is a factor on another value.
        bounds: ends of a range; None otherwise.
        tolerance: whether it differs between specimens, that is, has a distribution.
    """

    name: str
    path: str
    unit: str | None
    values: Array | None = None
    choices: tuple[str, ...] = ()
    quantile: Quantile | None = None
    relative: bool = False
    bounds: tuple[float, float] | None = None
    tolerance: bool = False

    def at(self, shares: Array) -> Array:
        """Values at shares of the distribution function.

        Raises:
            ValueError: a list of values or a choice has no distribution.
        """
        if self.quantile is None:
            raise ValueError(f"{self.name} has no distribution")
        return self.quantile(np.clip(shares, _EDGE, 1.0 - _EDGE))

    def shown(self, value: float) -> float | str:
        """The value of a point, a choice as its text."""
        return self.choices[int(value)] if self.choices else float(value)


def normal(*, mean: float, deviation: float, least: float = -np.inf, most: float = np.inf) -> Quantile:
    r"""Normal distribution, truncated to [least, most].

    .. math:: x(u) = \mu + \sigma \Phi^{-1}\bigl(\Phi(a) + u\,(\Phi(b) - \Phi(a))\bigr),
        \quad a, b = (x_{\min,\max} - \mu)/\sigma

    Args:
        mean, deviation: before truncation.
        least, most: bounds.
    """

    def quantile(shares: Array) -> Array:
        from scipy.special import ndtr, ndtri  # 0.2 s import, not paid at start

        low, high = (least - mean) / deviation, (most - mean) / deviation
        if low > 0.0:  # in the upper tail 1 - u keeps the digits that u loses
            below, above = ndtr(-low), ndtr(-high)
            standard = -ndtri(below + shares * (above - below))
        else:
            below, above = ndtr(low), ndtr(high)
            standard = ndtri(below + shares * (above - below))
        return np.clip(mean + deviation * standard, least, most)

    return quantile


def lognormal(*, median: float, log_deviation: float, least: float = 0.0, most: float = np.inf) -> Quantile:
    """Lognormal distribution: ln(x / median) is normal with this deviation; truncated to [least, most]."""
    with np.errstate(divide="ignore"):
        low, high = np.log(np.array([max(least, 0.0), most]) / median)
    logarithm = normal(mean=0.0, deviation=log_deviation, least=float(low), most=float(high))
    return lambda shares: np.clip(median * np.exp(logarithm(shares)), least, most)


def uniform(*, least: float, most: float) -> Quantile:
    """Uniform distribution on [least, most]."""
    return lambda shares: least + (most - least) * shares


def log_uniform(*, least: float, most: float) -> Quantile:
    """Distribution on [least, most], both above 0, whose logarithm is uniform."""
    ratio = most / least
    return lambda shares: np.clip(least * ratio**shares, least, most)


def triangular(*, least: float, mode: float, most: float) -> Quantile:
    r"""Triangular distribution: :math:`x = a + \sqrt{u (b-a)(m-a)}` up to the mode m, mirrored above it."""

    def quantile(shares: Array) -> Array:
        width = most - least
        rising = least + np.sqrt(shares * width * (mode - least))
        falling = most - np.sqrt((1.0 - shares) * width * (most - mode))
        return np.where(shares * width < mode - least, rising, falling)

    return quantile


def points_of(variables: Sequence[Variable], shares: Array) -> Array:
    """Points at shares of the unit cube, both of shape (runs, variables)."""
    columns = [variable.at(shares[:, index]) for index, variable in enumerate(variables)]
    return np.column_stack(columns)
