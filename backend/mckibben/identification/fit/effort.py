"""How much work a fit and a search may do. It depends on what a prediction costs, never on the clock."""

from __future__ import annotations

from dataclasses import dataclass

_STARTS = 4
_TIGHT = 1e-10  # with exact derivatives a fit converges quadratically: this costs one evaluation more


@dataclass(frozen=True, slots=True)
class FitEffort:
    """Work of one fit.

    Attributes:
        starts: the given start and random ones inside the bounds; the best end wins.
        tolerance: relative change of the sum of squares, of the numbers and of the gradient that ends it.
        evaluations: most evaluations of each start.
    """

    starts: int
    tolerance: float
    evaluations: int


@dataclass(frozen=True, slots=True)
class SearchEffort:
    """Work of a diagnosis.

    Attributes:
        fit: of each fit.
        tried: candidates that are fitted to one model, those that promise most to first order.
        thorough: whether further constants of the start model too are tried in every model.
        dimensions: whether other dimensions of the muscle are tried as an explanation.
    """

    fit: FitEffort
    tried: int
    thorough: bool
    dimensions: bool


def search_effort(*, simulated: bool) -> FitEffort:
    """Of a fit within a search: nearly exact for closed forms, as fine as the differences for runs."""
    return FitEffort(1, 1e-4, 20) if simulated else FitEffort(1, 1e-6, 60)


def final_effort(*, simulated: bool) -> FitEffort:
    """Of a single fit whose numbers are shown."""
    return FitEffort(1, 1e-5, 40) if simulated else FitEffort(_STARTS, _TIGHT, 200)


def diagnosis_effort(*, simulated: bool) -> SearchEffort:
    """Of a diagnosis; a run costs thousands of times what a closed form does."""
    fit = search_effort(simulated=simulated)
    if simulated:
        return SearchEffort(fit, tried=12, thorough=False, dimensions=False)
    return SearchEffort(fit, tried=40, thorough=True, dimensions=True)
