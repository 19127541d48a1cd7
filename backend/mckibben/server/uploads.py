"""Bodies of requests that are files: they go to the disk while they arrive, not into memory."""

from __future__ import annotations

import tempfile
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress
from pathlib import Path
from typing import IO

from anyio import CancelScope
from fastapi import Request
from fastapi.concurrency import run_in_threadpool

from mckibben.folder import is_full
from mckibben.measurement.store import MeasurementStore

_PIECE = 1_000_000  # bytes that are written at once
_STALE = 3600.0  # s without a change; the server of an older file has ended


class Scratch:
    """Files on their way in or out of a server; what a server that was killed has left is removed.

    Args:
        store: in whose folder they are: on the disk on which they are kept later.
    """

    def __init__(self, store: MeasurementStore) -> None:
        self._store = store
        self._folder = store.data / "passing"
        self._tidied = False

    @contextmanager
    def file(self) -> Iterator[tuple[Path, IO[bytes]]]:
        """A new file, to write; removed at the end of the block."""
        handle = self._begun()
        try:
            yield Path(handle.name), handle
        finally:
            _removed(handle)

    @asynccontextmanager
    async def received(self, request: Request) -> AsyncIterator[Path]:
        """The body of a request in a file, which is removed at the end of the block.

        Raises:
            InputError: code ``no_space``, the disk is full, also without what was deleted.
        """
        handle = await run_in_threadpool(self._begun)
        try:
            pieces, size = [], 0
            async for piece in request.stream():
                pieces.append(piece)
                size += len(piece)
                if size >= _PIECE:
                    await run_in_threadpool(self._write, handle, b"".join(pieces))
                    pieces, size = [], 0
            await run_in_threadpool(self._write, handle, b"".join(pieces))
            yield Path(handle.name)
        finally:
            with CancelScope(shield=True):
                await run_in_threadpool(_removed, handle)

    def _begun(self) -> IO[bytes]:
        with self._usable():
            return tempfile.NamedTemporaryFile(dir=self._opened(), prefix=".", buffering=0, delete=False)

    def _write(self, handle: IO[bytes], content: bytes) -> None:
        begin = handle.tell()
        try:
            _written(handle, content)
        except OSError as error:
            if not is_full(error):
                raise
            self._store.empty_bin()
            handle.seek(begin)
            with self._usable():
                _written(handle, content)

    def _opened(self) -> Path:
        """The folder, at first without what servers that have ended have left.

        Not later: where the clock jumps, files of this server would look old.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        tidied, self._tidied = self._tidied, True
        for path in () if tidied else self._folder.iterdir():
            with suppress(OSError):
                if time.time() - path.stat().st_mtime > _STALE:
                    path.unlink()
        return self._folder

    @contextmanager
    def _usable(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise self._store.unusable("stored", error) from error


def _removed(handle: IO[bytes]) -> None:
    handle.close()
    Path(handle.name).unlink(missing_ok=True)


def _written(handle: IO[bytes], content: bytes) -> None:
    left = memoryview(content)
    while left:
        left = left[handle.write(left) :]
