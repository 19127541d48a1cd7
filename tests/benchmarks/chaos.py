"""A server under load and attack: ``python -m tests.benchmarks.chaos [load] [queue] [memory] [held] [away]
[end] [storm] [calm]``.

Load at 1, 10 and 100 clients with and without diagnoses, a transient beside 20 diagnoses, memory over 3000
structures of models and beside files that are held or exported, a database that is away and comes back, the
end under each kind of work, and everything hostile at once, with and without kills. "Threads" is a server
without processes of its own (``--workers 0``), as it was before it had any. All of them take a quarter of an
hour.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import signal
import socket
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import mckibben.server
from tests.robustness.chaos import Plan, storm
from tests.robustness.load import DIAGNOSIS, ask, clients, diagnosis, metrics, processes, watched
from tests.running_server import AUTHORIZED, MAIN, RunningServer

LOAD_SECONDS = 10.0
STRUCTURES = 3000
EACH, PATIENCE = 4, 25.0  # s
FEW_FILES = ("/bin/sh", "-c", 'ulimit -n 256; exec "$@"', "sh", *MAIN)
EXAMPLES = json.loads((Path(mckibben.server.__file__).parent / "request_examples.json").read_text("utf-8"))
TRANSIENT, TASK = EXAMPLES["simulation"], EXAMPLES["task"]
STATIC = b"# kind: static\npressure_bar;length_mm;force_N\n"
TERM = {"custom": {"term": "abs(" * 18 + "c*v+P" + ")" * 18}}
# 13 kills in 240 s
PLAN = Plan(seconds=240, clients=100, diagnoses=20, every=4, halves=300, megabytes=300, kill_every=18.0)


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


@contextmanager
def served(workers: int, *, few: bool = False) -> Iterator[RunningServer]:
    """A server that has warmed up."""
    with (
        tempfile.TemporaryDirectory() as folder,
        RunningServer(
            Path(folder), command=FEW_FILES if few else MAIN, arguments=["--workers", str(workers)]
        ) as server,
    ):
        ask(server, "POST", "/api/diagnoses", DIAGNOSIS | {"noise": 60.0})
        ask(server, "POST", "/api/simulations", TRANSIENT)
        clients(server, 4, 1.0, every=0.1)
        yield server


@contextmanager
def diagnosing(server: RunningServer, number: int) -> Iterator[None]:
    """So many diagnoses all the while."""
    over = threading.Event()

    def again() -> None:
        while not over.is_set():
            ask(server, "POST", "/api/diagnoses", diagnosis(), within=600.0)

    threads = [threading.Thread(target=again, daemon=True) for _ in range(number)]
    for thread in threads:
        thread.start()
    time.sleep(1.0)
    try:
        yield
    finally:
        over.set()


def load() -> None:
    """Curves at a request a second from each client."""
    _say("\nCurves, one request a second from each client: number, median, 99 %, longest [ms], failed")
    for name, workers in (("threads", 0), ("processes", 2)):
        for diagnoses in (0, 2):
            with served(workers) as server, diagnosing(server, diagnoses):
                for number in (1, 10, 100):
                    pace = clients(server, number, LOAD_SECONDS)
                    _say(f"{name:10} {diagnoses} diagnoses {number:4d} clients {pace.line()}")


def queue() -> None:
    """A transient, curves and an upload beside 20 diagnoses."""
    _say(f"\nBeside 20 diagnoses, {EACH} of each: median and longest [ms], answered in {PATIENCE:g} s")
    asked: dict[str, Callable[[RunningServer, int], Any]] = {
        "transient": lambda server, _: ask(server, "POST", "/api/simulations", TRANSIENT, within=PATIENCE),
        "upload": lambda server, number: ask(
            server, "PUT", "/api/measurements?name=a.csv",
            STATIC + b"1;300;9\n1;290;5\n1;280;%d\n" % number, within=PATIENCE,
        ),
        "comparison": lambda server, _: ask(server, "POST", "/api/comparisons", DIAGNOSIS, within=PATIENCE),
    }  # fmt: skip
    for name, workers in (("threads", 0), ("processes", 2)):
        for diagnoses in (0, 20):
            with served(workers) as server, diagnosing(server, diagnoses):
                for what, send in asked.items():
                    said = [send(server, number) for number in range(EACH)]
                    times = [1e3 * one.seconds for one in said]
                    good = sum(one.status == 200 for one in said)
                    _say(
                        f"{name:10} {diagnoses:2d} diagnoses {what:11} {statistics.median(times):9.1f} "
                        f"{max(times):9.1f} {good:3d} of {EACH}"
                    )


def memory() -> None:
    """Curves of as many different models."""
    _say("\nResident memory over structures of models [MB]: server, largest process")
    with served(2) as server:
        effects = [item["id"] for item in json.loads(ask(server, "GET", "/api/effects").body)["effects"]]
        chosen = (some for size in (1, 2, 3) for some in itertools.combinations(effects, size))
        computed = 0
        for some in chosen:
            if computed in (0, 500, 1000, 1500, 2000, 2500, STRUCTURES):
                taken = processes(server)
                _say(f"{computed:5d} {taken[server.pid] / 1e6:8.0f} {max(taken.values()) / 1e6:8.0f}")
            if computed == STRUCTURES:
                return
            body = {"muscle": {"preset": "DMSP-20"}, "pressures": ["2 bar"], "points": 5,
                    "effects": {name: {} for name in some}}  # fmt: skip
            computed += ask(server, "POST", "/api/curves", body).status == 200


HELD, OF = 12, 62_000_000  # unfinished uploads, bytes of each
ROWS = 2_400_000  # of a file of 38 MB


def held() -> None:
    """The server's own memory beside unfinished uploads, and while a project with large files is sent."""
    _say("\nMemory of the server itself [MB]")
    with served(2) as server:

        def own() -> float:
            return metrics(server)["mckibben_memory_bytes"] / 1e6

        _say(f"  at rest                    {own():6.0f}")
        with contextlib.ExitStack() as stack:
            answers = []
            for _ in range(HELD):
                port = int(server.url.rpartition(":")[2])
                line = stack.enter_context(socket.create_connection(("127.0.0.1", port)))
                head = "PUT /api/measurements?name=a HTTP/1.1\r\nhost: 127.0.0.1\r\n"
                head += f"content-length: {OF + 1}\r\n"
                line.sendall(f"{head}authorization: {AUTHORIZED['authorization']}\r\n\r\n".encode())
                line.settimeout(30.0)
                with contextlib.suppress(OSError):
                    line.sendall(bytes(OF))
                line.settimeout(0.5)
                with contextlib.suppress(OSError):
                    answers.append(line.recv(100).split(b"\r\n")[0].decode())
            _say(f"  {HELD} uploads of 62 MB held   {own():6.0f}, refused: {answers}")
        time.sleep(1.0)
        ids = []
        for number in range(4):
            rows = b"".join(b"%d;%.4f;1.25\n" % (number + 1, 280 + row * 1e-5) for row in range(ROWS))
            said = ask(server, "PUT", "/api/measurements?name=large.csv", STATIC + rows, within=600.0)
            ids.append(json.loads(said.body)["id"])
        _say(f"  4 files of {len(rows) / 1e6:.0f} MB uploaded    {own():6.0f}")
        body = {"title": "Large", "document": {"cases": ids}}
        made = json.loads(ask(server, "POST", "/api/projects", body, within=600.0).body)["project"]["id"]
        _say(f"  kept in a project          {own():6.0f}")
        with watched(server, 0.05) as seen:
            packed = ask(server, "GET", f"/api/projects/{made}/file", within=600.0)
        _say(f"  exported, {len(packed.body) / 1e6:.0f} MB           {seen.own / 1e6:6.0f} at most")


def away() -> None:
    """A PostgreSQL that is away: the answer, and the return."""
    from tests.projects.conftest import _as_user, _server_of_its_own

    _say("\nA database that is stopped and started again")
    own = _server_of_its_own()
    address = next(own)
    folder = address.partition("host=")[2]
    control = ["pg_ctl", "-D", f"{folder}/data", "-w"]
    try:
        with (
            tempfile.TemporaryDirectory() as data,
            RunningServer(Path(data), arguments=["--workers", "0", "--projects", address]) as server,
        ):
            ask(server, "POST", "/api/projects", {"title": "Lift", "document": {}})
            _as_user([*control, "-m", "immediate", "stop"])
            for _ in range(3):
                said = ask(server, "GET", "/api/projects")
                _say(f"  stopped: {said.status} in {said.seconds:.2f} s")
            settings = f"-c listen_addresses='' -c unix_socket_directories={folder} -c fsync=off"
            _as_user([*control, "-o", settings, "-l", f"{folder}/log", "start"])
            said = ask(server, "GET", "/api/projects")
            back = len(json.loads(said.body)["projects"])
            _say(f"  started: {said.status} in {said.seconds:.2f} s, {back} project")
    finally:
        next(own, None)


def end() -> None:
    """SIGTERM under each kind of work."""
    _say("\nThe end under work: seconds to the end of the process, last event, traceback")
    slow = STATIC + b"1;280;10\n2;281;20\n" * 2_000_000
    works: dict[str, tuple[str, str, Any]] = {
        "nothing": ("GET", "/api/health", None),
        "diagnosis": ("POST", "/api/diagnoses", DIAGNOSIS),
        "20 diagnoses": ("POST", "/api/diagnoses", DIAGNOSIS),
        "sizing": ("POST", "/api/sizings", TASK),
        "report": ("POST", "/api/reports", DIAGNOSIS | {"diagnose": True}),
        "file": ("PUT", "/api/measurements?name=a.csv", slow),
        "typed term": ("POST", "/api/curves", {"muscle": {"preset": "DMSP-20"}, "effects": TERM}),
        "transient": ("POST", "/api/simulations", TRANSIENT),
    }
    for name, (method, path, body) in works.items():
        for number in (signal.SIGTERM, signal.SIGINT):
            with served(2) as server:
                said: list[bytes] = []

                def work(method: str = method, path: str = path, body: Any = body) -> None:
                    events = path != "/api/reports" and not isinstance(body, bytes)
                    said.append(ask(server, method, path, body, events=events).body)  # noqa: B023 - ends before

                threads = [threading.Thread(target=work) for _ in range(20 if name == "20 diagnoses" else 1)]
                for thread in threads:
                    thread.start()
                time.sleep(1.0)
                begin = time.perf_counter()
                server.send_signal(number)
                server.wait(30.0)
                took = time.perf_counter() - begin
                for thread in threads:
                    thread.join()
                told = sum(
                    b"event: error" in one or b"event: done" in one or b'"error"' in one for one in said
                )
                trace = "TRACEBACK" if "Traceback" in server.output else "none"
                _say(f"{name:13} {number.name:8} {took:5.2f} {told:3d} of {len(said)} {trace}")
                if trace != "none":
                    _say("..." + server.output.partition("Traceback")[2][:3000])


def calm() -> None:
    """The storm without kills: what its clients are compared with."""
    everything(replace(PLAN, kill_every=1e9))


def everything(plan: Plan = PLAN) -> None:
    """The storm, with 256 descriptors."""
    with served(2, few=True) as server:
        begin = time.monotonic()
        found = storm(server, plan)
        took = time.monotonic() - begin
        if found.traceback:
            _say("..." + server.output.partition("Traceback")[2][:3000])
    _say(f"\nEverything at once, {took:.0f} s, 256 descriptors, 2 workers")
    for attack, answers in found.answers.items():
        _say(f"  {attack:22} {dict(sorted(answers.items()))}")
    _say(f"  not allowed            {len(found.wrong)} {found.wrong[:5]}")
    _say(f"  killed, replaced       {found.killed}, {found.replaced}")
    _say(f"  acknowledged, lost     {len(found.acknowledged)}, {len(found.lost)}")
    _say(f"  curves                 {found.curves.line()} {found.curves.failed[:5]}")
    health = found.watch.health
    _say(f"  health                 {len(health)}, longest {max(health):.3f} s, {found.watch.unhealthy}")
    _say(
        f"  largest process        {found.watch.largest / 1e6:.0f} MB, server {found.watch.own / 1e6:.0f} MB"
    )
    _say(f"  descriptors            {found.watch.descriptors}")
    _say(f"  processes left         {found.left}")
    _say(f"  ended in               {found.ended:.2f} s, traceback {found.traceback}, {found.lines} lines")


TABLES: dict[str, Callable[[], None]] = {
    "load": load,
    "queue": queue,
    "memory": memory,
    "held": held,
    "away": away,
    "end": end,
    "storm": everything,
    "calm": calm,
}

if __name__ == "__main__":
    for table in sys.argv[1:] or TABLES:
        TABLES[table]()
