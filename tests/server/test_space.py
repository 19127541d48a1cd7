"""The ledger of space: quotas by kind, imports counted before they write, full disks, erasing at once."""

from __future__ import annotations

import errno
import hashlib
import os
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.folder import Quotas
from mckibben.measurement import store as measurement_store
from mckibben.projects.project import Revision, StoredFile
from mckibben.server import security
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.server.conftest import CSV, URL, assert_error
from tests.server.packed_projects import packed_project

ID = hashlib.sha256(CSV).hexdigest()
LARGE = CSV + b"".join(b"# " + os.urandom(40_000).hex().encode() + b"\n" for _ in range(4))


def served(folder: Path, **quotas: int) -> TestClient:
    """A server whose quotas are small."""
    settings = Settings(data=folder / "data", user_presets=folder / "presets", quotas=Quotas(**quotas))
    return TestClient(create_app(settings), base_url=URL, raise_server_exceptions=False)


def stored(client: TestClient, content: bytes, name: str = "run.csv") -> str:
    answer = client.put(f"/api/measurements?name={name}", content=content)
    assert answer.status_code == 200, answer.text
    return answer.json()["id"]


def ledger(client: TestClient) -> dict[str, Any]:
    return {each["kind"]: each for each in client.get("/api/kept").json()["space"]}


def made(client: TestClient, document: dict[str, Any]) -> Any:
    return client.post("/api/projects", json={"title": "Lift", "document": document})


def on_disk(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def test_projects_have_a_quota_and_the_bin_makes_room(tmp_path: Path) -> None:
    client = served(tmp_path, projects=500_000)
    first = made(client, {"case": stored(client, LARGE)}).json()["project"]["id"]
    assert ledger(client)["projects"]["taken"] > 300_000
    error = assert_error(made(client, {"text": "x" * 300_000}), 507, code="no_space")
    assert "of 500 kB" in error["message"]
    assert "--quota projects=GB" in error["hint"]
    assert len(client.get("/api/projects").json()["projects"]) == 1
    client.delete(f"/api/projects/{first}")
    assert ledger(client)["projects"]["restorable"] > 300_000
    assert made(client, {"text": "x" * 300_000}).status_code == 201
    assert client.get("/api/projects?deleted=true").json()["projects"] == []


def test_what_is_erased_is_given_back_to_the_disk(tmp_path: Path) -> None:
    client = served(tmp_path)
    identity = stored(client, LARGE)
    project = made(client, {"case": identity}).json()["project"]["id"]
    before = on_disk(tmp_path)
    client.delete(f"/api/projects/{project}")
    assert client.delete("/api/kept/space/bin/projects").status_code == 200
    assert on_disk(tmp_path) < before - len(LARGE)
    assert client.delete(f"/api/kept/files/{identity}?erase=true").json()["deleted"] == []
    assert on_disk(tmp_path / "data" / "measurements") == 0
    other = stored(client, LARGE)
    client.delete(f"/api/kept/files/{other}")
    assert ledger(client)["measurements"]["restorable"] == len(LARGE)
    assert client.delete(f"/api/kept/files/{other}?erase=true").json()["deleted"] == []
    stored(client, LARGE)
    client.delete(f"/api/kept/files/{other}")
    assert client.delete("/api/kept/space/bin/measurements").json()["deleted"] == []
    assert ledger(client)["measurements"] == {
        "kind": "measurements", "taken": 0, "restorable": 0, "quota": 4_000_000_000,
    }  # fmt: skip


def test_an_import_without_room_writes_nothing(tmp_path: Path) -> None:
    client = served(tmp_path, projects=200_000)
    client.get("/api/projects")
    packed = packed_project({}, {hashlib.sha256(LARGE).hexdigest(): LARGE})
    before = on_disk(tmp_path)
    assert_error(client.post("/api/projects/import", content=packed), 507, code="no_space")
    assert on_disk(tmp_path) == before
    assert client.get("/api/kept").json()["items"] == []


def test_an_imported_history_keeps_to_the_most_versions(client: TestClient) -> None:
    client.get("/api/projects")
    store = client.app.state.projects  # type: ignore[attr-defined]
    many = [(Revision(n, 1e9, "saved", n % 2 == 0), {"n": n}) for n in range(1, 261)]
    project = store.revive(many, title="Lift", files=[StoredFile(ID, "a.csv", CSV)])
    kept = [each.version for each in store.history(project.summary.id)]
    assert (len(kept), kept[0]) == (200, 260)
    assert all(version in kept for version in range(1, 260, 2)), "versions saved by hand give way last"


def test_on_a_full_disk_the_bin_is_emptied_and_the_upload_goes_on(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    binned = stored(client, CSV)
    client.delete(f"/api/kept/files/{binned}")
    write, bin_folder = measurement_store._write, client.app.state.store.data / "measurements" / ".deleted"  # type: ignore[attr-defined]

    def full(path: Path, content: bytes) -> None:
        if any(bin_folder.iterdir()) or content == LARGE:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(path, content)

    monkeypatch.setattr(measurement_store, "_write", full)
    stored(client, CSV + b"1;279;127\n")
    assert client.get("/api/kept").json()["deleted"] == []
    error = assert_error(client.put("/api/measurements?name=b.csv", content=LARGE), 507, code="no_space")
    assert "the disk is full" in error["message"]
    assert "left" in error["message"]


def test_presets_have_a_quota(tmp_path: Path) -> None:
    client = served(tmp_path, presets=10)
    body = client.get("/api/presets/muscles/DMSP-20").json()
    document = {key: body[key] for key in ("schema", "kind", "title", "geometry") if key in body}
    answer = client.post("/api/presets/muscles", json={**document, "id": "mine"})
    assert_error(answer, 507, code="no_space")


def test_too_much_in_flight_is_refused_before_it_is_taken(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(security, "IN_FLIGHT", {True: len(CSV), False: 100})
    stored(client, CSV)
    stored(client, CSV)  # the first one is over
    refused = client.put("/api/measurements?name=b.csv", content=LARGE)
    assert_error(refused, 429, code="busy")
    assert int(refused.headers["retry-after"]) > 0
    assert_error(client.post("/api/curves", json={"muscle": {"preset": "D" * 200}}), 429, code="busy")

    def pieces() -> Any:
        yield from (LARGE[:100_000], LARGE[100_000:])

    assert_error(client.put("/api/measurements?name=b.csv", content=pieces()), 429, code="busy")
    monkeypatch.undo()
    stored(client, LARGE)  # nothing is counted for good
