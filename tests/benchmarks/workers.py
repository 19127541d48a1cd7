"""Cases in parallel: one process for each core, with one thread and a studio of its own.

``MCKIBBEN_PROCESSES=1`` leaves the other cores alone.
"""

from __future__ import annotations

import hashlib
import multiprocessing
import os
import pickle
import resource
import time
from argparse import ArgumentParser
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from mckibben.documents.studio import Studio

Item = TypeVar("Item")
Found = TypeVar("Found")


@dataclass(frozen=True)
class Examined(Generic[Found]):
    """What became of one case.

    Attributes:
        key: of the case.
        result: what the work made of it.
        seconds: of processor time, children included.
        code: hash of the program that it was made with.
    """

    key: str
    result: Found
    seconds: float
    code: str


def in_parallel(work: Callable[[Item], Found], items: Iterable[Item]) -> Iterator[Found]:
    """What the work makes of each item, in the order in which it is done."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    processes = int(os.environ.get("MCKIBBEN_PROCESSES", os.cpu_count() or 1))
    if processes == 1:
        yield from map(work, items)
        return
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        yield from pool.imap_unordered(work, items)


def examined(
    work: Callable[[Item], Found],
    items: Iterable[Item],
    *,
    key: Callable[[Item], str] = str,
    keep: Path | None = None,
) -> Iterator[Examined[Found]]:
    """What the work makes of each item, with its processor time; what a file keeps is not done again.

    Args:
        work: on one item, in a process of its own.
        items: to work on.
        key: of an item, by which a file knows it again.
        keep: file to which each case is added as soon as it is done; None keeps nothing.
    """
    done: dict[str, Examined[Found]] = {}
    if keep is not None and keep.exists():
        with keep.open("rb") as file:
            while file.peek(1):
                one = pickle.load(file)
                done[one.key] = one
    waiting = []
    for item in items:
        if key(item) in done:
            yield done[key(item)]
        else:
            waiting.append((key(item), item))
    for one in in_parallel(partial(_timed, work), waiting):
        if keep is not None:
            with keep.open("ab") as file:
                pickle.dump(one, file)
        yield one


def _timed(work: Callable[[Item], Found], named: tuple[str, Item]) -> Examined[Found]:
    own_studio()
    key, item = named
    began = processor_time()
    result = work(item)
    return Examined(key, result, processor_time() - began, code_hash())


def processor_time() -> float:
    """Processor time [s] of this process and of its children that have ended."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


@cache
def code_hash() -> str:
    """Hash of the program: what was examined with another one is told."""
    found = hashlib.sha256()
    for file in sorted((Path(__file__).parents[2] / "backend" / "mckibben").rglob("*.py")):
        found.update(file.read_bytes())
    return found.hexdigest()[:12]


def other_code(lines: Iterable[Examined[Any]]) -> str:
    """How many of the lines were made with another program than this one; empty for none."""
    count = sum(line.code != code_hash() for line in lines)
    return f"{count} cases were examined with another version of the program" if count else ""


def add_keep(parser: ArgumentParser) -> None:
    """The option that lets an examination go on after an interruption."""
    parser.add_argument("--keep", type=Path, default=None, help="file of the cases done; goes on after them")


@cache
def own_studio() -> Studio:
    """The catalogues of a process, its kernels loaded."""
    # Imported here: each process limits its threads before numpy is loaded.
    from mckibben.documents.studio import Studio
    from mckibben.resources import presets_folder
    from mckibben.simulation.integrate.lane_buffers import lane_kernels

    lane_kernels.warm().join()
    return Studio(presets=presets_folder())
