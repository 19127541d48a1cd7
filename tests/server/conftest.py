"""An application with folders of its own, and the assertions that all routes share."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from mckibben.simulation.integrate.lane_buffers import lane_kernels

T = TypeVar("T")
URL = "http://127.0.0.1:8000"
CSV = b"# kind: static\npressure_bar;length_mm;force_N\n" + b"".join(
    f"{p};{length};{100 * p + length / 10:.1f}\n".encode() for p in (1, 2, 3) for length in (280, 290, 300)
)


@pytest.fixture(scope="session", autouse=True)
def _kernel_is_ready() -> None:
    """Nothing is imported in the background while a test runs.

    ``warnings.catch_warnings`` is not safe between threads: what FastAPI silences while it builds a route
    could come out as an error of the test.
    """
    lane_kernels.warm().join()


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Empty folders for data and presets."""
    return Settings(data=tmp_path / "data", user_presets=tmp_path / "presets")


@pytest.fixture
def app(settings: Settings) -> FastAPI:
    """An application of its own."""
    return create_app(settings)


@pytest.fixture
def client(app: FastAPI) -> Iterator[TestClient]:
    """A client on this machine; errors of the application become 500 as they would for a browser."""
    with TestClient(app, base_url=URL, raise_server_exceptions=False) as client:
        yield client


@pytest.fixture(scope="session")
def shared_client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """One client for the whole run, for tests that change nothing on the server."""
    folder = tmp_path_factory.mktemp("api")
    app = create_app(Settings(data=folder / "data", user_presets=folder / "presets"))
    with TestClient(app, base_url=URL, raise_server_exceptions=False) as client:
        yield client


def assert_error(response: Any, status: int, *, code: str | None = None, field: str | None = None) -> dict:
    """The one shape of every error; returns what is inside."""
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/json"
    body = response.json()
    assert list(body) == ["error"]
    error = body["error"]
    assert set(error) == {"code", "message", "field", "hint"}
    assert isinstance(error["code"], str)
    assert error["message"]
    assert "Traceback" not in error["message"]
    if code is not None:
        assert error["code"] == code
    if field is not None:
        assert error["field"] == field
    return error


def post(client: TestClient, path: str, body: object) -> Any:
    """POST a JSON body."""
    return client.post(path, content=json.dumps(body), headers={"content-type": "application/json"})


def run_async(work: Coroutine[Any, Any, T]) -> T:
    """What asynchronous work returns; in a thread, for the browser tests keep a loop running in this one."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, work).result()
