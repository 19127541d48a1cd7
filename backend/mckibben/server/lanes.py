"""The processes of a server, in lanes: long work, files, and models with what the user typed.

A queue of diagnoses does not delay an upload, and a file that takes a minute no curve.
"""

from __future__ import annotations

from mckibben.server.job import LaneName
from mckibben.server.jobs import JOBS
from mckibben.server.lane import Lane
from mckibben.server.settings import Settings
from mckibben.server.workers import Workers

_MOST_SHORT = 2  # processes of a lane of short work
_SHORT_QUEUE = 64


class Lanes:
    """All worker processes of a server; made on its event loop, used there alone.

    Args:
        settings: number of processes, length of the queue, memory, and the folders of the server.
    """

    def __init__(self, settings: Settings) -> None:
        few = min(_MOST_SHORT, settings.workers)
        self._of: dict[LaneName, Workers] = {
            "long": Workers(settings),
            "files": Workers(settings, Lane(few, _SHORT_QUEUE, settings.reader_memory, compiled=False)),
            "models": Workers(settings, Lane(few, _SHORT_QUEUE, settings.worker_memory)),
        }

    def of(self, kind: str) -> Workers:
        """The processes that do a kind of `JOBS`."""
        return self._of[JOBS[kind].lane]

    @property
    def each(self) -> dict[LaneName, Workers]:
        """The lanes by name."""
        return dict(self._of)

    def start(self, *names: LaneName) -> None:
        """Start the processes of lanes, of all without a name. Later calls do nothing."""
        for name in names or self._of:
            self._of[name].start()

    def end(self) -> None:
        """The server ends: every job ends now, and who waits for one hears so. From any thread."""
        for workers in self._of.values():
            workers.end()

    def close(self) -> None:
        """End all processes, whatever they do."""
        for workers in self._of.values():
            workers.close()
