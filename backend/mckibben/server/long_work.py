"""Long work: runs in a thread, reports progress, and ends when the caller has disconnected.

The event loop only receives and sends. Reading files, preparing, computing and writing large answers happen
in worker threads, so that other requests are answered in the meantime.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator, Callable
from typing import Any, ParamSpec, TypeVar

from fastapi import Request
from fastapi.concurrency import run_in_threadpool
from fastapi.sse import EventSourceResponse, format_sse_event
from starlette.requests import ClientDisconnect

from mckibben.application.json_text import to_json
from mckibben.physics.errors import InputError
from mckibben.server.errors import input_error_answer, unexpected_answer
from mckibben.simulation.outcome import TIME_LIMIT, Watch

P = ParamSpec("P")
T = TypeVar("T")
Work = Callable[[Watch], object]

_LOOK_EVERY = 0.1  # s


def wants_events(request: Request) -> bool:
    """Whether the caller requests a stream of events."""
    return "text/event-stream" in request.headers.get("accept", "")


async def prepared(request: Request, prepare: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Run a function that reads files or prepares a computation in a worker thread; returns its result.

    Raises:
        ClientDisconnect: the caller has disconnected; the prepared work need not start.
    """
    result = await run_in_threadpool(prepare, *args, **kwargs)
    if await request.is_disconnected():
        raise ClientDisconnect
    return result


async def finished(
    request: Request, work: Work, written: Callable[[Any], bytes], *, time_limit: float = TIME_LIMIT
) -> bytes:
    """The result of the work, converted by ``written``; the work is cancelled if the caller disconnects."""
    gone = threading.Event()
    watch = Watch(cancelled=gone.is_set, time_limit=time_limit)
    running = asyncio.get_running_loop().run_in_executor(None, lambda: written(work(watch)))
    while True:
        done, _ = await asyncio.wait({running}, timeout=_LOOK_EVERY)
        if done:
            return running.result()
        if await request.is_disconnected():
            gone.set()


def events(work: Work, *, time_limit: float = TIME_LIMIT) -> EventSourceResponse:
    """``progress`` events while the work runs, then ``done`` with its result, or ``error``."""
    return EventSourceResponse(_events(work, time_limit))


async def _events(work: Work, time_limit: float) -> AsyncIterator[bytes]:
    loop = asyncio.get_running_loop()
    news: asyncio.Queue[dict[str, object] | None] = asyncio.Queue()
    gone = threading.Event()

    def send_progress(**fresh: object) -> None:
        # The event loop may end before the thread.
        if not loop.is_closed():
            loop.call_soon_threadsafe(news.put_nowait, fresh)

    watch = Watch(
        cancelled=gone.is_set,
        progress=lambda share: send_progress(share=share),
        found=lambda found: send_progress(found=found),
        time_limit=time_limit,
    )
    running = loop.run_in_executor(None, lambda: _event("done", to_json(work(watch))))
    running.add_done_callback(lambda _: news.put_nowait(None))
    # Retrieve the exception of cancelled work, which nobody else may do.
    running.add_done_callback(lambda ended: None if ended.cancelled() else ended.exception())
    try:
        share: object = 0.0
        yield _event("progress", to_json({"share": share}))
        while (fresh := await news.get()) is not None:
            share = fresh.get("share", share)
            yield _event("progress", to_json({"share": share, **fresh}))
        try:
            yield running.result()
        except InputError as error:
            yield _event("error", bytes(input_error_answer(error).body))
        except Exception as error:  # the stream has begun: the error handlers can no longer answer
            yield _event("error", bytes(unexpected_answer(error).body))
    finally:
        gone.set()


def _event(name: str, data: bytes) -> bytes:
    return format_sse_event(event=name, data_str=data.decode())
