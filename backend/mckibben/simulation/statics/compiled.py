"""From the symbolic model to machine code: symengine builds and differentiates, its LLVM back end compiles.

One structure (one choice of effects) is compiled once, with geometry and parameters as inputs, so changing
a value never compiles. The functions run over whole arrays of states.

Structures that other processes of this machine have compiled before are kept. The key holds the declaration
of the effects, what was asked for, the sources of the physics and the versions. Only structures of built-in
effects are kept; those of a typed term or of a user's effect file depend on more than that, and are
compiled by each process.
"""

from __future__ import annotations

import io
import pickle
import platform
from collections.abc import Callable, Mapping, Sequence
from functools import cache, lru_cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np
import symengine as se

import mckibben.physics
from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.effect import Effect
from mckibben.physics.model import State
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.simulation.kept_code import keep, kept
from mckibben.simulation.statics.symbolic import INPUTS, symbolic_state

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


# Exact derivatives after the fields of State, as (field, input).
DERIVATIVES = (
    ("force", "length"),
    ("force", "pressure"),
    ("tension", "length"),
    ("tension", "pressure"),
    ("length", "length"),
    ("volume", "length"),
    ("volume", "pressure"),
)
OUTPUTS = (*State._fields, *(f"{field}_by_{by}" for field, by in DERIVATIVES))
# The compiled function holds the interpreter lock: short calls let other threads run in between.
_ROWS_AT_ONCE = 20_000


class CompiledState:
    """`Model.evaluate` and its exact derivatives as machine code.

    Args:
        effects: the effects of the structure.
        gradient: names to differentiate by: geometry fields, "effect.parameter" or (with memory)
            "effect.state". Each adds the outputs d force, d tension, d length, d compliance, in this order.
        memory: whether the states of the muscle's effects are inputs of each row; else they are at rest.
        quick: compile in half the time, for structures used once; each row then takes 1.6 times as long.

    Attributes:
        constants: names of geometry and parameters, in the order in which they are packed.
        inputs: names of what varies from row to row; `INPUTS` and then the states ("effect.state").
    """

    def __init__(
        self,
        effects: tuple[Effect, ...],
        gradient: Sequence[str] = (),
        *,
        memory: bool = False,
        quick: bool = False,
    ) -> None:
        symbolic = symbolic_state(effects, memory=memory)
        self.constants = tuple(symbolic.constants)
        self.inputs = (*INPUTS, *symbolic.states)
        symbols = [
            *symbolic.inputs.values(), *symbolic.states.values(), *symbolic.constants.values()
        ]  # fmt: skip

        def build() -> Any:
            fields = symbolic.fields
            outputs = [*fields, *(symbolic.by(field, name) for field, name in DERIVATIVES)]
            named = {**symbolic.constants, **symbolic.states}
            for name in gradient:
                chosen = (fields.force, fields.tension, fields.length, fields.compliance)
                outputs += [output.diff(named[name]) for output in chosen]
            return se.Lambdify(symbols, outputs, backend="llvm", cse=True, opt_level=0 if quick else 3)

        self._function = kept_or_compiled(effects, (tuple(gradient), memory, quick), build)
        self._width = len(symbols)
        self.compliant = symbolic.model.has("compliance")

    def pack(self, muscle: Muscle, values: Mapping[str, Mapping[str, float]]) -> np.ndarray:
        """Geometry and parameters in the order of `constants`."""
        numbers = [getattr(muscle, name) for name in GEOMETRY]
        for name in self.constants[len(GEOMETRY) :]:
            effect, parameter = name.split(".")
            numbers.append(values[effect][parameter])
        return np.array(numbers, dtype=float)

    def __call__(self, constants: np.ndarray, **inputs: Any) -> np.ndarray:
        """Outputs as an array of shape (number of outputs, rows).

        ``inputs`` holds every name of `inputs`, as numbers or arrays that broadcast to one dimension.
        """
        columns = [inputs[name] for name in self.inputs]
        sizes = [1 if isinstance(column, int | float) else np.size(column) for column in columns]
        rows = np.empty((max(sizes), self._width))
        for index, column in enumerate(columns):
            rows[:, index] = column
        rows[:, len(self.inputs) :] = constants
        if len(rows) <= _ROWS_AT_ONCE:
            return np.ascontiguousarray(self._function(rows).T)
        pieces = (rows[begin : begin + _ROWS_AT_ONCE] for begin in range(0, len(rows), _ROWS_AT_ONCE))
        return np.concatenate([self._function(piece).T for piece in pieces], axis=1)


@lru_cache(maxsize=1024)
def compiled_state(
    effects: tuple[Effect, ...], gradient: tuple[str, ...] = (), *, memory: bool = False, quick: bool = False
) -> CompiledState:
    """The compiled structure, built once on a machine (10 to 50 ms) and kept.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(effects):
        return CompiledState(effects, gradient, memory=memory, quick=quick)
