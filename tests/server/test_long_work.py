"""Long work of a request that nobody waits for any more."""

from __future__ import annotations

import asyncio
import gc
from types import SimpleNamespace
from typing import Any, cast

import pytest

from mckibben.physics.errors import InputError
from mckibben.server.long_work import whole
from tests.server.conftest import run_async


class Workers:
    """Workers whose only job ends with an error, after the server has given its requests up."""

    def __init__(self) -> None:
        self.runs, self.ended, self.stopped = asyncio.Event(), asyncio.Event(), False

    def of(self, _kind: str) -> Workers:
        return self

    def enter(self) -> Any:
        async def place() -> None:
            return None

        return SimpleNamespace(place=place)

    async def submit(self, *_: object) -> Any:
        news: asyncio.Queue[None] = asyncio.Queue()
        news.put_nowait(None)
        return SimpleNamespace(news=news)

    async def result(self, _running: object) -> bytes:
        self.runs.set()
        await self.ended.wait()
        raise InputError("the server is ending")

    def stop(self, _running: object) -> None:
        self.stopped = True


class Requested:
    """A request whose caller stays."""

    def __init__(self, workers: Workers) -> None:
        self.app = SimpleNamespace(state=SimpleNamespace(workers=workers))

    async def is_disconnected(self) -> bool:
        return False


def test_a_request_given_up_stops_its_job_and_leaves_no_lost_exception() -> None:
    lost: list[dict[str, Any]] = []

    async def given_up() -> Workers:
        asyncio.get_running_loop().set_exception_handler(lambda _, context: lost.append(context))
        workers: Any = Workers()
        request = cast(Any, Requested(workers))
        answer = asyncio.ensure_future(whole(request, "comparison", None, cast(Any, None), cast(Any, None)))
        await workers.runs.wait()
        answer.cancel()
        with pytest.raises(asyncio.CancelledError):
            await answer
        workers.ended.set()
        for _ in range(5):
            await asyncio.sleep(0)
        gc.collect()
        return workers

    assert run_async(given_up()).stopped
    assert lost == []
