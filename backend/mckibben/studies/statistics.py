"""Statistics of a study: percentiles and moments with intervals, probabilities, rank correlations.

Intervals hold for independent runs, that is Monte Carlo studies; others have none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from mckibben.facts.result import Number, result_class
from mckibben.facts.study import INFLUENCE, STUDY, SUMMARY
from mckibben.studies.optimise import FigureLimit, keeps
from mckibben.studies.table import StudyTable

Array = np.ndarray
PERCENTILES = (1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0)


@result_class
class Estimate:
    """A value with the ends of its confidence interval; None where the runs do not give them."""

    value: Number
    """The value."""
    low: float | None = None
    """Lower end; None where the runs do not give one."""
    high: float | None = None
    """Upper end; None where the runs do not give one."""


@result_class
class FigureSummary:
    """A figure over all runs that have it; SI."""

    FIGURES: ClassVar = SUMMARY.name

    figure: str
    """Path of the figure."""
    unit: str
    """Its SI unit."""
    count: int
    missing: int
    mean: Estimate | None
    deviation: Estimate | None
    least: float | None
    most: float | None
    percentiles: dict[str, Estimate]


@result_class
class Probability:
    """Share of the runs that keep limits, with the exact interval of Clopper and Pearson."""

    FIGURES: ClassVar = STUDY.name

    what: str
    """The figure of the limit, or 'all'."""
    kept: int
    """Runs that keep it."""
    runs: int
    """All runs."""
    probability: Estimate


@result_class
class FigureCorrelation:
    """Spearman's rank correlation of a quantity and a figure; None where one of them does not vary."""

    FIGURES: ClassVar = INFLUENCE.name

    figure: str
    """Path of the figure."""
    quantity: str
    """Name of the quantity."""
    rank_correlation: float | None


def summaries(table: StudyTable, confidence: float, independent: bool) -> list[FigureSummary]:
    """Each figure over all runs that have it."""
    return [
        _summary(figure.path, figure.unit, table.figure(figure.path), confidence, independent)
        for figure in table.figures
    ]


def _summary(name: str, unit: str, values: Array, confidence: float, independent: bool) -> FigureSummary:
    known = np.sort(values[np.isfinite(values)])
    count, missing = len(known), int(len(values) - len(known))
    if not count:
        return FigureSummary(name, unit, 0, missing, None, None, None, None, {})
    mean, deviation = float(known.mean()), float(known.std(ddof=1)) if count > 1 else None
    of_mean, of_deviation = Estimate(mean), None if deviation is None else Estimate(deviation)
    if independent and deviation is not None:
        from scipy.special import chdtri, stdtrit

        tail = 0.5 * (1.0 - confidence)
        half = float(stdtrit(count - 1, 1.0 - tail)) * deviation / count**0.5
        of_mean = Estimate(mean, mean - half, mean + half)
        ends = [deviation * float(((count - 1) / chdtri(count - 1, p)) ** 0.5) for p in (tail, 1.0 - tail)]
        of_deviation = Estimate(deviation, *ends)
    percentiles = {
        f"{percent:g}": _percentile(known, percent / 100.0, confidence if independent else None)
        for percent in PERCENTILES
    }
    return FigureSummary(
        name, unit, count, missing, of_mean, of_deviation, float(known[0]), float(known[-1]), percentiles
    )


def _percentile(known: Array, share: float, confidence: float | None) -> Estimate:
    r"""A percentile by linear interpolation; its interval from the order statistics.

    The number of values below the true percentile is binomial, so :math:`[x_{(l)}, x_{(u)}]` with the
    binomial quantiles l and u + 1 of the tails covers it with at least the confidence. None where an end lies
    beyond the extremes.
    """
    value = float(np.quantile(known, share))
    if confidence is None:
        return Estimate(value)
    from scipy.stats import binom

    tail, count = 0.5 * (1.0 - confidence), len(known)
    lower = int(binom.ppf(tail, count, share))  # P(B < lower) <= tail
    upper = int(binom.ppf(1.0 - tail, count, share)) + 1  # P(B >= upper) <= tail
    return Estimate(
        value,
        float(known[lower - 1]) if lower >= 1 else None,
        float(known[upper - 1]) if upper <= count else None,
    )


def probability(what: str, kept: Array, confidence: float, independent: bool = True) -> Probability:
    """The share of runs that are True."""
    runs, number = len(kept), int(np.sum(kept))
    share = number / runs if runs else float("nan")
    if not independent or not runs:
        return Probability(what, number, runs, Estimate(share))
    from scipy.special import betaincinv

    tail = 0.5 * (1.0 - confidence)
    low = 0.0 if number == 0 else float(betaincinv(number, runs - number + 1, tail))
    high = 1.0 if number == runs else float(betaincinv(number + 1, runs - number, 1.0 - tail))
    return Probability(what, number, runs, Estimate(share, low, high))


def probabilities(
    table: StudyTable, limits: Sequence[FigureLimit], confidence: float, independent: bool
) -> list[Probability]:
    """Probability of keeping each limit, and all of them; empty without limits."""
    if not limits:
        return []
    each = [
        probability(item.figure, item.kept(table.figure(item.figure)), confidence, independent)
        for item in limits
    ]
    return [*each, probability("all", keeps(table, limits), confidence, independent)]


def correlations(table: StudyTable) -> list[FigureCorrelation]:
    """Rank correlations of every quantity with every figure."""
    from scipy.stats import rankdata

    found = []
    for figure in table.figures:
        values = table.figure(figure.path)
        known = np.isfinite(values)
        for index, variable in enumerate(table.variables):
            x, y = table.points[known, index], values[known]
            coefficient = None
            if not variable.choices and len(x) > 2 and np.ptp(x) > 0.0 and np.ptp(y) > 0.0:
                coefficient = float(np.corrcoef(rankdata(x), rankdata(y))[0, 1])
            found.append(FigureCorrelation(figure.path, variable.name, coefficient))
    return found
