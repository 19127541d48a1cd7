"""Work on several records at once, in two threads: simulated runs release the interpreter lock."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

_THREADS = 2  # cores of a small computer
_NAME = "records"


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(_THREADS, _NAME)


def side_by_side(function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """Results of a function of items, in their order; a single item is done in this thread, and so are items
    of items, which would wait for each other.

    Args:
        function: must release the interpreter lock for most of its time, else two threads gain nothing. Its
            result must not depend on which item is done first.
    """
    if len(items) < 2 or threading.current_thread().name.startswith(_NAME):
        return [function(item) for item in items]
    return list(_pool().map(function, items))
