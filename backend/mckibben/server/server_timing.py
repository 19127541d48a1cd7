"""The outermost layer: measures the time of an answer and handles unexpected errors."""

from __future__ import annotations

from time import perf_counter

from starlette.datastructures import MutableHeaders
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mckibben.server.errors import unexpected_answer


class TimingMiddleware:
    """``Server-Timing: app;dur=<ms>`` on API answers, no caching unless a route sets it, 500 as JSON."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Time one request from its arrival to the first byte of its answer, without waiting for its body."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        start, waited, started = perf_counter(), 0.0, False
        is_api = scope["path"].startswith("/api/")

        async def timed_receive() -> Message:
            nonlocal waited
            before = perf_counter()
            message = await receive()
            waited += perf_counter() - before
            return message

        async def timed_send(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                if is_api:
                    headers = MutableHeaders(raw=message["headers"])
                    headers.setdefault("cache-control", "no-store")
                    headers["server-timing"] = f"app;dur={(perf_counter() - start - waited) * 1e3:.3f}"
            await send(message)

        try:
            await self.app(scope, timed_receive, timed_send)
        except ClientDisconnect:
            return  # the client disconnected within the body: no answer is needed, and nothing is stored
        except Exception as error:
            # Inside Starlette's error layer, which would send plain text and log a second time.
            if started:
                raise
            await unexpected_answer(error)(scope, receive, timed_send)
