"""How likely a drive does its task: specimens are simulated that vary as `mckibben.sizing.spread` says."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from mckibben.sizing.bench import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.prepared import Prepared
from mckibben.sizing.spread import Spread, spread_of
from mckibben.sizing.task import Task
from mckibben.sizing.trial import times_over

_CHUNK = 25  # specimens a thread takes at a time


@dataclass(frozen=True, slots=True)
class Chance:
    """Share of the specimens that do the task, its standard error, and how many there were."""

    probability: float
    error: float
    specimens: int


def chance(bench: Bench, design: Design, share: tuple[float, float], specimens: int) -> Chance:
    """The probability that a design does the task.

    Args:
        bench: of the task.
        design: what is built.
        share: of the whole work before and after, for its progress.
        specimens: how many are simulated.

    Raises:
        EndedError: the bench's watch says so.
    """
    prepared, spread = bench.prepared(design), spread_of(design, bench.task, specimens)
    starts = range(0, specimens, _CHUNK)

    def met(begin: int) -> int:
        chosen = range(begin, min(begin + _CHUNK, specimens))
        return sum(_met(prepared, bench.task, spread, index) for index in chosen)

    probability = sum(bench.each(met, starts, share, len(starts))) / specimens
    # At 0 and 1 as if one specimen had been otherwise.
    variance = max(probability * (1.0 - probability), 1.0 / specimens)
    return Chance(probability, sqrt(variance / specimens), specimens)


def _met(prepared: Prepared, task: Task, spread: Spread, index: int) -> bool:
    """Whether one specimen reaches the end of the stroke in time, keeps it, and is back in time."""
    figures = prepared.built(
        float(spread.shift[index]),
        float(spread.friction[index]),
        float(spread.pressure[index]),
        task.returns,
    )
    late = max(times_over(figures, task).values(), default=0.0)
    return figures.time is not None and figures.held and late <= 1.0
