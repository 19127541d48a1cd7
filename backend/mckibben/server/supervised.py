"""One worker process and the pipe that only the server and this process hold.

A thread starts the process and hears it; all else happens on the event loop. The end of the pipe is the death
of the process: nothing is concluded from silence, except where a process is stopped from outside.
"""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from mckibben.server.jobs import JOBS
from mckibben.server.lane import Lane
from mckibben.server.settings import Settings
from mckibben.server.worker import Message, Order, Stop, serve

log = logging.getLogger("mckibben.server")

_MADE_WITHIN = 5.0  # s in which a fork server makes a process; it takes milliseconds
_FIRST_WITHIN = 60.0  # s in which it makes its first one: it loads the program before
_READY_WITHIN = 120.0  # s; a process loads its program in two, on a busy machine in many more
_TAKEN_WITHIN = 30.0  # s in which a process that waits says that it has a job, unless it is stopped
_GRACE = 2.0  # s that a job may take to end by itself when it is asked to
_CODE_WITHIN = 1.0  # s in which the fork server tells how a process ended
_PATIENCE = 5.0  # times the work of a job that may pass while others have the processor
_OVER_WORK = None if sys.platform == "win32" else -signal.SIGXCPU


class EndedError(Exception):
    """The process ended in the middle of a job.

    Attributes:
        began: whether it had begun with it.
        reason: of `Supervised.reason`.
    """

    def __init__(self, began: bool, reason: str) -> None:
        super().__init__(f"the process was {reason}")
        self.began, self.reason = began, reason


class FailedError(RuntimeError):
    """An error of the program in a worker; the text is its traceback there."""


class Supervised:
    """A worker process, from its start to its end.

    Args:
        settings: the folders of the server.
        lane: how much it may take.
        changed: called on the event loop when it is ready, and when it has ended.
        senders: threads that write to pipes; a process that is stopped from outside reads none.

    Attributes:
        ready: whether it has loaded its program.
        gone: whether it has ended.
        jobs: that it was given.
        tired: whether another one shall take its place.
        reason: why it ended: "killed" by others, "stopped" with a job that did not stop by itself, by the
            "deadline" of its work, "silent" where it was stopped from outside, or "renewed".
    """

    def __init__(
        self, settings: Settings, lane: Lane, changed: Callable[[Supervised], None], senders: Executor
    ) -> None:
        self._loop = asyncio.get_running_loop()
        self._settings, self._lane, self._changed, self._senders = settings, lane, changed, senders
        self._process: Any = None
        self._line: Connection | None = None
        self._speaking = threading.Lock()
        self._job: asyncio.Future[bytes] | None = None
        self._order: Order | None = None
        self._news: Callable[[Message], None] | None = None
        self._taken = self._began = False
        self.ready = self.gone = self.tired = False
        self.jobs = 0
        self.reason = ""
        threading.Thread(target=self._live, name="worker", daemon=True).start()
        self._limits = [
            self._loop.call_later(_MADE_WITHIN, self._look_at_fork_server, False),
            self._loop.call_later(_FIRST_WITHIN, self._look_at_fork_server, True),
            self._loop.call_later(_READY_WITHIN, lambda: self.ready or self.kill("silent")),
        ]

    @property
    def idle(self) -> bool:
        """Whether it waits for a job."""
        return self.ready and not self.gone and self._job is None

    @property
    def pid(self) -> int | None:
        """Of the process; None before it is made."""
        return None if self._process is None else self._process.pid

    async def perform(self, order: Order, news: Callable[[Message], None]) -> bytes:
        """The answer of a job.

        Args:
            order: the job.
            news: called with what the worker says on the way.

        Raises:
            InputError: the job refuses.
            EndedError: the process ended.
            FailedError: an error of the program.
        """
        self._order, self._news, self._taken, self._began = order, news, False, False
        self._job, self.jobs = self._loop.create_future(), self.jobs + 1
        within = _PATIENCE * JOBS[order.kind].ended_after
        limits = [
            self._loop.call_later(_TAKEN_WITHIN, lambda: self._taken or self.kill("silent")),
            self._loop.call_later(within, self.kill, "deadline"),
        ]
        self._send(order)
        try:
            return await self._job
        finally:
            self._job = None
            for limit in limits:
                limit.cancel()

    def stop(self, number: int) -> None:
        """Ask the job of a number to end, and end it if it does not."""
        if self._runs(number):
            self._send(Stop(number))
            self._loop.call_later(_GRACE, lambda: self.kill("stopped") if self._runs(number) else None)

    def kill(self, reason: str) -> None:
        """End it, whatever it does."""
        if not self.gone:
            self.reason = self.reason or reason
            if self._process is None:
                end_fork_server()  # which has not made it: the thread that waits for it goes on
            else:
                with suppress(OSError):
                    self._process.kill()

    def joined(self, seconds: float) -> bool:
        """Whether the fork server knows its end by then [s]; from any thread."""
        if self._process is None:
            return False
        self._process.join(seconds)
        return self._process.exitcode is not None

    def _runs(self, number: int) -> bool:
        return self._job is not None and self._order is not None and self._order.number == number

    def _send(self, told: Order | Stop) -> None:
        self._senders.submit(self._written, told)

    def _written(self, told: Order | Stop) -> None:
        with self._speaking, suppress(OSError):  # it has ended by now, which its pipe says, too
            if self._line is not None:
                self._line.send(told)

    def _look_at_fork_server(self, loaded: bool) -> None:
        """End one that makes no process; one that has made none yet has perhaps not loaded the program."""
        if self.pid is None and (loaded or _fork_server() in _proven):
            end_fork_server()

    def _live(self) -> None:
        """Start the process and hear it until it ends; a thread of its own."""
        try:
            self._start()
            assert self._line is not None  # noqa: S101 - just started
            while True:
                message = self._line.recv()
                answer = self._line.recv_bytes() if message.kind == "done" else None
                self._tell(self._heard, message, answer)
        except (EOFError, OSError) as error:
            if self._process is None:
                log.error("no worker can be started: %s", error or type(error).__name__)
        except Exception:
            log.exception("a worker is not understood")
            self.kill("killed")
        with suppress(OSError):
            if self._line is not None:
                self._line.close()
        if self._process is not None:
            self._process.join(_CODE_WITHIN)
        self._tell(self._ended, None if self._process is None else self._process.exitcode)

    def _start(self) -> None:
        context = multiprocessing.get_context("forkserver" if sys.platform != "win32" else "spawn")
        if sys.platform != "win32":
            context.set_forkserver_preload(["mckibben.server.forked"])
        self._line, there = context.Pipe()
        arguments = (there, self._settings, self._lane.memory, self._lane.compiled)
        process = context.Process(target=serve, args=arguments, daemon=True)
        try:
            process.start()
        finally:
            there.close()
        _proven.add(_fork_server())
        self._process = process

    def _tell(self, what: Callable[..., None], *arguments: object) -> None:
        with suppress(RuntimeError):  # the event loop has ended
            self._loop.call_soon_threadsafe(what, *arguments)

    def _heard(self, message: Message, answer: bytes | None) -> None:
        if message.kind == "ready":
            self.ready = True
            self._changed(self)
        elif self._job is None or self._job.done() or self._news is None:
            return
        elif message.kind == "taken":
            self._taken = True
        elif message.kind in ("prepared", "progress"):
            self._began = True
            self._news(message)
        elif answer is not None:
            self._job.set_result(answer)
        elif message.refused is not None:
            self._job.set_exception(message.refused.error())
        else:
            self._job.set_exception(FailedError(message.data.decode("utf-8", "replace")))

    def _ended(self, code: int | None) -> None:
        for limit in self._limits:
            limit.cancel()
        self.gone = True
        self.reason = self.reason or ("deadline" if code == _OVER_WORK and code is not None else "killed")
        if self._job is not None and not self._job.done():
            self._job.set_exception(EndedError(self._began, self.reason))
        self._changed(self)


def end_fork_server() -> None:
    """End a fork server that makes no processes; the next process starts another, those it made stay."""
    pid = _fork_server()
    if pid is not None:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


#: Process ids of fork servers that have made a process.
_proven: set[int | None] = set()


def _fork_server() -> int | None:
    if sys.platform == "win32":
        return None
    from multiprocessing import forkserver

    # There is no public way to end one that is stopped: the one of the library waits for it.
    return forkserver._forkserver._forkserver_pid  # type: ignore
