"""What takes long to import, imported in the background."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Generic, TypeVar

Loaded = TypeVar("Loaded")
_LOOK_EVERY = 0.1  # s
_compiled: list[str] = []  # names of what is being compiled
_tell: list[Callable[[], None]] = []


def tell_who_waits(tell: Callable[[], None]) -> None:
    """Call a function whenever somebody waits for a compilation."""
    _tell.append(tell)


@contextmanager
def compiling(name: str) -> Iterator[None]:
    """Something is compiled within: nothing is kept of it.

    That happens once after an installation, for about 20 s of a core; people who wait for it want to know.
    """
    _compiled.append(name)
    try:
        yield
    finally:
        _compiled.remove(name)


def is_compiling() -> bool:
    """Whether something is being compiled for this machine."""
    return bool(_compiled)


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
        thread, told = self.warm(), False
        while thread.is_alive():
            thread.join(_LOOK_EVERY)
            if is_compiling() and not told:
                told = True
                for tell in _tell:
                    tell()
        if self._loaded is None:
            raise RuntimeError(f"{self._name} cannot be loaded")
        return self._loaded

    def _run(self) -> None:
        self._loaded = self._load()
