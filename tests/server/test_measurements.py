"""``/api/measurements``: send, read back, refuse."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest
from fastapi.testclient import TestClient
from httpx2 import Response

from mckibben.application.measurement.summary import MeasurementDetails, MeasurementSummary, PreviewResult
from mckibben.measurement.measurement import build
from mckibben.measurement.points import Points, joined
from mckibben.measurement.store import clean_name
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.server.answers import valid
from tests.server.conftest import CSV, URL, assert_error

ID = hashlib.sha256(CSV).hexdigest()


def upload(
    client: TestClient, content: bytes = CSV, name: str = "run1.csv", kind: str = "text/csv"
) -> Response:
    """PUT a file."""
    return client.put(
        "/api/measurements", params={"name": name}, content=content, headers={"content-type": kind}
    )


def test_a_file_is_understood_and_said_back(client: TestClient) -> None:
    response = upload(client)
    assert response.status_code == 200, response.text
    valid(MeasurementSummary, response.content)
    body = response.json()
    assert body["id"] == ID
    assert (body["name"], body["kind"], body["kind_detected"], body["rows"]) == (
        "run1.csv",
        "static",
        False,
        9,
    )
    channels = {channel["name"]: channel for channel in body["channels"]}
    assert channels["pressure"]["unit"] == "bar"
    assert channels["pressure"]["si_unit"] == "Pa"
    assert channels["pressure"]["maximum"] == 3e5


def test_it_is_read_back_in_si(client: TestClient) -> None:
    sent = upload(client).json()
    response = client.get(f"/api/measurements/{ID}")
    valid(MeasurementDetails, response.content)
    body = response.json()
    assert {name: body[name] for name in sent} == sent
    assert body["columns"]["length"][:3] == pytest.approx([0.28, 0.29, 0.3])
    assert body["columns"]["slack"] == [False] * 9


def test_sent_twice_it_is_kept_once(client: TestClient, settings: Settings) -> None:
    assert upload(client).json()["id"] == upload(client, name="other.csv").json()["id"]
    assert len(list(settings.data.rglob("*.data"))) == 1
    assert client.get(f"/api/measurements/{ID}").json()["name"] == "other.csv"
    assert not [path for path in settings.data.rglob("*") if path.suffix == ".tmp"]


def test_it_is_there_after_a_restart(client: TestClient, settings: Settings) -> None:
    upload(client)
    with TestClient(create_app(settings), base_url=URL) as later:
        assert later.get(f"/api/measurements/{ID}").json()["name"] == "run1.csv"
        for path in settings.data.rglob("*.json"):
            path.write_text("{broken", "utf-8")
    with TestClient(create_app(settings), base_url=URL) as later:
        assert later.get(f"/api/measurements/{ID}").json()["rows"] == 9


def test_an_unknown_id_asks_to_send_the_file_again(client: TestClient) -> None:
    error = assert_error(client.get(f"/api/measurements/{ID}"), 404, code="not_found")
    assert "upload the file again" in error["hint"]


@pytest.mark.parametrize("name", ["x", "A" * 64, "g" * 64, f"{ID}.data", f"{ID}%0a"])
def test_anything_else_is_no_id(client: TestClient, name: str) -> None:
    assert_error(client.get(f"/api/measurements/{name}"), 404)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", ""),
        (b"\x00\x01\x02", ""),
        (b"pressure_bar;length_mm;force_N\n1;300;abc\n", "abc"),
        (b"pressure_kg;length_mm;force_N\n1;300;1\n", ""),
        (b"just a text", ""),
    ],
)
def test_what_is_no_measurement_is_refused_and_not_kept(
    client: TestClient, settings: Settings, content: bytes, words: str
) -> None:
    error = assert_error(upload(client, content), 422)
    assert "run1.csv" in error["message"]
    assert words in error["message"]
    assert not list(settings.data.rglob("*.data"))


def test_the_name_is_needed_and_bounded(client: TestClient) -> None:
    assert_error(client.put("/api/measurements", content=CSV), 422, field="name")
    assert_error(upload(client, name=""), 422, field="name")
    assert_error(upload(client, name="x" * 201), 422, field="name")


def test_a_form_is_refused_with_a_way_out(client: TestClient) -> None:
    error = assert_error(upload(client, kind="multipart/form-data; boundary=x"), 415)
    assert "as the body" in error["message"]


@pytest.mark.parametrize(
    "kind",
    [
        "text/csv; charset=utf-8",
        "TEXT/CSV",
        "application/vnd.ms-excel",
        "application/octet-stream",
        "application/x-www-form-urlencoded",  # what curl --data-binary says
    ],
)
def test_the_body_is_the_file_whatever_a_client_calls_it(client: TestClient, kind: str) -> None:
    assert upload(client, kind=kind).status_code == 200


@pytest.mark.parametrize(
    "name", ["../../etc/passwd.csv", "C:\\Users\\me\\run1.csv", "/tmp/run1.csv", "a\x00b.csv", "run\n1.csv"]
)
def test_a_name_is_only_a_name(client: TestClient, settings: Settings, name: str) -> None:
    body = upload(client, name=name).json()
    assert "/" not in body["name"]
    assert "\\" not in body["name"]
    written = {
        path.relative_to(settings.data)
        for path in settings.data.rglob("*")
        if path.is_file() and not path.name.startswith(".")
    }
    assert written == {Path(f"measurements/{ID}.data"), Path(f"measurements/{ID}.json")}


def test_names_are_cleaned() -> None:
    assert clean_name("a/b/c.csv") == "c.csv"
    assert clean_name("\x00\n") == "measurement.csv"
    assert clean_name("ä b.csv") == "ä b.csv"


def test_a_folder_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("a file", "utf-8")
    with TestClient(create_app(Settings(data=tmp_path / "data")), base_url=URL) as client:
        error = assert_error(upload(client), 409)
    assert "--data" in error["hint"]


def test_every_row_is_accounted_for(client: TestClient) -> None:
    text = "# pressure: gauge\npressure_bar;length_mm;force_N\n" + "".join(
        f"{p};{length};{max(0, 100 * p + length - 400)}\n" for p in (1, 2, 3) for length in (180, 220, 300)
    )
    body = upload(client, text.encode()).json()
    assert body["excluded"] == {"slack": 4}
    assert (body["rows"], body["usable_rows"], body["skipped"]) == (9, 5, {})
    assert body["segments"]["signal"] == "length"
    columns = client.get(f"/api/measurements/{body['id']}").json()["columns"]
    assert sum(columns["usable"]) == 5
    assert {"slack", "sweep", "cycle", "motion"} <= set(columns)


def preview(client: TestClient, content: bytes, **query: str) -> Response:
    """POST a file for a look."""
    return client.post("/api/measurements/preview", params={"name": "run1.csv", **query}, content=content)


def test_a_preview_says_what_the_file_is_and_keeps_nothing(client: TestClient, settings: Settings) -> None:
    response = preview(client, CSV)
    valid(PreviewResult, response.content)
    body = response.json()
    assert [column["channel"] for column in body["columns"]] == ["pressure", "length", "force"]
    assert body["sample"][0] == ["1", "280", "128.0"]
    assert (body["rows"], body["valid_rows"], body["kind"]) == (9, 9, "static")
    assert body["problem"] is None
    assert body["measurement"]["id"] == ID
    assert "pressure" in [choice["name"] for choice in body["channel_choices"]]
    assert not (settings.data / "measurements").exists()


def test_a_preview_leads_to_the_mapping_that_is_sent(client: TestClient) -> None:
    content = CSV.replace(b"pressure_bar", b"kanal1") + b"4;oops;1\n"
    body = preview(client, content).json()
    assert body["columns"][0]["channel"] == "pressure"  # by its numbers, which is asked
    assert "kanal1" in body["problem"]["message"]
    assert body["skipped"] == [{"reason": "not a number", "rows": 1, "first": "row 12, column 'length_mm'"}]
    mapping = '{"columns": {"kanal1": {"channel": "pressure", "unit": "bar"}}, "bad_rows": "%s"}'
    body = preview(client, content, mapping=mapping % "refuse").json()
    valid(PreviewResult, body)
    assert body["only_bad_rows"]
    assert "row 12" in body["problem"]["message"]
    skip = mapping % "skip"
    body = preview(client, content, mapping=skip).json()
    assert body["problem"] is None
    sent = client.put("/api/measurements", params={"name": "run1.csv", "mapping": skip}, content=content)
    assert sent.json() == body["measurement"]
    assert sent.json()["id"] != hashlib.sha256(content).hexdigest()
    assert client.get(f"/api/measurements/{sent.json()['id']}").json()["rows"] == 9


def test_a_preview_of_no_table_is_refused(client: TestClient) -> None:
    assert "row 1" in assert_error(preview(client, b""), 422)["message"]
    assert_error(preview(client, CSV, mapping="{"), 422, field="mapping")
    assert_error(preview(client, CSV, mapping='{"knd": "static"}'), 422, field="mapping.knd")


def test_a_preview_takes_as_much_as_an_upload(client: TestClient) -> None:
    assert preview(client, CSV + b"1;280;1\n" * 200_000).json()["rows"] == 200_009


def test_joined_files_keep_what_is_known_of_each() -> None:
    rows = {"pressure": np.full(40, 1e5), "length": 0.3 - 1e-3 * np.arange(40), "force": 1.0 + np.arange(40)}
    bad = np.arange(40) < 5
    parts = [
        build(
            rows, name=name, id="0" * 64, kind="isobaric", excluded_rows={"force stuck": bad}, skipped=skipped
        )
        for name, skipped in (("a.csv", {"not a number": 2}), ("b.csv", {}))
    ]
    together = joined([Points(part) for part in parts])
    measurement = together.measurement
    assert together.left_out == {"not a number": 2}
    assert measurement.starts == (0, 40)
    assert dict(measurement.exclusions) == {"force stuck": 10}
    assert np.flatnonzero(np.diff(measurement.segments.sweep)).tolist() == [39]
