"""Load on a real server: requests one by one, clients at a steady pace, a watch on health and memory.

As a program, ``python -m tests.robustness.load URL PID CLIENTS``, it is the clients and the watch until its
standard input ends, and then writes what they found: who attacks the server does not slow them down.
"""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import itertools
import json
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from tests.running_server import AUTHORIZED

CURVES = {"muscle": {"preset": "DMSP-20"}, "pressures": ["2 bar", "4 bar"], "points": 50}
DIAGNOSIS = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "measurement": "martens-dmsp-20-300",
}
_asked = itertools.count()


def diagnosis() -> dict[str, Any]:
    """A diagnosis that was not asked before: a finished one is answered from what is kept."""
    muscle = {"preset": "DMSP-20", "nominal_length": f"{300.0 + 1e-6 * next(_asked):.6f} mm"}
    return DIAGNOSIS | {"muscle": muscle}


_ROUND = 5.0  # s; how often clients apart look whether to go on
_LAST_WORDS = 120.0  # s


class Server(Protocol):
    """A server that runs."""

    url: str

    @property
    def pid(self) -> int: ...


class Said(NamedTuple):
    """Status (0 = no answer), body and time of an answer [s]."""

    status: int
    body: bytes
    seconds: float


def ask(
    server: Server,
    method: str,
    path: str,
    body: Any = None,
    *,
    within: float = 120.0,
    events: bool = False,
) -> Said:
    """Send a request of its own connection; an object is sent as JSON, bytes as a file."""
    content = body if body is None or isinstance(body, bytes) else json.dumps(body).encode()
    headers = AUTHORIZED | {"content-type": "text/csv" if isinstance(body, bytes) else "application/json"}
    if events:
        headers["accept"] = "text/event-stream"
    begin = time.perf_counter()
    connection = http.client.HTTPConnection(server.url.removeprefix("http://"), timeout=within)
    try:
        connection.request(method, path, content, headers)
        answer = connection.getresponse()
        return Said(answer.status, answer.read(), time.perf_counter() - begin)
    except (OSError, http.client.HTTPException):
        return Said(0, b"", time.perf_counter() - begin)
    finally:
        connection.close()


def share(values: list[float], part: float) -> float:
    """The value that this share of the values does not exceed; 0 of none."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))] if ordered else 0.0


@dataclass
class Pace:
    """What clients at a steady pace found: times of the answers [s], and requests without a good one."""

    seconds: list[float] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)

    def line(self) -> str:
        """Number, median, 99 %, longest, failed."""
        middle = statistics.median(self.seconds) if self.seconds else 0.0
        return (
            f"{len(self.seconds):6d} {1e3 * middle:9.1f} {1e3 * share(self.seconds, 0.99):9.1f} "
            f"{1e3 * max(self.seconds, default=0.0):9.1f} {len(self.failed):7d}"
        )


async def _client(port: int, request: bytes, delay: float, end: float, every: float, pace: Pace) -> None:
    await asyncio.sleep(delay)
    streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] | None = None
    while time.perf_counter() < end:
        begin = time.perf_counter()
        for kept in (True, False):  # a kept connection may have been closed, as a browser knows
            try:
                if streams is None:
                    streams = await asyncio.open_connection("127.0.0.1", port)
                    kept = False
                reader, writer = streams
                writer.write(request)
                head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), 30)
                length = int(head.lower().partition(b"content-length: ")[2].split(b"\r\n")[0])
                await reader.readexactly(length)
            except (OSError, asyncio.IncompleteReadError, TimeoutError) as error:
                streams = None
                if not kept:
                    pace.failed.append(type(error).__name__)
                    break
                continue
            if head.startswith(b"HTTP/1.1 200 "):
                pace.seconds.append(time.perf_counter() - begin)
            else:
                pace.failed.append(head.split(b"\r\n")[0].decode())
            break
        await asyncio.sleep(max(0.0, every - (time.perf_counter() - begin)))
    if streams is not None:
        streams[1].close()
        with contextlib.suppress(OSError):
            await streams[1].wait_closed()


def clients(server: Server, number: int, seconds: float, every: float = 1.0) -> Pace:
    """So many clients, each with one request for curves at a time at this pace [s]."""
    body = json.dumps(CURVES).encode()
    port = int(server.url.rpartition(":")[2])
    request = (
        f"POST /api/curves HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\ncontent-type: application/json\r\n"
        f"authorization: {AUTHORIZED['authorization']}\r\ncontent-length: {len(body)}\r\n\r\n"
    ).encode() + body
    pace = Pace()

    async def run() -> None:
        end = time.perf_counter() + seconds
        each = (_client(port, request, every * i / number, end, every, pace) for i in range(number))
        await asyncio.gather(*each)

    asyncio.run(run())
    return pace


def metrics(server: Server) -> dict[str, float]:
    """What a server says of itself: name with labels -> value."""
    lines = ask(server, "GET", "/metrics").body.decode().splitlines()
    return {
        name: float(value) for name, _, value in (line.rpartition(" ") for line in lines if line[0] != "#")
    }


def descriptors(server: Server) -> int:
    """Files and connections that the server itself has open; 0 where /proc does not tell."""
    with contextlib.suppress(OSError):
        return len(list(Path(f"/proc/{server.pid}/fd").iterdir()))
    return 0


def processes(server: Server) -> dict[int, int]:
    """The processes of a server with what each has in memory [bytes]; those of Linux alone."""
    parents: dict[int, tuple[int, int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError, IndexError, ValueError):
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
                parents[int(entry.name)] = int(fields[1]), 4096 * int(fields[21])
    found = {server.pid}
    while more := {pid for pid, (parent, _) in parents.items() if parent in found} - found:
        found |= more
    return {pid: parents[pid][1] for pid in found if pid in parents}


def workers_of(server: Server) -> list[int]:
    """Process ids of the workers: children of the fork server, not the readers that they fork themselves."""
    parents = {}
    for pid in processes(server):
        with contextlib.suppress(OSError):
            parents[pid] = int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    direct = {pid for pid, parent in parents.items() if parent == server.pid}
    return [pid for pid, parent in parents.items() if parent in direct]


@dataclass
class Watched:
    """Health and memory of a server over a time.

    Attributes:
        health: times of the answers [s].
        unhealthy: what came instead of an answer.
        largest: most that one process had in memory [bytes].
        own: most that the server itself had [bytes].
        descriptors: most that it had open.
    """

    health: list[float] = field(default_factory=list)
    unhealthy: list[int] = field(default_factory=list)
    largest: int = 0
    own: int = 0
    descriptors: int = 0


@contextmanager
def watched(server: Server, every: float = 0.25) -> Iterator[Watched]:
    """Ask for the health of a server all the while, and look at its memory."""
    found, over = Watched(), threading.Event()

    def look() -> None:
        while not over.wait(every):
            said = ask(server, "GET", "/api/health", within=30.0)
            (found.health.append(said.seconds) if said.status == 200 else found.unhealthy.append(said.status))
            memory = processes(server)
            found.own = max(found.own, memory.get(server.pid, 0))
            found.descriptors = max(found.descriptors, descriptors(server))
            found.largest = max(found.largest, *memory.values(), 0)

    thread = threading.Thread(target=look)
    thread.start()
    try:
        yield found
    finally:
        over.set()
        thread.join()


@dataclass(frozen=True)
class _Elsewhere:
    url: str
    pid: int


@dataclass
class Apart:
    """What clients and a watch in a process of their own found."""

    curves: Pace = field(default_factory=Pace)
    watch: Watched = field(default_factory=Watched)


@contextmanager
def clients_apart(server: Server, number: int) -> Iterator[Apart]:
    """So many clients and a watch all the while, in a process of their own; known at the end."""
    found = Apart()
    command = [sys.executable, "-m", "tests.robustness.load", server.url, str(server.pid), str(number)]
    with subprocess.Popen(
        command, cwd=Path(__file__).parents[2], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        try:
            yield found
            said, _ = process.communicate(timeout=_LAST_WORDS)
        finally:
            process.kill()
    told = json.loads(said)
    found.curves, found.watch = Pace(**told["curves"]), Watched(**told["watch"])


def main(url: str, pid: int, number: int) -> None:
    """Be the clients until standard input ends."""
    server, found, over = _Elsewhere(url, pid), Apart(), threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
    with watched(server) as found.watch:
        while not over.is_set():
            pace = clients(server, number, _ROUND)
            found.curves.seconds += pace.seconds
            found.curves.failed += pace.failed
    sys.stdout.write(json.dumps(asdict(found)))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
