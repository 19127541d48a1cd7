"""Reading in a process of its own, with limits of time and memory that hold without the help of the readers.

Readers count what they take (`limits.py`); this is for what they do not foresee, in them and in the libraries
that they call: a pattern that goes back without end, a loop in native code. On Linux the process is a copy of
this one, so it takes milliseconds; elsewhere a copy is not safe or not possible, a new process would take a
second, and files are read in this one without these limits.
"""

from __future__ import annotations

import copyreg
import ctypes
import gc
import importlib
import io
import os
import pickle
import select
import signal
import sys
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from io import BufferedReader
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple, NoReturn, TypeVar

from mckibben.measurement.reading.limits import MOST_MEMORY, SPLIT, seconds_for, size_of
from mckibben.physics.errors import InputError

Found = TypeVar("Found")
PATIENCE = 5  # times the limit of processor time that may pass while others have the processor
_PARENT_DIES = 1  # PR_SET_PDEATHSIG of prctl


class _Answer(NamedTuple):
    """What the process found: a result, an error, or neither where its memory was not enough."""

    result: object = None
    error: BaseException | None = None
    short: bool = False
    imported: frozenset[str] = frozenset()


#: What readers have imported in their processes: the next one finds it loaded, and the first file of a kind
#: does not pay for it twice.
_wanted: set[str] = set()


def bounded(work: Callable[[], Found], name: str, load: Callable[[], object], *, size: int) -> Found:
    """The result of reading a file; what it raises is raised here.

    Args:
        work: reads the file; nothing that it changes is changed here.
        name: of the file, for messages.
        load: what every file needs, called once before the first of them.
        size: of the file [bytes]; the time that it may take grows with it.

    Raises:
        InputError: it takes more processor time than `seconds_for` its size, or more than `MOST_MEMORY`, or
            its reader ends unexpectedly.
    """
    if sys.platform != "linux":
        return work()
    _once(load)
    for module in sorted(_wanted - sys.modules.keys()):
        with suppress(ImportError):
            importlib.import_module(module)
    seconds = seconds_for(size)
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # Other threads do not go on in the copy; locks that they may hold are not taken there.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        _work_alone(work, writing, seconds)
    os.close(writing)
    try:
        with open(reading, "rb") as source:
            answer = _heard(source, seconds)
    except TimeoutError:
        _end(child)
        raise _too_much(name, f"{seconds} s of processor time") from None
    except BaseException:
        _end(child)
        raise
    status = _status(child)
    if answer is None:
        raise _refusal(name, status, seconds)
    _wanted.update(answer.imported)
    if answer.short:
        raise _too_much(name, f"{size_of(MOST_MEMORY)} of memory")
    if answer.error is not None:
        raise answer.error
    return answer.result  # type: ignore - what work returned


def limit_memory(most: int) -> None:
    """Let this process take at most so many bytes, and no more than it may already; nothing on Windows."""
    if sys.platform != "win32":
        import resource

        _lower(resource.RLIMIT_DATA, most)


@cache
def _once(load: Callable[[], object]) -> None:
    load()


def _lower(kind: int, most: int) -> None:
    import resource

    limits = resource.getrlimit(kind)
    least = min([most, *(limit for limit in limits if limit != resource.RLIM_INFINITY)])
    resource.setrlimit(kind, (least, limits[1]))


def _work_alone(work: Callable[[], object], writing: int, seconds: int) -> NoReturn:
    """Do the work and write what came of it; the process ends."""
    code = 1
    try:
        _take_limits(writing, seconds)
        before = set(sys.modules)
        try:
            parts = _packed(_Answer(work(), imported=_imported_since(before)))
        except MemoryError:
            parts = _packed(_Answer(short=True))
        except BaseException as error:
            parts = _packed_error(error, _imported_since(before))
        with open(writing, "wb") as out:
            for part in parts:
                out.write(part)
        code = 0
    finally:
        os._exit(code)


def _take_limits(kept: int, seconds: int) -> None:
    """Limits of the process; it ends with the one that waits for it, and has none of its files open."""
    import resource

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGXCPU):
        signal.signal(number, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(_PARENT_DIES, signal.SIGKILL)
    for number in map(int, os.listdir("/proc/self/fd")):
        if number > 2 and number != kept:
            with suppress(OSError):
                os.close(number)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what a library prints as it ends
    _lower(resource.RLIMIT_CORE, 0)
    _lower(resource.RLIMIT_CPU, seconds)
    limit_memory(_taken() + MOST_MEMORY)
    gc.freeze()


def _taken() -> int:
    """Bytes that count against the limit of memory."""
    lines = Path("/proc/self/status").read_text("ascii", "replace").splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmData:"))


def _imported_since(before: set[str]) -> frozenset[str]:
    """Packages, which bring their modules, and modules of this program."""
    new = sys.modules.keys() - before
    return frozenset(name for name in new if "." not in name or name.startswith("mckibben."))


def _view(content: dict[object, object]) -> MappingProxyType[object, object]:
    return MappingProxyType(content)  # whose type has no name that pickle finds


class _Pickler(pickle.Pickler):
    dispatch_table = copyreg.dispatch_table | {MappingProxyType: lambda view: (_view, (dict(view),))}


def _packed(answer: _Answer) -> list[bytes | memoryview]:
    """An answer as bytes, its arrays behind the rest and without a copy."""
    arrays: list[pickle.PickleBuffer] = []
    head = io.BytesIO()
    _Pickler(head, protocol=5, buffer_callback=arrays.append).dump(answer)
    views = [array.raw() for array in arrays]
    sizes = [(view.nbytes, view.readonly) for view in views]
    return [pickle.dumps((head.getvalue(), sizes)), *views]


def _packed_error(error: BaseException, imported: frozenset[str]) -> list[bytes | memoryview]:
    try:
        return _packed(_Answer(error=error, imported=imported))
    except Exception:  # an exception that holds what cannot be sent
        return _packed(_Answer(error=RuntimeError(f"{type(error).__name__}: {error}"), imported=imported))


def _heard(source: BufferedReader, seconds: int) -> _Answer | None:
    """The answer of a process; None if it ended without one.

    Raises:
        TimeoutError: it does neither.
    """
    waiting = select.poll()  # not select: a server may have more than 1024 files open
    waiting.register(source, select.POLLIN)
    if not waiting.poll(1000 * PATIENCE * seconds):
        raise TimeoutError
    try:
        head, sizes = pickle.load(source)
    except (EOFError, pickle.UnpicklingError):
        return None
    arrays: list[memoryview] = []
    for size, readonly in sizes:
        array = memoryview(bytearray(size))
        if source.readinto(array) != size:
            return None
        arrays.append(array.toreadonly() if readonly else array)
    return pickle.loads(head, buffers=arrays)


def _status(child: int) -> int:
    """How a process ended; 0 where somebody else has asked already."""
    with suppress(ChildProcessError):
        return os.waitpid(child, 0)[1]
    return 0


def _end(child: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(child, signal.SIGKILL)
    _status(child)


def _refusal(name: str, status: int, seconds: int) -> InputError:
    """Why a process gave no answer."""
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        return _too_much(name, f"{seconds} s of processor time")
    how = f"signal {os.WTERMSIG(status)}" if os.WIFSIGNALED(status) else f"code {os.WEXITSTATUS(status)}"
    return InputError(
        f"{name}: no column can be read: its reader ended unexpectedly ({how})", field="file",
        hint="export it again, or save it as CSV",
    )  # fmt: skip


def _too_much(name: str, what: str) -> InputError:
    return InputError(
        f"{name}: no column can be read: reading the file takes more than {what}", field="file",
        hint=f"{SPLIT}; or save only the table, as CSV",
    )  # fmt: skip
