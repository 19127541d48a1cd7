"""Diagnoses that the server gave once are given again: the same question, the same answer, without the wait.

For tests of what the page does with a diagnosis. Those of the diagnosis on its way, its progress and its end,
ask the server each time.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple

from playwright.sync_api import Error, Page, Request, Route

_PATH = "**/api/diagnoses"
_DONE = b"event: done"


class _Answer(NamedTuple):
    content_type: str
    body: bytes


_known: dict[str, _Answer] = {}


def remember(page: Page) -> None:
    """Let this page's diagnoses be answered by what the server told any page of this run before."""
    page.route(_PATH, _answer)
    page.on("requestfinished", _keep)


def alter(page: Page, change: Callable[[dict[str, Any]], None]) -> None:
    """Let this page's diagnoses be answered as they are, with something changed in the result."""

    def answer(route: Route) -> None:
        known = _known.get(route.request.post_data or "")
        body = known.body if known else route.fetch().body()
        lines = body.splitlines()
        last = max(n for n, line in enumerate(lines) if line.startswith(b"data: "))  # that of "done"
        done = json.loads(lines[last].removeprefix(b"data: "))
        change(done)
        lines[last] = b"data: " + json.dumps(done).encode()
        route.fulfill(content_type="text/event-stream", body=b"\n".join(lines) + b"\n\n")

    page.route(_PATH, answer)


def _answer(route: Route) -> None:
    known = _known.get(route.request.post_data or "")
    if known is None:
        route.fallback()
    else:
        route.fulfill(content_type=known.content_type, body=known.body)


def _keep(request: Request) -> None:
    asked = request.post_data or ""
    if not request.url.endswith("/api/diagnoses") or asked in _known:
        return
    with suppress(Error):  # the page was closed meanwhile
        response = request.response()
        if response is not None and response.ok and _DONE in (body := response.body()):
            _known[asked] = _Answer(response.headers["content-type"], body)
