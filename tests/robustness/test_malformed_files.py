"""Damaged and unusual files through the application: refused with a place, or read right; none is left."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from fastapi.testclient import TestClient
from httpx2 import Response

from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.robustness.files import GOOD, KIND, ROWS, SI
from tests.robustness.variants import Variant, variants

URL = "http://127.0.0.1:8000"
#: A refusal says where: a row, a column by its name, a key, or the part of the file that is damaged.
PLACE = re.compile(
    r"(row|line) \d+|no table|no arrays? of numbers|columns '[^']+' and '[^']+'"
    r"|(column|variable|channel|sheet|struct|group|field) '[^']+'|(variable|segment|byte|sheet) \d+"
    r"|kind '[^']*'|(part|holds) '?[\w/.]+|no (column|variable|channel) can be read: [^:]{12,}"
    r"|no variable is a vector of numbers"
)


@pytest.fixture
def client(tmp_path: Path):
    """A client of an application whose data folder is empty."""
    app = create_app(Settings(data=tmp_path, user_presets=tmp_path / "presets"))
    with TestClient(app, base_url=URL, raise_server_exceptions=False) as client:
        yield client


def put(client: TestClient, name: str, content: bytes):
    return client.put("/api/measurements", params={"name": name}, content=content)


def kept(folder: Path) -> set[Path]:
    return {path for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", GOOD)
def test_every_format_gives_the_same_measurement(client: TestClient, name: str) -> None:
    sent = put(client, name, GOOD[name])
    assert sent.status_code == 200, sent.text
    answer = client.get(f"/api/measurements/{sent.json()['id']}").json()
    assert (answer["kind"], answer["kind_detected"], answer["rows"]) == (KIND, False, ROWS)
    for channel, values in SI.items():
        np.testing.assert_allclose(answer["columns"][channel], values, rtol=1e-12, err_msg=channel)


def test_300_malformed_files(client: TestClient, tmp_path: Path) -> None:
    outcomes: Counter[str] = Counter()
    failures = []
    for number, variant in enumerate(variants()):
        before = kept(tmp_path)
        response = put(client, variant.name, variant.content)
        if response.status_code == 200:
            outcomes["read"] += 1
            wrong = wrong_reading(client, variant, response.json()["id"])
        else:
            outcomes["refused"] += 1
            wrong = wrong_refusal(variant, response)
            wrong += ["left a file behind"] if kept(tmp_path) != before else []
        failures += [f"{number} {variant}: {problem}" for problem in wrong]
    assert not failures, "\n".join(failures)
    assert sum(outcomes.values()) >= 300
    assert outcomes["refused"] > 200
    assert outcomes["read"] > 25


def wrong_refusal(variant: Variant, response: Response) -> list[str]:
    """What is wrong with a refusal: it must be the caller's fault and say where."""
    if not 400 <= response.status_code < 500:
        return [f"status {response.status_code}: {response.text[:300]}"]
    error = response.json()["error"]
    message = error["message"]
    problems = [
        f"does not name {wanted}: {message}" for wanted in variant.names or () if wanted not in message
    ]
    if variant.names is None:
        problems.append(f"must be read: {message}")
    if not error["field"] or variant.name not in message or not PLACE.search(message):
        problems.append(f"names no place: {message} ({error['field']})")
    return problems


def wrong_reading(client: TestClient, variant: Variant, identity: str) -> list[str]:
    """What is wrong with what was read: it must be the good file's values, all of them."""
    if variant.names:
        return ["must be refused"]
    answer = client.get(f"/api/measurements/{identity}").json()
    columns = answer["columns"]
    if "length" not in columns:
        return [f"length is missing, read: {', '.join(columns)}"]
    # The length tells the row; in a damaged directory a column may have lost its name, but no value.
    index = np.argmin(np.abs(SI["length"][:, None] - np.array(columns["length"])[None, :]), axis=0)
    problems = [
        f"other values of {channel}"
        for channel, values in SI.items()
        if channel in columns
        and (channel != "time" or variant.names is None)
        and not np.allclose(columns[channel], values[index], rtol=1e-9, atol=1e-12)
    ]
    if len(set(index)) != len(index) or len(index) != ROWS - variant.left_out:
        problems.append(f"{len(index)} rows")
    if sum(answer["skipped"].values()) != variant.left_out:
        problems.append(f"skipped {answer['skipped']}")
    if variant.names is None and not set(SI) <= set(columns):
        problems.append(f"read only {', '.join(columns)}")
    return problems


@pytest.mark.examination("test_300_malformed_files")
def test_a_preview_of_them_never_fails(client: TestClient, tmp_path: Path) -> None:
    for number, variant in enumerate(variants()):
        response = client.post(
            "/api/measurements/preview", params={"name": variant.name}, content=variant.content
        )
        label = f"variant {number}: {variant}"
        assert response.status_code in (200, 422), f"{label}: {response.text}"
        body = response.json()
        if response.status_code == 200 and variant.names:
            problem = body["problem"]
            assert problem, label
            assert PLACE.search(problem["message"]), label
    assert not kept(tmp_path)
