"""The functions of a structure as machine code on rows of lanes."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.effect import Effect
from mckibben.simulation.integrate.compiling import COMPILING
from mckibben.simulation.integrate.elimination import Plan
from mckibben.simulation.integrate.lane_algebra import algebra_texts
from mckibben.simulation.integrate.lane_writer import lane_writer, lanes_of_machine
from mckibben.simulation.integrate.machine_code import engine_of, texts_of

_LEVEL, _QUICK_LEVEL = 2, 0  # of LLVM's code generator
_ALIGNED = 64  # bytes

Functions = Mapping[str, tuple[Sequence[Any], Sequence[Any]]]


def aligned(*shape: int, zeros: bool = True) -> np.ndarray:
    """An array at an address that rows of lanes may have; of zeros, or of anything."""
    count = math.prod(shape)
    raw = (np.zeros if zeros else np.empty)(count + _ALIGNED // 8)
    address = raw.__array_interface__["data"][0]
    skip = -address % _ALIGNED // 8
    return raw[skip : skip + count].reshape(shape)


class LaneFunction:
    """A compiled function: rows of lanes in, rows of lanes out.

    Attributes:
        address: of ``void f(double* out, const double* in, void*)``; both arrays aligned, one row of lanes
            per variable.
        size, width: number of arguments and of results.
    """

    def __init__(self, engine: Any, name: str, size: int, width: int, lanes: int) -> None:
        self._engine = engine  # owns the code: keeps it alive
        self.address: int = engine.get_function_address(name)
        self.size, self.width, self.lanes = size, width, lanes
        self._call = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)(self.address)

    def __call__(self, given: np.ndarray) -> np.ndarray:
        """Results, shape (width, lanes), of arguments, shape (size, lanes).

        Raises:
            ValueError: another shape.
        """
        if np.shape(given) != (self.size, self.lanes):
            raise ValueError(
                f"arguments of shape {(self.size, self.lanes)} are needed, not {np.shape(given)}"
            )
        packed, results = aligned(self.size, self.lanes), aligned(self.width, self.lanes)
        packed[:] = given
        self._call(results.ctypes.data, packed.ctypes.data, None)
        return results


def lane_code(
    functions: Functions, *, plan: Plan | None = None, lanes: int | None = None, quick: bool = False
) -> dict[str, LaneFunction]:
    """Compile functions together.

    Args:
        functions: name -> (symbols in the order of their rows, expressions).
        plan: adds ``factorise`` and ``solve`` of `mckibben.simulation.integrate.lane_algebra`.
        lanes: numbers in a row; default those of a register of this machine.
        quick: compile in a third of the time code that runs half as fast.

    Raises:
        NotImplementedError: an expression with a function that has no machine code here.
    """
    lanes = lanes or lanes_of_machine()
    texts = texts_of(functions, lane_writer(lanes), quick=quick)
    if plan is not None:
        texts = list(dict.fromkeys([*texts, *algebra_texts(plan, lanes)]))
    engine = engine_of(texts, _QUICK_LEVEL if quick else _LEVEL)
    sizes = {name: (len(arguments), len(results)) for name, (arguments, results) in functions.items()}
    if plan is not None:
        sizes |= {"factorise": (len(plan.places), plan.size), "solve": (plan.size, len(plan.places))}
    return {name: LaneFunction(engine, name, *size, lanes) for name, size in sizes.items()}


class LaneCodes:
    """The functions of a structure on rows of lanes, each compiled when it is first wanted.

    Args:
        functions: as `mckibben.simulation.integrate.system.CompiledDrive.functions`.
        plan: elimination of the structure.
        effects: those of the structure, for messages about a typed term among them.
        quick: see `lane_code`.
    """

    def __init__(
        self, functions: Functions, plan: Plan, effects: Sequence[Effect] = (), *, quick: bool = False
    ) -> None:
        self._functions, self._plan, self._quick, self._effects = functions, plan, quick, effects
        self._step: dict[str, LaneFunction] | None = None
        self._outputs: dict[tuple[int, ...], tuple[LaneFunction, np.ndarray]] = {}

    @property
    def step(self) -> dict[str, LaneFunction]:
        """What a step needs: ``rates``, ``jacobian``, ``factorise`` and ``solve``.

        Raises:
            InputError: a typed term among the effects cannot be compiled.
        """
        with COMPILING, blamed_on_the_term(self._effects):
            if self._step is None:
                wanted = {name: self._functions[name] for name in ("rates", "jacobian")}
                self._step = lane_code(wanted, plan=self._plan, quick=self._quick)
            return self._step

    def outputs(self, chosen: Sequence[int]) -> tuple[LaneFunction, np.ndarray]:
        """A function that computes only these outputs, and the numbers of the arguments it depends on."""
        key = tuple(chosen)
        with COMPILING, blamed_on_the_term(self._effects):
            found = self._outputs.get(key)
            if found is None:
                arguments, results = self._functions["outputs"]
                results = [results[index] for index in key]
                used = set().union(*(result.free_symbols for result in results))
                needs = [index for index, symbol in enumerate(arguments) if symbol in used]
                code = lane_code({"outputs": (arguments, results)}, quick=self._quick)["outputs"]
                found = self._outputs[key] = code, np.array(needs, np.int64)
            return found
