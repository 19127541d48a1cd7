"""Kernels: functions that numba compiles once per installation, under names that change with the code."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar

from numba import njit
from numba.core.caching import FunctionCache

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


class Kernel(Generic[Compiled]):
    """A function with one signature, compiled when it is first asked for and not when it is imported.

    Args:
        function: in Python.
        signature: as numba writes it.
    """

    def __init__(self, function: Compiled, signature: str) -> None:
        self._signature = signature
        self.dispatcher: Any = njit(error_model="numpy", cache=True, nogil=True)(function)

    def is_kept(self) -> bool:
        """Whether numba's cache has it as it is now: then `compiled` takes no compilation."""
        cache = FunctionCache(self.dispatcher.py_func)
        return cache.load_overload(self._signature, self.dispatcher.targetctx) is not None

    def compiled(self) -> Compiled:
        """The compiled function; from numba's cache, or compiled for it."""
        if not self.dispatcher.signatures:
            self.dispatcher.compile(self._signature)
            self.dispatcher.disable_compile()
        return self.dispatcher


def kernel(signature: str, *modules: ModuleType, also: object = "") -> Callable[[Compiled], Kernel[Compiled]]:
    """A decorator that makes a function a kernel, named by a hash of the sources of modules and of ``also``.

    numba's cache goes by the name, and by the age of the function's own file alone: a change of the others
    must not leave it with old code.
    """
    sources = b"".join(Path(str(module.__file__)).read_bytes() for module in modules)
    mark = zlib.crc32(sources + repr(also).encode())

    def stamp(function: Compiled) -> Kernel[Compiled]:
        function.__qualname__ += f"_{mark:08x}"  # type: ignore - a function has one
        return Kernel(function, signature)

    return stamp
