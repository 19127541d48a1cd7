"""Whether a typed term can be compiled: its size with its derivatives, and whether they are finite and real.

``abs`` and ``sign`` contain their argument twice, so the size of nested calls doubles with every level. A
product grows with the square of its number of factors in the first derivative and with the cube in the
second. A short text can therefore keep symengine busy for hours, while nothing else in the process runs. Two
numbers are bounded:

- the parts of the fully expanded term, counted on the text before symengine processes it: comparing two
  expressions may take that many steps;
- the distinct parts of the value and its derivatives, counted after each derivative: the time to compile is
  proportional to them.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
import symengine as se

from mckibben.physics.errors import InputError
from mckibben.physics.ops import Value

#: Known values by name -> value of the term.
TermFunction = Callable[[Mapping[str, Value]], Value]

# Parts of the fully expanded first derivative: 18 nested abs of a sum, which compile in half a second.
_MOST_WRITTEN = 2**23
# Distinct parts, with their arguments, of the value, its first derivatives and the second that a
# simulation takes: 0.4 s for the largest drive. Eight waves with a friction each have 600.
_MOST_PARTS = 20_000
_FEWER = "use fewer factors, and fewer functions in each other"
_UNREAL = "look for a division by zero, a root or power of a negative number, a number beyond 1e308"
_AT_REST = " at t = 0, at which curves are taken"
_LONGEST_SHOWN = 60


class NoValueError(ArithmeticError):
    """A part of a term has no finite, real value; contains the part."""

    def __init__(self, part: ast.expr) -> None:
        super().__init__()
        self.part = part


class _Size(NamedTuple):
    """Number of parts, written out in full, of a value and of one first derivative."""

    value: int
    derivative: int


def refused(message: str, *, hint: str | None = None) -> InputError:
    """The error of a term that cannot be used."""
    return InputError(message, field="effects.custom.term", hint=hint)


def shown(*, part: ast.expr | str) -> str:
    """A term or a part of it for a message: one line, shortened.

    Raises:
        InputError: the part is nested too deeply to be written.
    """
    try:
        text = part if isinstance(part, str) else ast.unparse(part)
    except RecursionError as error:  # some hundred signs in a row
        raise refused("the term is nested too deeply", hint=_FEWER) from error
    text = " ".join(text.split())
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."


def finite(*, part: ast.expr, evaluate: TermFunction, known: Mapping[str, Value]) -> Value:
    """Value of a part of the term; numbers are floats, also those that symengine simplifies from c/c.

    Exact numbers could grow without bound: ((c + c)/c)**... is a tower of integers.

    Raises:
        NoValueError: there is no finite, real value.
    """
    try:
        with np.errstate(all="ignore"):
            value = evaluate(known)
        if isinstance(value, se.Number) or (isinstance(value, np.ndarray) and not value.ndim):
            value = float(value)
    except NoValueError:
        raise
    except (ArithmeticError, RuntimeError) as error:  # symengine raises the latter
        raise NoValueError(part) from error
    if isinstance(value, complex) or (isinstance(value, int | float) and not math.isfinite(value)):
        raise NoValueError(part)
    return value


@contextmanager
def errors_of_term(*, term: str, where: str = "") -> Iterator[None]:
    """Turn errors in evaluating a term into an error that names the part and the term.

    Args:
        term: as it was typed.
        where: appended to the message, e.g. " at t = 0".
    """
    try:
        yield
    except NoValueError as error:
        part, whole = shown(part=error.part), shown(part=term)
        place = f"'{part}'" if "".join(part.split()) == "".join(whole.split()) else f"'{part}' in '{whole}'"
        raise refused(f"{place} has no finite value{where}", hint=_UNREAL) from error
    except RuntimeError as error:  # of symengine, e.g. the exponential of infinity
        raise refused(f"'{shown(part=term)}' has no finite value{where}", hint=_UNREAL) from error


def check_written_out(*, tree: ast.expr, term: str) -> None:
    """Refuse a term that is too large when expanded with its derivative.

    Args:
        tree: the parsed term, with permitted parts only.
        term: as it was typed.
    """
    if _written(tree).derivative > _MOST_WRITTEN:
        raise refused(
            f"'{shown(part=term)}' is too large: written out in full, its derivative has more than "
            f"{_MOST_WRITTEN} parts",
            hint=_FEWER,
        )


def _written(node: ast.AST) -> _Size:
    if isinstance(node, ast.UnaryOp):
        value, derivative = _written(node.operand)
        return _Size(value + 1, derivative + 1)
    if isinstance(node, ast.BinOp):
        return _written_operation(node)
    if isinstance(node, ast.Call):
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        return _written_call(name, *_written(node.args[0]))
    return _Size(1, 1)


def _written_operation(node: ast.BinOp) -> _Size:
    (a, by_a), (b, by_b) = _written(node.left), _written(node.right)
    value, derivative = a + b + 1, by_a + by_b + 1
    if isinstance(node.op, ast.Mult):
        derivative += a + b + 2
    elif isinstance(node.op, ast.Div):
        derivative += a + 2 * b + 4
    elif isinstance(node.op, ast.Pow):  # every derivative holds another power, and perhaps the logarithm
        value += a
        derivative += 4 * a + 2 * b + 6
    return _Size(value, derivative)


def _written_call(name: str, value: int, derivative: int) -> _Size:
    if name == "abs":
        return _Size(2 * value + 3, derivative + 4 * value + 8)
    if name == "sign":
        return _Size(2 * value + 4, 2 * value + 4)
    if name == "sqrt":  # a power too
        return _Size(2 * value + 1, 2 * value + derivative + 3)
    if name == "tanh":
        return _Size(value + 6, 2 * value + derivative + 12)
    return _Size(value + 1, value + derivative + 3)


def check_derivatives(*, evaluate: TermFunction, names: Iterable[str], term: str) -> None:
    """Refuse a term that, or whose derivatives, are not finite and real or are too large.

    Args:
        evaluate: the term.
        names: the names in the term.
        term: as it was typed.
    """
    symbols: dict[str, Any] = {name: se.Symbol(name) for name in (*names, "direction", "L") if name != "pi"}
    known = symbols | {"pi": math.pi}
    parts = _Parts(term)
    with errors_of_term(term=term):
        value = se.sympify(evaluate(known))
        parts.add(value)
        slopes: dict[str, Any] = {}
        for name, symbol in symbols.items():
            slopes[name] = value.diff(symbol)
            parts.add(slopes[name])
    moving = [symbols[name] for name in ("L", "kappa", "P", "v", "direction") if name in symbols]
    if "t" in symbols:
        with errors_of_term(term=term, where=_AT_REST):
            begin = se.sympify(evaluate(known | {"t": 0.0}))
            at_rest = _Parts(term, _AT_REST)  # separate: comparing equal parts of two expressions is slow
            for part in (begin, *(begin.diff(x) for x in moving)):
                at_rest.add(part)
        moving.append(symbols["t"])
    # With series compliance the tension contains dF/dL, which the integrator differentiates.
    with errors_of_term(term=term):
        for slope in (slopes[name] for name in ("L", "kappa") if name in slopes):
            for symbol in moving:
                parts.add(slope.diff(symbol), real=False)


class _Parts:
    """Counts the distinct parts of expressions, up to a limit."""

    def __init__(self, term: str, where: str = "") -> None:
        self._term, self._where = term, where
        self._seen: set[Any] = set()
        self._count = 0

    def add(self, expression: Any, *, real: bool = True) -> None:
        """Count the new parts of an expression, and check that its numbers are finite and real."""
        left = [expression]
        while left:
            part = left.pop()
            if part in self._seen:
                continue
            self._seen.add(part)
            inside = part.args
            left += inside
            self._count += 1 + len(inside)
            if self._count > _MOST_PARTS:
                raise refused(
                    f"'{shown(part=self._term)}' is too large: with its derivatives it has more than "
                    f"{_MOST_PARTS} parts",
                    hint=_FEWER,
                )
            if real and isinstance(part, se.Number) and not _is_real(part):
                raise refused(f"'{shown(part=self._term)}' has no finite value{self._where}", hint=_UNREAL)


def _is_real(number: Any) -> bool:
    try:
        return math.isfinite(float(number))
    except RuntimeError:  # not real, or zoo: infinite without a sign
        return False
