"""What a squared residual is made of: parts that add up to all of it, none counted twice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.comparison import RESIDUAL
from mckibben.facts.result import result_class

Array = NDArray[np.float64]

_BINS = 10
_NOISE = 1.3  # times the noise that a rest may be
_MOST_LEVELS = 12  # different values of a variable that are levels rather than a range
#: Variables in the order in which they take their part.
ORDER = ("contraction", "displacement", "pressure", "command", "direction")


@result_class
class ResidualPart:
    """A part of a squared residual."""

    FIGURES: ClassVar = RESIDUAL.name

    of: str
    """'offset', a variable, 'together' (several variables), or what follows none: 'noise' or 'rest'."""
    share: float


def residual_parts(
    residual: Array, variables: Mapping[str, Array], noise: float | None
) -> list[ResidualPart]:
    r"""The parts of :math:`\sum r^2`: offset, each variable, several together, rest; their sum is 1.

    One after the other takes what the ones before left: the offset its mean, a variable the means of its
    levels or of ten ranges with equally many rows, 'together' the means of the cells of all variables. What
    chance would give is taken away from each and belongs to the rest: :math:`(k-1)\,s^2` of k means and
    :math:`s^2` of the offset, with the variance :math:`s^2` inside the cells. A sequential analysis of
    variance: Montgomery, Design and Analysis of Experiments, chapter 5.

    Args:
        residual: shape (rows,).
        variables: name -> values, shape (rows,); those not in `ORDER` are left out.
        noise: standard deviation of the noise in the unit of the residual, None where it is not known. A rest
            of at most 1.3 times it is noise.

    Returns:
        Empty where the residual is zero everywhere.
    """
    whole = float(np.sum(residual**2))
    if not whole > 0.0:
        return []
    places = {name: _places(variables[name]) for name in ORDER if name in variables}
    cells = _cells(list(places.values()), len(residual))
    chance = _variance_inside(residual, cells)
    left = residual - np.mean(residual)
    parts = {"offset": max(whole - float(np.sum(left**2)) - chance, 0.0)}
    for name, place in [*places.items(), ("together", cells)]:
        if name == "together" and len(places) < 2:
            continue
        before = float(np.sum(left**2))
        left = left - _means(left, place)
        parts[name] = max(before - float(np.sum(left**2)) - int(np.max(place)) * chance, 0.0)
    rest = max(whole - sum(parts.values()), 0.0)
    alone = noise is not None and np.sqrt(rest / len(residual)) <= _NOISE * noise
    parts["noise" if alone else "rest"] = rest
    return [ResidualPart(name, value / whole) for name, value in parts.items()]


def _places(values: Array) -> NDArray[np.intp]:
    """The level or range of each value, from 0 without gaps."""
    levels = np.unique(values)
    if len(levels) > _MOST_LEVELS:
        edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, _BINS + 1)))
        place = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, max(len(edges) - 2, 0))
    else:
        place = np.searchsorted(levels, values)
    return np.unique(place, return_inverse=True)[1]


def _cells(places: Sequence[NDArray[np.intp]], rows: int) -> NDArray[np.intp]:
    """The cell of each row in the grid of all variables, from 0 without gaps."""
    cell = np.zeros(rows, dtype=np.intp)
    for place in places:
        cell = np.unique(cell * (int(np.max(place)) + 1) + place, return_inverse=True)[1]
    return cell


def _means(values: Array, place: NDArray[np.intp]) -> Array:
    """The mean of the values at each row's place."""
    return (np.bincount(place, values) / np.bincount(place))[place]


def _variance_inside(residual: Array, cells: NDArray[np.intp]) -> float:
    """Variance of the residual around the means of its cells; 0 where no cell has two rows."""
    freedom = len(residual) - (int(np.max(cells)) + 1)
    return float(np.sum((residual - _means(residual, cells)) ** 2)) / freedom if freedom > 0 else 0.0
