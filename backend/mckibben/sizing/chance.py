"""Probability that a drive does its task, from simulated specimens; see `mckibben.sizing.spread`."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.prepared import Figures
from mckibben.sizing.side_by_side import Case, figures_of_many
from mckibben.sizing.spread import spread_of
from mckibben.sizing.task import Task
from mckibben.sizing.trial import times_over

_CHUNK = 128  # specimens a thread takes at a time


@dataclass(frozen=True, slots=True)
class Chance:
    """Share of the specimens that fulfil the task, its standard error, and the number of specimens."""

    probability: float
    error: float
    specimens: int


def chance(bench: Bench, design: Design, share: tuple[float, float], specimens: int) -> Chance:
    """The probability that a design fulfils the task.

    Args:
        bench: runs the designs of the task.
        design: the design.
        share: progress before and after, as shares of the whole work.
        specimens: number of specimens simulated.

    Raises:
        EndedError: the bench's watch ends the work.
    """
    prepared, spread = bench.prepared(design), spread_of(design, bench.task, specimens)
    starts = range(0, specimens, _CHUNK)

    def successes(begin: int) -> int:
        chosen = range(begin, min(begin + _CHUNK, specimens))
        cases = [
            Case(prepared, *prepared.specimen(spread.shift[i], spread.friction[i], spread.pressure[i]))
            for i in chosen
        ]
        return sum(_succeeds(figures, bench.task) for figures in figures_of_many(cases, bench.task.returns))

    probability = sum(bench.each(successes, starts, share, len(starts))) / specimens
    # At 0 and 1 the variance is that of one deviating specimen, not zero.
    variance = max(probability * (1.0 - probability), 1.0 / specimens)
    return Chance(probability, sqrt(variance / specimens), specimens)


def _succeeds(figures: Figures, task: Task) -> bool:
    """Whether one specimen reaches the end of the stroke in time, stays there, and returns in time."""
    late = max(times_over(figures, task).values(), default=0.0)
    return figures.time is not None and figures.holds and late <= 1.0
