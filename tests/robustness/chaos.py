"""Everything at once against one server: hostile files and formulas, half requests, killed workers, load."""

from __future__ import annotations

import contextlib
import gzip
import itertools
import json
import os
import random
import signal
import socket
import threading
import time
import zlib
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from typing import Any

from tests.robustness.hostile import MATLAB, hostile
from tests.robustness.load import (
    CURVES,
    DIAGNOSIS,
    Pace,
    Watched,
    ask,
    clients_apart,
    diagnosis,
    metrics,
    processes,
    workers_of,
)
from tests.robustness.variants import variants
from tests.running_server import RunningServer

#: What a server may answer: never a 5xx, never nothing. A worker that is killed costs a 422 of its own job.
ALLOWED = {200, 400, 404, 409, 413, 415, 422, 429, 507}
HALVES = (
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n",
    b"POST /api/curves HTTP/1.1\r\nHost: 127.0.0.1\r\ncontent-type: application/json\r\n"
    b"content-length: 99\r\n\r\n{",
    b"",
)
FORMULAS = (
    "abs(" * 18 + "c*v+P" + ")" * 18,
    "abs(" * 24 + "c*v" + ")" * 24,
    "(P+kappa+L+v+c)**60",
    "c" + "*(P+v+c)" * 60,
    "*".join(f"(P+c{i})" for i in range(60)),
    "exp(" * 30 + "c*P" + ")" * 30,
    "c" + "**9" * 80,
    "c**" + "(" * 30 + "P" + "**2)" * 30,
    "sin(" * 35 + "c*t*v" + ")" * 35,
    "+".join(f"tanh(c{i}*v*P)" for i in range(35)),
    "c*1e308*1e308*P",
    "c/(v-v)",
    "__import__('os')",
    "(" * 240 + "c" + ")" * 240,
    "\x00c*v",
)
SIMULATED = {"supply": {"pressure": "6 bar"}, "load": {"mass": "5 kg"}, "duration": "0.2 s"}


def bombs(megabytes: int) -> dict[str, bytes]:
    """Small files that unpack to so much, in zlib streams of several kinds."""
    empty = bytes(1_000_000)
    packing = zlib.compressobj(9)
    stream = b"".join([*(packing.compress(empty) for _ in range(megabytes)), packing.flush()])
    element = (15).to_bytes(4, "little") + len(stream).to_bytes(4, "little") + stream
    text = gzip.compress(b"1;2;3\n" * (160_000 * megabytes), 1)
    return {"bomb.mat": MATLAB + element, "bomb.csv.gz": text, "twice.csv.gz": gzip.compress(text, 9)}


@dataclass
class Storm:
    """What became of it.

    Attributes:
        answers: of each attack, by status.
        wrong: answers that are not allowed, with what was asked.
        acknowledged: ids of the files that the server said it keeps.
        lost: those that it does not have afterwards.
        killed: workers.
        replaced: workers that the server says were killed and replaced.
        left: processes of the server that live on after its end.
        curves: of the clients.
        watch: health and memory.
        ended: seconds from SIGTERM to the end of the process.
        traceback: whether one was printed.
        lines: that were printed.
    """

    answers: dict[str, Counter[int]] = field(default_factory=dict)
    wrong: list[str] = field(default_factory=list)
    acknowledged: set[str] = field(default_factory=set)
    lost: set[str] = field(default_factory=set)
    killed: int = 0
    replaced: int = 0
    left: int = 0
    curves: Pace = field(default_factory=Pace)
    watch: Watched = field(default_factory=Watched)
    ended: float = 0.0
    traceback: bool = False
    lines: int = 0

    def note(self, attack: str, what: str, status: int, body: bytes = b"") -> None:
        """Note an answer."""
        self.answers.setdefault(attack, Counter())[status] += 1
        if status not in ALLOWED:
            self.wrong.append(f"{attack}, {what}: {status} {body[:200]!r}")


@dataclass(frozen=True)
class Plan:
    """How hard it blows.

    Attributes:
        seconds: that the load lasts at least.
        clients: with one request for curves a second each.
        diagnoses: that run all the while.
        every: one of so many hostile and malformed files is sent.
        halves: half requests.
        megabytes: that a bomb unpacks to.
        kill_every: s between two killed workers.
        formulas: one of so many formulas is sent.
    """

    seconds: float
    clients: int
    diagnoses: int
    every: int
    halves: int
    megabytes: int
    kill_every: float
    formulas: int = 1


def storm(server: RunningServer, plan: Plan) -> Storm:
    """Attack a server with everything; it is ended by SIGTERM in the middle of diagnoses."""
    found, over = Storm(), threading.Event()
    attacks: list[Callable[[], None]] = [
        lambda: _files(server, plan, found),
        lambda: _formulas(server, plan, found),
        lambda: _halves(server, plan, found),
    ]
    background: list[Callable[[], None]] = [
        lambda: _kills(server, plan, found, over),
        *[lambda: _diagnoses(server, found, over)] * plan.diagnoses,
    ]
    with clients_apart(server, plan.clients) as apart:
        running = [_started(work) for work in background]
        attacking = [_started(work) for work in attacks]
        begin = time.monotonic()
        for thread in attacking:
            thread.join()
        over.wait(plan.seconds - (time.monotonic() - begin))
    over.set()
    found.curves, found.watch = apart.curves, apart.watch
    for identity in found.acknowledged:
        if ask(server, "GET", f"/api/measurements/{identity}").status != 200:
            found.lost.add(identity)
    told = metrics(server)
    found.replaced = round(sum(told[name] for name in told if "ended_total{" in name and '"killed"' in name))
    everyone = processes(server)
    begin = time.monotonic()
    server.send_signal(signal.SIGTERM)
    server.wait(30.0)
    found.ended = time.monotonic() - begin
    for thread in running:
        thread.join()
    last = time.monotonic() + 10.0
    while (left := [pid for pid in everyone if os.path.exists(f"/proc/{pid}")]) and time.monotonic() < last:
        time.sleep(0.1)
    found.left = len(left)
    found.traceback = "Traceback" in server.output
    found.lines = len(server.output.splitlines())
    return found


def _started(work: Callable[[], None]) -> threading.Thread:
    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    return thread


def _files(server: RunningServer, plan: Plan, found: Storm) -> None:
    files = [*((file.name, file.content) for file in hostile())]
    files += [(variant.name, variant.content) for variant in variants()]
    chosen = [*bombs(plan.megabytes).items(), *files[:: plan.every]]
    for number, (name, content) in enumerate(chosen):
        said = ask(server, "PUT", f"/api/measurements?name=f{number}", content)
        found.note("hostile files", name, said.status, said.body)
        if said.status == 200:
            found.acknowledged.add(json.loads(said.body)["id"])
        if number % 10 == 0:
            look = ask(server, "POST", f"/api/measurements/preview?name=f{number}", content)
            found.note("previews", name, look.status, look.body)


def _formulas(server: RunningServer, plan: Plan, found: Storm) -> None:
    for term in FORMULAS[:: plan.formulas]:
        effects = {"custom": {"term": term}}
        muscle: dict[str, Any] = {"preset": "DMSP-20", "nominal_length": "300 mm"}
        drive = {"muscle": muscle, "effects": effects, **SIMULATED}
        for path, body in (
            ("/api/curves", CURVES | {"effects": effects}),
            ("/api/inverse", {"question": "pressure", "muscle": muscle, "effects": effects, "force": 500,
                              "contraction": 0.1}),
            ("/api/simulations", {"drive": drive, "points": 11}),
            ("/api/comparisons", DIAGNOSIS | {"effects": effects}),
        ):  # fmt: skip
            said = ask(server, "POST", path, body)
            found.note("formulas", f"{path} {term[:40]}", said.status, said.body)


@contextmanager
def half_requests(server: RunningServer, number: int) -> Iterator[None]:
    """So many connections whose requests never arrive whole."""
    port = int(server.url.rpartition(":")[2])
    with ExitStack() as stack:
        for kind, _ in zip(itertools.cycle(HALVES), range(number), strict=False):
            with contextlib.suppress(OSError):
                held = stack.enter_context(socket.create_connection(("127.0.0.1", port), timeout=5.0))
                held.sendall(kind)
        yield


def _halves(server: RunningServer, plan: Plan, found: Storm) -> None:
    with half_requests(server, plan.halves):
        for _ in range(10):
            found.note("beside half requests", "health", ask(server, "GET", "/api/health").status)
            time.sleep(0.1)


def _kills(server: RunningServer, plan: Plan, found: Storm, over: threading.Event) -> None:
    chance = random.Random(18)
    while not over.wait(plan.kill_every):
        if pids := workers_of(server):
            with contextlib.suppress(ProcessLookupError):
                os.kill(chance.choice(pids), signal.SIGKILL)
                found.killed += 1


def _diagnoses(server: RunningServer, found: Storm, over: threading.Event) -> None:
    while not over.is_set():
        said = ask(server, "POST", "/api/diagnoses", diagnosis(), within=300.0, events=True)
        last = said.body.rpartition(b"event: ")[2].partition(b"\n")[0].strip().decode()
        ended = last in ("done", "error") or said.body.startswith(b'{"error"')
        found.note("diagnoses", f"last event {last!r}", said.status if ended else 0, said.body[-300:])
        over.wait(0.2)
