"""Limits on the work of fits and searches. They depend on the cost of a prediction, never on the clock."""

from __future__ import annotations

from dataclasses import dataclass

_STARTS = 4  # the given one and three random ones, against local minima
_TIGHT = 1e-10  # tolerance; with exact derivatives it costs only one more evaluation


@dataclass(frozen=True, slots=True)
class FitEffort:
    """Limits of one fit.

    Attributes:
        starts: number of starts: the given one and random ones inside the bounds. The best result counts.
        tolerance: relative change of the sum of squares at which the fit stops.
        evaluations: most evaluations from each start.
    """

    starts: int
    tolerance: float
    evaluations: int


@dataclass(frozen=True, slots=True)
class SearchEffort:
    """Limits of a diagnosis.

    Attributes:
        fit: limits of each fit.
        tried: candidates fitted per model: those with the largest first-order gain.
        thorough: whether further constants of the start model's effects are tried too.
        dimensions: whether wrong dimensions of the muscle are tried as an explanation.
    """

    fit: FitEffort
    tried: int
    thorough: bool
    dimensions: bool


def search_effort(*, simulated: bool) -> FitEffort:
    """Limits of a fit within a search; simulated runs only have finite-difference derivatives."""
    return FitEffort(1, 1e-4, 20) if simulated else FitEffort(1, 1e-6, 60)


def final_effort(*, simulated: bool) -> FitEffort:
    """Limits of a single fit whose results are shown."""
    return FitEffort(1, 1e-5, 40) if simulated else FitEffort(_STARTS, _TIGHT, 200)


def diagnosis_effort(*, simulated: bool) -> SearchEffort:
    """Limits of a diagnosis; a simulated run costs a thousand times a closed-form evaluation."""
    fit = search_effort(simulated=simulated)
    if simulated:
        return SearchEffort(fit, tried=12, thorough=False, dimensions=False)
    return SearchEffort(fit, tried=40, thorough=True, dimensions=True)
