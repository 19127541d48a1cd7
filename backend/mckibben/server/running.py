"""A job in a worker process, as the server sees it: its future, and the line on which the worker speaks."""

from __future__ import annotations

import asyncio
import threading
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection

from pebble import ProcessFuture, ProcessPool

from mckibben.server.worker import Message, Refused


@dataclass(eq=False)
class Running:
    """A job in a worker.

    Attributes:
        kind: of `mckibben.server.jobs.JOBS`.
        number: under which the worker introduces itself.
        future: of the answer.
        news: what the worker says; None when the job has ended.
        line: on which it speaks; None = it has not begun.
        speaking: held while something is said on it, and while it is closed.
        stopped: whether it shall end.
        again: how often it was given away once more because it did not begin.
        lost: whether the processes have stopped taking jobs, this one among them.
        pool: that has it.
    """

    kind: str
    number: int
    future: ProcessFuture[bytes | Refused]
    news: asyncio.Queue[Message | None] = field(default_factory=asyncio.Queue)
    line: Connection | None = None
    speaking: threading.Lock = field(default_factory=threading.Lock)
    stopped: bool = False
    again: int = 0
    lost: bool = False
    pool: ProcessPool | None = None

    def ask_to_end(self) -> None:
        """Say so to the worker, if it has begun and has not ended."""
        if self.line is not None:
            with self.speaking, suppress(OSError):  # closed by now
                self.line.send("stop")

    def hear(self, line: Connection, loop: asyncio.AbstractEventLoop) -> None:
        """Pass on what the worker says until it says no more; a thread of its own, which closes the line."""
        self.line = line
        try:
            with suppress(EOFError, OSError):
                while (message := line.recv()).kind != "over" and not loop.is_closed():
                    loop.call_soon_threadsafe(self.news.put_nowait, message)
        finally:
            with self.speaking:  # or what is said now would go to the next connection of this number
                line.close()
