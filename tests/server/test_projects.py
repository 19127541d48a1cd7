"""Projects over HTTP: kept with their measurements, never overwritten silently, taken along as one file."""

from __future__ import annotations

import hashlib
import io
import json
import shutil
import zipfile
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.application.project import projects
from mckibben.server import long_work
from mckibben.server.app import create_app
from mckibben.server.jobs import JOBS
from mckibben.server.routes import projects as routes
from mckibben.server.settings import Settings
from tests.application.study.test_study import STUDY
from tests.server.conftest import CSV, URL, assert_error
from tests.server.packed_projects import packed_project

ID = hashlib.sha256(CSV).hexdigest()


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    """A server with an empty data folder."""
    return TestClient(
        create_app(Settings(data=tmp_path / "data")), base_url=URL, raise_server_exceptions=False
    )


def made(client: TestClient, document: dict[str, Any] | None = None, **more: Any) -> dict[str, Any]:
    answer = client.post("/api/projects", json={"title": "Lift", "document": document or {}} | more)
    assert answer.status_code == 201, answer.text
    return answer.json()


def test_a_project_lives(client: TestClient) -> None:
    project = made(client, {"mass": 20}, notes="small bench")["project"]
    path = f"/api/projects/{project['id']}"
    saved = client.put(path, json={"document": {"mass": 25}, "base_version": 1, "label": "mass 25 kg"}).json()
    assert (saved["project"]["version"], saved["revision"]["label"]) == (2, "mass 25 kg")
    assert client.get(path).json()["document"] == {"mass": 25}
    assert client.get(path, params={"version": 1}).json()["document"] == {"mass": 20}
    renamed = client.patch(path, json={"title": "Arm", "base_version": 2}).json()
    assert (renamed["title"], renamed["notes"], renamed["version"]) == ("Arm", "small bench", 3)
    labels = [each["label"] for each in client.get(f"{path}/history").json()["history"]]
    assert labels == ["title: Arm", "mass 25 kg", "created"]
    copy = client.post(f"{path}/copies", json={}).json()
    assert copy["project"]["title"] == "Arm (copy)"
    assert client.delete(path).json()["deleted"] is not None
    assert [each["title"] for each in client.get("/api/projects").json()["projects"]] == ["Arm (copy)"]
    assert client.post(f"{path}/restore").json()["deleted"] is None
    assert len(client.get("/api/projects").json()["projects"]) == 2


def test_a_second_window_is_told(client: TestClient) -> None:
    path = f"/api/projects/{made(client)['project']['id']}"
    assert client.put(path, json={"document": {"by": 1}, "base_version": 1}).status_code == 200
    error = assert_error(
        client.put(path, json={"document": {"by": 2}, "base_version": 1}), 409, code="conflict"
    )
    assert error["field"] == "base_version"
    assert "version 2" in error["hint"]
    assert client.get(path).json()["document"] == {"by": 1}


def test_measurements_come_back_with_the_project(client: TestClient, tmp_path: Path) -> None:
    assert client.put("/api/measurements", params={"name": "run1.csv"}, content=CSV).status_code == 200
    project = made(client, {"case": {"files": [{"id": ID}]}})
    assert project["measurements"] == [ID]
    shutil.rmtree(tmp_path / "data" / "measurements")
    client.app.state.store._recent.clear()  # type: ignore[attr-defined]
    assert client.get(f"/api/measurements/{ID}").status_code == 404
    assert client.get(f"/api/projects/{project['project']['id']}").status_code == 200
    assert client.get(f"/api/measurements/{ID}").json()["name"] == "run1.csv"


def test_a_project_moves_to_another_machine(client: TestClient, tmp_path: Path) -> None:
    mapping = json.dumps({"kind": "isobaric"})
    client.put("/api/measurements", params={"name": "run1.csv"}, content=CSV)
    corrected = client.put(
        "/api/measurements", params={"name": "täst/run 2.csv", "mapping": mapping}, content=CSV
    ).json()["id"]
    assert corrected != ID
    project = made(client, {"files": [ID, corrected], "text": "größer"}, notes="n")["project"]
    path = f"/api/projects/{project['id']}"
    client.put(path, json={"document": {"files": [corrected]}, "base_version": 1, "label": "second"})
    answer = client.get(f"{path}/file")
    assert answer.headers["content-disposition"] == 'attachment; filename="Lift.mckibben.zip"'
    other = TestClient(create_app(Settings(data=tmp_path / "other")), base_url=URL)
    moved = other.post("/api/projects/import", content=answer.content)
    assert moved.status_code == 201, moved.text
    assert moved.json()["document"] == {"files": [corrected]}
    assert sorted(moved.json()["measurements"]) == sorted([ID, corrected])
    assert other.get(f"/api/measurements/{corrected}").json()["name"] == "run 2.csv"
    there = f"/api/projects/{moved.json()['project']['id']}"
    assert other.get(there, params={"version": 1}).json()["document"]["text"] == "größer"
    assert [each["label"] for each in other.get(f"{there}/history").json()["history"]] == [
        "second",
        "created",
    ]
    again = other.get(f"{there}/file").content
    names = [sorted(zipfile.ZipFile(io.BytesIO(each)).namelist()) for each in (answer.content, again)]
    assert names[0] == names[1]


def test_the_table_of_a_study_moves_too(client: TestClient, tmp_path: Path) -> None:
    study = STUDY | {"method": {"type": "monte_carlo", "runs": 4, "seed": 3}}
    with client:
        table = client.post("/api/studies", json=study).json()["table"]
    project = made(client, {"any": 1}, study=study)
    assert (project["studies"], project["remarks"]) == (1, [])
    packed = client.get(f"/api/projects/{project['project']['id']}/file").content
    with TestClient(create_app(Settings(data=tmp_path / "other")), base_url=URL) as other:
        moved = other.post("/api/projects/import", content=packed).json()
        assert other.post("/api/studies/kept", json=study).json() == {"runs": 0, "planned": 4}
        opened = other.get(f"/api/projects/{moved['project']['id']}").json()
        assert (opened["studies"], opened["remarks"]) == (1, [])
        assert other.post("/api/studies/kept", json=study).json() == {"runs": 4, "planned": 4}
        answer = other.post("/api/studies", json=study).json()
    assert (answer["kept"], answer["runs"]) == (4, 4)
    assert answer["table"] == table


BAD_NUMBER = [{"version": "x", "saved": 0, "label": "", "automatic": False, "file": "history/1.json"}]
TWICE = [{"version": 1, "saved": 0, "label": "", "automatic": False, "file": "history/1.json"}] * 2


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "not a packed project"),
        (b"PK\x03\x04 cut off", "not a packed project"),
        (packed_project({}, {}, schema="other/9"), "other/9"),
        (packed_project({}, {}, history=None), "damaged"),
        (packed_project({}, {}, history=BAD_NUMBER), "damaged"),
        (packed_project({}, {}, history=TWICE), "different numbers"),
        (packed_project({}, {}, history=[]), "different numbers"),
        (packed_project({}, {}, title=""), "title"),
        (packed_project({}, {"0" * 64: CSV}), "was changed"),
        (
            packed_project({}, {}, files=[{"measurement": ID, "name": "a", "mapping": None, "file": "../x"}]),
            "damaged",
        ),
        (packed_project({}, {}, studies=[{"environment": "0" * 64, "file": "history/1.json"}]), "damaged"),
        (packed_project({}, {}, studies=[{"environment": "0" * 64, "file": "none"}]), "damaged"),
        (packed_project({}, {ID: b"\0\1\2 no table"}), ""),
    ],
)
def test_damaged_projects_are_refused(client: TestClient, content: bytes, words: str) -> None:
    error = assert_error(client.post("/api/projects/import", content=content), 422)
    assert words in error["message"]
    assert client.get("/api/projects").json()["projects"] == []


def test_a_bomb_is_not_unpacked(client: TestClient) -> None:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("project.json", b"{}")
        archive.writestr("zeros", bytes(600_000_000))
    error = assert_error(client.post("/api/projects/import", content=buffer.getvalue()), 422)
    assert "too large" in error["message"]


def repeated(what: str, size: int) -> bytes:
    """A project in which one part is named ten times, and so would be written ten times."""
    document = {"text": "x" * size} if what == "history" else {}
    many = {
        "history": [
            {"version": n, "saved": 1.6e9, "label": "", "automatic": False, "file": "history/1.json"}
            for n in range(1, 11)
        ],
        "files": [
            {"measurement": ID, "name": "run1.csv", "mapping": None, "file": "measurements/0.csv"}
            for _ in range(10)
        ],
    }
    content = CSV + b"# " + b"x" * size + b"\n"
    return packed_project(document, {ID: content}, **{what: many[what]})


@pytest.mark.parametrize("what", ["history", "files"])
@pytest.mark.parametrize("limit", ["_MOST_BYTES", "_MOST_FILES"])
def test_what_an_import_writes_is_counted_as_often_as_it_is_written(
    client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str, limit: str
) -> None:
    """The parts of a ZIP file were counted once each: 2.4 kB wrote 717 MB."""
    before = everything(tmp_path)
    monkeypatch.setattr(projects, limit, {"_MOST_BYTES": 40_000, "_MOST_FILES": 9}[limit])
    error = assert_error(client.post("/api/projects/import", content=repeated(what, 10_000)), 422)
    assert "too large" in error["message"]
    assert "as often as it is named" in error["hint"]
    assert client.get("/api/projects").json()["projects"] == []
    assert everything(tmp_path) == before


def test_an_import_that_fails_leaves_the_measurements_as_they_were(
    client: TestClient, tmp_path: Path
) -> None:
    other, third = CSV + b"1.5;280.5;178.1\n", CSV + b"1.6;280.6;188.1\n"
    ids = [hashlib.sha256(content).hexdigest() for content in (other, third)]
    client.put("/api/measurements", params={"name": "mine.csv"}, content=CSV)
    client.put("/api/measurements", params={"name": "binned.csv"}, content=other)
    client.delete(f"/api/kept/files/{ids[0]}")
    before = everything(tmp_path)
    parts = {ID: CSV, ids[0]: other, ids[1]: third, "0" * 64: CSV + b"1.7;280.7;198.1\n"}
    error = assert_error(client.post("/api/projects/import", content=packed_project({}, parts)), 422)
    assert "was changed" in error["message"]
    assert everything(tmp_path) == before
    assert client.get(f"/api/measurements/{ID}").json()["name"] == "mine.csv"
    assert client.get(f"/api/measurements/{ids[1]}").status_code == 404
    del parts["0" * 64]
    assert client.post("/api/projects/import", content=packed_project({}, parts)).status_code == 201
    assert client.get(f"/api/measurements/{ids[1]}").status_code == 200


def test_the_files_of_a_project_are_read_where_files_are_read(
    client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client.put("/api/measurements", params={"name": "run1.csv"}, content=CSV)
    path = f"/api/projects/{made(client, {'case': ID})['project']['id']}"
    asked: list[str] = []

    async def whole(request: Any, kind: str, *arguments: Any) -> bytes:
        asked.append(kind)
        return await long_work.whole(request, kind, *arguments)

    monkeypatch.setattr(routes, "whole", whole)
    assert client.get(path).status_code == 200
    assert asked == [], "nothing is missing"
    shutil.rmtree(tmp_path / "data" / "measurements")
    assert client.get(path).status_code == 200
    assert asked == ["project files"]
    assert JOBS["project files"].lane == JOBS["file upload"].lane == "files"


def everything(folder: Path) -> dict[str, bytes]:
    """The measurements on the disk: file -> content."""
    kept = (folder / "data" / "measurements").rglob("*")
    return {str(path): path.read_bytes() for path in kept if path.is_file() and not path.name.startswith(".")}


def test_a_version_beyond_all_numbers_of_the_database(client: TestClient) -> None:
    path = f"/api/projects/{made(client)['project']['id']}"
    assert_error(client.get(path, params={"version": 10**25}), 404, code="not_found")
    assert_error(client.put(path, json={"document": {}, "base_version": 2**60}), 409, code="conflict")


@pytest.mark.parametrize("method", ["get", "put", "patch", "delete"])
def test_unknown_projects_are_said(client: TestClient, method: str) -> None:
    bodies = {"put": {"document": {}, "base_version": 1}, "patch": {"title": "x", "base_version": 1}}
    sent = {"json": bodies[method]} if method in bodies else {}
    assert_error(client.request(method, f"/api/projects/{'0' * 32}", **sent), 404, code="not_found")
    assert client.request(method, "/api/projects/..%2Fx", **sent).status_code in (404, 405, 422)


def test_a_database_that_cannot_be_used_is_said(tmp_path: Path) -> None:
    (tmp_path / "projects.sqlite").mkdir(parents=True)
    client = TestClient(create_app(Settings(data=tmp_path)), base_url=URL, raise_server_exceptions=False)
    error = assert_error(client.get("/api/projects"), 409, code="conflict")
    assert str(tmp_path) in error["hint"]
    assert client.get("/api/health").status_code == 200
