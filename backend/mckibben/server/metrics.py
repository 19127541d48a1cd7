"""Figures of the server about itself, in the text format of Prometheus. They hold no data of users."""

from __future__ import annotations

import mmap
import time
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

#: The media type of the format.
MEDIA_TYPE = "text/plain; version=0.0.4; charset=utf-8"
_BOUNDS = (0.005, 0.02, 0.1, 0.5, 2.0, 10.0, 60.0)  # s, of the latencies that are told apart
_PAGE = mmap.PAGESIZE

Labels = Mapping[str, str]


@dataclass
class Requests:
    """What was asked and how it was answered; used on the event loop.

    Attributes:
        answers: number by method, route and status.
        latencies: numbers by route, in the classes of `_BOUNDS` and above.
        seconds: sum of the latencies by route [s], without the time in which a body arrived.
        refused: connections by why they were ended.
    """

    answers: Counter[tuple[str, str, int]] = field(default_factory=Counter)
    latencies: dict[str, list[int]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    refused: Counter[str] = field(default_factory=Counter)
    began: float = field(default_factory=time.monotonic)

    def add(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count an answer."""
        self.answers[method, route, status] += 1
        classes = self.latencies.setdefault(route, [0] * (len(_BOUNDS) + 1))
        classes[bisect_left(_BOUNDS, seconds)] += 1
        self.seconds[route] = self.seconds.get(route, 0.0) + seconds

    def families(self) -> Iterator[str]:
        """All of it as text."""
        yield from family(
            "requests_total", "counter", "Answers by method, route and status.",
            (({"method": m, "route": r, "status": str(s)}, n) for (m, r, s), n in self.answers.items()),
        )  # fmt: skip
        yield from family(
            "connections_ended_total", "counter", "Connections that were ended, by why.",
            (({"why": why}, number) for why, number in self.refused.items()),
        )  # fmt: skip
        yield "# HELP mckibben_request_seconds Time until the first byte of an answer.\n"
        yield "# TYPE mckibben_request_seconds histogram\n"
        for route, classes in self.latencies.items():
            below = 0
            for bound, number in zip((*_BOUNDS, "+Inf"), classes, strict=True):
                below += number
                yield _line("request_seconds_bucket", {"route": route, "le": str(bound)}, below)
            yield _line("request_seconds_sum", {"route": route}, self.seconds[route])
            yield _line("request_seconds_count", {"route": route}, below)
        yield from family(
            "uptime_seconds", "gauge", "Since the start.", [({}, time.monotonic() - self.began)]
        )


def family(name: str, kind: str, help_text: str, values: Iterable[tuple[Labels, float]]) -> Iterator[str]:
    """The lines of a metric.

    Args:
        name: without ``mckibben_``.
        kind: "counter" or "gauge".
        help_text: what it is.
        values: labels and value of each line.
    """
    yield f"# HELP mckibben_{name} {help_text}\n# TYPE mckibben_{name} {kind}\n"
    for labels, value in values:
        yield _line(name, labels, value)


def _line(name: str, labels: Labels, value: float) -> str:
    inside = ",".join(f'{key}="{_escaped(text)}"' for key, text in labels.items())
    return f"mckibben_{name}{'{' + inside + '}' if inside else ''} {value:.10g}\n"


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")


def memory_of(pid: int) -> int | None:
    """What a process has in memory at the moment [bytes]; None where this system does not tell."""
    with suppress(OSError, ValueError, IndexError):
        return _PAGE * int(Path(f"/proc/{pid}/statm").read_text("ascii").split()[1])
    return None


def open_descriptors() -> int | None:
    """Files and connections that this process has open; None where this system does not tell."""
    with suppress(OSError):
        return len(list(Path("/proc/self/fd").iterdir()))
    return None
