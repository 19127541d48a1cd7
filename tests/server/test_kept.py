"""Kept data: list, rename, delete with undo, quota; two servers on one folder."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.folder import Quotas, locked
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.server.conftest import CSV, URL, assert_error, post

MUSCLE = {
    "schema": 1, "kind": "muscle", "id": "bench-3", "title": "Bench 3",
    "geometry": {
        name: {"value": value, "unit": unit, "source": "bench", "grade": "user"}
        for name, value, unit in (
            ("nominal_length", 300, "mm"), ("braid_diameter", 22, "mm"), ("inside_diameter", 20, "mm"),
            ("braid_angle", 25, "deg"),
        )
    },
}  # fmt: skip


@pytest.fixture
def pair(tmp_path: Path) -> Iterator[tuple[TestClient, TestClient]]:
    """Two servers on the same folders."""
    settings = Settings(data=tmp_path / "data", user_presets=tmp_path / "presets")
    with ExitStack() as stack:
        one, other = (
            stack.enter_context(TestClient(create_app(settings), base_url=URL, raise_server_exceptions=False))
            for _ in range(2)
        )
        yield one, other


def stored(client: TestClient, content: bytes = CSV, name: str = "run1.csv", query: str = "") -> Any:
    return client.put(f"/api/measurements?name={name}{query}", content=content)


def names(answer: Any) -> dict[str, list[str]]:
    assert answer.status_code == 200, answer.text
    body = answer.json()
    return {part: [item["name"] for item in body[part]] for part in ("items", "deleted")}


def test_a_measurement_is_renamed_deleted_and_restored(client: TestClient) -> None:
    identity = stored(client).json()["id"]
    path = f"/api/kept/files/{identity}"
    listed = client.get("/api/kept").json()
    assert [(item["kind"], item["id"], item["size"]) for item in listed["items"]] == [
        ("files", identity, len(CSV))
    ]
    assert listed["space"][0]["taken"] >= len(CSV)
    answer = client.patch(path, json={"name": "bench 3.csv", "was": "run1.csv"})
    assert names(answer) == {"items": ["bench 3.csv"], "deleted": []}
    assert client.get(f"/api/measurements/{identity}").json()["name"] == "bench 3.csv"
    assert names(client.delete(path)) == {"items": [], "deleted": ["bench 3.csv"]}
    assert_error(client.get(f"/api/measurements/{identity}"), 404)
    assert_error(client.delete(path), 404)
    assert names(client.post(f"{path}/restore")) == {"items": ["bench 3.csv"], "deleted": []}
    assert client.get(f"/api/measurements/{identity}").status_code == 200
    assert_error(client.post("/api/kept/files/" + "0" * 64 + "/restore"), 404)


def test_a_deleted_measurement_is_there_again_when_it_is_uploaded(client: TestClient) -> None:
    identity = stored(client).json()["id"]
    client.delete(f"/api/kept/files/{identity}")
    assert stored(client).json()["id"] == identity
    assert names(client.get("/api/kept")) == {"items": ["run1.csv"], "deleted": []}


def test_a_content_stays_as_long_as_one_reading_of_it_is_kept(client: TestClient, tmp_path: Path) -> None:
    plain = stored(client).json()["id"]
    mapping = "&mapping=%7B%22kind%22%3A%20%22static%22%7D"
    corrected = stored(client, query=mapping).json()["id"]
    assert corrected != plain
    client.delete(f"/api/kept/files/{plain}")
    store = MeasurementStore(tmp_path / "data", quotas=Quotas(measurements=0))
    with pytest.raises(InputError, match="of 0 kB"):  # it removed for good what it could
        store.put(CSV + b"1;282;120\n", "other.csv")
    assert store.deleted() == []
    assert client.get(f"/api/measurements/{corrected}").status_code == 200
    assert_error(client.post(f"/api/kept/files/{plain}/restore"), 404)


def test_what_was_deleted_makes_room_and_nothing_else_does(tmp_path: Path) -> None:
    files = [CSV + b"1;280;%d\n" % number for number in range(3)]
    store = MeasurementStore(tmp_path, quotas=Quotas(measurements=round(2.9 * len(files[0]))))
    first, second = (store.put(content, f"{number}.csv") for number, content in enumerate(files[:2]))
    with pytest.raises(InputError, match="kept measurements take") as full:
        store.put(files[2], "2.csv")
    assert full.value.code == "no_space"
    assert {file.id for file in store.kept()} == {first.id, second.id}
    store.delete(first.id)
    third = store.put(files[2], "2.csv")
    assert {file.id for file in store.kept()} == {second.id, third.id}
    assert store.deleted() == []
    assert store.size() <= store.quotas.measurements
    store.put(files[1], "again.csv")  # is there already


def test_a_preset_is_renamed_deleted_and_restored(client: TestClient) -> None:
    assert post(client, "/api/presets/muscles", MUSCLE).status_code == 201
    path = "/api/kept/muscles/bench-3"
    assert names(client.patch(path, json={"name": "Rig 3"})) == {"items": ["Rig 3"], "deleted": []}
    assert client.get("/api/presets/muscles/bench-3").json()["title"] == "Rig 3"
    assert names(client.delete(path)) == {"items": [], "deleted": ["Rig 3"]}
    assert_error(client.get("/api/presets/muscles/bench-3"), 404)
    assert post(client, "/api/presets/muscles", MUSCLE).status_code == 201
    assert_error(client.post(f"{path}/restore"), 409)
    client.delete(path)
    assert names(client.post(f"{path}/restore"))["items"] == ["Bench 3"]
    assert_error(client.delete("/api/kept/muscles/DMSP-20"), 409)
    assert_error(client.patch("/api/kept/muscles/DMSP-20", json={"name": "a"}), 409)
    assert_error(client.delete("/api/kept/muscles/nothing"), 404)
    assert_error(client.patch(path, json={"name": " "}), 422, field="name")


def test_two_servers_do_not_overwrite_a_preset_of_each_other(pair: tuple[TestClient, TestClient]) -> None:
    one, other = pair
    assert post(one, "/api/presets/muscles", MUSCLE).status_code == 201
    mine = MUSCLE | {"title": "Mine"}
    error = assert_error(post(other, "/api/presets/muscles", mine), 409, field="id")
    assert "another program has changed 'bench-3'" in error["message"]
    assert one.get("/api/presets/muscles/bench-3").json()["title"] == "Bench 3"
    other.get("/api/presets/muscles")  # now it has been seen there
    assert post(other, "/api/presets/muscles", mine).status_code == 201
    assert_error(one.delete("/api/kept/muscles/bench-3"), 409)
    assert_error(one.patch("/api/kept/muscles/bench-3", json={"name": "X", "was": "Bench 3"}), 409)
    assert names(one.get("/api/kept"))["items"] == ["Mine"]
    assert names(one.delete("/api/kept/muscles/bench-3"))["deleted"] == ["Mine"]


def test_two_servers_do_not_rename_a_file_over_each_other(pair: tuple[TestClient, TestClient]) -> None:
    one, other = pair
    path = f"/api/kept/files/{stored(one).json()['id']}"
    assert one.patch(path, json={"name": "a.csv", "was": "run1.csv"}).status_code == 200
    error = assert_error(other.patch(path, json={"name": "b.csv", "was": "run1.csv"}), 409, field="was")
    assert "'a.csv'" in error["message"]
    assert names(other.get("/api/kept"))["items"] == ["a.csv"]
    assert other.delete(path).status_code == 200
    assert_error(one.get(path.replace("kept/files", "measurements")), 404)  # also where it was in memory


def test_one_program_at_a_time_changes_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mckibben.folder._WITHIN", 0.05)
    store = MeasurementStore(tmp_path)
    with locked(tmp_path / "measurements"), pytest.raises(InputError, match="another program keeps"):
        store.put(CSV, "run1.csv")
    assert store.put(CSV, "run1.csv").rows == store.get(store.kept()[0].id).rows
