"""A lane of worker processes: its size, a place in its queue, and its refusal when that is full."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Lane:
    """Processes for one sort of work, so that no sort waits for another.

    Attributes:
        processes: jobs that run at a time.
        queue: jobs that may wait; more are refused.
        memory: bytes that one process may take.
        compiled: whether its jobs run the integrators, which take seconds to load.
    """

    processes: int
    queue: int
    memory: int
    compiled: bool = True


class BusyError(Exception):
    """The queue is full.

    Attributes:
        waiting: jobs in it.
        seconds: after which there will be room, about.
    """

    def __init__(self, waiting: int, seconds: float) -> None:
        super().__init__(waiting, seconds)
        self.waiting, self.seconds = waiting, seconds


@dataclass(frozen=True, slots=True)
class Place:
    """A place in the queue: number of jobs before this one, and the time until it begins, about [s]."""

    before: int
    seconds: float
