"""What the fork server loads before it makes a worker: program and units, and silence for a worker too late.

A worker that is made while its pool ends does not find the pool's locks any more. Nobody waits for it, and a
traceback of it among the last lines of the server would look like a fault.
"""

from __future__ import annotations

import sys
from types import TracebackType

from mckibben.measurement.reading import load_readers
from mckibben.server import worker  # noqa: F401 - loaded for the workers

_LOCKS = "multiprocessing.synchronize"


def _is_too_late(error: BaseException, trace: TracebackType | None) -> bool:
    """Whether a process ended because the locks that it was to share are gone."""
    if not isinstance(error, FileNotFoundError) or trace is None:
        return False
    while trace.tb_next is not None:
        trace = trace.tb_next
    return trace.tb_frame.f_globals.get("__name__") == _LOCKS


def _show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if not _is_too_late(error, trace):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _show
load_readers()  # with the units, which presets need too: a third of the start of each worker
