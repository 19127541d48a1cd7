"""A worker process: it runs one job at a time, tells how far it is, and ends it when asked to.

It hears and speaks on a pipe of its own, which nobody else holds: the end of the pipe is the end of the
server for the worker, and the end of the worker for the server, at the moment in which it happens.
"""

from __future__ import annotations

import gc
import math
import os
import queue
import signal
import sys
import threading
import time
import traceback
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, Literal, NamedTuple, NoReturn

from mckibben.application.json_text import to_json
from mckibben.documents.studio import Studio
from mckibben.measurement.reading import load_readers
from mckibben.measurement.reading.process import limit_memory
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.server.jobs import JOBS
from mckibben.server.settings import Settings
from mckibben.simulation.integrate.many import lane_kernels
from mckibben.simulation.outcome import Watch

_NICE = 10  # requests of the page come first
_KERNELS_WITHIN = 5.0  # s


class Order(NamedTuple):
    """A job that a worker is given: its number, its kind (of `JOBS`) and the validated body."""

    number: int
    kind: str
    body: Any


class Stop(NamedTuple):
    """That the job of this number shall end."""

    number: int


@dataclass(frozen=True, slots=True)
class Message:
    """What a worker says.

    Attributes:
        kind: that it is ready for jobs; that it has one; that the job is prepared; a piece of JSON for a
            progress event; and how the job ended: with an answer (whose bytes follow), refused, or by an
            error of the program (its traceback).
        data: the JSON, or the traceback.
        refused: why there is no answer.
    """

    kind: Literal["ready", "taken", "prepared", "progress", "done", "refused", "failed"]
    data: bytes = b""
    refused: Refused | None = None


@dataclass(frozen=True, slots=True)
class Refused:
    """An `InputError` of a job; the error itself does not cross processes."""

    message: str
    field: str | None
    hint: str | None
    code: str

    def error(self) -> InputError:
        """The error again."""
        return InputError(self.message, field=self.field, hint=self.hint, code=self.code)


@dataclass(slots=True)
class _Own:
    """What a worker opens once."""

    studio: Studio
    store: MeasurementStore
    memory: int


class _Line:
    """The pipe to the server, and the stop of the job that runs."""

    def __init__(self, connection: Connection) -> None:
        self._connection, self._speaking = connection, threading.Lock()
        self.orders: queue.SimpleQueue[Order] = queue.SimpleQueue()
        self.stop, self.number = threading.Event(), 0

    def say(self, message: Message, answer: bytes | None = None) -> None:
        """Speak; a job may have threads. The bytes of an answer follow without a copy."""
        try:
            with self._speaking:
                self._connection.send(message)
                if answer is not None:
                    self._connection.send_bytes(answer)
        except OSError:
            os._exit(1)  # nobody hears it

    def hear(self) -> NoReturn:
        """Take orders until the server is gone, at whatever the worker is then."""
        try:
            while True:
                told = self._connection.recv()
                if isinstance(told, Order):
                    self.say(Message("taken"))
                    self.orders.put(told)
                elif told.number == self.number:
                    self.stop.set()
        finally:
            os._exit(1)


def serve(connection: Connection, settings: Settings, memory: int, compiled: bool) -> None:
    """Be a worker until the pipe ends.

    Args:
        connection: the pipe to the server.
        settings: the folders of the server.
        memory: bytes that the process may take.
        compiled: whether its jobs run the integrators.
    """
    # Ctrl+C reaches the whole group; the server ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    line = _Line(connection)
    threading.Thread(target=line.hear, daemon=True).start()
    own = _begin(settings, memory, compiled)
    line.say(Message("ready"))
    while True:
        order = line.orders.get()
        line.stop.clear()
        line.number = order.number
        _perform(order, own, line)


def _begin(settings: Settings, memory: int, compiled: bool) -> _Own:
    if hasattr(os, "nice"):
        os.nice(_NICE)
    limit_memory(memory)
    studio = Studio(presets=settings.presets, user_presets=settings.user_presets, effects=settings.effects)
    # Loaded before the first job, so that each worker gives the same answer; compiling them the first time
    # ever takes longer, and goes on beside the first job.
    if compiled:
        lane_kernels.warm().join(_KERNELS_WITHIN)
    else:
        load_readers()
    gc.freeze()  # what is loaded by now stays; looking at it again would stop a job for a tenth of a second
    return _Own(studio, MeasurementStore(settings.data, quotas=settings.quotas), memory)


def _perform(order: Order, own: _Own, line: _Line) -> None:
    """Run a job and say how it ended."""
    job = JOBS[order.kind]
    _bound_work(job.ended_after)
    try:
        work = job.prepare(order.body, own.studio, own.store)
        line.say(Message("prepared"))
        watch = Watch(
            cancelled=line.stop.is_set,
            progress=lambda share: line.say(Message("progress", to_json({"share": share}))),
            found=lambda found: line.say(Message("progress", to_json({"found": found}))),
            time_limit=job.time_limit,
        )
        line.say(Message("done"), work(watch))
    except InputError as error:
        line.say(Message("refused", refused=Refused(error.message, error.field, error.hint, error.code)))
    except MemoryError:
        words = f"this needs more than the {own.memory / 1e9:.1f} GB of memory that one request may use"
        line.say(Message("refused", refused=Refused(words, None, job.hint, "stopped")))
    except Exception:
        line.say(Message("failed", traceback.format_exc().encode("utf-8", "replace")))
    finally:
        _bound_work(math.inf)


def _bound_work(seconds: float) -> None:
    """Let this process end after so much further processor time [s], in native code too; not on Windows."""
    if sys.platform != "win32":
        import resource

        hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
        most = hard
        if math.isfinite(seconds):
            most = math.ceil(time.process_time() + seconds)
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(resource.RLIMIT_CPU, (most, hard))
        # Such an end is no fault that anybody looks into: nothing is written of it.
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
