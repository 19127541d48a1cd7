"""Runs the points of a plan in chunks, by threads of this process or by a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import suppress
from itertools import islice

import numpy as np

from mckibben.simulation.outcome import Outcome, Watch
from mckibben.studies.plan import Plan
from mckibben.studies.table import Evaluate, Figure, Row, StudyTable

Array = np.ndarray
#: Numbers of runs and their points: what a worker gets at a time.
Chunk = tuple[list[int], Array]
#: From chunks to finished chunks, in any order.
Workers = Callable[[Iterable[Chunk]], Iterator[tuple[Chunk, Sequence[Row]]]]
CHUNK = 64  # runs: eight full lanes of the engine several times over, and news twice a second
_THREADS = 2


def in_threads(evaluate: Evaluate, threads: int = _THREADS) -> Workers:
    """Workers of this process; the engine releases the interpreter lock while it integrates."""

    def work(chunks: Iterable[Chunk]) -> Iterator[tuple[Chunk, Sequence[Row]]]:
        source = iter(chunks)
        with ThreadPoolExecutor(threads) as pool:
            running: dict[Future[Sequence[Row]], Chunk] = {}
            try:
                while True:
                    for chunk in islice(source, 2 * threads - len(running)):
                        running[pool.submit(evaluate, chunk[1])] = chunk
                    if not running:
                        return
                    for done in wait(running, return_when=FIRST_COMPLETED).done:
                        yield running.pop(done), done.result()
            finally:
                for waiting in running:
                    waiting.cancel()

    return work


class _Ended(Exception):  # noqa: N818 - not an error
    """The watch ends the study."""


def run_plan(
    plan: Plan,
    figures: Sequence[Figure],
    workers: Workers,
    watch: Watch,
    *,
    known: Mapping[int, Row] | None = None,
    finished: Callable[[Sequence[int], Array, Sequence[Row]], None] | None = None,
    recalled: Callable[[Sequence[int], Array, Sequence[Row]], None] | None = None,
    chunk: int = CHUNK,
) -> tuple[StudyTable, Outcome]:
    """All runs of a plan, or those made before the watch ended the study.

    The table does not depend on the workers or the size of a chunk.

    Args:
        plan: the points.
        figures: columns of the rows.
        workers: who runs them.
        watch: follows and ends the study.
        known: rows of an interrupted study by the number of their run; they are not made again.
        finished: called with numbers, points and rows of each chunk, in the order in which they end.
        recalled: called alike with the runs of each batch that are known.
        chunk: number of runs that a worker gets at a time.
    """
    known = known or {}
    rows: dict[int, Row] = {}
    points: dict[int, Array] = {}
    outcome = Outcome.COMPLETED
    total, begin = plan.runs, 0

    def check() -> None:
        nonlocal outcome
        ended = watch.ended(len(rows) / total)
        if ended is not None:
            outcome = ended
            raise _Ended

    def chunks_of(batch: Array, first: int) -> Iterator[Chunk]:
        missing = [run for run in range(first, first + len(batch)) if run not in rows]
        for place in range(0, len(missing), chunk):
            check()
            numbers = missing[place : place + chunk]
            yield numbers, batch[[number - first for number in numbers]]

    batches = plan.batches()
    with suppress(_Ended):
        answer: list[Row] | None = None
        while True:
            try:
                batch = next(batches) if answer is None else batches.send(answer)
            except StopIteration:
                break
            numbers = range(begin, begin + len(batch))
            points |= zip(numbers, batch, strict=True)
            found = [number for number in numbers if number in known]
            rows |= {number: known[number] for number in found}
            if found and recalled is not None:
                recalled(found, batch[[number - begin for number in found]], [rows[n] for n in found])
            if len(found) < len(numbers):
                check()
            for (made, made_points), results in workers(chunks_of(batch, begin)):
                rows |= zip(made, results, strict=True)
                if finished is not None:
                    finished(made, made_points, results)
                check()
            answer = [rows[number] for number in numbers]
            begin += len(batch)
    return StudyTable.of(plan.variables, figures, points, rows), outcome
