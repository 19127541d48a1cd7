"""``/api/exports``: the file that the other doors write, its name, and errors that name the field."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.export.registry import formats
from mckibben.server.jobs import JOBS
from mckibben.server.routes import exports
from tests.export.test_formats import SAVED

MUSCLE = {"preset": "DMSP-20", "nominal_length": "300 mm"}


def test_the_formats_are_listed(shared_client: TestClient) -> None:
    formats = shared_client.get("/api/exports").json()["formats"]
    assert {"c", "json", "latex", "matlab", "modelica", "python", "table"} <= {each["id"] for each in formats}
    assert [each["drives"] for each in formats if each["id"] == "table"] == [False]
    assert [each["id"] for each in formats if not each["muscles"]] == ["linear"]


def test_one_file_comes_as_it_is_with_its_name(shared_client: TestClient) -> None:
    body = {"as": "python", "muscle": MUSCLE, "effects": {}, "name": "bench"}
    answer = shared_client.post("/api/exports", json=body)
    assert answer.status_code == 200
    assert answer.headers["content-disposition"] == 'attachment; filename="bench.py"'
    assert answer.headers["content-type"].startswith("text/x-python")
    module: dict[str, object] = {}
    exec(answer.text, module)
    curves = shared_client.post(
        "/api/curves",
        json={"muscle": MUSCLE, "effects": {}, "pressures": [4e5], "points": 3, "contraction_from": 0.0},
    ).json()
    theirs = module["force"](4e5, curves["contraction"])  # type: ignore[operator]
    assert theirs.tolist() == pytest.approx(curves["force"][0], rel=1e-12)


def test_several_files_come_as_a_zip_file(shared_client: TestClient) -> None:
    body = {"as": "c", "drive": "propneu-20"}
    answer = shared_client.post("/api/exports", json=body)
    assert answer.headers["content-type"] == "application/zip"
    assert answer.headers["content-disposition"] == 'attachment; filename="propneu_20.zip"'
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        assert archive.namelist() == ["propneu_20.c", "propneu_20.h"]
    assert (
        shared_client.post("/api/exports", json={"as": "c", "drive": "propneu-20"}).content == answer.content
    )


def test_what_needs_a_compiler_waits_in_the_queue_of_long_work(
    shared_client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the server itself each such request would take a thread for as long as a compiler runs."""
    asked: dict[str, tuple[str, bool]] = {}

    async def whole(request: Any, kind: str, body: Any, *_: Any, quick: bool = False) -> bytes:
        asked[body.format_id] = kind, quick
        return b'{"name": "x", "media_type": "text/plain"}\nx'

    monkeypatch.setattr(exports, "whole", whole)
    for form in formats():
        assert shared_client.post("/api/exports", json={"as": form, "drive": "propneu-20"}).text == "x"
    queued = {form for form, (kind, quick) in asked.items() if not quick and JOBS[kind].lane == "long"}
    assert queued == {"fmu", "fmu3"}
    assert JOBS["compiled export"].time_limit >= 3 * 600.0  # three systems, the first time


def test_a_fitted_model_keeps_its_range_and_its_files(shared_client: TestClient) -> None:
    text = shared_client.post("/api/exports", json={"as": "matlab", "model": SAVED, "title": "Bench 3"}).text
    assert "Bench 3" in text
    assert "pressure from 100000 to 500000 Pa (measured)" in text
    assert "map.csv: 720 rows" in text


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"as": "c"}, "muscle"),
        ({"as": "c", "muscle": MUSCLE, "drive": "propneu-20"}, "drive"),
        ({"as": "fortran", "muscle": MUSCLE}, "as"),
        ({"as": "linear", "muscle": MUSCLE}, "as"),
        ({"as": "linear", "drive": "paper-ramp"}, "as"),
        ({"as": "c", "drive": "propneu-21"}, "drive"),
        ({"as": "c", "drive": "propneu-20", "effects": {}}, "effects"),
        ({"as": "c", "muscle": MUSCLE, "name": "../../x"}, "name"),
        ({"as": "matlab", "muscle": MUSCLE, "name": "my-model"}, "name"),
        ({"as": "c", "muscle": MUSCLE, "effects": {"dahll": {}}}, "effects.dahll"),
        ({"as": "c", "model": {**SAVED, "effects": {"dahll": {}}}}, "model.effects.dahll"),
        ({"as": "c", "muscle": MUSCLE, "effects": {"dahl": {"force": "1 m"}}}, "effects.dahl.force"),
    ],
)
def test_errors_name_the_field(shared_client: TestClient, body: dict[str, object], field: str) -> None:
    answer = shared_client.post("/api/exports", json=body)
    assert 400 <= answer.status_code < 500, answer.text
    assert answer.json()["error"]["field"] == field
    assert answer.json()["error"]["hint"]
