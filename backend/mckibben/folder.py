"""A folder that several programs write: one changes it at a time; what is deleted can be restored.

And the space that all that is kept may take: by kind, with one refusal that names the figures.
"""

from __future__ import annotations

import errno
import os
import shutil
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from mckibben.physics.errors import InputError

DELETED = ".deleted"
_WITHIN = 10.0  # s for another program to be done
_AGAIN = 0.01  # s


class FolderBusyError(OSError):
    """Another program keeps the folder for itself."""


class DiskFullError(InputError):
    """What is kept would have room by its quota, and the disk has none."""


@dataclass(frozen=True, slots=True)
class Quotas:
    """Most bytes that each kind of what is kept may take on the disk, with what can be restored.

    Attributes:
        measurements: uploaded files.
        projects: documents with all their versions, the measurements and study tables kept with them.
        studies: rows of studies; those not used for longest go first.
        diagnoses: finished ones; those not used for longest go first.
        presets: presets of the user.
    """

    measurements: int = 4_000_000_000
    projects: int = 4_000_000_000
    studies: int = 500_000_000
    diagnoses: int = 200_000_000
    presets: int = 100_000_000


#: Where nothing else is stated.
QUOTAS = Quotas()


def in_bytes(size: float) -> str:
    """A size for people."""
    for unit, factor in (("GB", 1e9), ("MB", 1e6)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e3:.3g} kB"


def free_space(folder: Path) -> int | None:
    """Bytes that the disk of a folder, or of the first one above it that exists, has left."""
    for place in (folder, *folder.parents):
        with suppress(OSError):
            return shutil.disk_usage(place).free
    return None


def is_full(error: OSError) -> bool:
    """Whether a disk, or what it gives to this user or to one file, is full."""
    return error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


def no_space(kind: str, *, taken: int, quota: int, needs: int | None = None, folder: Path) -> InputError:
    """The refusal of what has no room, with the figures.

    Args:
        kind: what is kept, "measurements" for example.
        taken, quota: bytes that all of them take, and may take.
        needs: bytes of what was to be kept; None = the disk is full.
        folder: on whose disk they are.
    """
    this = ", and the disk is full" if needs is None else f", this one needs {in_bytes(needs)}"
    free = free_space(folder)
    left = "" if free is None else f"; the disk has {in_bytes(free)} left"
    return (DiskFullError if needs is None else InputError)(
        f"no space: the kept {kind} take {in_bytes(taken)} of {in_bytes(quota)}{this}{left}",
        hint=f"erase what is deleted or delete some (Catalogue, Kept), or start the server with a larger "
        f"--quota {kind}=GB",
        code="no_space",
    )


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


def size_of_deleted(folder: Path) -> int:
    """Bytes of the files of a folder that can be restored."""
    total = 0
    for path in deleted(folder):
        with suppress(OSError):
            total += path.stat().st_size
    return total


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
