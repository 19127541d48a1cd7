"""The OpenAPI document explains itself: every property is described, every example of a body is accepted."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.documents.study import StudyDocument
from mckibben.server.app import create_app
from mckibben.server.schemas.drives import SizingReportRequest
from mckibben.server.schemas.models import DiagnosisRequest
from mckibben.server.settings import Settings
from tests.server.conftest import CSV, URL
from tests.server.typescript import published

# Seconds of search each: their examples are read by their models, and what they hold is asked elsewhere here.
LONG = {
    "/api/diagnoses": DiagnosisRequest,
    "/api/sizings/reports": SizingReportRequest,
    "/api/studies/parquet": StudyDocument,  # needs an extra to answer
}
PARAMETERS = {"mystery_id": "the-dip"}
#: Paths whose POST makes something.
MADE = (
    "/api/presets/muscles",
    "/api/presets/muscles/fitted",
    "/api/projects",
    "/api/projects/{project_id}/copies",
)

Example = tuple[str, str, str, Any]


def bodies(document: dict[str, Any]) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Method, path and media types of every request body."""
    for path, item in document["paths"].items():
        for method, operation in item.items():
            if "requestBody" in operation:
                yield method, path, operation["requestBody"]["content"]


def examples(document: dict[str, Any]) -> Iterator[Example]:
    """Method, path, media type and value of every example."""
    for method, path, content in bodies(document):
        for kind, media in content.items():
            if "example" in media:
                yield method, path, kind, media["example"]
            for named in media.get("examples", {}).values():
                yield method, path, kind, named["value"]


def objects(node: Any, where: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every object schema below a part of the document, with its path."""
    if isinstance(node, dict):
        if node.get("type") == "object" and "properties" in node:
            yield where, node["properties"]
        for key, value in node.items():
            if key not in ("example", "examples"):
                yield from objects(value, f"{where}/{key}")
    elif isinstance(node, list):
        for index, value in enumerate(node):
            yield from objects(value, f"{where}/{index}")


@pytest.fixture(scope="module")
def own_client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A server whose folders these examples may fill."""
    folder = tmp_path_factory.mktemp("examples")
    app = create_app(Settings(data=folder / "data", user_presets=folder / "presets"))
    with TestClient(app, base_url=URL, raise_server_exceptions=False) as client:
        yield client


DOCUMENT = published()
EXAMPLES = list(examples(DOCUMENT))


def test_no_property_lacks_a_description() -> None:
    described = list(objects(DOCUMENT))
    assert len(described) > 150
    silent = [f"{where}.{name}" for where, fields in described for name in fields if not words(fields[name])]
    assert not silent


def words(schema: dict[str, Any]) -> str:
    """The description of a property itself, not of the object it refers to."""
    return schema.get("description", "").strip()


def test_every_body_has_an_example() -> None:
    # A ZIP archive cannot stand in the document.
    shown = {(method, path) for method, path, _, _ in EXAMPLES} | {("post", "/api/projects/import")}
    assert shown == {(method, path) for method, path, _ in bodies(DOCUMENT)}


def test_every_form_of_a_question_has_an_example() -> None:
    schemas = DOCUMENT["components"]["schemas"]
    forms = {
        schemas[part["$ref"].rpartition("/")[2]]["properties"]["question"]["const"]
        for part in DOCUMENT["paths"]["/api/inverse"]["post"]["requestBody"]["content"]["application/json"][
            "schema"
        ]["oneOf"]
    }
    assert forms == {value["question"] for _, path, _, value in EXAMPLES if path == "/api/inverse"}


@pytest.mark.parametrize(
    ("method", "path", "kind", "value"),
    [example for example in EXAMPLES if example[1] not in LONG],
    ids=lambda value: value if isinstance(value, str) and len(value) < 40 else "",
)
def test_the_server_accepts_it(
    own_client: TestClient, method: str, path: str, kind: str, value: object
) -> None:
    parameters = PARAMETERS
    if "{project_id}" in path:
        made = own_client.post("/api/projects", json={"title": "Lift", "document": {}}).json()
        parameters = PARAMETERS | {"project_id": made["project"]["id"]}
    if path == "/api/kept/{kind}/{identity}":
        kept = own_client.put("/api/measurements", params={"name": "a.csv"}, content=CSV).json()["id"]
        parameters = {"kind": "files", "identity": kept}
    answer = own_client.request(
        method,
        path.format_map(parameters),
        params={"name": "example.csv"} if isinstance(value, str) else None,
        content=value if isinstance(value, str) else json.dumps(value),
        headers={"content-type": kind},
    )
    assert answer.status_code == (201 if path in MADE else 200), answer.text
    if path == "/api/sizings":
        assert answer.json()["proposals"], "the task of the example cannot be fulfilled"
    if path == "/api/measurements/preview":
        assert answer.json()["problem"] is None


@pytest.mark.parametrize(("path", "model"), list(LONG.items()), ids=list(LONG))
def test_the_long_ones_are_well_formed(path: str, model: type[Any]) -> None:
    shown = [value for _, its_path, _, value in EXAMPLES if its_path == path]
    assert shown
    for value in shown:
        model.model_validate(value)


def test_the_example_of_a_diagnosis_leaves_no_question_open(own_client: TestClient) -> None:
    value = next(value for _, path, _, value in EXAMPLES if path == "/api/diagnoses")
    answer = own_client.post("/api/experiments", json=value)
    assert answer.status_code == 200, answer.text
    assert answer.json()["problem"] is None
