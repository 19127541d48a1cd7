"""What takes long to import, imported in the background."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

Loaded = TypeVar("Loaded")
_LONG = 2.0  # s; what is only loaded is ready before
_under_way: dict[str, float] = {}  # name -> when it was begun, see `time.monotonic`
_tell: list[Callable[[], None]] = []


def tell_who_waits(tell: Callable[[], None]) -> None:
    """Call a function whenever somebody waits for longer than loading alone takes."""
    _tell.append(tell)


def is_compiling() -> bool:
    """Whether something is being compiled for this machine: it is loaded for longer than loading alone takes.

    That happens once after an installation, for about 20 s of a core; people who wait for it want to know.
    """
    return any(time.monotonic() - begun > _LONG for begun in list(_under_way.values()))


class Background(Generic[Loaded]):
    """Something imported (and on first use compiled) in the background.

    Args:
        load: imports and returns it.
        name: of the thread.
    """

    def __init__(self, load: Callable[[], Loaded], name: str) -> None:
        self._load, self._name = load, name
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._loaded: Loaded | None = None

    def warm(self) -> threading.Thread:
        """Start getting it ready; returns the thread that does it."""
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()
            return self._thread

    def awaited(self) -> Loaded:
        """It, as soon as it is ready.

        Raises:
            RuntimeError: it cannot be loaded; the thread has printed why.
        """
        thread = self.warm()
        thread.join(_LONG)
        if thread.is_alive():
            for tell in _tell:
                tell()
            thread.join()
        if self._loaded is None:
            raise RuntimeError(f"{self._name} cannot be loaded")
        return self._loaded

    def _run(self) -> None:
        _under_way[self._name] = time.monotonic()
        try:
            self._loaded = self._load()
        finally:
            del _under_way[self._name]
