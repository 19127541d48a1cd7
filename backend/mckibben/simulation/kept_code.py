"""Machine code, kept on disk: compiled once on a machine, and not in every process again.

Loading takes a hundredth of the time of compiling. Code is found by a key that holds all it was made from, in
the user's folder or among what was compiled with the installation; the folder goes by the processor. Nothing
fails when a file cannot be read or written: then it is compiled.
"""

from __future__ import annotations

import os
import platform
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from hashlib import blake2b
from pathlib import Path

from mckibben.resources import cache_folder, installed_code_folder

_SUM = 16  # bytes of the checksum before the code
_MOST = 200e6  # bytes kept
_LEFT = 0.5  # share of them that stays when there are more
_UNUSED = 30 * 24 * 3600.0  # s after which the code for another processor is removed


def kept(key: bytes) -> bytes | None:
    """The code of a key; None if there is none, or if it is not as it was written."""
    for folder in (_folder(), _of_processor(installed_code_folder())):
        with suppress(OSError):
            content = b"" if folder is None else (folder / _name(key)).read_bytes()
            code = content[_SUM:]
            if code and blake2b(code, digest_size=_SUM).digest() == content[:_SUM]:
                return code
    return None


def keep(key: bytes, code: bytes) -> None:
    """Keep the code of a key, where there is a place for it."""
    folder = _folder()
    if folder is None:
        return
    with suppress(OSError):
        handle, name = tempfile.mkstemp(dir=folder)
        try:
            with os.fdopen(handle, "wb") as partial:
                partial.write(blake2b(code, digest_size=_SUM).digest() + code)
            os.replace(name, folder / _name(key))  # at once: no other process ever reads a part
        except OSError:
            Path(name).unlink(missing_ok=True)


@contextmanager
def one_process_at_a_time(what: str) -> Iterator[None]:
    """Hold back other processes of this machine that compile the same; they find it compiled then.

    Where files cannot be locked, each compiles for itself.

    Args:
        what: is compiled, part of the name of a file.
    """
    folder = _folder()
    if folder is None or sys.platform == "win32":
        yield
        return
    import fcntl

    with ExitStack() as held:
        with suppress(OSError):
            file = held.enter_context((folder / f"{what}.lock").open("ab"))
            fcntl.lockf(file, fcntl.LOCK_EX)  # of this process alone: a fork does not hold it on
        yield


def _name(key: bytes) -> str:
    return blake2b(key, digest_size=16).hexdigest()


@cache
def _folder() -> Path | None:
    """The folder of this machine; None where nothing is to be kept."""
    place = cache_folder()
    if place is None:
        return None
    folder = _of_processor(place)
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        os.utime(folder)
    except OSError:
        return None
    with suppress(OSError):  # another process may tidy, or write, at the same time
        _tidy(folder)
    return folder


def _of_processor(place: Path) -> Path:
    return place / "code" / blake2b(_processor().encode(), digest_size=8).hexdigest()


@cache
def _processor() -> str:
    """What machine code must suit."""
    with suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        told = sorted({line for line in lines if line.startswith(("model name", "flags", "Features", "CPU"))})
        if told:
            return f"{platform.machine()} {told}"
    return f"{platform.machine()} {platform.processor()} {platform.node()}"


def _tidy(folder: Path) -> None:
    """Remove the code for processors that are gone, and the oldest where there is too much."""
    for other in folder.parent.iterdir():
        if other != folder and time.time() - other.stat().st_mtime > _UNUSED:
            for file in other.iterdir():
                file.unlink(missing_ok=True)
            other.rmdir()
    found = []
    with os.scandir(folder) as entries:
        for entry in entries:
            with suppress(FileNotFoundError):  # a partial file that has got its name meanwhile
                found.append((entry.stat().st_mtime, entry.stat().st_size, entry.path))
    found.sort()
    size = sum(bytes_ for _, bytes_, _ in found)
    if size <= _MOST:
        return
    for _, bytes_, path in found:
        if size <= _LEFT * _MOST:
            break
        Path(path).unlink(missing_ok=True)
        size -= bytes_
