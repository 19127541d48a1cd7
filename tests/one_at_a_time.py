"""A lock between processes, for what only one of them should do while the others wait for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def one_at_a_time(lock: Path, waits: Callable[[], None] = lambda: None) -> Iterator[None]:
    """Hold back every other process that asks for the same lock.

    Args:
        lock: a file, created if need be; it stays.
        waits: called once before this process waits for another.
    """
    try:
        import fcntl
    except ImportError:  # Windows: each does it for itself
        yield
        return
    with lock.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            waits()
            fcntl.flock(file, fcntl.LOCK_EX)
        yield
