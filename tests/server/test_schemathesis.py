"""Generated requests over the whole OpenAPI document: no 5xx, and every answer is the one declared.

The seed is fixed: the same requests every run. What the document forbids must be refused; the reverse, that
what it allows is accepted, does not hold for texts with units, whose grammar no JSON schema can say.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import pytest
import schemathesis
from fastapi import FastAPI
from hypothesis import HealthCheck, Phase, given, seed, settings
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    negative_data_rejection,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.server.test_openapi import PATHS

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
    response_headers_conformance,
    negative_data_rejection,
]
OPERATIONS = [(method, path) for path, methods in PATHS.items() for method in sorted(methods)]
# Without parameters and body nothing can be sent wrong, and any bytes may be a file.
INFALLIBLE = [
    *(
        ("get", path)
        for path in (
            "/api/health",
            "/api/figures",
            "/api/units",
            "/api/effects",
            "/api/exports",
            "/api/kept",
            "/api/mysteries",
        )
    ),
    ("post", "/api/projects/import"),
]
FALLIBLE = [operation for operation in OPERATIONS if operation not in INFALLIBLE]
MODELS = ["/api/curves", "/api/inverse", "/api/comparisons"]
EXAMPLES = int(os.environ.get("MCKIBBEN_REQUESTS", "3"))  # of each operation; tests.benchmarks.requests: 500
HOST = {"host": "127.0.0.1"}
PATIENCE = 120.0  # s; schemathesis would wait 10 s, and a generated diagnosis takes that on a busy machine


@pytest.fixture(scope="module")
def described(tmp_path_factory: pytest.TempPathFactory) -> schemathesis.BaseSchema:
    """The schema of an application with folders of its own."""
    folder = tmp_path_factory.mktemp("schemathesis")
    app: FastAPI = create_app(Settings(data=folder / "data", user_presets=folder / "presets"))
    return schemathesis.openapi.from_asgi("/openapi.json", app, headers=HOST)


Change = Callable[[schemathesis.Case], None]


def examine(operation: schemathesis.APIOperation, mode: GenerationMode, change: Change | None = None) -> None:
    """Send generated requests, changed first if asked, and check every answer."""

    @seed(20261121)
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        database=None,
        phases=[Phase.explicit, Phase.generate],
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
    )
    @given(case=operation.as_strategy(generation_mode=mode))
    def check(case: schemathesis.Case) -> None:
        if change is not None:
            change(case)
        case.validate_response(case.call(headers=HOST, timeout=PATIENCE), checks=CHECKS)

    check()


@pytest.mark.parametrize(("method", "path"), OPERATIONS)
def test_what_the_document_allows_gets_a_declared_answer(
    described: schemathesis.BaseSchema, method: str, path: str
) -> None:
    examine(described[path][method], GenerationMode.POSITIVE)


@pytest.mark.parametrize(("method", "path"), FALLIBLE)
def test_what_the_document_forbids_is_refused(
    described: schemathesis.BaseSchema, method: str, path: str
) -> None:
    examine(described[path][method], GenerationMode.NEGATIVE)


@pytest.mark.parametrize("path", MODELS)
def test_any_conditions_of_a_real_muscle_get_a_declared_answer(
    described: schemathesis.BaseSchema, path: str
) -> None:
    # Generated muscles hardly ever exist, so the physics behind would stay untested.
    def use_a_real_muscle(case: schemathesis.Case) -> None:
        body: dict[str, Any] = case.body if isinstance(case.body, dict) else {}
        # Nor do generated texts with a unit: the numbers among the values remain.
        body = {
            name: value for name, value in body.items() if name == "question" or not isinstance(value, str)
        }
        if isinstance(body.get("pressures"), list):
            body["pressures"] = [value for value in body["pressures"] if isinstance(value, int | float)] or [
                1e5
            ]
        body["muscle"] = {"preset": "DMSP-20"}
        body.pop("effects", None)
        if path == "/api/comparisons":
            body["measurement"] = "martens-dmsp-20-300"
        case.body = body

    examine(described[path]["post"], GenerationMode.POSITIVE, use_a_real_muscle)
