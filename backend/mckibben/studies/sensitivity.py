"""Global sensitivity: Sobol's indices and Morris' elementary effects, with SALib.

Both need complete blocks of runs: where a run of a block has no figure, the whole block is left out, and the
result says how many were.

Sources: Sobol, Math. Comput. Simul. 55 (2001) 271; Saltelli et al., Comput. Phys. Commun. 181 (2010) 259
(estimators); Morris, Technometrics 33 (1991) 161; Campolongo et al., Environ. Model. Softw. 22 (2007) 1509.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from mckibben.extras import of_extra
from mckibben.facts.result import result_class
from mckibben.facts.study import INFLUENCE
from mckibben.studies.plan import FixedPlan
from mckibben.studies.table import StudyTable
from mckibben.studies.variable import Variable, points_of

Array = np.ndarray
_RESAMPLES = 200  # of the bootstrap for intervals: their half widths are then known within about 5 %
_LEAST_BLOCKS = 8  # fewer give no interval worth the name


@result_class
class Influence:
    """Influence of a quantity on a figure, by Sobol or by Morris; effects are in the unit of the figure."""

    FIGURES: ClassVar = INFLUENCE.name

    figure: str
    """Path of the figure."""
    quantity: str
    """Name of the quantity."""
    first: float | None = None
    first_error: float | None = None
    total: float | None = None
    total_error: float | None = None
    mean: float | None = None
    mean_size: float | None = None
    mean_size_error: float | None = None
    deviation: float | None = None


@result_class
class Sensitivity:
    """Influences on a figure, and from how many blocks of runs they follow; empty with too few."""

    figure: str
    """Path of the figure."""
    influences: tuple[Influence, ...]
    """Of each quantity; empty with too few runs."""
    blocks: int
    """Blocks of runs used; one with a failed run is left out."""


@dataclass(frozen=True, eq=False)
class SobolPlan(FixedPlan):
    """Runs for Sobol's indices; blocks of variables + 2 runs belong together."""

    seed: int

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return self.runs // (len(self.variables) + 2)

    def sensitivity(self, table: StudyTable, confidence: float) -> list[Sensitivity]:
        """First-order and total indices of each figure."""
        sobol = of_extra("SALib.analyze.sobol")

        def analyse(values: Array, _: Array) -> list[dict[str, float]]:
            found = sobol.analyze(
                _problem(self.variables), values, calc_second_order=False, num_resamples=_RESAMPLES,
                conf_level=confidence, seed=self.seed,
            )  # fmt: skip
            names = {"first": "S1", "first_error": "S1_conf", "total": "ST", "total_error": "ST_conf"}
            return _by_variable(found, names, len(self.variables))

        return _each_figure(self, table, analyse)


def sobol_plan(variables: Sequence[Variable], samples: int, seed: int) -> SobolPlan:
    """Saltelli's sampling on a scrambled Sobol sequence: samples * (variables + 2) runs."""
    sobol = of_extra("SALib.sample.sobol")

    shares = sobol.sample(_problem(variables), samples, calc_second_order=False, seed=seed)
    return SobolPlan(tuple(variables), points_of(variables, np.asarray(shares)), seed)


@dataclass(frozen=True, eq=False)
class MorrisPlan(FixedPlan):
    """Runs for elementary effects; trajectories of variables + 1 runs belong together."""

    shares: Array
    levels: int
    seed: int

    @property
    def blocks(self) -> int:
        """Number of trajectories."""
        return self.runs // (len(self.variables) + 1)

    def sensitivity(self, table: StudyTable, confidence: float) -> list[Sensitivity]:
        """Elementary effects on each figure."""
        morris = of_extra("SALib.analyze.morris")

        def analyse(values: Array, runs: Array) -> list[dict[str, float]]:
            found = morris.analyze(
                _problem(self.variables), self.shares[runs], values, num_resamples=_RESAMPLES,
                conf_level=confidence, num_levels=self.levels, seed=self.seed,
            )  # fmt: skip
            names = {
                "mean": "mu",
                "mean_size": "mu_star",
                "mean_size_error": "mu_star_conf",
                "deviation": "sigma",
            }
            return _by_variable(found, names, len(self.variables))

        return _each_figure(self, table, analyse)


def morris_plan(variables: Sequence[Variable], trajectories: int, levels: int, seed: int) -> MorrisPlan:
    """Random trajectories that change one quantity at a time: trajectories * (variables + 1) runs.

    A range is covered from end to end; a distribution, which may be unbounded, between its quantiles
    0.5 / levels and 1 - 0.5 / levels.
    """
    morris = of_extra("SALib.sample.morris")

    shares = np.asarray(morris.sample(_problem(variables), trajectories, num_levels=levels, seed=seed))
    outside = np.array([0.5 / levels if variable.tolerance else 0.0 for variable in variables])
    points = points_of(variables, outside + shares * (1.0 - 2.0 * outside))
    return MorrisPlan(tuple(variables), points, shares, levels, seed)


def _problem(variables: Sequence[Variable]) -> dict[str, Any]:
    count = len(variables)
    return {
        "num_vars": count,
        "names": [f"x{index}" for index in range(count)],
        "bounds": [[0.0, 1.0]] * count,
    }


def _by_variable(found: Any, names: dict[str, str], count: int) -> list[dict[str, float]]:
    return [{name: float(found[key][index]) for name, key in names.items()} for index in range(count)]


def _each_figure(plan: SobolPlan | MorrisPlan, table: StudyTable, analyse: Any) -> list[Sensitivity]:
    block, results = plan.runs // plan.blocks, []
    for figure in table.figures:
        whole = np.full(plan.runs, np.nan)
        whole[table.runs] = table.figure(figure.path)
        kept = np.isfinite(whole.reshape(plan.blocks, block)).all(axis=1)
        runs = np.flatnonzero(np.repeat(kept, block))
        blocks, influences = int(kept.sum()), ()
        if blocks >= min(_LEAST_BLOCKS, plan.blocks) and np.ptp(whole[runs]) > 0.0:
            influences = tuple(
                Influence(figure.path, variable.name, **estimate)
                for variable, estimate in zip(plan.variables, analyse(whole[runs], runs), strict=True)
            )
        results.append(Sensitivity(figure.path, influences, blocks))
    return results
