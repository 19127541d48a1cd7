"""Long work in supervised processes: a few at a time, the others in a queue of bounded length.

Pebble keeps the processes, because it can end one that is busy and start another in its place; the pools of
the standard library cannot. A job has a deadline that holds without its help, and so has its memory.
"""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import os
import sys
import threading
import time
from asyncio import CancelledError
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, Listener
from typing import Any

from pebble import ProcessExpired, ProcessFuture, ProcessPool

from mckibben.physics.errors import InputError
from mckibben.server.jobs import JOBS
from mckibben.server.lane import BusyError, Lane, Place, end_pool
from mckibben.server.settings import Settings
from mckibben.server.worker import Message, Refused, begin, perform

log = logging.getLogger("mckibben.server")

_GRACE = 2.0  # s that a job may take to end by itself when it is asked to
_BEGINS_WITHIN = 10.0  # s; a job whose turn it is begins at once, or when a process is replaced
_FIRST_WITHIN = 40.0  # s; the first one waits for the first processes
_MOST_TRIES = 3  # of a job whose process was killed before it began
_RENEWED_AFTER = 200  # jobs, then a process is replaced: what was compiled stays in memory
_LOOK_EVERY = 0.2  # s; at the place in the queue
_FIRST_GUESS = 5.0  # s that a job takes, as long as none has ended
_WEIGHT_OF_LAST = 0.3  # weight of the last job in the mean


class Ticket:
    """The right to a worker, in the order of arrival; `leave` gives it back."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._told = -1
        self._began = 0.0

    async def place(self) -> Place | None:
        """The next place in the queue, at first and whenever it changes; None when it is its turn.

        Raises:
            InputError: the server ends.
        """
        while not self._turn.done():
            if self._workers.ending:
                raise _ending()
            place = self._workers.place_of(self)
            if place.before != self._told:
                self._told = place.before
                return place
            await asyncio.wait({self._turn}, timeout=_LOOK_EVERY)
        return None

    def begin(self) -> None:
        """It is its turn."""
        self._began = time.monotonic()
        if not self._turn.done():
            self._turn.set_result(None)

    def leave(self) -> None:
        """Give the place or the worker to the next one. Later calls do nothing."""
        self._workers.left(self, time.monotonic() - self._began if self._turn.done() else None)


class Workers:
    """The worker processes of a lane; made on the server's event loop, used there alone.

    Args:
        settings: the folders of the server.
        lane: how many processes, how long a queue, how much memory; None = those of long work.
    """

    def __init__(self, settings: Settings, lane: Lane | None = None) -> None:
        self._settings = settings
        self._lane = lane or Lane(settings.workers, settings.queue, settings.worker_memory)
        self._pool: ProcessPool | None = None
        self._listener: Listener | None = None
        self._parked: list[tuple[ProcessPool, Listener | None]] = []
        self._key = os.urandom(16)
        self._running: dict[int, Running] = {}
        self._waiting: deque[Ticket] = deque()
        self._inside: set[Ticket] = set()
        self._number = 0
        self._mean = _FIRST_GUESS
        self._loop: asyncio.AbstractEventLoop | None = None
        self._lock = threading.Lock()
        # Not the threads of the event loop: simulations may keep all of those busy.
        self._starter = ThreadPoolExecutor(1, thread_name_prefix="workers")
        self._started = False
        self.ending = False

    @property
    def processes(self) -> int:
        """Jobs that run at a time."""
        return self._lane.processes

    @property
    def waiting(self) -> int:
        """Jobs in the queue."""
        return len(self._waiting)

    @property
    def running(self) -> int:
        """Jobs in the workers."""
        return len(self._inside)

    def start(self) -> None:
        """Start the processes, so that the first job need not wait for them. Later calls do nothing."""
        if self._pool is None and not self.ending:
            self._starter.submit(lambda: self._ready_pool()[0].active)

    def end(self) -> None:
        """The server ends: every job ends now, and who waits for one hears so. From any thread."""
        self.ending = True
        for running in list(self._running.values()):
            running.stopped = True
            running.future.cancel()

    def close(self) -> None:
        """End all processes, whatever they do."""
        self._park()
        self._starter.shutdown(wait=False, cancel_futures=True)
        with ThreadPoolExecutor() as threads:
            list(threads.map(lambda parked: end_pool(*parked), self._parked))

    def enter(self) -> Ticket:
        """A place in the queue, or a worker at once if one is free.

        Raises:
            BusyError: the queue is full.
        """
        if len(self._inside) < self._lane.processes and not self._waiting:
            ticket = Ticket(self)
            self._inside.add(ticket)
            ticket.begin()
            return ticket
        if len(self._waiting) >= self._lane.queue:
            raise BusyError(len(self._waiting), self._seconds(len(self._waiting)))
        ticket = Ticket(self)
        self._waiting.append(ticket)
        return ticket

    def place_of(self, ticket: Ticket) -> Place:
        """The place of a ticket that waits."""
        before = self._waiting.index(ticket)
        return Place(before, self._seconds(before))

    def left(self, ticket: Ticket, took: float | None) -> None:
        """A ticket is given back, after the time that its job took [s]; None: it never began."""
        if ticket in self._waiting:
            self._waiting.remove(ticket)
        if ticket not in self._inside:
            return
        self._inside.remove(ticket)
        if took is not None:
            self._mean += _WEIGHT_OF_LAST * (took - self._mean)
        if self._waiting:
            following = self._waiting.popleft()
            self._inside.add(following)
            following.begin()

    def _seconds(self, before: int) -> float:
        return self._mean * (before + 1) / self._lane.processes

    async def submit(self, ticket: Ticket, kind: str, body: Any) -> Running:
        """Give a job to a worker; its ticket, whose turn it is, is given back when the job has ended.

        Args:
            ticket: of the job.
            kind: of `mckibben.server.jobs.JOBS`.
            body: the validated body of the request.

        Raises:
            InputError: the server ends.
        """
        if self.ending:
            raise _ending()
        loop = self._loop = self._loop or asyncio.get_running_loop()
        first = not self._started
        self._number += 1
        running = Running(kind, self._number, ProcessFuture())
        self._running[running.number] = running  # known before it is scheduled: the worker may speak at once

        def schedule() -> None:
            pool, listener = self._ready_pool()
            arguments = [kind, body, listener.address, self._key, running.number]
            running.pool = pool
            running.future = pool.schedule(perform, args=arguments, timeout=JOBS[kind].ended_after)
            running.stopped = running.stopped or self.ending
            if running.stopped:  # meanwhile; what stopped it met the future that stood here before
                running.future.cancel()

        def ended() -> None:
            error = None if running.future.cancelled() else running.future.exception()
            died = isinstance(error, ProcessExpired | BrokenProcessPool)
            never_began = running.lost or (running.line is None and died)
            if never_began and running.again < _MOST_TRIES and not (running.stopped or self.ending):
                # Nobody need know. A process found lost may have spoken after all, a moment too late.
                running.again, running.lost, running.line = running.again + 1, False, None
                self._starter.submit(lambda: (schedule(), follow()))
                return
            self._running.pop(running.number, None)
            if self._parked:
                self._end_parked()
            running.news.put_nowait(None)
            ticket.leave()

        def look(future: object) -> None:
            # A process that is killed while it takes a job from the others' pipe leaves the pipe locked.
            if running.future is future and not running.future.done() and running.line is None:
                log.error("the workers take no jobs any more and are replaced")
                running.lost = not running.stopped
                self._park()
                running.future.cancel()

        def follow() -> None:
            within = _BEGINS_WITHIN if self._started and not first else _FIRST_WITHIN
            loop.call_soon_threadsafe(loop.call_later, within, look, running.future)
            running.future.add_done_callback(lambda _: loop.is_closed() or loop.call_soon_threadsafe(ended))

        try:
            # A pool that has to be started again would keep the event loop waiting for its processes.
            if self._started and self._pool is not None and self._pool.active:
                schedule()
            else:
                await self._beside(schedule)
        except BaseException:
            self._running.pop(running.number, None)
            running.stopped = True
            running.future.cancel()
            raise
        follow()
        return running

    async def _beside(self, schedule: Callable[[], None]) -> None:
        """Schedule in a thread of its own: the first processes take seconds to start."""
        scheduled: asyncio.Future[None] = asyncio.get_running_loop().run_in_executor(self._starter, schedule)
        while not (await asyncio.wait({scheduled}, timeout=_LOOK_EVERY))[0]:
            if self.ending:  # longer than the end may take
                raise _ending()
        await scheduled
        self._started = True

    async def result(self, running: Running) -> bytes:
        """The bytes of the answer of a job.

        Raises:
            InputError: it was refused, was stopped, took too long, or its process ended.
        """
        kind = running.kind
        try:
            found = await asyncio.wrap_future(running.future)
        except CancelledError:
            if not running.stopped:
                raise
            raise (
                _ending() if self.ending else InputError(f"the {kind} was stopped", code="stopped")
            ) from None
        except TimeoutError:
            raise InputError(
                f"the {kind} took longer than {JOBS[kind].time_limit:g} s and was ended",
                hint=JOBS[kind].hint,
                code="stopped",
            ) from None
        except (ProcessExpired, BrokenProcessPool) as error:
            log.error("a worker ended while it did a %s: %s", kind, error)
            raise InputError(
                f"the process of the {kind} ended unexpectedly; nothing else was affected",
                hint="try again; if it happens again, look at the log of the server",
                code="stopped",
            ) from error
        if isinstance(found, Refused):
            raise found.error()
        return found

    def stop(self, running: Running) -> None:
        """Ask a job to end, and end it if it does not."""
        if running.future.done() or running.stopped:
            return
        running.stopped = True
        running.ask_to_end()
        assert self._loop is not None  # noqa: S101 - a job runs
        self._loop.call_later(_GRACE, running.future.cancel)

    def _park(self) -> None:
        """Take no further jobs to the present processes; those at work may end theirs."""
        with self._lock:
            if self._pool is not None:
                self._parked.append((self._pool, self._listener))
                self._pool.close()
                self._pool = self._listener = None

    def _end_parked(self) -> None:
        """End parked processes of which nobody waits for a job any more: they hold descriptors."""
        busy = {running.pool for running in self._running.values()}
        with self._lock:
            idle = [parked for parked in self._parked if parked[0] not in busy]
            self._parked = [parked for parked in self._parked if parked[0] in busy]
        for parked in idle:
            threading.Thread(target=end_pool, args=parked, daemon=True).start()

    def _ready_pool(self) -> tuple[ProcessPool, Listener]:
        with self._lock:
            if self._pool is not None and not self._pool.active:
                # A process that is killed while it waits for work breaks the pool; its jobs have ended then.
                log.error("the workers are started again")
                threading.Thread(target=end_pool, args=(self._pool, self._listener), daemon=True).start()
                self._pool, self._listener = None, None
            if self._pool is None:
                context = multiprocessing.get_context("forkserver" if sys.platform != "win32" else "spawn")
                if sys.platform != "win32":
                    context.set_forkserver_preload(["mckibben.server.forked"])
                self._listener = Listener(authkey=self._key)
                threading.Thread(target=self._accept, args=(self._listener,), daemon=True).start()
                self._pool = ProcessPool(
                    max_workers=self._lane.processes,
                    max_tasks=_RENEWED_AFTER,
                    initializer=begin,
                    initargs=[self._settings, self._lane.memory, self._lane.compiled],
                    context=context,
                )
            assert self._listener is not None  # noqa: S101 - made with the pool
            return self._pool, self._listener

    def _accept(self, listener: Listener) -> None:
        """Take the connections of the workers, one for each job."""
        while True:
            try:
                line = listener.accept()
                running = self._running.get(line.recv())
            except multiprocessing.AuthenticationError:
                continue
            except (EOFError, OSError):
                if self._listener is not listener:
                    return
                continue
            if running is None:
                line.close()
                continue
            assert self._loop is not None  # noqa: S101 - a job runs
            threading.Thread(target=running.hear, args=(line, self._loop), daemon=True).start()


def _ending() -> InputError:
    return InputError("the server is ending", hint="start it again and repeat the request", code="stopped")


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
