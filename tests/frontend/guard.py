"""What the pages of a browser test must not do."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import BrowserContext, ConsoleMessage, Request, Response, WebError

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

    def leave(self, context: BrowserContext) -> None:
        """Listen no more."""
        context.remove_listener("console", self._on_console)
        context.remove_listener("weberror", self._on_error)
        context.remove_listener("request", self._on_request)
        context.remove_listener("response", self._on_response)

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
        self._complaints.append(
            f"uncaught error in the page: {error.error}\n{error.error.stack or ''}".rstrip()
        )

    def _on_request(self, request: Request) -> None:
        if not request.url.startswith((f"{self._origin}/", *LOCAL_SCHEMES)):
            self._complaints.append(f"request to another origin: {request.method} {request.url}")

    def _on_response(self, response: Response) -> None:
        if response.status >= 500:
            self._complaints.append(f"{response.status} from {response.request.method} {response.url}")
