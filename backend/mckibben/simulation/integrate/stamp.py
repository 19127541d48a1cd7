"""Names for numba's cache that change with the code."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


def stamped_with(*modules: ModuleType, also: object = "") -> Callable[[Compiled], Compiled]:
    """A decorator that names a function by a hash of the sources of modules and of ``also``.

    numba's cache goes by the name, and by the age of the function's own file alone: a change of the others
    must not leave it with old code.
    """
    sources = b"".join(Path(str(module.__file__)).read_bytes() for module in modules)
    mark = zlib.crc32(sources + repr(also).encode())

    def stamp(function: Compiled) -> Compiled:
        function.__qualname__ += f"_{mark:08x}"  # type: ignore - a function has one
        return function

    return stamp
