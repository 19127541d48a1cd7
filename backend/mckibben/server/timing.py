"""The outermost layer: how long an answer took, and what happens when something unexpected fails."""

from __future__ import annotations

from time import perf_counter

from starlette.datastructures import MutableHeaders
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mckibben.server.errors import unexpected_answer


class TimingMiddleware:
    """``Server-Timing: app;dur=<ms>`` on API answers, no caching unless a route asks for it, 500 as JSON."""

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
            return  # hung up in the middle of a body: nobody waits for an answer, and nothing was kept
        except Exception as error:
            # Inside Starlette's own error layer, which would send a plain text and log a second time.
            if started:
                raise
            await unexpected_answer(error)(scope, receive, timed_send)
