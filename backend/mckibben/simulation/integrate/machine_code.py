"""Machine code of symbolic expressions, by way of LLVM's intermediate language.

symengine can compile its expressions itself; for functions of this size that takes three to four times as
long. Here every expression becomes straight-line code without a branch (a ``Piecewise`` is a select), which
LLVM's fast instruction selection turns into good code in a few milliseconds.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import struct
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache, partial
from typing import Any

import numpy as np
import symengine as se

from mckibben.simulation.integrate.invariants import is_invariant
from mckibben.simulation.kept_code import keep, kept

# Function of symengine -> function for LLVM to call; those without a dot are from the C library.
_FUNCTIONS = {
    "sin": "llvm.sin.f64", "cos": "llvm.cos.f64", "log": "llvm.log.f64", "Abs": "llvm.fabs.f64",
    "tan": "tan", "asin": "asin", "acos": "acos", "atan": "atan", "sinh": "sinh", "cosh": "cosh",
    "tanh": "tanh",
}  # fmt: skip
_LIBRARY = ("sin", "cos", "log", "exp", "pow", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
_COMPARISONS = {"StrictLessThan": "olt", "LessThan": "ole", "Equality": "oeq", "Unequality": "une"}
# Largest integer exponent that is expanded into multiplications.
_MOST_FACTORS = 32
# Calls within calls while an expression is written; a typed term of 38 nested functions needs a thousand.
_DEEPEST = 5000
# Exponents of reciprocals.
_RECIPROCALS = (se.Integer(-1), se.Rational(-1, 2))


class Function:
    """A compiled function: a row of numbers in, a row of numbers out.

    Attributes:
        address: of ``void f(double* out, const double* in, void*)``.
        size: number of arguments.
        width: number of results.
    """

    def __init__(self, engine: Any, name: str, size: int, width: int) -> None:
        self._engine = engine  # owns the code: keeps it alive
        self.address: int = engine.get_function_address(name)
        self.size, self.width = size, width
        self._call = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)(self.address)

    def __call__(self, given: np.ndarray) -> np.ndarray:
        """Results as an array of shape (width,).

        Raises:
            ValueError: not ``size`` arguments.
        """
        packed, results = np.ascontiguousarray(given, dtype=np.float64), np.empty(self.width)
        if packed.shape != (self.size,):
            raise ValueError(f"{self.size} arguments are needed, not {packed.shape}")
        self._call(results.ctypes.data, packed.ctypes.data, None)
        return results

    def bound(self, given: np.ndarray, results: np.ndarray) -> Callable[[], None]:
        """Calls it with what is in one array, and writes the results to another one; both stay in place.

        Raises:
            ValueError: arrays that are not of ``size`` and ``width`` numbers in a row.
        """
        for array, count in ((given, self.size), (results, self.width)):
            if array.shape != (count,) or array.dtype != np.float64 or not array.flags.c_contiguous:
                raise ValueError(f"{count} numbers in a row are needed, not {array.shape}")
        return partial(self._call, results.ctypes.data, given.ctypes.data, None)


def machine_code(
    functions: Mapping[str, tuple[Sequence[Any], Sequence[Any]]], *, level: int = 0
) -> dict[str, Function]:
    """Compile functions together.

    Args:
        functions: name -> (symbols in the order of their packed values, expressions).
        level: level of LLVM's code generator, 0 to 3. Level 1 compiles in twice the time, and its code runs
            1.5 to 2 times as fast; higher levels gain nothing.

    Raises:
        NotImplementedError: an expression with a function that has no machine code here.
    """
    engine = engine_of(texts_of(functions, Writer), level)
    return {
        name: Function(engine, name, len(arguments), len(results))
        for name, (arguments, results) in functions.items()
    }


def texts_of(
    functions: Mapping[str, tuple[Sequence[Any], Sequence[Any]]],
    writer_of: Callable[[Sequence[Any], Mapping[Any, Any]], Writer],
    *,
    quick: bool = False,
) -> list[str]:
    """LLVM's text of functions that share their common subexpressions, with the declarations it needs.

    Args:
        functions: as of `machine_code`.
        writer_of: makes the writer of a function.
        quick: share equal subexpressions only, not also common parts of sums and products: twice the code
            in a third of the time.
    """
    wanted = [se.sympify(result) for _, results in functions.values() for result in results]
    shared, reduced = ([], wanted) if quick else se.cse(wanted)
    left, texts, declared = iter(reduced), [], set()
    with _nested():
        for name, (arguments, results) in functions.items():
            writer = writer_of(arguments, dict(shared))
            texts.append(writer.function(name, [next(left) for _ in results]))
            declared |= writer.declared
    return [*texts, *sorted(declared)]


@contextmanager
def _nested() -> Iterator[None]:
    """Allow writers to follow expressions that are nested as deeply as typed terms may be."""
    usual = sys.getrecursionlimit()
    sys.setrecursionlimit(max(usual, _DEEPEST))
    try:
        yield
    finally:
        sys.setrecursionlimit(usual)


def engine_of(texts: Sequence[str], level: int) -> Any:
    """The compiled code of texts, for this machine."""
    import llvmlite
    import llvmlite.binding as llvm

    text, target = "\n".join(texts), _host(level)
    key = f"{llvmlite.__version__} {target.triple} {level}\n{text}".encode()
    code = kept(key)
    if code is not None:
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target)
        engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    else:
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(text), target)
        engine.set_object_cache(notify_func=lambda _, made: keep(key, made))
    engine.finalize_object()
    return engine


@cache
def _ready() -> Any:
    """The target of this machine, with the C library's functions registered."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    library = ctypes.CDLL(ctypes.util.find_library("m") or "ucrtbase")
    for name in _LIBRARY:
        llvm.add_symbol(name, ctypes.cast(getattr(library, name), ctypes.c_void_p).value)
    return llvm.Target.from_default_triple()


def _host(level: int) -> Any:
    """A target machine; each compilation needs a new one."""
    import llvmlite.binding as llvm

    target = _ready()
    features = llvm.get_host_cpu_features().flatten()
    return target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=features, opt=level)


class Writer:
    """Writes the code of one function; equal expressions are computed once.

    Attributes:
        real, truth: LLVM's types of a value and of a condition.
        lanes: numbers in a value.
        declared: declarations that the text of `function` needs.
    """

    real, truth, lanes = "double", "i1", 1

    def __init__(self, arguments: Sequence[Any], shared: Mapping[Any, Any]) -> None:
        self._index = {symbol: index for index, symbol in enumerate(arguments)}
        self._shared = shared
        self._lines: list[str] = []
        self._known: dict[Any, str] = {}
        self._conditions: dict[Any, str] = {}
        self._block = "begin"  # that the lines are in
        self.declared: set[str] = set()

    def function(self, name: str, results: Sequence[Any]) -> str:
        """The code; `declared` then holds the declarations it needs."""
        for index, result in enumerate(results):
            value = self._value(result)
            place = self._new(f"getelementptr {self.real}, ptr %out, i64 {index}")
            self._lines.append(f"store {self.real} {value}, ptr {place}")
        body = "\n".join(["begin:", *self._lines])
        return f"define void @{name}(ptr noalias %out, ptr noalias %in, ptr %data) {{\n{body}\nret void\n}}"

    def _new(self, text: str) -> str:
        name = f"%t{len(self._lines)}"
        self._lines.append(f"{name} = {text}")
        return name

    def _binary(self, operation: str, a: str, b: str) -> str:
        return self._new(f"{operation} contract {self.real} {a}, {b}")

    def _number(self, value: float) -> str:
        """A constant."""
        return number(value)

    def _call(self, function: str, *arguments: str) -> str:
        self.declared.add(f"declare double @{function}({', '.join(['double'] * len(arguments))})")
        return self._new(f"call double @{function}({', '.join(f'double {a}' for a in arguments)})")

    def _value(self, expression: Any) -> str:
        known = self._known.get(expression)
        if known is None:
            known = self._known[expression] = self._computed(expression)
        return known

    def _computed(self, expression: Any) -> str:
        kind = type(expression).__name__
        if kind == "Mul":  # the most frequent first: each question to symengine takes its time
            return self._product(expression.args)
        if kind == "Add":
            return self._folded("fadd", expression.args)
        if kind == "Pow":
            return self._power(*expression.args)
        if expression.is_Symbol:
            if expression in self._shared:
                return self._value(self._shared[expression])
            place = self._new(f"getelementptr {self.real}, ptr %in, i64 {self._index[expression]}")
            return self._new(f"load {self.real}, ptr {place}")
        if not expression.args or expression.is_Number:
            return self._number(float(expression.n(53, real=True)))
        if kind == "Piecewise":
            branches = list(zip(expression.args[0::2], expression.args[1::2], strict=True))
            value = self._value(branches[-1][0])
            for branch, condition in reversed(branches[:-1]):
                value = self._select(condition, self._value(branch), value)
            return value
        if kind in ("Max", "Min"):
            return self._extreme("ogt" if kind == "Max" else "olt", expression.args)
        if kind in _FUNCTIONS:
            return self._call(_FUNCTIONS[kind], self._value(expression.args[0]))
        raise NotImplementedError(f"there is no machine code for {kind}")

    def _select(self, condition: Any, yes: str, no: str) -> str:
        return self._chosen(self._condition(condition), yes, no)

    def _chosen(self, condition: str, yes: str, no: str) -> str:
        return self._new(f"select {self.truth} {condition}, {self.real} {yes}, {self.real} {no}")

    def _comparison(self, kind: str, a: str, b: str) -> str:
        return self._new(f"fcmp {kind} {self.real} {a}, {b}")

    def _extreme(self, comparison: str, arguments: Sequence[Any]) -> str:
        value, *others = map(self._value, arguments)
        for other in others:
            value = self._chosen(self._comparison(comparison, value, other), value, other)
        return value

    def _folded(self, operation: str, arguments: Sequence[Any]) -> str:
        value, *others = map(self._value, arguments)
        for other in others:
            value = self._binary(operation, value, other)
        return value

    def _product(self, factors: Sequence[Any]) -> str:
        """A product with at most one division, besides those of reciprocals that serve several times.

        The derivative of a power has its exponent as a factor: where such a constant of the run is 0, the
        power is not computed.
        """
        gate = next(filter(is_invariant, factors), None)
        if gate is None or not any(map(self._is_own_power, factors)):
            return self._whole_product(factors)
        for factor in factors:
            self._value(factor.args[0] if self._is_own_power(factor) else factor)
        return self._unless_zero([gate], lambda: self._whole_product(factors), 0.0)

    def _whole_product(self, factors: Sequence[Any]) -> str:
        above, below = [], []
        for factor in factors:
            base, exponent = factor.args if type(factor).__name__ == "Pow" else (factor, None)
            if exponent is not None and exponent in _RECIPROCALS and factor not in self._known:
                below.append(base**-exponent)
            else:
                above.append(factor)
        value = self._folded("fmul", above) if above else self._number(1.0)
        return self._binary("fdiv", value, self._folded("fmul", below)) if below else value

    def _power(self, base: Any, exponent: Any) -> str:
        if base == se.E:
            gates = self._gates(exponent)
            return self._unless_zero(gates, lambda: self._call("llvm.exp.f64", self._value(exponent)), 1.0)
        if exponent.is_Number:
            power = float(exponent)
            if power < 0.0:
                return self._reciprocal(base, exponent)
            whole = int(power)
            if power - whole in (0.0, 0.5) and whole <= _MOST_FACTORS:
                root = self._call("llvm.sqrt.f64", self._value(base)) if power > whole else None
                raised = self._whole_power(self._value(base), whole) if whole else None
                if root is None or raised is None:
                    return root or raised or self._number(1.0)
                return self._binary("fmul", raised, root)
        given = self._value(base), self._value(exponent)
        return self._unless_zero(self._gates(exponent), lambda: self._call("llvm.pow.f64", *given), 1.0)

    def _gates(self, exponent: Any) -> list[Any]:
        """Constants of a run, one a factor of each term of an exponent; none where a term has none.

        Such are the exponents of effects: 0 where the term is not in use, and the power is 1. What the
        logarithms in it are of is computed here, so that others may share it.
        """
        exponent = self._shared.get(exponent, exponent)
        kind = type(exponent).__name__
        if kind == "Add":
            found = [self._gates(term) for term in exponent.args]
            return list(dict.fromkeys(gate for gates in found for gate in gates)) if all(found) else []
        factors = exponent.args if kind == "Mul" else (exponent,)
        gate = next((each for each in factors if is_invariant(each)), None)
        if gate is None:
            return []
        for factor in factors:
            meant = self._shared.get(factor, factor)
            self._value(meant.args[0] if type(meant).__name__ == "log" else factor)
        return [gate]

    def _is_own_power(self, factor: Any) -> bool:
        """Whether a factor is a power that takes long and serves this product alone: no other shares it."""
        return type(factor).__name__ == "Pow" and not factor.args[1].is_Number and factor not in self._known

    def _unless_zero(self, gates: Sequence[Any], compute: Callable[[], str], otherwise: float) -> str:
        """A value, which is not computed where all gates are 0, in all lanes, but known."""
        if not gates:
            return compute()
        zero = self._number(0.0)
        used = [self._any_lane(self._comparison("une", self._value(gate), zero)) for gate in gates]
        some = used[0]
        for each in used[1:]:
            some = self._new(f"or i1 {some}, {each}")
        before, number = self._block, len(self._lines)
        inside, behind = f"inside{number}", f"behind{number}"
        self._lines += [f"br i1 {some}, label %{inside}, label %{behind}", f"{inside}:"]
        known, conditions, self._block = dict(self._known), dict(self._conditions), inside
        value, last = compute(), self._block
        self._known, self._conditions = known, conditions  # what is computed inside is not to be had behind
        self._lines += [f"br label %{behind}", f"{behind}:"]
        self._block = behind
        return self._new(f"phi {self.real} [ {value}, %{last} ], [ {self._number(otherwise)}, %{before} ]")

    def _any_lane(self, condition: str) -> str:
        """Whether a condition holds in any lane."""
        return condition

    def _reciprocal(self, base: Any, exponent: Any) -> str:
        """A negative power; divisions are slow, so all negative powers of a base share one."""
        halves = -2.0 * float(exponent)
        root = _RECIPROCALS[0] if halves % 2.0 == 0.0 else _RECIPROCALS[1]
        if exponent == root or halves % 1.0 or halves > _MOST_FACTORS:
            return self._binary("fdiv", self._number(1.0), self._value(base**-exponent))
        factors = int(halves) // 2 if root == _RECIPROCALS[0] else int(halves)
        return self._whole_power(self._value(base**root), factors)

    def _whole_power(self, base: str, power: int) -> str:
        if power == 1:
            return base
        half = self._whole_power(base, power // 2)
        square = self._binary("fmul", half, half)
        return self._binary("fmul", square, base) if power % 2 else square

    def _condition(self, condition: Any) -> str:
        known = self._conditions.get(condition)
        if known is None:
            known = self._conditions[condition] = self._compared(condition)
        return known

    def _truth(self, value: bool) -> str:
        return "true" if value else "false"

    def _compared(self, condition: Any) -> str:
        kind = type(condition).__name__
        if kind in ("BooleanTrue", "BooleanFalse"):
            return self._truth(kind == "BooleanTrue")
        if condition.is_Symbol:  # a condition that is shared
            return self._condition(self._shared[condition])
        if kind == "Equality" and condition.args[1] == se.true:
            return self._condition(condition.args[0])
        if kind in _COMPARISONS:
            a, b = map(self._value, condition.args)
            return self._comparison(_COMPARISONS[kind], a, b)
        if kind in ("And", "Or"):
            value, *others = map(self._condition, condition.args)
            for other in others:
                value = self._new(f"{kind.lower()} {self.truth} {value}, {other}")
            return value
        if kind == "Not":
            return self._new(f"xor {self.truth} {self._condition(condition.args[0])}, {self._truth(True)}")
        raise NotImplementedError(f"there is no machine code for the condition {kind}")


def number(value: float) -> str:
    """A constant, bit by bit."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}"
