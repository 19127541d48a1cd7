"""What a file leaves open, over HTTP: questions, columns not read, origins, answers in the same words."""

from __future__ import annotations

import json
import re
from collections.abc import Callable

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.measurement.summary import MeasurementSummary, PreviewResult
from tests.measurement.reading.open_files import WRITERS, OpenFile
from tests.measurement.reading.sealed_files import three_heads
from tests.server.answers import valid
from tests.server.conftest import assert_error


def mapping_of(file: OpenFile) -> str:
    """The options of a file as a mapping."""
    words = {"--rest-length": "rest_length"}
    said: dict[str, object] = {}
    for name, value in zip(file.options[::2], file.options[1::2], strict=True):
        key = words.get(name, name[2:])
        said[key] = [value] if key in ("column", "ignore", "experiment") else value
    return json.dumps(said)


@pytest.mark.parametrize("writer", WRITERS, ids=lambda writer: writer.__name__)
def test_a_preview_lists_the_questions(client: TestClient, writer: Callable[[], OpenFile]) -> None:
    file = writer()
    query = {"name": file.name}
    response = client.post("/api/measurements/preview", params=query, content=file.data)
    body = response.json()
    valid(PreviewResult, response.content)
    assert sorted(question["about"] for question in body["questions"]) == sorted(file.about)
    put = client.put("/api/measurements", params=query, content=file.data)
    if file.stops:
        assert body["measurement"] is None
        assert body["problem"]["message"] == assert_error(put, 422)["message"]
    else:
        assert put.json()["questions"] == body["questions"]
    query["mapping"] = mapping_of(file)
    put = client.put("/api/measurements", params=query, content=file.data)
    assert put.status_code == 200, put.text
    valid(MeasurementSummary, put.content)
    assert file.channel is not None
    channel, values = file.channel
    columns = client.get(f"/api/measurements/{put.json()['id']}").json()["columns"]
    np.testing.assert_allclose(columns[channel], values, atol=1e-4 * np.max(np.abs(values)))


def test_a_preview_says_where_everything_stands(client: TestClient) -> None:
    file = three_heads()
    body = client.post("/api/measurements/preview", params={"name": file.name}, content=file.data).json()
    columns = {column["header"]: column for column in body["columns"]}
    assert list(columns) == ["Lfd. Nr.", "Zeit", "Muskeldruck", "Hub", "Last"]
    assert columns["Muskeldruck"]["channel"] == "pressure"
    assert (columns["Muskeldruck"]["unit"], columns["Muskeldruck"]["unit_origin"]) == ("bar", "file")
    assert columns["Muskeldruck"]["unit_where"] == "line 6"
    assert columns["Lfd. Nr."]["unread"] == "it is a running number"
    assert body["unread"] == [{"column": "Lfd. Nr.", "why": "it is a running number"}]
    assert {
        "key": "nominal_length",
        "value": 0.25,
        "origin": "file",
        "where": "hubversuch.csv, line 2",
    } in body["stated"]
    mapping = '{"rest_length": "260 mm"}'
    query = {"name": file.name, "mapping": mapping}
    body = client.post("/api/measurements/preview", params=query, content=file.data).json()
    assert {"key": "nominal_length", "value": 0.26, "origin": "you", "where": ""} in body["stated"]


@pytest.mark.parametrize(
    ("mapping", "field"),
    [
        ('{"head": "3"}', "mapping.head"),
        ('{"sheet": 3}', "mapping.sheet"),
        ('{"column": "force=F"}', "mapping.column"),
        ('{"column": ["force"]}', "mapping.column"),
        ('{"ignore": [3]}', "mapping.ignore"),
        ('{"rest_length": "3 bar"}', "mapping.rest_length"),
        ('{"load": []}', "mapping.load"),
        ('{"strict": 1}', "mapping.strict"),
        ('{"columns": {"F": {"channel": "force", "sign": 2}}}', "mapping.columns.F.sign"),
    ],
)
def test_a_bad_answer_names_its_key(client: TestClient, mapping: str, field: str) -> None:
    file = three_heads()
    query = {"name": file.name, "mapping": mapping}
    error = assert_error(client.post("/api/measurements/preview", params=query, content=file.data), 422)
    assert error["field"] == field


def test_a_hint_is_in_the_words_of_requests(client: TestClient) -> None:
    """The correction that a refusal names is the field of the mapping, which then reads the file."""
    data = b"time_s,pressure_bar,force_N,force_N\n0,1,2,3\n1,2,3,4\n2,3,4,5\n"
    query = {"name": "twice.csv"}
    refused = assert_error(client.put("/api/measurements", params=query, content=data), 422)
    found = re.search(r"\"column\": \[.*?\]", refused["message"])
    assert found is not None, refused["message"]
    query["mapping"] = f"{{{found[0]}}}"
    assert client.put("/api/measurements", params=query, content=data).status_code == 200
