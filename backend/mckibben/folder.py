"""A folder that several programs write: one changes it at a time; what is deleted can be restored."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

DELETED = ".deleted"
KEPT_DELETED = 30 * 86_400.0  # s that a deleted file can be restored
_WITHIN = 10.0  # s for another program to be done
_AGAIN = 0.01  # s


class FolderBusyError(OSError):
    """Another program keeps the folder for itself."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other programs from changing a folder, which is created; the lock ends with the process.

    Raises:
        OSError: it cannot be written, or another program has kept it for too long.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / ".lock").open("ab") as stream:
        end = time.monotonic() + _WITHIN
        while not _taken(stream):
            if time.monotonic() > end:
                raise FolderBusyError(None, f"another program keeps {folder} locked")
            time.sleep(_AGAIN)
        try:
            yield
        finally:
            _release(stream)


def delete(path: Path) -> Path:
    """Move a file where it can be restored from; the time of the file becomes that of the deletion."""
    there = path.parent / DELETED / path.name
    there.parent.mkdir(exist_ok=True)
    os.utime(path)
    path.replace(there)
    return there


def deleted(folder: Path) -> list[Path]:
    """The files of a folder that can be restored, the last one first."""
    found: list[tuple[float, Path]] = []
    with suppress(OSError):
        for path in (folder / DELETED).iterdir():
            with suppress(OSError):
                found.append((path.stat().st_mtime, path))
    return [path for _, path in sorted(found, reverse=True)]


def restore(folder: Path, name: str) -> None:
    """Bring a deleted file back.

    Raises:
        FileNotFoundError: it cannot be restored.
        FileExistsError: there is another one of that name.
    """
    if (folder / name).exists():
        raise FileExistsError(name)
    (folder / DELETED / name).replace(folder / name)


if sys.platform == "win32":
    import msvcrt

    def _taken(stream: IO[bytes]) -> bool:
        try:
            stream.seek(0)
            msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True

    def _release(stream: IO[bytes]) -> None:
        stream.seek(0)
        msvcrt.locking(stream.fileno(), msvcrt.LK_UNLCK, 1)
else:
    import fcntl

    def _taken(stream: IO[bytes]) -> bool:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def _release(stream: IO[bytes]) -> None:
        fcntl.flock(stream, fcntl.LOCK_UN)
