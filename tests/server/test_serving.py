"""Limits on connections, log, fixed token: the real server with 256 descriptors, and the guard alone."""

from __future__ import annotations

import asyncio
import json
import logging
import socket
import sys
import urllib.error
import urllib.request
from collections.abc import Awaitable, Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest
import uvicorn

from mckibben.server.app import TimingMiddleware
from mckibben.server.serving import GuardedProtocol, JsonLines, Seldom, WithoutToken, connections_for
from tests.running_server import MAIN, RunningServer
from tests.server.conftest import run_async

TOKEN = "a-fixed-token-of-a-test"
HALVES = (
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n",
    b"POST /api/curves HTTP/1.1\r\nHost: 127.0.0.1\r\ncontent-length: 99\r\n\r\n{",
    b"",
)
FEW_FILES = ("/bin/sh", "-c", 'ulimit -n 256; exec "$@"', "sh", *MAIN)
Application = Callable[..., Awaitable[None]]


@pytest.fixture(scope="module")
def guarded_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    if sys.platform == "win32":
        pytest.skip("descriptors are limited by the shell")
    folder = tmp_path_factory.mktemp("serving")
    (folder / "token").write_text(TOKEN + "\n", "utf-8")
    arguments = ["--workers", "0", "--access-log", "--token-file", str(folder / "token")]
    with RunningServer(folder, command=FEW_FILES, arguments=arguments, token=TOKEN) as server:
        yield server


def health(server: RunningServer, **headers: str) -> int:
    request = urllib.request.Request(f"{server.url}/api/health", headers=headers)
    with urllib.request.urlopen(request, timeout=20) as answer:
        return answer.status


def test_half_requests_keep_nobody_from_being_answered(guarded_server: RunningServer) -> None:
    port = int(guarded_server.url.rpartition(":")[2])
    lines = len(guarded_server.output.splitlines())
    with ExitStack() as open_ones:
        for number in range(300):
            held = open_ones.enter_context(socket.create_connection(("127.0.0.1", port)))
            held.sendall(HALVES[number % 3])
            if number % 60 == 59:
                assert health(guarded_server, authorization=f"Bearer {TOKEN}") == 200
        assert health(guarded_server, authorization=f"Bearer {TOKEN}") == 200
    guarded_server.check_alive()
    # Two thirds have no whole headers and no line; what is left are the others, and little else.
    assert len(guarded_server.output.splitlines()) - lines < 130
    assert "Traceback" not in guarded_server.output


def test_the_token_of_a_file_is_asked_for_and_never_written(guarded_server: RunningServer) -> None:
    with pytest.raises(urllib.error.HTTPError) as refused:
        health(guarded_server)
    assert refused.value.code == 401
    refused.value.close()
    opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
    with opener.open(f"{guarded_server.url}/api/health?token={TOKEN}", timeout=20) as answer:
        assert json.load(answer)["status"] == "ok"
    requests = [line for line in guarded_server.output.splitlines() if '"GET ' in line]
    assert any("token=..." in line for line in requests)
    assert not any(TOKEN in line for line in requests)


def asked(application: Application, use: Callable[[int], Awaitable[Any]], **limits: float) -> Any:
    """What a client makes of an application behind the guard with these limits."""

    async def run() -> Any:
        protocol = type("Protocol", (GuardedProtocol,), limits)
        listening = socket.create_server(("127.0.0.1", 0))
        config = uvicorn.Config(application, http=protocol, ws="none", lifespan="off", log_config=None)
        server = uvicorn.Server(config)
        serving = asyncio.ensure_future(server.serve(sockets=[listening]))
        try:
            return await asyncio.wait_for(use(listening.getsockname()[1]), 20)
        finally:
            server.should_exit = True
            await serving
            listening.close()

    return run_async(run())


async def says_ok(scope: Any, receive: Any, send: Any) -> None:
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
    await send({"type": "http.response.body", "body": b"ok"})


@pytest.mark.parametrize("half", HALVES)
def test_a_request_that_does_not_arrive_is_ended(half: bytes) -> None:
    async def wait_for_the_end(port: int) -> bytes:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(half)
        said = await reader.read()
        writer.close()
        await writer.wait_closed()
        return said

    assert asked(says_ok, wait_for_the_end, headers_within=0.1, body_within=0.1).startswith(b"HTTP/1.1 408 ")


def test_a_slow_body_that_goes_on_is_taken() -> None:
    async def drip(port: int) -> bytes:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(b"POST / HTTP/1.1\r\nhost: a\r\nconnection: close\r\ncontent-length: 8\r\n\r\n")
        for _ in range(8):  # together longer than a piece may take
            await asyncio.sleep(0.1)
            writer.write(b"x")
        said = await reader.read()
        writer.close()
        await writer.wait_closed()
        return said

    assert asked(says_ok, drip, headers_within=0.4, body_within=0.5).startswith(b"HTTP/1.1 200 ")


def test_with_every_connection_at_work_the_next_is_refused() -> None:
    goes_on: list[asyncio.Event] = []

    async def works(scope: Any, receive: Any, send: Any) -> None:
        goes_on.append(asyncio.Event())
        await goes_on[-1].wait()
        await says_ok(scope, receive, send)

    async def three(port: int) -> list[bytes]:
        connections = []
        for number in range(3):
            connections.append(await asyncio.open_connection("127.0.0.1", port))
            connections[-1][1].write(b"GET / HTTP/1.1\r\nhost: a\r\nconnection: close\r\n\r\n")
            while len(goes_on) < min(number + 1, 2):
                await asyncio.sleep(0.01)
        refused = await connections[2][0].read()
        for event in goes_on:
            event.set()
        said = [*[await reader.read() for reader, _ in connections[:2]], refused]
        for _, writer in connections:
            writer.close()
            await writer.wait_closed()
        return said

    said = asked(works, three, most=2)
    assert [answer[:13] for answer in said] == [b"HTTP/1.1 200 ", b"HTTP/1.1 200 ", b"HTTP/1.1 503 "]


def test_half_of_the_descriptors_is_left_for_files_and_workers() -> None:
    assert connections_for(256) == 128
    assert connections_for(20) == 16
    assert connections_for(100_000) == 1000


def test_a_message_that_repeats_is_written_a_few_times() -> None:
    seldom = Seldom(most=3, seconds=60.0)

    def record(text: str) -> logging.LogRecord:
        return logging.LogRecord("asyncio", logging.ERROR, "", 0, text, (), None)

    assert sum(seldom.filter(record(f"socket {number} failed")) for number in range(1000)) == 3
    assert seldom.filter(record("something else"))


def test_after_a_while_it_says_how_many_were_left_out() -> None:
    seldom = Seldom(most=2, seconds=0.0)
    seldom._seen["a 40 again"] = (-1.0, 12)
    late = logging.LogRecord("a", logging.ERROR, "", 0, "again", (), None)
    assert seldom.filter(late)
    assert late.getMessage() == "again (and 10 more like it before)"


def test_the_token_in_a_query_is_left_out() -> None:
    arguments = ("127.0.0.1:1", "GET", "/?a=1&token=secret&b=2", "1.1", 303)
    line = logging.LogRecord(
        "uvicorn.access", logging.INFO, "", 0, '%s - "%s %s HTTP/%s" %d', arguments, None
    )
    assert WithoutToken().filter(line)
    assert line.getMessage() == '127.0.0.1:1 - "GET /?a=1&token=...&b=2 HTTP/1.1" 303'


async def exchanged(port: int, sent: bytes) -> bytes:
    """All that is answered to these bytes on a connection."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(sent)
    said = await reader.read()
    writer.close()
    await writer.wait_closed()
    return said


async def is_cancelled(scope: Any, receive: Any, send: Any) -> None:
    raise asyncio.CancelledError


@pytest.mark.parametrize(
    ("sent", "status", "code"),
    [
        (b"\x16\x03\x01 nonsense\r\n\r\n", b"400", "bad_request"),
        (b"GET / HTTP/1.1\r\nhost: a\r\nconnection: close\r\n\r\n", b"503", "unavailable"),
    ],
)
def test_errors_have_one_form_without_exception(sent: bytes, status: bytes, code: str) -> None:
    """What is no HTTP, and a request that the end of the server cancels, were answered in plain text."""
    said = asked(TimingMiddleware(is_cancelled), lambda port: exchanged(port, sent))
    head, _, body = said.partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 " + status)
    assert json.loads(body)["error"]["code"] == code


def test_a_body_slower_than_the_least_rate_is_ended() -> None:
    """One byte every 19 s kept 62 MB in memory for as long as anybody liked."""

    async def drip(port: int) -> bytes:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(b"POST / HTTP/1.1\r\nhost: a\r\ncontent-length: 9000\r\n\r\n")
        said = asyncio.ensure_future(reader.read())
        while not said.done():
            writer.write(b"x")
            await asyncio.sleep(0.05)
        writer.close()
        return said.result()

    said = asked(says_ok, drip, body_within=5.0, slow_within=0.2, least_rate=1e4)
    assert said.startswith(b"HTTP/1.1 408 ")


def test_lines_of_json_hold_no_query() -> None:
    arguments = ("127.0.0.1:1", "PUT", "/api/measurements?name=secret.csv&token=secret", "1.1", 200)
    asked = logging.LogRecord("uvicorn.access", logging.INFO, "", 0, "%s", arguments, None)
    told = logging.LogRecord("mckibben.server", logging.ERROR, "", 0, "a worker was %s", ("killed",), None)
    lines = [json.loads(JsonLines().format(record)) for record in (asked, told)]
    assert lines[0].items() >= {"method": "PUT", "path": "/api/measurements", "status": 200}.items()
    assert "secret" not in json.dumps(lines[0])
    assert (lines[1]["level"], lines[1]["message"]) == ("error", "a worker was killed")
