"""Figures of the server about itself."""

from __future__ import annotations

import re
import sys

from fastapi.testclient import TestClient

from tests.server.conftest import CSV

LINE = re.compile(r'mckibben_[a-z_]+(\{([a-z]+="[^"]*",?)+\})? [0-9.e+-]+')


def test_they_are_prometheus_text_without_data(client: TestClient) -> None:
    client.put("/api/measurements?name=secret-name.csv", content=CSV)
    client.get("/api/measurements/" + "f" * 64)
    client.get("/api/nothing-of-this-name")
    client.get("/nothing-of-this-name")
    answer = client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=0.0.4")
    for line in answer.text.splitlines():
        assert line.startswith(("# HELP mckibben_", "# TYPE mckibben_")) or LINE.fullmatch(line), line
    figures = dict(line.rsplit(" ", 1) for line in answer.text.splitlines() if not line.startswith("#"))
    route = "/api/measurements/{measurement_id}"
    assert figures[f'mckibben_requests_total{{method="GET",route="{route}",status="404"}}'] == "1"
    assert figures['mckibben_requests_total{method="GET",route="page",status="404"}'] == "1"
    assert figures['mckibben_request_seconds_bucket{route="/api/measurements",le="+Inf"}'] == "1"
    assert float(figures['mckibben_space_bytes{kind="measurements",what="taken"}']) > len(CSV)
    assert figures['mckibben_in_flight_bytes{what="files"}'] == "0"
    assert not re.search("secret|nothing-of|fffffff", answer.text)
    if sys.platform == "linux":
        assert float(figures["mckibben_memory_bytes"]) > 1e7
