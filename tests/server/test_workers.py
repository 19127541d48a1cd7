"""Supervised workers: the real server with processes, under load, with killed workers, at its end."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from mckibben.server.settings import Settings
from mckibben.server.workers import BusyError, Ticket, Workers
from tests.running_server import RunningServer
from tests.server.conftest import run_async

DIAGNOSIS = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "measurement": "martens-dmsp-20-300",
}
QUICK = DIAGNOSIS | {"noise": 60.0}  # nothing is above it, so nothing is searched
CURVES = {"muscle": {"preset": "DMSP-20"}}
UNKNOWN = DIAGNOSIS | {"measurement": "0" * 64}
TERM = {"custom": {"term": "c*L", "c": 1.0}}

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="kills processes by signals")


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory, compiled_kernels: None) -> Iterator[RunningServer]:
    arguments = ["--workers", "2"]
    with RunningServer(tmp_path_factory.mktemp("workers"), arguments=arguments) as server:
        yield server


def send(
    server: RunningServer, path: str, body: dict[str, Any] | None, accept: str = "application/json"
) -> Any:
    data = None if body is None else json.dumps(body).encode()
    headers = {"content-type": "application/json", "accept": accept}
    request = urllib.request.Request(server.url + path, data, headers)
    try:
        with urllib.request.urlopen(request, timeout=300) as answer:
            return answer.status, answer.read().decode(), answer.headers
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode(), error.headers


def health(server: RunningServer) -> dict[str, Any]:
    return json.loads(send(server, "/api/health", None)[1])


def workers_of(server: RunningServer) -> list[int]:
    """Process ids: the workers are children of a fork server, which is one of the server."""

    def children(parent: int) -> list[int]:
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                with contextlib.suppress(OSError, IndexError):
                    fields = (entry / "stat").read_text().rpartition(")")[2].split()
                    if int(fields[1]) == parent:
                        found.append(int(entry.name))
        return found

    return [pid for middle in children(server._process.pid) for pid in children(middle)]


def until(condition: Any, within: float = 60.0) -> None:
    end = time.monotonic() + within
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.05)


def test_an_answer_of_a_worker_is_that_of_the_server_itself(served: RunningServer) -> None:
    status, text, _ = send(served, "/api/diagnoses", DIAGNOSIS)
    assert status == 200
    assert json.loads(text)["verdict"]["status"]
    status, text, _ = send(served, "/api/diagnoses", DIAGNOSIS, "text/event-stream")
    assert status == 200
    assert text.count("event: progress") > 3
    assert '"found"' in text
    assert "event: done" in text
    status, text, _ = send(served, "/api/diagnoses", UNKNOWN)
    assert status == 404
    assert json.loads(text)["error"]["field"] == "measurement"
    # What is refused before it begins has the status of an error, also where a stream is asked for.
    assert send(served, "/api/diagnoses", UNKNOWN, "text/event-stream")[0] == 404


def test_a_full_queue_is_told_and_curves_are_answered_meanwhile(served: RunningServer) -> None:
    with ThreadPoolExecutor(24) as threads:
        answers = [threads.submit(send, served, "/api/diagnoses", QUICK) for _ in range(22)]
        until(lambda: sum(answer.done() for answer in answers) >= 4)
        status, text, headers = send(served, "/api/diagnoses", QUICK)
        now = health(served)
        assert (now["running"], now["workers"]) == (2, 2)
        if status == 429:  # unless the others were quicker
            assert json.loads(text)["error"]["code"] == "busy"
            assert int(headers["Retry-After"]) >= 1
        assert send(served, "/api/curves", CURVES)[0] == 200
        statuses = [answer.result()[0] for answer in answers]
    assert set(statuses) == {200, 429}
    assert statuses.count(429) >= 4  # 2 run, 16 wait
    until(lambda: health(served)["running"] == health(served)["waiting"] == 0)


def test_a_killed_worker_takes_its_own_job_alone(served: RunningServer) -> None:
    assert send(served, "/api/diagnoses", QUICK)[0] == 200
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(send, served, "/api/diagnoses", DIAGNOSIS)
        until(lambda: health(served)["running"] == 1)
        time.sleep(0.2)
        for pid in workers_of(served):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        status, text, _ = answer.result()
    if status != 200:  # it may have been ready just before
        assert status == 422
        assert json.loads(text)["error"]["code"] == "stopped"
        assert "nothing else was affected" in text
    assert send(served, "/api/curves", CURVES)[0] == 200
    assert send(served, "/api/diagnoses", QUICK)[0] == 200


def test_whoever_leaves_frees_the_worker(served: RunningServer) -> None:
    data = json.dumps(DIAGNOSIS).encode()
    headers = {"content-type": "application/json", "accept": "text/event-stream"}
    for _ in range(3):
        request = urllib.request.Request(served.url + "/api/diagnoses", data, headers)
        with urllib.request.urlopen(request, timeout=60) as answer:
            answer.readline()
    until(lambda: health(served)["running"] == 0, within=10.0)
    assert send(served, "/api/diagnoses", QUICK)[0] == 200


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_the_server_ends_under_work_and_leaves_no_process(
    tmp_path: Path, compiled_kernels: None, number: signal.Signals
) -> None:
    with RunningServer(tmp_path, arguments=["--workers", "1"]) as server:
        told: list[str] = []

        def ask() -> None:
            told.append(send(server, "/api/diagnoses", DIAGNOSIS, "text/event-stream")[1])

        asking = threading.Thread(target=ask)
        asking.start()
        until(lambda: health(server)["running"] == 1)
        until(lambda: workers_of(server))
        pids = workers_of(server)
        server._process.send_signal(number)
        server._process.wait(10)
        asking.join(10)
        assert not asking.is_alive()
        until(lambda: not any(Path(f"/proc/{pid}").exists() for pid in pids), within=10.0)
        assert "Traceback" not in server.output
        assert "the server is ending" in told[0]  # as the last event, or as the answer if it had not begun


def queue(workers: int, length: int) -> Workers:
    return Workers(Settings(workers=workers, queue=length))


def test_places_go_by_arrival_and_the_queue_has_an_end() -> None:
    async def run() -> None:
        pool = queue(1, 2)
        first, second, third = pool.enter(), pool.enter(), pool.enter()
        with pytest.raises(BusyError) as full:
            pool.enter()
        assert full.value.waiting == 2
        assert await first.place() is None
        place = await second.place()
        assert place is not None
        assert place.before == 0
        later = await third.place()
        assert later is not None
        assert (later.before, later.seconds) == (1, 2 * place.seconds)
        second.leave()  # it gave up
        moved = await third.place()
        assert moved is not None
        assert moved.before == 0
        first.leave()
        first.leave()  # a second time changes nothing
        assert await third.place() is None
        assert (pool.running, pool.waiting) == (1, 0)
        third.leave()
        assert (pool.running, pool.waiting) == (0, 0)

    run_async(run())


def test_a_free_worker_is_given_at_once() -> None:
    async def run() -> list[Ticket]:
        pool = queue(2, 0)
        tickets = [pool.enter(), pool.enter()]
        assert [await ticket.place() for ticket in tickets] == [None, None]
        with pytest.raises(BusyError):
            pool.enter()
        return tickets

    assert len(run_async(run())) == 2
