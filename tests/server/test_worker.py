"""A worker's job in this process, with a stand-in for the server at the other end of its line."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Iterator
from multiprocessing.connection import Client, Connection, Listener

import pytest

from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.server import worker
from mckibben.server.job import Job, Prepared
from mckibben.server.settings import Settings

KEY = b"a key"

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="numbers of descriptors are those of Unix")


class LateConnection(Connection):
    """Its reader loses the processor just before it reads, as happens on a busy machine."""

    def _recv(self, size: int, read: object = None) -> object:
        number = self.fileno()
        time.sleep(0.2)
        return super()._recv(size, lambda _, remaining: os.read(number, remaining))


def late_client(address: str, authkey: bytes) -> Connection:
    line = Client(address, authkey=authkey)
    line.__class__ = LateConnection
    return line


def prepare_nothing(_body: object, _studio: Studio, _store: MeasurementStore) -> Prepared:
    return lambda _: b"nothing"


@pytest.fixture
def listener(monkeypatch: pytest.MonkeyPatch, settings: Settings) -> Iterator[Listener]:
    monkeypatch.setattr(worker, "JOBS", {"nothing": Job(prepare_nothing)})
    monkeypatch.setattr(
        worker, "_own", worker._Own(Studio(presets=settings.presets), MeasurementStore(settings.data), 1)
    )
    monkeypatch.setattr(worker, "Client", late_client)
    with Listener(authkey=KEY) as listener:
        yield listener


def hear(listener: Listener, heard: list[object]) -> None:
    """One job, as a server hears it that is slow to greet the worker."""
    time.sleep(0.4)
    with listener.accept() as line:
        heard.append(line.recv())
        while heard[-1] != "over":
            heard.append(line.recv().kind)


def test_a_late_listener_does_not_read_the_line_of_the_next_job(listener: Listener) -> None:
    for number in (1, 2, 3):
        heard: list[object] = []
        hearing = threading.Thread(target=hear, args=(listener, heard), daemon=True)
        hearing.start()
        assert worker.perform("nothing", None, listener.address, KEY, number) == b"nothing"
        hearing.join(10)
        assert heard == [number, "prepared", "over"]
