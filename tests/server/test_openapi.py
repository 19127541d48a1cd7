"""The interface's own description is complete."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from tests.server import typescript

PATHS = {
    "/api/health": {"get"},
    "/api/effects": {"get"},
    "/api/figures": {"get"},
    "/api/units": {"get"},
    "/api/presets/{kind}": {"get"},
    "/api/presets/{kind}/{preset_id}": {"get"},
    "/api/presets/muscles": {"post"},
    "/api/presets/muscles/fitted": {"post"},
    "/api/order-codes/{code}": {"get"},
    "/api/asked": {"post"},
    "/api/curves": {"post"},
    "/api/inverse": {"post"},
    "/api/joints": {"post"},
    "/api/measurements": {"put"},
    "/api/measurements/preview": {"post"},
    "/api/measurements/{measurement_id}": {"get"},
    "/api/kept": {"get"},
    "/api/kept/{kind}/{identity}": {"patch", "delete"},
    "/api/kept/{kind}/{identity}/restore": {"post"},
    "/api/kept/space/bin/{kind}": {"delete"},
    "/api/comparisons": {"post"},
    "/api/diagnoses": {"post"},
    "/api/experiments": {"post"},
    "/api/reports": {"post"},
    "/api/exports": {"get", "post"},
    "/api/mysteries": {"get"},
    "/api/mysteries/{mystery_id}/reveal": {"post"},
    "/api/simulations": {"post"},
    "/api/signatures": {"post"},
    "/api/linearisations": {"post"},
    "/api/sizings": {"post"},
    "/api/sizings/reports": {"post"},
    "/api/studies": {"post"},
    "/api/studies/kept": {"post"},
    "/api/studies/options": {"post"},
    "/api/studies/parquet": {"post"},
    "/api/projects": {"get", "post"},
    "/api/projects/import": {"post"},
    "/api/projects/{project_id}": {"get", "put", "patch", "delete"},
    "/api/projects/{project_id}/copies": {"post"},
    "/api/projects/{project_id}/restore": {"post"},
    "/api/projects/{project_id}/history": {"get"},
    "/api/projects/{project_id}/file": {"get"},
}


@pytest.fixture(scope="module")
def document(shared_client: TestClient) -> dict[str, Any]:
    """The document as served."""
    return shared_client.get("/openapi.json").json()


def operations(document: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every operation with its name."""
    for path, item in document["paths"].items():
        for method, operation in item.items():
            yield f"{method} {path}", operation


def test_it_lists_every_path(document: dict[str, Any]) -> None:
    assert {path: set(item) for path, item in document["paths"].items()} == PATHS


def test_operations_are_named_described_and_tagged(document: dict[str, Any]) -> None:
    names = [operation["operationId"] for _, operation in operations(document)]
    assert len(set(names)) == len(names)
    assert all(name.isidentifier() for name in names)
    known = {tag["name"] for tag in document["tags"]}
    for name, operation in operations(document):
        assert operation["description"], name
        assert set(operation["tags"]) <= known, name


def test_every_error_is_declared_in_the_one_shape(document: dict[str, Any]) -> None:
    for name, operation in operations(document):
        for status, response in operation["responses"].items():
            if int(status) >= 400:
                schema = response["content"]["application/json"]["schema"]
                assert schema == {"$ref": "#/components/schemas/ErrorBody"}, f"{name} {status}"
    assert "HTTPValidationError" not in document["components"]["schemas"]


def properties(schema: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The fields of an object schema."""
    yield from schema.get("properties", {}).items()


def test_requests_refuse_unknown_fields_and_say_what_each_field_is(document: dict[str, Any]) -> None:
    for name, schema in document["components"]["schemas"].items():
        if schema.get("type") != "object":
            continue
        assert schema["additionalProperties"] is False, name
        assert schema["description"], name


def test_physical_fields_of_requests_have_units_and_examples(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]
    seen = 0
    for name in ("MuscleInput", "CurvesRequest", "PressureQuestion", "ContractionQuestion", "RhombusInput"):
        for field, schema in properties(schemas[name]):
            parts = [schema, *schema.get("anyOf", []), schema.get("items", {})]
            kinds = {inner.get("type") for part in parts for inner in (part, *part.get("anyOf", []))}
            if {"number", "string"} <= kinds:
                found = [part for part in parts if "unit" in part]
                assert found, f"{name}.{field} has no unit"
                assert found[0]["examples"], f"{name}.{field} has no example"
                seen += 1
    assert seen > 15


def test_figures_of_answers_have_units(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]
    for name in ("CurveLimits", "Characteristics", "GeometrySummary", "OperatingPoint", "PressureBranch"):
        for field, schema in properties(schemas[name]):
            texts = {"flags", "free_contraction_note", "rhombus", "stretched"}
            assert field in texts or "unit" in schema, f"{name}.{field}"


def test_there_is_no_documentation_page_that_loads_scripts_from_elsewhere(shared_client: TestClient) -> None:
    for path in ("/docs", "/redoc"):
        assert shared_client.get(path).status_code == 404


def test_the_document_does_not_depend_on_the_settings(document: dict[str, Any]) -> None:
    assert document == typescript.published()
