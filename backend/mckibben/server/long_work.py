"""Long work: runs beside the event loop, reports progress, and ends when the caller has disconnected.

The event loop only receives and sends. Reading files, preparing, computing and writing large answers happen
in worker threads, so that other requests are answered in the meantime; jobs in processes of their own, where
the server has some (`mckibben.server.workers`).
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncGenerator, AsyncIterator, Callable
from contextlib import aclosing
from typing import Any, ParamSpec, TypeVar

import orjson
from fastapi import Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.sse import EventSourceResponse, format_sse_event
from starlette.requests import ClientDisconnect

from mckibben.application.json_text import to_json
from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.errors import InputError
from mckibben.server.answer import JsonAnswer
from mckibben.server.errors import input_error_answer, unexpected_answer
from mckibben.server.jobs import JOBS
from mckibben.server.lanes import Lanes
from mckibben.server.workers import Workers
from mckibben.simulation.outcome import Watch

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
    request: Request, work: Work, written: Callable[[Any], bytes], *, time_limit: float = float("inf")
) -> bytes:
    """The result of the work, converted by ``written``; the work is cancelled if the caller disconnects."""
    gone = threading.Event()
    watch = Watch(cancelled=gone.is_set, time_limit=time_limit)
    running = asyncio.get_running_loop().run_in_executor(None, lambda: written(work(watch)))
    running.add_done_callback(_exception_of)
    while True:
        done, _ = await asyncio.wait({running}, timeout=_LOOK_EVERY)
        if done:
            return running.result()
        if await request.is_disconnected():
            gone.set()


def events(work: Work, *, time_limit: float = float("inf")) -> EventSourceResponse:
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
    running = loop.run_in_executor(None, lambda: _event("done", _bytes(work(watch))))
    running.add_done_callback(lambda _: news.put_nowait(None))
    running.add_done_callback(_exception_of)
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


def _exception_of(ended: asyncio.Future[Any]) -> BaseException | None:
    """Retrieve the exception of work that nobody may wait for any more; asyncio would report it as lost."""
    return None if ended.cancelled() else ended.exception()


async def answered(
    request: Request,
    kind: str,
    body: object,
    studio: Studio,
    store: MeasurementStore,
    *,
    quick: bool = False,
) -> Response:
    """The answer of a job: JSON, or a stream of events if the caller requests one.

    Args:
        request: of the caller; the job ends when it has disconnected.
        kind: of `JOBS`.
        body: the validated body.
        studio, store: for a job that runs in the server.
        quick: a job that ends so soon that it need not wait for a worker.

    Raises:
        InputError: what the job refuses; once a stream has begun, it is its last event.
        BusyError: too many jobs wait.
    """
    if not wants_events(request):
        return JsonAnswer(await whole(request, kind, body, studio, store, quick=quick))
    workers = _workers(request, kind, quick=quick)
    if workers is None:
        job = JOBS[kind]
        work = await prepared(request, job.prepare, body, studio, store)
        return events(work, time_limit=job.time_limit)
    stream = _worked(workers, kind, body)
    first = await anext(stream)  # what is refused at once has the status of an error
    return EventSourceResponse(_whole_stream(first, stream))


async def whole(
    request: Request,
    kind: str,
    body: object,
    studio: Studio,
    store: MeasurementStore,
    *,
    quick: bool = False,
) -> bytes:
    """The bytes of the answer of a job; arguments and errors as in `answered`."""
    workers = _workers(request, kind, quick=quick)
    if workers is None:
        job = JOBS[kind]
        if quick:  # in one thread: to change it takes as long as a short run

            def work(watch: Watch) -> object:
                return job.prepare(body, studio, store)(watch)
        else:
            work = await prepared(request, job.prepare, body, studio, store)
        return await finished(request, work, lambda found: found, time_limit=job.time_limit)
    ending = asyncio.ensure_future(_last(_worked(workers, kind, body)))
    ending.add_done_callback(_exception_of)
    try:
        while True:
            done, _ = await asyncio.wait({ending}, timeout=_LOOK_EVERY)
            if done:
                return ending.result()
            if await request.is_disconnected():
                raise ClientDisconnect
    finally:
        ending.cancel()


def contained(request: Request, body: object) -> bool:
    """Whether a model is computed in a process of its own: it holds a term that the user typed, or his code.

    What stays in the server compiles effects of the program alone.

    Args:
        request: of the caller.
        body: with the effects of a muscle, of a drive, of a joint or of a saved model.
    """
    if request.app.state.workers is None:
        return False
    studio: Studio = request.app.state.studio
    joint = getattr(body, "joint", None)
    parts = (body, getattr(body, "drive", None), getattr(body, "model", None), joint)
    for part in (*parts, *getattr(joint, "muscles", ())):
        if isinstance(part, str):
            if not studio.library.is_built_in("drives", part):
                return True
        elif not set(getattr(part, "effects", None) or ()) <= set(default_catalogue()):
            return True
    return False


def _workers(request: Request, kind: str, *, quick: bool) -> Workers | None:
    """The processes for a job; None for one that runs in the server itself."""
    lanes: Lanes | None = request.app.state.workers
    return None if quick or lanes is None else lanes.of(kind)


async def _worked(workers: Workers, kind: str, body: object) -> AsyncGenerator[tuple[str, bytes]]:
    """``progress`` while the job waits and runs, then ``done`` with the answer."""
    ticket = workers.enter()
    running = None
    try:
        while (place := await ticket.place()) is not None:
            waiting = {"before": place.before, "seconds": place.seconds}
            yield "progress", to_json({"share": 0.0, "waiting": waiting})
        running = await workers.submit(ticket, kind, body)
        share: object = 0.0
        while (message := await running.news.get()) is not None:
            fresh = orjson.loads(message.data) if message.data else {}
            share = fresh.get("share", share)
            yield "progress", to_json({"share": share, **fresh})
        yield "done", await workers.result(running)
    finally:
        if running is None:
            ticket.leave()
        else:
            workers.stop(running)


async def _whole_stream(
    first: tuple[str, bytes], stream: AsyncGenerator[tuple[str, bytes]]
) -> AsyncIterator[bytes]:
    async with aclosing(stream):
        yield _event(*first)
        try:
            async for name, data in stream:
                yield _event(name, data)
        except InputError as error:
            yield _event("error", bytes(input_error_answer(error).body))
        except Exception as error:  # the stream has begun: the error handlers can no longer answer
            yield _event("error", bytes(unexpected_answer(error).body))


async def _last(stream: AsyncGenerator[tuple[str, bytes]]) -> bytes:
    answer = b""
    async with aclosing(stream):
        async for name, data in stream:
            if name == "done":
                answer = data
    return answer


def _bytes(answer: object) -> bytes:
    return answer if isinstance(answer, bytes) else to_json(answer)


def _event(name: str, data: bytes) -> bytes:
    return format_sse_event(event=name, data_str=data.decode())
