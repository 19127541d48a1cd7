"""Long work in supervised processes: a few at a time, the others in a queue of bounded length.

A process that ends is replaced at once, and takes its own job alone with it; a job that it had not begun is
given to another one. All of this happens on the event loop.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import Counter, deque
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from mckibben.physics.errors import InputError
from mckibben.server.jobs import JOBS
from mckibben.server.lane import BusyError, Lane, Place
from mckibben.server.settings import Settings
from mckibben.server.supervised import EndedError, Supervised, end_fork_server
from mckibben.server.worker import Message, Order

log = logging.getLogger("mckibben.server")

_MOST_TRIES = 3  # of a job whose process ended before it began
_RENEWED_AFTER = 200  # jobs, then a process is replaced: what was compiled stays in memory
_LOOK_EVERY = 0.2  # s; at the place in the queue
_FIRST_GUESS = 5.0  # s that a job takes, as long as none has ended
_WEIGHT_OF_LAST = 0.3  # weight of the last job in the mean
_AGAIN, _LONGEST_PAUSE = 0.5, 30.0  # s before the next start after one that failed, doubled each time
_MOST_FAILED = 5  # starts one after the other, then who waits for a process hears so
_FREE_WITHIN = 180.0  # s in which a job whose turn it is has a process
_JOINED_WITHIN = 2.0  # s at the end of the server, of all processes


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

    Attributes:
        ended: processes that have ended, by the reason of `Supervised`.
        ending: whether the server ends.
    """

    def __init__(self, settings: Settings, lane: Lane | None = None) -> None:
        self._settings = settings
        self._lane = lane or Lane(settings.workers, settings.queue, settings.worker_memory)
        self._processes: list[Supervised] = []
        self._wanting: deque[asyncio.Future[None]] = deque()
        self._running: dict[int, Running] = {}
        self._waiting: deque[Ticket] = deque()
        self._inside: set[Ticket] = set()
        self._number = 0
        self._mean = _FIRST_GUESS
        self._failed = 0
        self._loop: asyncio.AbstractEventLoop | None = None
        # Not the threads of the event loop: simulations may keep all of those busy.
        self._senders = ThreadPoolExecutor(2 * self._lane.processes + 1, thread_name_prefix="orders")
        self.ended: Counter[str] = Counter()
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

    @property
    def pids(self) -> list[int]:
        """Of its processes."""
        return [process.pid for process in self._processes if process.pid is not None]

    def start(self) -> None:
        """Start the processes, so that the first job need not wait for them. Later calls do nothing."""
        if self._loop is None:
            self._loop = asyncio.get_running_loop()
            self._keep_up()

    def end(self) -> None:
        """The server ends: every job ends now, and who waits for one hears so. From any thread."""
        self.ending = True
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._end)

    def close(self) -> None:
        """End all processes, whatever they do; in a thread."""
        self.ending = True
        for process in self._processes:
            process.kill("stopped")
        end = time.monotonic() + _JOINED_WITHIN
        if not all(process.joined(max(0.0, end - time.monotonic())) for process in self._processes):
            end_fork_server()  # it tells nobody's end, and the program would wait for it
        self._senders.shutdown(wait=False, cancel_futures=True)

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
        self.start()
        self._number += 1
        running = Running(Order(self._number, kind, body))
        self._running[self._number] = running

        def over(answer: asyncio.Future[bytes]) -> None:
            _ = answer.cancelled() or answer.exception()  # known, though nobody may wait for it any more
            del self._running[running.order.number]
            running.news.put_nowait(None)
            ticket.leave()

        running.answer = asyncio.ensure_future(self._answer(running))
        running.answer.add_done_callback(over)
        return running

    async def _answer(self, running: Running) -> bytes:
        kind = running.order.kind
        for _ in range(_MOST_TRIES):
            process = await self._idle()
            if running.stopped or self.ending:
                raise self._stopped(kind)
            running.process = process
            try:
                return await process.perform(running.order, running.news.put_nowait)
            except EndedError as error:
                if running.stopped or self.ending:
                    raise self._stopped(kind) from None
                if error.reason == "deadline":
                    raise InputError(
                        f"the {kind} took more than {JOBS[kind].time_limit:g} s of processor time "
                        "and was ended",
                        hint=JOBS[kind].hint,
                        code="stopped",
                    ) from None
                if error.began:
                    raise InputError(
                        f"the process of the {kind} ended unexpectedly; nothing else was affected",
                        hint="try again; if it happens again, look at the log of the server",
                        code="stopped",
                    ) from error
            finally:
                running.process = None
                self._changed(process)
        raise _no_process()

    async def result(self, running: Running) -> bytes:
        """The bytes of the answer of a job.

        Raises:
            InputError: it was refused, was stopped, took too long, or its process ended.
            FailedError: an error of the program in its process.
        """
        assert running.answer is not None  # noqa: S101 - of a job that was submitted
        return await asyncio.shield(running.answer)

    def stop(self, running: Running) -> None:
        """Ask a job to end, and end it if it does not."""
        if running.answer is None or running.answer.done() or running.stopped:
            return
        running.stopped = True
        if running.process is not None:
            running.process.stop(running.order.number)

    def _stopped(self, kind: str) -> InputError:
        return _ending() if self.ending else InputError(f"the {kind} was stopped", code="stopped")

    def _end(self) -> None:
        for running in list(self._running.values()):
            running.stopped = True
            if running.process is not None:
                running.process.kill("stopped")
        while self._wanting:
            self._wanting.popleft().set_exception(_ending())

    async def _idle(self) -> Supervised:
        """A process that waits; as many jobs have their turn as there are processes."""
        loop = asyncio.get_running_loop()
        end = loop.time() + _FREE_WITHIN
        while not (free := [process for process in self._processes if process.idle]):
            wanting: asyncio.Future[None] = loop.create_future()
            self._wanting.append(wanting)
            await asyncio.wait({wanting}, timeout=end - loop.time())
            if not wanting.done():
                self._wanting.remove(wanting)
                raise _no_process()
            wanting.result()
        return min(free, key=lambda process: process.tired)

    def _changed(self, process: Supervised) -> None:
        """A process waits for a job, or has ended."""
        if process.gone and process in self._processes:
            self._processes.remove(process)
            self.ended[process.reason] += 1
            self._failed = 0 if process.ready else self._failed + 1
            if process.reason != "renewed" and not self.ending:
                log.error("a worker has ended (%s) and is replaced", process.reason)
            if self._failed >= _MOST_FAILED:
                while self._wanting:
                    self._wanting.popleft().set_exception(_no_process())
            if self._failed and self._loop is not None:
                pause = min(_AGAIN * 2.0**self._failed, _LONGEST_PAUSE)
                self._loop.call_later(pause, self._keep_up)
        elif process.idle:
            self._failed = 0
            process.tired = process.tired or process.jobs >= _RENEWED_AFTER
            if self._wanting:
                self._wanting.popleft().set_result(None)
            else:
                self._retire_tired()
        if not self._failed:
            self._keep_up()

    def _retire_tired(self) -> None:
        if sum(process.ready and not process.tired for process in self._processes) >= self._lane.processes:
            for process in self._processes:
                if process.tired and process.idle:
                    process.kill("renewed")

    def _keep_up(self) -> None:
        """Start the processes that are missing."""
        missing = self._lane.processes - sum(not process.tired for process in self._processes)
        for _ in range(0 if self.ending else missing):
            self._processes.append(Supervised(self._settings, self._lane, self._changed, self._senders))


def _ending() -> InputError:
    return InputError("the server is ending", hint="start it again and repeat the request", code="stopped")


def _no_process() -> InputError:
    return InputError(
        "the server cannot start a process for this at the moment",
        hint="try again in a minute; the log of the server says how its processes end",
        code="unavailable",
    )


@dataclass(eq=False)
class Running:
    """A job in a worker.

    Attributes:
        order: what the worker is told.
        news: what the worker says; None when the job has ended.
        answer: its bytes, or why there are none.
        process: that has it.
        stopped: whether it shall end.
    """

    order: Order
    news: asyncio.Queue[Message | None] = field(default_factory=asyncio.Queue)
    answer: asyncio.Future[bytes] | None = None
    process: Supervised | None = None
    stopped: bool = False
