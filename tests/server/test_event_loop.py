"""The event loop only receives and sends: no route reads a file, parses or prepares on it."""

from __future__ import annotations

import asyncio
import hashlib
import json
import re
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any
from uuid import UUID

import pytest
from fastapi import FastAPI, Request
from fastapi.testclient import TestClient
from starlette.requests import ClientDisconnect

from mckibben.application.compare import specimens
from mckibben.application.diagnose import diagnose
from mckibben.documents.studio import Studio
from mckibben.measurement import store
from mckibben.measurement.store import MeasurementStore
from mckibben.presets import PresetLibrary
from mckibben.projects import store as projects
from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore
from mckibben.resources import presets_folder
from mckibben.server import short_jobs
from mckibben.server.answer import read_json
from mckibben.server.app import create_app
from mckibben.server.long_work import prepared
from mckibben.server.settings import Settings
from tests.server.conftest import CSV, URL, assert_error, post, run_async
from tests.server.packed_projects import packed_project
from tests.server.test_simulations import LIFT

ID = hashlib.sha256(CSV).hexdigest()
MINE = {"preset": "mine-20"}
MODEL = {"muscle": MINE, "effects": {"prestress": {}}, "measurement": ID}
NOISY = {"noise": 9e3}  # nothing is above it: nothing is searched
TASK = {
    "load": {"mass": "20 kg"},
    "stroke": "60 mm",
    "time": "0.5 s",
    "catalogue": {"muscles": ["mine-20"], "valves": ["MPYE-5-1/8-HF"], "tubes": ["PUN-H-6x1"]},
    "uncertainty": {"specimens": 0},
}
DRIVE = LIFT | {"muscle": MINE | {"nominal_length": "800 mm"}, "duration": "0.5 s"}
MUSCLE = json.loads((presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8")) | {"id": "mine-20"}
FILE = {"params": {"name": "a.csv"}, "content": CSV}

PROJECT = f"/api/projects/{'1' * 32}"
PACKED = packed_project({"file": ID}, {ID: CSV})

STUDY = {
    "subject": {"drive": DRIVE},
    "quantities": [{"path": "load.mass", "from": "9 kg", "to": "10 kg", "points": 2}],
    "figures": ["timing.extend.rise_time"],
    "method": {"type": "grid"},
}

#: Every route of the interface: (method, path of the description) -> (path, what is sent).
REQUESTS: dict[tuple[str, str], tuple[str, dict[str, Any]]] = {
    ("POST", "/api/asked"): ("/api/asked", {"json": {"text": "mine-20, 6 bar, 20 kg"}}),
    ("POST", "/api/curves"): ("/api/curves", {"json": {"muscle": MINE}}),
    ("POST", "/api/signatures"): (
        "/api/signatures", {"json": {"muscle": MINE, "effect": "coulomb_friction"}},
    ),
    ("POST", "/api/simulations"): ("/api/simulations", {"json": {"drive": DRIVE, "points": 11}}),
    ("POST", "/api/linearisations"): ("/api/linearisations", {"json": {"drive": DRIVE}}),
    ("POST", "/api/inverse"): (
        "/api/inverse", {"json": {"question": "working_range", "muscle": MINE, "load": "100 N",
                                  "pressure": "3 bar"}},
    ),
    ("POST", "/api/joints"): (
        "/api/joints", {"json": {"joint": {"muscle": MINE, "muscles": [{"path": {"lever": "30 mm"}}],
                                           "stops": {"min_angle": 0.0, "max_angle": 0.5}}}},
    ),
    ("POST", "/api/sizings"): ("/api/sizings", {"json": TASK}),
    ("POST", "/api/sizings/reports"): ("/api/sizings/reports", {"json": {"task": TASK}}),
    ("POST", "/api/studies"): ("/api/studies", {"json": STUDY}),
    ("POST", "/api/studies/kept"): ("/api/studies/kept", {"json": STUDY}),
    ("POST", "/api/studies/parquet"): ("/api/studies/parquet", {"json": STUDY}),
    ("POST", "/api/studies/options"): ("/api/studies/options", {"json": {"subject": {"drive": DRIVE}}}),
    ("POST", "/api/comparisons"): ("/api/comparisons", {"json": MODEL}),
    ("POST", "/api/diagnoses"): ("/api/diagnoses", {"json": MODEL | NOISY}),
    ("POST", "/api/experiments"): ("/api/experiments", {"json": MODEL}),
    ("GET", "/api/health"): ("/api/health", {}),
    ("GET", "/api/figures"): ("/api/figures", {}),
    ("GET", "/api/units"): ("/api/units", {}),
    ("GET", "/api/effects"): ("/api/effects", {}),
    ("GET", "/api/presets/{kind}"): ("/api/presets/muscles", {}),
    ("GET", "/api/presets/{kind}/{preset_id}"): ("/api/presets/muscles/mine-20", {}),
    ("GET", "/api/order-codes/{code}"): ("/api/order-codes/DMSP-20-300N-RM-CM", {}),
    ("POST", "/api/presets/muscles"): ("/api/presets/muscles", {"json": MUSCLE | {"id": "other-20"}}),
    ("POST", "/api/presets/muscles/fitted"): (
        "/api/presets/muscles/fitted", {"json": MODEL | {"id": "fitted"}},
    ),
    ("PUT", "/api/measurements"): ("/api/measurements", FILE),
    ("POST", "/api/measurements/preview"): ("/api/measurements/preview", FILE),
    ("GET", "/api/measurements/{measurement_id}"): (f"/api/measurements/{ID}", {}),
    ("GET", "/api/kept"): ("/api/kept", {}),
    ("PATCH", "/api/kept/{kind}/{identity}"): ("/api/kept/muscles/mine-20", {"json": {"name": "mine"}}),
    ("DELETE", "/api/kept/{kind}/{identity}"): ("/api/kept/muscles/mine-20", {}),
    ("POST", "/api/kept/{kind}/{identity}/restore"): ("/api/kept/muscles/gone-20/restore", {}),
    ("DELETE", "/api/kept/space/bin/{kind}"): ("/api/kept/space/bin/presets", {}),
    ("POST", "/api/reports"): (
        "/api/reports",
        {"json": MODEL | NOISY | {"history": [{"label": "before", "effects": {}}], "diagnose": True}},
    ),
    ("GET", "/api/exports"): ("/api/exports", {}),
    ("POST", "/api/exports"): ("/api/exports", {"json": {"as": "c", "muscle": MINE}}),
    ("GET", "/api/projects"): ("/api/projects", {}),
    ("POST", "/api/projects"): ("/api/projects", {"json": {"title": "Lift", "document": {"file": ID}}}),
    ("POST", "/api/projects/import"): ("/api/projects/import", {"content": PACKED}),
    ("GET", "/api/projects/{project_id}"): (PROJECT, {}),
    ("PUT", "/api/projects/{project_id}"): (PROJECT, {"json": {"document": {}, "base_version": 1}}),
    ("PATCH", "/api/projects/{project_id}"): (PROJECT, {"json": {"title": "Arm", "base_version": 1}}),
    ("DELETE", "/api/projects/{project_id}"): (PROJECT, {}),
    ("POST", "/api/projects/{project_id}/copies"): (f"{PROJECT}/copies", {"json": {}}),
    ("POST", "/api/projects/{project_id}/restore"): (f"{PROJECT}/restore", {}),
    ("GET", "/api/projects/{project_id}/history"): (f"{PROJECT}/history", {}),
    ("GET", "/api/projects/{project_id}/file"): (f"{PROJECT}/file", {}),
    ("GET", "/api/mysteries"): ("/api/mysteries", {}),
    ("POST", "/api/mysteries/{mystery_id}/reveal"): ("/api/mysteries/the-dip/reveal", {"json": {}}),
}  # fmt: skip
#: Besides the interface: the page, its parts, the description, and the search for the nearest path.
OTHERS = {
    "page": ("GET", "/", {}),
    "plotly": ("GET", "/vendor/plotly.min.js", {}),
    "description": ("GET", "/openapi.json", {}),
    "nothing": ("GET", "/api/nothing", {}),
}
STREAMED = ("/api/simulations", "/api/studies", "/api/linearisations", "/api/sizings", "/api/diagnoses")
CASES = {
    **{f"{method} {path}": (method, *request) for (method, path), request in REQUESTS.items()},
    **OTHERS,
    **{
        f"{path} as a stream": ("POST", path, REQUESTS["POST", path][1] | {
            "headers": {"accept": "text/event-stream"}
        })
        for path in STREAMED
    },
}  # fmt: skip
#: Requests that name the uploaded measurement, which nobody has read since the server started.
READERS = [
    name
    for name, case in CASES.items()
    if (ID in str(case) or "content" in case[2]) and "/api/projects" not in case[1]
]
#: What reads or prepares, wherever it is called from.
HEAVY = [
    (MeasurementStore, "get"), (MeasurementStore, "put"), (PresetLibrary, "_refresh"),
    (Studio, "start_model"), (Studio, "static_model"), (Studio, "slow_model"),
    (store, "read_measurement"),
    (short_jobs, "preview"), (specimens, "predictor_of"), (FastAPI, "openapi"),
]  # fmt: skip


class Watcher:
    """What happened where: on the event loop, or in a worker thread."""

    def __init__(self) -> None:
        self.watching = False
        self.on_loop: list[str] = []
        self.elsewhere: list[str] = []

    def note(self, what: str) -> None:
        """Note it with the thread it happens in."""
        if self.watching:
            there = asyncio._get_running_loop() is not None
            (self.on_loop if there else self.elsewhere).append(what)

    def noting(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, noted at each call."""

        def noted(*args: Any, **kwargs: Any) -> Any:
            self.note(name)
            return function(*args, **kwargs)

        return noted


_WATCHER = Watcher()


def _hook(event: str, args: tuple[Any, ...]) -> None:
    # FastAPI looks up the source line of a route once; anyio imports what serves files when first needed.
    if event in ("open", "os.listdir", "os.scandir") and not re.search(r"\.py$|\banyio\b", str(args[0])):
        _WATCHER.note(f"{event} {args[0]}")


@pytest.fixture(scope="module", autouse=True)
def _hooked() -> None:
    sys.addaudithook(_hook)  # there is no way to take it away again; it does nothing while nobody watches


@pytest.fixture
def watcher(monkeypatch: pytest.MonkeyPatch) -> Iterator[Watcher]:
    """Watches files and heavy functions until the test ends."""
    for owner, name in HEAVY:
        monkeypatch.setattr(owner, name, _WATCHER.noting(name, getattr(owner, name)))
    _WATCHER.on_loop, _WATCHER.elsewhere, _WATCHER.watching = [], [], True
    yield _WATCHER
    _WATCHER.watching = False


@pytest.fixture
def client(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[TestClient]:
    """A server that has just started, with a measurement, a muscle and a project of the user on disk."""
    settings = Settings(data=tmp_path / "data", user_presets=tmp_path / "presets")
    MeasurementStore(settings.data).put(CSV, "run1.csv")
    (tmp_path / "presets" / "muscles").mkdir(parents=True)
    (tmp_path / "presets" / "muscles" / "mine-20.json").write_text(json.dumps(MUSCLE), "utf-8")
    (tmp_path / "presets" / "muscles" / ".deleted").mkdir()
    gone = tmp_path / "presets" / "muscles" / ".deleted" / "gone-20.json"
    gone.write_text(json.dumps(MUSCLE | {"id": "gone-20"}), "utf-8")
    with monkeypatch.context() as patch:
        patch.setattr(projects, "uuid4", lambda: UUID(int=0x1111_1111_1111_1111_1111_1111_1111_1111))
        database = Database(settings.data)
        ProjectStore(database).create({"file": ID}, title="Lift")
        database.close()
    with TestClient(create_app(settings), base_url=URL, raise_server_exceptions=False) as client:
        yield client


def test_every_route_is_looked_at(client: TestClient) -> None:
    paths = client.get("/openapi.json").json()["paths"]
    routes = {(method.upper(), path) for path, methods in paths.items() for method in methods}
    assert routes == set(REQUESTS)
    assert len(READERS) >= 7


@pytest.mark.parametrize("name", CASES)
def test_nothing_is_read_or_prepared_on_the_event_loop(
    client: TestClient, watcher: Watcher, name: str
) -> None:
    method, path, sent = CASES[name]
    response = client.request(method, path, **sent)
    refused = name == "nothing" or "pyarrow" in response.text  # an extra
    assert response.status_code < 300 or refused, response.text
    assert "event: error" not in response.text
    assert watcher.on_loop == []
    if name in READERS:
        assert {"read_measurement", "preview"} & set(watcher.elsewhere)


def test_quick_curves_stay_on_the_loop_and_need_no_file(client: TestClient, watcher: Watcher) -> None:
    assert post(client, "/api/curves", {"muscle": {"preset": "DMSP-20"}}).status_code == 200
    assert "slow_model" in watcher.on_loop
    assert not [what for what in watcher.on_loop if what == "_refresh" or what.startswith(("open", "os."))]
    watcher.on_loop = []
    term = {"custom": {"term": "c*L", "c": 1.0}}
    assert post(client, "/api/curves", {"muscle": {"preset": "DMSP-20"}, "effects": term}).status_code == 200
    assert watcher.on_loop == []


@pytest.mark.parametrize("name", READERS)
def test_others_are_answered_while_a_file_is_read(
    client: TestClient, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    reading, go_on = threading.Event(), threading.Event()

    def slow(function: Callable[..., Any]) -> Callable[..., Any]:
        def read(*args: Any) -> Any:
            reading.set()
            assert go_on.wait(60.0)
            return function(*args)

        return read

    monkeypatch.setattr(store, "read_measurement", slow(store.read_measurement))
    monkeypatch.setattr(short_jobs, "preview", slow(short_jobs.preview))
    method, path, sent = CASES[name]
    with ThreadPoolExecutor(2) as threads:
        answer = threads.submit(client.request, method, path, **sent)
        try:
            assert reading.wait(60.0)
            healthy = threads.submit(client.get, "/api/health").result(timeout=30.0)  # fails where it waits
            assert not answer.done()
        finally:
            go_on.set()
        assert healthy.status_code == 200
        assert answer.result().status_code < 300


def test_what_was_read_for_somebody_who_has_gone_is_not_diagnosed(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = threading.Event()
    started: list[str] = []
    read = store.read_measurement

    def read_until_gone(*args: Any) -> Any:
        gone.set()  # the connection is closed while the file is being read
        return read(*args)

    monkeypatch.setattr(store, "read_measurement", read_until_gone)
    monkeypatch.setattr(diagnose, "search_effects", lambda *_, **__: started.append("diagnosed"))
    for accepted in (b"application/json", b"text/event-stream"):
        gone.clear()
        client.app.state.store._recent.clear()  # type: ignore[attr-defined]
        assert run_async(_asked(client.app, json.dumps(MODEL).encode(), accepted, gone)) == []
        assert gone.is_set()
    assert started == []


async def _asked(app: Any, body: bytes, accepted: bytes, gone: threading.Event) -> list[Any]:
    """What the application sends to somebody who asks for a diagnosis and closes the connection."""
    sent: list[Any] = []
    waiting = [{"type": "http.request", "body": body}]

    async def receive() -> dict[str, Any]:
        if waiting:
            return waiting.pop()
        while not gone.is_set():
            await asyncio.sleep(0.01)
        return {"type": "http.disconnect"}

    async def send(message: Any) -> None:
        sent.append(message)

    headers = [(b"host", b"127.0.0.1"), (b"content-type", b"application/json"), (b"accept", accepted)]
    path = "/api/diagnoses"
    scope = {
        "type": "http", "method": "POST", "path": path, "raw_path": path.encode(), "query_string": b"",
        "headers": headers, "http_version": "1.1", "scheme": "http", "server": ("127.0.0.1", 8000),
    }  # fmt: skip
    await app(scope, receive, send)
    return sent


def test_prepared_tells_when_nobody_waits() -> None:
    async def message(kind: str) -> dict[str, str]:
        return {"type": kind}

    there = Request({"type": "http", "headers": []}, lambda: message("http.request"))
    assert run_async(prepared(there, sum, (1, 2))) == 3
    gone = Request({"type": "http", "headers": []}, lambda: message("http.disconnect"))
    with pytest.raises(ClientDisconnect):
        run_async(prepared(gone, sum, (1, 2)))


def test_a_large_body_is_read_in_a_thread(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    places: list[bool] = []

    def noted(text: bytes) -> Any:
        places.append(asyncio._get_running_loop() is not None)
        return read_json(text)

    monkeypatch.setattr("mckibben.server.answer.read_json", noted)
    for blanks in (0, 900_000):
        content = json.dumps({"muscle": {"preset": "DMSP-20"}}) + " " * blanks
        response = client.post("/api/curves", content=content, headers={"content-type": "application/json"})
        assert response.status_code == 200
    assert places == [True, False]


@pytest.mark.parametrize("keys", [10, 80_000])
def test_the_key_that_occurs_twice_is_found_among_many(client: TestClient, keys: int) -> None:
    names = [*(f"k{number}" for number in range(keys)), f"k{keys - 1}"]
    body = "{" + ",".join(f'"{name}":1' for name in names) + "}"
    with ThreadPoolExecutor(1) as thread:  # looking at every pair of keys would take minutes
        asked = thread.submit(
            client.post, "/api/curves", content=body, headers={"content-type": "application/json"}
        )
        error = assert_error(asked.result(timeout=60.0), 400, code="bad_json")
    assert f"'k{keys - 1}' occurs twice" in error["message"]
