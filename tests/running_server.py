"""The real server as a subprocess, for tests that speak HTTP to it or open it in a browser."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
import urllib.request
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

TOKEN = "the-token-of-the-servers-of-the-tests"
AUTHORIZED = {"authorization": f"Bearer {TOKEN}"}
READY_WITHIN = 60.0  # s; the first start on a cold machine compiles bytecode of every dependency
STOPS_WITHIN = 10.0  # s
READY = re.compile(r"ready at (http://[\d.]+:\d+)/")  # what it prints, with the port it was given
MAIN = (sys.executable, "-m", "mckibben")


class _WithToken(urllib.request.BaseHandler):
    """Sends the token of the servers of the tests."""

    def http_request(self, request: urllib.request.Request) -> urllib.request.Request:
        request.add_unredirected_header("Authorization", AUTHORIZED["authorization"])
        return request


def opener() -> urllib.request.OpenerDirector:
    """Opens what servers of the tests answer; without proxies, to which some machines send loopback too."""
    return urllib.request.build_opener(urllib.request.ProxyHandler({}), _WithToken())


class ServerError(AssertionError):
    """The server did not become ready, or died; the message holds what it printed."""


class RunningServer:
    """``mckibben serve`` on a free loopback port, with folders of its own; a context manager.

    Args:
        folder: where it keeps measurements, presets and its log; also its working directory, so that nothing
            can depend on the one of the tests.
        command: what to start, without the arguments of ``serve``.
        arguments: further arguments of ``serve``.
        token: that it asks for where the arguments state it.

    Attributes:
        url: ``http://127.0.0.1:<port>``.
        data, presets: the folders given to it as ``--data`` and ``--presets``.
        seconds_to_ready: from process start to the first answer of ``/api/health``.
    """

    def __init__(
        self,
        folder: Path,
        *,
        command: Sequence[str] = MAIN,
        arguments: Sequence[str] = (),
        token: str = TOKEN,
    ) -> None:
        self.data = folder / "data"
        self.presets = folder / "presets"
        self._folder = folder
        self._log = folder / "server.log"
        self._command = command
        self._arguments = arguments
        self._headers = {"authorization": f"Bearer {token}"}
        self.url = ""
        self.seconds_to_ready = 0.0

    def __enter__(self) -> Self:
        self.data.mkdir(parents=True, exist_ok=True)
        self.presets.mkdir(exist_ok=True)
        serve = ["serve", "--port", "0", "--no-open", "--data", self.data, "--presets", self.presets]
        with self._log.open("wb") as log:  # a file: a pipe nobody reads would stop the server when it is full
            self._process = subprocess.Popen(
                [*self._command, *map(str, serve), *self._arguments],
                cwd=self._folder,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONUNBUFFERED": "1", "MCKIBBEN_TOKEN": TOKEN},
            )
        try:
            self._wait_until_ready()
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop()

    @property
    def output(self) -> str:
        """Everything the server has printed so far."""
        return self._log.read_text(encoding="utf-8", errors="replace")

    @property
    def pid(self) -> int:
        """Of the process of the server."""
        return self._process.pid

    def send_signal(self, number: int) -> None:
        """Send a signal to it."""
        self._process.send_signal(number)

    def wait(self, within: float) -> int:
        """Wait for its end; its exit code."""
        return self._process.wait(within)

    def check_alive(self) -> None:
        """Raise `ServerError` with the server's output when its process has ended."""
        code = self._process.poll()
        if code is not None:
            raise ServerError(
                f"the server ended with exit code {code}; it printed:\n{self.output or '(nothing)'}"
            )

    def _wait_until_ready(self) -> None:
        start = time.perf_counter()
        while not (ready := READY.search(self.output)):
            self.check_alive()
            if time.perf_counter() - start > READY_WITHIN:
                raise ServerError(
                    f"the server was not ready after {READY_WITHIN:g} s; it printed:\n{self.output}"
                )
            time.sleep(0.01)
        self.url = ready[1]
        plain = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        request = urllib.request.Request(f"{self.url}/api/health", headers=self._headers)
        with plain.open(request, timeout=READY_WITHIN):
            self.seconds_to_ready = time.perf_counter() - start

    def _stop(self) -> None:
        self._process.terminate()
        try:
            self._process.wait(STOPS_WITHIN)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
