"""A worker process: it runs one job at a time, tells how far it is, and ends it when asked to.

What it says goes through a connection of its own for each job, so that a process that is ended in the middle
of a word leaves nothing locked behind.
"""

from __future__ import annotations

import gc
import os
import signal
import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Client, Connection
from typing import Any, Literal

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
_LOOK_EVERY = 1.0  # s; whether the server is still there


@dataclass(frozen=True, slots=True)
class Message:
    """What a worker says on the way.

    Attributes:
        kind: that the job is prepared, a piece of JSON for a progress event, or that it says no more.
        data: the JSON.
    """

    kind: Literal["prepared", "progress", "over"]
    data: bytes = b""


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


_own: _Own | None = None


def begin(settings: Settings, memory: int, compiled: bool) -> None:
    """Open presets and store, and take the limits of a worker; called once in each process.

    Args:
        settings: the folders of the server.
        memory: bytes that the process may take.
        compiled: whether its jobs run the integrators.
    """
    global _own
    signal.signal(
        signal.SIGINT, signal.SIG_IGN
    )  # Ctrl+C reaches the whole group; the server ends its workers
    if hasattr(os, "nice"):
        os.nice(_NICE)
    limit_memory(memory)
    threading.Thread(target=_end_with_the_server, args=(os.getppid(),), daemon=True).start()
    studio = Studio(presets=settings.presets, user_presets=settings.user_presets, effects=settings.effects)
    # Loaded before the first job, so that each worker gives the same answer; compiling them the first time
    # ever takes longer, and goes on beside the first job.
    if compiled:
        lane_kernels.warm().join(_KERNELS_WITHIN)
    else:
        load_readers()
    _own = _Own(studio, MeasurementStore(settings.data, quota=settings.quota), memory)
    gc.freeze()  # what is loaded by now stays; looking at it again would stop a job for a tenth of a second


def perform(kind: str, body: Any, address: str, key: bytes, number: int) -> bytes | Refused:
    """Run a job.

    Args:
        kind: of `JOBS`.
        body: the validated body of the request.
        address, key: where the server listens for what the worker says.
        number: of the job.

    Returns:
        The bytes of the answer, or why there is none.
    """
    assert _own is not None, "begin() comes first"  # noqa: S101 - the pool's initializer
    job = JOBS[kind]
    line = Client(address, authkey=key)
    line.send(number)
    stop, speaking = threading.Event(), threading.Lock()

    def say(message: Message) -> None:
        with speaking:  # a job may have threads
            line.send(message)

    threading.Thread(target=_listen, args=(line, stop, speaking), daemon=True).start()
    try:
        work = job.prepare(body, _own.studio, _own.store)
        say(Message("prepared"))
        watch = Watch(
            cancelled=stop.is_set,
            progress=lambda share: say(Message("progress", to_json({"share": share}))),
            found=lambda found: say(Message("progress", to_json({"found": found}))),
            time_limit=job.time_limit,
        )
        return work(watch)
    except InputError as error:
        return Refused(error.message, error.field, error.hint, error.code)
    except MemoryError:
        return Refused(
            f"this needs more than the {_own.memory / 1e9:.1f} GB of memory that one request may use",
            None,
            job.hint,
            "stopped",
        )
    finally:
        with suppress(OSError):
            say(Message("over"))


def _listen(line: Connection, stop: threading.Event, speaking: threading.Lock) -> None:
    """Wait for the word to stop; the end of the connection is one too.

    The server closes its end when the job is over; then this thread closes the one here. Nobody else may: if
    it was about to read a connection closed by another thread, it would read the next job's, which gets its
    number.
    """
    with suppress(EOFError, OSError):
        while True:
            line.recv()
            stop.set()
    stop.set()
    with speaking:
        line.close()


def _end_with_the_server(parent: int) -> None:
    """A server that is killed leaves no workers behind."""
    while os.getppid() == parent:
        time.sleep(_LOOK_EVERY)
    os._exit(1)
