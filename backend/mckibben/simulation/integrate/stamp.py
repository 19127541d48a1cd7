"""Kernels: functions that numba compiles once for a machine, and `mckibben.simulation.kept_code` keeps.

numba's own cache goes by the age of a function's file, so neither an installation nor a change of a function
that is called would be noticed. Here the key holds the sources, the versions and the processor.
"""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar

import llvmlite
import numba
from numba import njit
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult

from mckibben.simulation.integrate.background import compiling
from mckibben.simulation.kept_code import keep, kept

Compiled = TypeVar("Compiled", bound=Callable[..., Any])


class _KeptCode(_Cache):
    """Where numba looks for the code of a kernel before it compiles it, and puts it afterwards."""

    def __init__(self, what: tuple[object, ...]) -> None:
        self._what = (*what, numba.__version__, llvmlite.__version__, sys.version)
        self.missing: Callable[[], object] = lambda: None  # called where nothing is kept

    @property
    def cache_path(self) -> None:
        return None

    def _key(self, signature: Any, codegen: Any) -> bytes:
        return repr((self._what, str(signature), codegen.magic_tuple())).encode()

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        target_context.refresh()
        code = kept(self._key(sig, target_context.codegen()))
        if code is None:
            self.missing()
        return None if code is None else CompileResult._rebuild(target_context, *pickle.loads(code))

    def save_overload(self, sig: Any, data: Any) -> None:
        keep(self._key(sig, data.codegen), pickle.dumps(data._reduce()))

    def enable(self) -> None:
        pass

    def disable(self) -> None:
        pass

    def flush(self) -> None:
        pass


class Kernel(Generic[Compiled]):
    """A function with one signature, compiled when it is first asked for and not when it is imported.

    Args:
        function: in Python.
        signature: as numba writes it.
        sources: of the modules it is made from.
    """

    def __init__(self, function: Compiled, signature: str, sources: bytes) -> None:
        self.signature = signature
        self.dispatcher: Any = njit(error_model="numpy", nogil=True)(function)
        self.dispatcher._cache = _KeptCode((repr(function).split(" at ")[0], sources))

    def compiled(self) -> Compiled:
        """The compiled function: kept since the installation or an earlier process, or compiled now."""
        if not self.dispatcher.signatures:
            with ExitStack() as stack:
                self.dispatcher._cache.missing = lambda: stack.enter_context(compiling(self.signature))
                self.dispatcher.compile(self.signature)
            self.dispatcher.disable_compile()
        return self.dispatcher


def kernel(signature: str, *modules: ModuleType, also: object = "") -> Callable[[Compiled], Kernel[Compiled]]:
    """A decorator that makes a function a kernel.

    Args:
        signature: as numba writes it.
        modules: that it is made from besides its own.
        also: what else its code depends on.
    """

    def made(function: Compiled) -> Kernel[Compiled]:
        own = sys.modules[function.__module__]
        sources = b"".join(Path(str(module.__file__)).read_bytes() for module in (own, *modules))
        return Kernel(function, signature, sources + repr(also).encode())

    return made
