"""Cases in parallel: one process for each core, with one thread and a studio of its own."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from mckibben.documents.studio import Studio

Item = TypeVar("Item")
Found = TypeVar("Found")


def in_parallel(work: Callable[[Item], Found], items: Iterable[Item]) -> Iterator[Found]:
    """What the work makes of each item, in the order in which it is done."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        yield from pool.imap_unordered(work, items)


@cache
def own_studio() -> Studio:
    """The catalogues of a process, its kernels loaded."""
    # Imported here: each process limits its threads before numpy is loaded.
    from mckibben.documents.studio import Studio
    from mckibben.resources import presets_folder
    from mckibben.simulation.integrate.engine import kernel

    kernel.warm().join()
    return Studio(presets=presets_folder())
