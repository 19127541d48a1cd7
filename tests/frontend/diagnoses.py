"""Diagnoses that the server gave once are given again: the same question, the same answer, without the wait.

For tests of what the page does with a diagnosis. Those of the diagnosis on its way, its progress and its end,
ask the server each time. The answers are kept in a folder that all workers of a run share.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from playwright.sync_api import Error, Page, Route

from tests.one_at_a_time import one_at_a_time

_PATH = "**/api/diagnoses"
_STREAM = "text/event-stream"
_DONE = b"event: done"
_WITHIN = 150_000  # ms; on a busy machine a drive takes its time

#: Folder of the answers; `keep_in` sets it.
_folder: Path | None = None
#: Questions of this process that are on their way.
_asking: set[Path] = set()


def keep_in(folder: Path) -> None:
    """Keep answers in this folder, which must be that of one run of the tests."""
    global _folder
    folder.mkdir(exist_ok=True)
    _folder = folder


def remember(page: Page) -> None:
    """Let this page's diagnoses be answered by what the server told any page of this run before.

    Once the page is open: a page with routes asks for all of its modules anew, which doubles what it costs.
    """
    page.route(_PATH, lambda route: _answer(route, lambda body: body))


@contextmanager
def unanswered(page: Page) -> Iterator[None]:
    """What the page asks meanwhile waits for ever: for models of which only the numbers are looked at."""

    def wait(route: Route) -> None:
        """The page ends it when it asks for the next model."""

    page.route(_PATH, wait)
    yield
    page.unroute(_PATH, wait)


def alter(page: Page, change: Callable[[dict[str, Any]], None]) -> None:
    """Let this page's diagnoses be answered as they are, with something changed in the result."""

    def changed(body: bytes) -> bytes:
        lines = body.splitlines()
        last = max(n for n, line in enumerate(lines) if line.startswith(b"data: "))  # that of "done"
        done = json.loads(lines[last].removeprefix(b"data: "))
        change(done)
        lines[last] = b"data: " + json.dumps(done).encode()
        return b"\n".join(lines) + b"\n\n"

    page.route(_PATH, lambda route: _answer(route, changed))


def _answer(route: Route, changed: Callable[[bytes], bytes]) -> None:
    # The page ends the stream itself as soon as it has the result, so the whole answer is only to be had by
    # asking for it.
    kept = _kept(route.request.post_data or "")
    with suppress(Error), _asked_once(kept):  # an error: the page was closed, or no longer wants the answer
        if kept.exists():
            body = kept.read_bytes()
        else:
            response = route.fetch(timeout=_WITHIN)
            body = response.body()
            if not response.ok or _DONE not in body:
                route.fulfill(response=response)
                return
            partial = kept.with_suffix(f".{os.getpid()}")
            partial.write_bytes(body)
            partial.replace(kept)
        route.fulfill(content_type=_STREAM, body=changed(body))


@contextmanager
def _asked_once(kept: Path) -> Iterator[None]:
    """What another worker is asking already is waited for; in one process it would wait for itself."""
    if kept in _asking:
        yield
        return
    _asking.add(kept)
    try:
        with one_at_a_time(kept.with_suffix(".lock")):
            yield
    finally:
        _asking.remove(kept)


def _kept(asked: str) -> Path:
    assert _folder is not None, "keep_in() comes first"
    return _folder / hashlib.sha256(asked.encode()).hexdigest()
