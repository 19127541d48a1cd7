"""Plans: which points are run, in batches that may depend on the results of earlier ones."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mckibben.studies.table import Row
from mckibben.studies.variable import Variable, points_of

Array = np.ndarray
#: Yields points, shape (runs, variables), and is sent their rows.
Batches = Generator[Array, Sequence[Row], None]


class Plan(Protocol):
    """Runs of a study; numbered in the order of the batches.

    Attributes:
        variables: columns of the points.
        runs: number of all runs.
    """

    @property
    def variables(self) -> tuple[Variable, ...]: ...  # noqa: D102 - see Attributes

    @property
    def runs(self) -> int: ...  # noqa: D102 - see Attributes

    def batches(self) -> Batches:
        """The points, the same at every call as long as the rows are."""
        ...


@dataclass(frozen=True, eq=False)
class FixedPlan:
    """Points that are known in advance, shape (runs, variables)."""

    variables: tuple[Variable, ...]
    points: Array

    @property
    def runs(self) -> int:
        """Number of runs."""
        return len(self.points)

    def batches(self) -> Batches:
        """All points at once."""
        yield self.points


def grid(variables: Sequence[Variable]) -> FixedPlan:
    """All combinations of the values; the last variable changes fastest."""
    return FixedPlan(tuple(variables), combinations(variables))


def combinations(variables: Sequence[Variable]) -> Array:
    """All combinations of the values, shape (runs, variables); one run without variables."""
    values = [_values(variable) for variable in variables]
    if not values:
        return np.zeros((1, 0))
    return np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, len(values))


def listed(variables: Sequence[Variable]) -> FixedPlan:
    """The first value of each variable, then the second ones; all have as many."""
    return FixedPlan(tuple(variables), np.column_stack([_values(variable) for variable in variables]))


def _values(variable: Variable) -> Array:
    if variable.values is None:
        raise ValueError(f"{variable.name} has no values")
    return variable.values


def monte_carlo(variables: Sequence[Variable], runs: int, seed: int) -> FixedPlan:
    """Independent random points; the first n of them are the same for any number of runs."""
    shares = np.random.default_rng(seed).random((runs, len(variables)))
    return FixedPlan(tuple(variables), points_of(variables, shares))


def latin_hypercube(variables: Sequence[Variable], runs: int, seed: int) -> FixedPlan:
    """A Latin hypercube: each of ``runs`` equal shares of each distribution occurs once, at a random place.

    Source: McKay, Beckman and Conover, Technometrics 21 (1979) 239.
    """
    random = np.random.default_rng(seed)
    cells = np.column_stack([random.permutation(runs) for _ in variables])
    return FixedPlan(tuple(variables), points_of(variables, (cells + random.random(cells.shape)) / runs))


@dataclass(frozen=True, eq=False)
class RobustPlan(FixedPlan):
    """Every design with the same specimens.

    The difference of two designs is then not blurred by different specimens (common random numbers).

    Attributes:
        designs: points of the designs, shape (designs, design variables).
        specimens: number of specimens.
    """

    designs: Array
    specimens: int


def robust(variables: Sequence[Variable], specimens: int, seed: int) -> RobustPlan:
    """All specimens of the first design, then of the second; designs are all combinations.

    Args:
        variables: those of the design first, then those with a distribution.
        specimens, seed: number of specimens, and where their random numbers come from.
    """
    designed = [variable for variable in variables if not variable.tolerance]
    spread = [variable for variable in variables if variable.tolerance]
    designs = combinations(designed)
    shares = np.random.default_rng(seed).random((specimens, len(spread)))
    each = points_of(spread, shares)
    points = np.hstack([np.repeat(designs, specimens, axis=0), np.tile(each, (len(designs), 1))])
    return RobustPlan((*designed, *spread), points, designs, specimens)
