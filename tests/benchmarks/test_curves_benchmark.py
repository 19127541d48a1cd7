"""How long the server takes for the curves behind one redrawn Design view.

Skipped in normal runs. One command measures:

    python -m pytest tests/benchmarks --benchmark-only

It asks the real server. The time that counts is the server's own (``Server-Timing``): from the arrival of the
request to the first byte of the answer, reading, checking and writing JSON included. 6 pressures, 200 points,
5 quantities.
"""

from __future__ import annotations

import json
import statistics
from collections.abc import Callable, Iterator
from http.client import HTTPConnection
from urllib.parse import urlsplit

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from tests.running_server import AUTHORIZED, RunningServer

MEDIAN_LIMIT_MS = 1.0
REQUESTS = {
    "preset": {"muscle": {"preset": "DMSP-20"}, "points": 200},
    "texts with units": {
        "muscle": {"preset": "DMSP-20", "nominal_length": "310 mm"},
        "pressures": [f"{bar} bar" for bar in range(1, 7)],
        "points": 200,
    },
    "with load line": {"muscle": {"preset": "DMSP-20"}, "load": "500 N", "fixed_length": "280 mm"},
}


@pytest.fixture
def connection(server: RunningServer) -> Iterator[HTTPConnection]:
    """A connection that stays open, as a browser's does."""
    opened = HTTPConnection(urlsplit(server.url).netloc)
    yield opened
    opened.close()


@pytest.mark.parametrize("name", REQUESTS)
def test_server_time_of_curves(
    benchmark: BenchmarkFixture, connection: HTTPConnection, announce: Callable[[str], None], name: str
) -> None:
    body = json.dumps(REQUESTS[name])
    times: list[float] = []

    def ask() -> bytes:
        connection.request("POST", "/api/curves", body, {"content-type": "application/json", **AUTHORIZED})
        response = connection.getresponse()
        times.append(float(str(response.headers["server-timing"]).partition("dur=")[2]))
        return response.read()

    answer = json.loads(benchmark.pedantic(ask, rounds=1000, warmup_rounds=50))
    assert (len(answer["force"]), len(answer["force"][0])) == (6, 200)
    times = sorted(times[50:])
    median, p95 = statistics.median(times), times[int(0.95 * len(times))]
    benchmark.extra_info.update(server_median_ms=round(median, 3), server_p95_ms=round(p95, 3))
    announce(f"{name}: server time median {median:.2f} ms, p95 {p95:.2f} ms")
    if name == "preset":
        assert median <= MEDIAN_LIMIT_MS, f"median {median:.3f} ms, p95 {p95:.3f} ms"
