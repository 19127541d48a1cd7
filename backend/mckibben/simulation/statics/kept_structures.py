"""Compiled structures of the static model that other processes of this machine have compiled before.

The key holds the declaration of the effects, what was asked for, the sources of the physics and the versions.
Only structures of built-in effects are kept; those of a typed term or of a user's effect file depend on more
than that, and are compiled by each process.
"""

from __future__ import annotations

import io
import pickle
import platform
from collections.abc import Callable, Sequence
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import symengine as se

import mckibben.physics
from mckibben.physics.effect import Effect
from mckibben.simulation.kept_code import keep, kept

_PHYSICS = Path(mckibben.physics.__path__[0])
_PARTS = {("symengine.lib.symengine_wrapper", "llvm_loading_func"), ("numpy", "float64")}


def kept_or_compiled(effects: Sequence[Effect], asked: object, compiled: Callable[[], Any]) -> Any:
    """A function of `symengine.Lambdify`: loaded if it is kept, else compiled and kept.

    Args:
        effects: the effects of the structure.
        asked: everything else that ``compiled`` depends on; its ``repr`` is compared.
        compiled: compiles the function.
    """
    if not all(map(_built_in, effects)):
        return compiled()
    key = repr(([_declaration(effect) for effect in effects], asked, _sources())).encode()
    packed = kept(key)
    if packed is not None:
        try:
            return _Unpickler(io.BytesIO(packed)).load()
        except (pickle.UnpicklingError, EOFError):
            pass  # of another make; written anew below
    function = compiled()
    keep(key, pickle.dumps(function))
    return function


def _built_in(effect: Effect) -> bool:
    """Whether the equations of an effect are in the sources of the physics, and in nothing else."""
    return all(
        (code := getattr(function, "__code__", None)) is not None
        and getattr(function, "__closure__", None) is None
        and _PHYSICS in Path(code.co_filename).parents
        for function in effect.slots.values()
    )


def _declaration(effect: Effect) -> tuple[object, ...]:
    """What the equations of a structure take from an effect besides its functions."""
    return (
        effect.id,
        effect.order,
        effect.needs,
        [parameter.name for parameter in effect.parameters],
        [(state.name, state.initial) for state in effect.states],
        sorted((slot, getattr(function, "__qualname__", "")) for slot, function in effect.slots.items()),
    )


@cache
def _sources() -> str:
    """A sum of the sources that make the equations, and of the versions of what compiles them."""
    found = blake2b(digest_size=16)
    for source in (*sorted(_PHYSICS.rglob("*.py")), *sorted(Path(__file__).parent.glob("*.py"))):
        found.update(source.read_bytes())
    return f"{found.hexdigest()} {se.__version__} {platform.python_version()}"


class _Unpickler(pickle.Unpickler):
    """Makes compiled functions and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        """One of the two names that a compiled function is made of."""
        if (module, name) not in _PARTS:
            raise pickle.UnpicklingError(f"{module}.{name} is no part of a compiled function")
        return super().find_class(module, name)
