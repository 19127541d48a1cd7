"""Supervised workers: the real server with processes, under load, with killed workers, at its end."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import multiprocessing
import os
import signal
import sys
import threading
import time
import urllib.error
import urllib.request
import warnings
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from typing import Any, get_args

import pytest
from starlette.testclient import TestClient

from mckibben.server import worker
from mckibben.server.app import create_app
from mckibben.server.job import Job, LaneName
from mckibben.server.lane import BusyError
from mckibben.server.schemas.curves import CurvesRequest
from mckibben.server.settings import Settings
from mckibben.server.supervised import Supervised, _fork_server
from mckibben.server.workers import Ticket, Workers
from tests.robustness.load import diagnosis
from tests.running_server import RunningServer, opener
from tests.server.conftest import CSV, run_async

DIAGNOSIS = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "measurement": "martens-dmsp-20-300",
}
_asked = itertools.count()


def quick() -> dict[str, Any]:
    """Nothing is above its noise, so nothing is searched; each is another one, or it would be kept."""
    return DIAGNOSIS | {"effects": {}, "noise": 400.0 + next(_asked)}


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
        with opener().open(request, timeout=300) as answer:
            return answer.status, answer.read().decode(), answer.headers
    except urllib.error.HTTPError as error:
        if error.code == 500:
            raise AssertionError(server.output) from error
        return error.code, error.read().decode(), error.headers


def health(server: RunningServer) -> dict[str, Any]:
    return json.loads(send(server, "/api/health", None)[1])


def children(parent: int) -> list[int]:
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError, IndexError):
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
                if int(fields[1]) == parent:
                    found.append(int(entry.name))
    return found


def workers_of(server: RunningServer) -> list[int]:
    """Process ids: the workers are children of a fork server, which is one of the server."""

    return [pid for middle in children(server._process.pid) for pid in children(middle)]


def until(condition: Any, within: float = 60.0) -> None:
    end = time.monotonic() + within
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.05)


def test_an_answer_of_a_worker_is_that_of_the_server_itself(served: RunningServer) -> None:
    status, text, _ = send(served, "/api/diagnoses", quick())
    assert status == 200
    assert json.loads(text)["verdict"]["status"]
    ideal = DIAGNOSIS | {"effects": {}, "noise": 20.0}  # a search of a second instead of five
    status, text, _ = send(served, "/api/diagnoses", ideal, "text/event-stream")
    assert status == 200
    assert text.count("event: progress") > 3
    assert '"found"' in text
    assert "event: done" in text
    status, text, _ = send(served, "/api/diagnoses", UNKNOWN)
    assert status == 404
    assert json.loads(text)["error"]["field"] == "measurement"
    # What is refused before it begins has the status of an error, also where a stream is asked for.
    assert send(served, "/api/diagnoses", UNKNOWN, "text/event-stream")[0] == 404


def test_a_finished_diagnosis_is_not_computed_again(served: RunningServer) -> None:
    """Also after a reload of the page and a restart of the server: it is a file of the data folder."""
    body = quick()
    first = send(served, "/api/diagnoses", body)[1]
    kept = list((served.data / "diagnoses").glob("*.json"))
    assert send(served, "/api/diagnoses", body)[1] == first  # with the times that the first one took
    assert sorted((served.data / "diagnoses").glob("*.json")) == sorted(kept)
    assert send(served, "/api/diagnoses", body | {"noise": 300.0})[1] != first
    # A project keeps what is about its measurements, and brings it back where it is opened.
    project = {"title": "Lift", "document": {"cases": [{"measurement": DIAGNOSIS["measurement"]}]}}
    identity = json.loads(send(served, "/api/projects", project)[1])["project"]["id"]
    for path in (served.data / "diagnoses").glob("*.json"):
        path.unlink()
    assert send(served, f"/api/projects/{identity}", None)[0] == 200
    assert send(served, "/api/diagnoses", body)[1] == first


def test_a_full_queue_is_told_and_curves_are_answered_meanwhile(served: RunningServer) -> None:
    with ThreadPoolExecutor(24) as threads:
        answers = [threads.submit(send, served, "/api/diagnoses", quick()) for _ in range(22)]
        until(lambda: sum(answer.done() for answer in answers) >= 4)
        status, text, headers = send(served, "/api/diagnoses", quick())
        now = health(served)
        assert now["workers"] == 2
        assert now["running"] <= 2  # a short one may just have ended
        if status == 429:  # unless the others were quicker
            assert json.loads(text)["error"]["code"] == "busy"
            assert int(headers["Retry-After"]) >= 1
        assert send(served, "/api/curves", CURVES)[0] == 200
        statuses = [answer.result()[0] for answer in answers]
    assert set(statuses) == {200, 429}
    assert statuses.count(429) >= 4  # 2 run, 16 wait
    until(lambda: health(served)["running"] == health(served)["waiting"] == 0)


def test_a_killed_worker_takes_its_own_job_alone(served: RunningServer) -> None:
    assert send(served, "/api/diagnoses", quick())[0] == 200
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(send, served, "/api/diagnoses", diagnosis())
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
    assert send(served, "/api/diagnoses", quick())[0] == 200


@pytest.mark.examination("test_a_killed_worker_takes_its_own_job_alone")
def test_an_idle_worker_that_is_killed_costs_no_job(served: RunningServer) -> None:
    assert send(served, "/api/diagnoses", quick())[0] == 200
    for pid in workers_of(served):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    # The next job may be given away before anybody has noticed.
    assert send(served, "/api/curves", CURVES | {"effects": TERM})[0] == 200
    assert send(served, "/api/diagnoses", quick())[0] == 200


@pytest.mark.examination("test_a_full_queue_is_told_and_curves_are_answered_meanwhile")
def test_a_typed_term_and_a_file_do_not_wait_for_diagnoses(served: RunningServer) -> None:
    headers = {"content-type": "application/json", "accept": "text/event-stream"}
    requests = [
        urllib.request.Request(served.url + "/api/diagnoses", json.dumps(diagnosis()).encode(), headers)
        for _ in range(4)
    ]
    with contextlib.ExitStack() as asked:
        streams = [asked.enter_context(opener().open(request, timeout=60)) for request in requests]
        until(lambda: health(served)["waiting"] == 2)
        assert send(served, "/api/curves", CURVES | {"effects": TERM})[0] == 200
        lanes = {lane["name"]: lane for lane in health(served)["lanes"]}
        assert lanes["long"]["running"] == 2
        assert lanes["files"]["processes"] == lanes["models"]["processes"] == 2
        comparison = DIAGNOSIS | {"effects": TERM}
        assert send(served, "/api/comparisons", comparison)[0] == 200
        upload = urllib.request.Request(f"{served.url}/api/measurements?name=a.csv", CSV, method="PUT")
        with opener().open(upload, timeout=60) as answer:
            assert answer.status == 200
        # All this was done before half of the diagnoses; nobody waits for them.
        assert health(served)["running"] + health(served)["waiting"] >= 2
        assert len(streams) == 4
    until(lambda: health(served)["running"] == health(served)["waiting"] == 0)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="counts descriptors by /proc")
def test_jobs_that_have_ended_hold_no_descriptors(served: RunningServer) -> None:
    body = CURVES | {"pressures": ["2 bar"], "points": 3, "effects": TERM}
    assert send(served, "/api/curves", body)[0] == 200
    until(lambda: health(served)["running"] == 0)
    everyone = [served.pid, *workers_of(served)]
    before = {pid: len(list(Path(f"/proc/{pid}/fd").iterdir())) for pid in everyone}
    for _ in range(12):
        assert send(served, "/api/curves", body)[0] == 200
    until(
        lambda: all(len(list(Path(f"/proc/{pid}/fd").iterdir())) <= before[pid] + 3 for pid in everyone), 10
    )


def test_whoever_leaves_frees_the_worker(served: RunningServer) -> None:
    data = json.dumps(diagnosis()).encode()
    headers = {"content-type": "application/json", "accept": "text/event-stream"}
    for _ in range(3):
        request = urllib.request.Request(served.url + "/api/diagnoses", data, headers)
        with opener().open(request, timeout=60) as answer:
            answer.readline()
    until(lambda: health(served)["running"] == 0, within=10.0)
    assert send(served, "/api/diagnoses", quick())[0] == 200


@pytest.mark.parametrize(
    "number",
    [
        signal.SIGTERM,
        pytest.param(
            signal.SIGINT,
            marks=pytest.mark.examination("test_the_server_ends_under_work_and_leaves_no_process"),
        ),
    ],
)
def test_the_server_ends_under_work_and_leaves_no_process(
    tmp_path: Path, compiled_kernels: None, number: signal.Signals
) -> None:
    with RunningServer(tmp_path, arguments=["--workers", "1"]) as server:
        told: list[str] = []

        def ask() -> None:
            told.append(send(server, "/api/diagnoses", diagnosis(), "text/event-stream")[1])

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


def pid_of(process: Supervised) -> int:
    assert process.pid
    return process.pid


def stop(pid: int | None) -> None:
    """Stop a process; on a busy machine its threads go on for a while after the signal."""
    assert pid
    os.kill(pid, signal.SIGSTOP)
    until(lambda: Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "T")


async def job(workers: Workers, body: CurvesRequest) -> bytes:
    """One job, from the queue to its answer."""
    ticket = workers.enter()
    assert await ticket.place() is None
    running = await workers.submit(ticket, "computation of curves", body)
    while await running.news.get() is not None:
        pass
    return await workers.result(running)


async def replaced(workers: Workers, before: Supervised) -> None:
    while not (workers._processes and workers._processes[0] is not before and workers._processes[0].ready):
        await asyncio.sleep(0.02)


def test_each_kill_is_one_replacement(tmp_path: Path, compiled_kernels: None) -> None:
    """At the moment of the death, without a job that asks for it."""
    body, workers = CurvesRequest.model_validate(CURVES), Workers(Settings(workers=1, data=tmp_path))

    async def run() -> None:
        try:
            first = await job(workers, body)
            for number in (1, 2):
                before = workers._processes[0]
                os.kill(pid_of(before), signal.SIGKILL)
                await replaced(workers, before)
                assert workers.ended == {"killed": number}
            assert await job(workers, body) == first
        finally:
            await asyncio.to_thread(workers.close)

    run_async(run())


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="sees by /proc whether a process is stopped")
@pytest.mark.examination("test_each_kill_is_one_replacement")
def test_stopped_processes_are_replaced(
    tmp_path: Path, compiled_kernels: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The fork server, and a worker: they say nothing and do not end by themselves."""
    body, workers = CurvesRequest.model_validate(CURVES), Workers(Settings(workers=1, data=tmp_path))
    monkeypatch.setattr("mckibben.server.supervised._MADE_WITHIN", 1.0)

    async def run() -> None:
        try:
            first = await job(workers, body)
            before = workers._processes[0]
            stop(_fork_server())
            os.kill(pid_of(before), signal.SIGKILL)
            assert await job(workers, body) == first
            monkeypatch.setattr("mckibben.server.supervised._TAKEN_WITHIN", 0.5)
            stop(pid_of(workers._processes[0]))
            assert await job(workers, body) == first
            assert workers.ended["silent"] == 1
            # The end does not wait for a fork server that cannot tell how processes end.
            stop(_fork_server())
        finally:
            await asyncio.to_thread(workers.close)

    run_async(run())


def test_work_has_an_end_in_native_code_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """By processor time: what others take of the processor is not taken from it."""
    endless = Job(lambda *_: lambda _: bytes(sum(range(10**15))), time_limit=1.0, looks=False)
    monkeypatch.setattr(worker, "JOBS", {"endless": endless})
    read, write = multiprocessing.Pipe()
    own = SimpleNamespace(studio=None, store=None, memory=1)
    forked = multiprocessing.get_context("fork").Process(
        target=worker._perform, args=(worker.Order(1, "endless", None), own, worker._Line(write))
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        forked.start()
    forked.join(60)
    assert forked.exitcode == -signal.SIGXCPU
    assert read.recv().kind == "prepared"


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


def test_every_lane_starts_when_the_page_looks_at_measurements(settings: Settings) -> None:
    """A comparison, the first that is asked then, would wait for its process to start."""
    started: list[str] = []
    app = create_app(settings)
    app.state.workers = SimpleNamespace(start=lambda *names: started.extend(names))
    assert (
        TestClient(app, base_url=f"http://127.0.0.1:{settings.port}").get("/api/mysteries").status_code == 200
    )
    assert sorted(started) == sorted(get_args(LaneName))
