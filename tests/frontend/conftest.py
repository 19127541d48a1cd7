"""Fixtures of the browser tests: Chromium, the real server, and a guard over what the pages do.

A test takes pytest-playwright's ``page`` (or ``context``, ``new_context``). Every page made that way is guarded:
an error or warning on the console, an uncaught error, a request that leaves the server's origin or an answer
5xx fails the test that caused it. Where a console message is meant, the test says so:
``page_guard.allow("status of 422")``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import BrowserContext, ConsoleMessage, Request, Response, WebError

from tests.frontend.browser import ARGUMENTS, NoBrowser, find_or_get
from tests.server import RunningServer

# Schemes that never reach the network.
LOCAL_SCHEMES = ("data:", "blob:", "about:")


class PageGuard:
    """Collects what the pages of one test must not do."""

    def __init__(self, origin: str) -> None:
        self._origin = origin
        self._allowed: list[str] = []
        self._complaints: list[str] = []

    def allow(self, pattern: str) -> None:
        """Let console messages pass that match this regular expression, until the end of the test."""
        self._allowed.append(pattern)

    def watch(self, context: BrowserContext) -> None:
        """Listen to every page this context has or opens."""
        context.on("console", self._on_console)
        context.on("weberror", self._on_error)
        context.on("request", self._on_request)
        context.on("response", self._on_response)

    def check(self) -> None:
        """Fail when anything was collected that the test did not allow."""
        if self._complaints:
            pytest.fail("\n".join(self._complaints), pytrace=False)

    def _on_console(self, message: ConsoleMessage) -> None:
        if message.type not in ("error", "warning"):
            return
        if not any(re.search(pattern, message.text) for pattern in self._allowed):
            self._complaints.append(f"console {message.type}: {message.text} ({message.location.get('url')})")

    def _on_error(self, error: WebError) -> None:
        self._complaints.append(f"uncaught error in the page: {error.error}")

    def _on_request(self, request: Request) -> None:
        if not request.url.startswith((f"{self._origin}/", *LOCAL_SCHEMES)):
            self._complaints.append(f"request to another origin: {request.method} {request.url}")

    def _on_response(self, response: Response) -> None:
        if response.status >= 500:
            self._complaints.append(f"{response.status} from {response.request.method} {response.url}")


@pytest.fixture(scope="session")
def browser_type_launch_args(
    browser_type_launch_args: dict[str, Any], announce: Callable[[str], None]
) -> dict[str, Any]:
    """How pytest-playwright starts Chromium: found or fetched once per run."""
    try:
        browser = find_or_get(announce)
    except NoBrowser as error:
        pytest.fail(str(error), pytrace=False)
    arguments = {**browser_type_launch_args, "args": [*ARGUMENTS]}
    return arguments if browser.executable is None else {**arguments, "executable_path": browser.executable}


@pytest.fixture(scope="session", autouse=True)
def delete_output_dir(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Instead of pytest-playwright's, which empties ``test-results`` of whatever folder pytest was started in.

    Screenshots and traces (``--screenshot``, ``--tracing``) go to pytest's temporary folder unless ``--output``
    names another.
    """
    if pytestconfig.getoption("--output") == "test-results":
        pytestconfig.option.output = str(tmp_path_factory.mktemp("browser"))


@pytest.fixture(scope="session")
def base_url(server_url: str) -> str:
    """What ``page.goto("/")`` is relative to."""
    return server_url


@pytest.fixture
def page_guard(server: RunningServer) -> Iterator[PageGuard]:
    """The guard of this test's pages; it speaks after they are closed, so nothing they did is missed."""
    guard = PageGuard(server.url)
    yield guard
    server.check_alive()
    guard.check()


@pytest.fixture
def new_context(
    page_guard: PageGuard, new_context: Callable[..., BrowserContext]
) -> Callable[..., BrowserContext]:
    """pytest-playwright's, with the guard watching."""

    def create(**options: Any) -> BrowserContext:
        context = new_context(**options)
        page_guard.watch(context)
        return context

    return create
